//! The number types of texels.

use crate::physics::num::{Half, Num};

/// The number type of a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// 8 bits, i/255 for 0 to 1.
    Unorm8,
    /// binary16: 11 significant bits.
    Half,
    /// 16 bits, i/65535 for 0 to 1. GLES and WebGPU sample it only with an extension.
    Unorm16,
    /// binary32. GLES and WebGPU filter it only with an extension.
    Float,
}

impl Depth {
    /// All depths, the smallest first; of equal sizes, the one that more devices can filter.
    pub const ALL: [Depth; 4] = [Depth::Unorm8, Depth::Half, Depth::Unorm16, Depth::Float];

    /// The name in reports, the bytes of a texel, and the largest integer.
    fn row(self) -> (&'static str, usize, Option<f32>) {
        match self {
            Depth::Unorm8 => ("unorm8", 4, Some(255.0)),
            Depth::Half => ("half", 8, None),
            Depth::Unorm16 => ("unorm16", 8, Some(65_535.0)),
            Depth::Float => ("float", 16, None),
        }
    }

    /// The name in reports.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// Bytes of a texel in GPU memory, where it has four channels.
    pub fn bytes(self) -> usize {
        self.row().1
    }

    /// The largest integer, for integer depths.
    pub fn largest(self) -> Option<f32> {
        self.row().2
    }

    /// The nearest value, as a sampler returns it. An integer depth holds only 0 to 1.
    pub fn nearest(self, value: f64) -> f32 {
        match self {
            Depth::Half => Half::from_f64(value).to_f32(),
            Depth::Float => value as f32,
            Depth::Unorm8 | Depth::Unorm16 => {
                let largest = self.largest().unwrap_or(1.0);
                let steps = value.clamp(0.0, 1.0) * f64::from(largest);
                steps.round() as f32 / largest
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_depth_rounds_to_its_nearest() {
        for (depth, value, want) in [
            (Depth::Unorm8, 0.5, 128.0 / 255.0),
            (Depth::Unorm8, 1.2, 1.0),
            (Depth::Unorm8, -0.1, 0.0),
            (Depth::Unorm8, f64::NAN, f32::NAN),
            (Depth::Unorm16, 0.25, 16384.0 / 65535.0),
            (Depth::Half, 1.0 + 0.000_6, 1.000_976_6),
            (Depth::Half, 0.1, 0.099_975_586),
            (Depth::Float, 0.1, 0.1),
            (Depth::Float, 1.06, 1.06),
        ] {
            let got = depth.nearest(value);
            assert!(
                got == want || got.is_nan() && want.is_nan(),
                "{depth:?} {value}: {got}"
            );
        }
    }
}
