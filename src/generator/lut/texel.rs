//! The texels of a table: their number types, how many there may be, and the errors of tables.

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

/// The fewest texels: one at each end.
pub const LEAST_TEXELS: usize = 2;
/// The most texels: the longest side of a texture that all today's GPUs take (Direct3D 11's limit; WebGL 2 asks for 2048).
pub const MOST_TEXELS: usize = 16_384;

/// The most texels per side: errors fall with the square of the size, and from 256 on half precision dominates.
const MOST_SIDE: usize = 1024;

/// Refuses a number of texels that a texture cannot have.
///
/// # Errors
/// Fewer than [`LEAST_TEXELS`], or more than `MOST_TEXELS`.
pub fn check_size(texels: usize) -> Result<(), Error> {
    if (LEAST_TEXELS..=MOST_TEXELS).contains(&texels) {
        Ok(())
    } else {
        Err(Error::Size { texels })
    }
}

/// Refuses a side that a table cannot have.
///
/// # Errors
/// Fewer than [`LEAST_TEXELS`], or more than a texture may have.
pub fn check_side(size: usize) -> Result<(), Error> {
    if (LEAST_TEXELS..=MOST_SIDE).contains(&size) {
        Ok(())
    } else {
        Err(Error::Side { size })
    }
}

/// An invalid request for a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A size that no texture can have.
    #[error("a table of {texels} texels cannot be: it has 2 to 16384")]
    Size {
        /// The size.
        texels: usize,
    },
    /// No table is good enough.
    #[error(
        "no table meets an error of {budget:?}: the best of {tried} reaches {best:.2e}, with 8-bit filtering weights and up to 16384 texels. Allow more, or more axes and formats"
    )]
    Budget {
        /// The largest error allowed.
        budget: f64,
        /// The least error reached.
        best: f64,
        /// The axes and depths that were tried.
        tried: String,
    },
    /// A size that a split-sum table cannot have.
    #[error("a split-sum table of {size} texels a side cannot be: it has 2 to {MOST_SIDE}")]
    Side {
        /// The size.
        size: usize,
    },
    /// An encoder refused.
    #[error("the table cannot be written as {format}: {why}")]
    Encode {
        /// The format's name.
        format: &'static str,
        /// The encoder's reason.
        why: String,
    },
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
