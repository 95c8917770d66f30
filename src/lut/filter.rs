//! The filter: what a linear sampler that clamps to the edge gives back for a cosine.
//!
//! The coordinate is computed as a shader does, in binary32 and unfused. A GPU then keeps eight bits of the place
//! between two texels (Vulkan's `subPixelPrecisionBits` and Direct3D's 8-bit fraction), so that weights are whole
//! 1/256; the mix itself is binary32. Source: Microsoft, *Direct3D 11.3 Functional Specification*, section 7.18.8, 2015,
//! <https://microsoft.github.io/DirectX-Specs/d3d/archive/D3D11_3_FunctionalSpec.htm>.

use crate::num::Num;

use super::axis::Axis;
use super::depth::Stored;

/// How finely the place between two texels is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// As finely as the coordinate.
    Exact,
    /// In steps of 1/256, as GPUs do.
    Steps256,
}

impl Stored {
    /// The filtered lookup at a cosine, scale included. A NaN is looked up at 0.
    pub fn lookup(&self, weights: Weights, cos_theta: f32) -> [f32; 3] {
        self.sample(weights, self.coordinate(cos_theta))
            .map(|value| value * self.scale)
    }

    /// u of a cosine: clamped, warped, and half a texel left at each end.
    pub fn coordinate(&self, cos_theta: f32) -> f32 {
        let (scale, offset) = Axis::half_texel(self.texels.len());
        self.axis.warp(cos_theta.saturate()) * scale as f32 + offset as f32
    }

    /// What a sampler gives at u, before the scale.
    pub fn sample(&self, weights: Weights, u: f32) -> [f32; 3] {
        let last = self.texels.len().saturating_sub(1);
        let place = f64::from(u) * self.texels.len() as f64 - 0.5;
        let place = match weights {
            Weights::Exact => place,
            Weights::Steps256 => (place * 256.0).round() / 256.0,
        };
        // A NaN is the first texel.
        let place = if place > 0.0 {
            place.min(last as f64)
        } else {
            0.0
        };
        let left = place.floor();
        let share = (place - left) as f32;
        let texel = |i: usize| self.texels.get(i.min(last)).copied().unwrap_or_default();
        let (a, b) = (texel(left as usize), texel(left as usize + 1));
        [0, 1, 2].map(|i| a[i] * (1.0 - share) + b[i] * share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lut::depth::Depth;

    fn ramp(axis: Axis, texels: usize) -> Stored {
        let value = |i: usize| [i as f32, 2.0 * i as f32, 1.0];
        Stored {
            axis,
            depth: Depth::Float,
            scale: 1.0,
            texels: (0..texels).map(value).collect(),
        }
    }

    #[test]
    fn ends_and_centres_are_hit() {
        for axis in Axis::ALL {
            for texels in [2, 3, 64, 255, 256, 1000, 16_384] {
                let ramp = ramp(axis, texels);
                for weights in [Weights::Exact, Weights::Steps256] {
                    let last = (texels - 1) as f32;
                    let at = |c: f32| ramp.lookup(weights, c)[0];
                    // u has 24 bits, of which the number of texels takes some.
                    let within = last * 4e-7;
                    assert!(at(0.0) <= within && at(-1.0) <= within && at(f32::NAN) <= within);
                    assert!((at(1.0) - last).abs() <= within && (at(2.0) - last).abs() <= within);
                }
                for i in [0, 1, texels / 2, texels - 1] {
                    let c = axis.cosine(i as f64 / (texels - 1) as f64) as f32;
                    let got = ramp.lookup(Weights::Steps256, c);
                    assert_eq!(got, ramp.texels[i], "{axis:?} {texels} {i}");
                }
            }
        }
    }

    #[test]
    fn between_centres_it_mixes() {
        let ramp = ramp(Axis::Cos, 5);
        let at = |weights, c| ramp.lookup(weights, c)[0];
        assert!((at(Weights::Exact, 0.3) - 1.2).abs() < 1e-6);
        // 1.2 lies between 307/256 and 308/256.
        assert_eq!(at(Weights::Steps256, 0.3), 307.0 / 256.0);
    }

    #[test]
    fn an_empty_table_is_black() {
        assert_eq!(ramp(Axis::Cos, 0).lookup(Weights::Exact, 0.5), [0.0; 3]);
    }

    #[test]
    fn the_usual_mistakes_are_seen() {
        // A table whose ends differ: without the half texel, and with repeat in place of clamp, its ends are wrong.
        let ramp = ramp(Axis::Cos, 8);
        let naive = ramp.sample(Weights::Exact, 0.25)[0];
        assert!((naive - 7.0 * 0.25).abs() > 0.2, "{naive}");
        let flipped = ramp.lookup(Weights::Exact, 1.0 - 0.25)[0];
        assert!((flipped - 7.0 * 0.25).abs() > 3.0);
    }
}
