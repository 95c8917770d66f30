//! Textures: texels, and the filter, which is what sampling them means.
//!
//! A linear sampler that clamps to the edge mixes the four texels whose centres lie around a place; the centre of texel
//! i of N lies at u = (i + 1/2)/N. GPUs keep eight bits of the place between two centres (Vulkan's
//! `subPixelPrecisionBits` and Direct3D's 8-bit fraction), so that weights are whole 1/256. Source: Microsoft,
//! *Direct3D 11.3 Functional Specification*, section 7.18.8, 2015,
//! <https://microsoft.github.io/DirectX-Specs/d3d/archive/D3D11_3_FunctionalSpec.htm>.

use std::sync::Arc;

use crate::num::{Num, each_channel};

/// How finely the place between two texels is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// As finely as the coordinate.
    Exact,
    /// In steps of 1/256, as GPUs do.
    Steps256,
}

/// The texels of a texture as a sampler gives them back.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels {
    /// In a row.
    pub width: usize,
    /// The rows one after the other, that at v = 0 first.
    pub texels: Arc<[[f32; 3]]>,
}

/// The texels before and after a place, and how far it lies between them.
struct TexelPair<N> {
    before: usize,
    after: usize,
    share: N,
}

impl Texels {
    /// One row.
    #[inline]
    pub fn row(texels: &[[f32; 3]]) -> Texels {
        Texels {
            width: texels.len(),
            texels: texels.into(),
        }
    }

    /// How many rows there are.
    #[inline]
    pub fn height(&self) -> usize {
        self.texels.len().checked_div(self.width).unwrap_or(0)
    }

    /// What a sampler gives at (u, v). A NaN is the first texel; where there are no texels all is black.
    #[inline]
    pub fn sample<N: Num>(&self, weights: Weights, u: N, v: N) -> [N; 3] {
        let row = |row: usize| {
            let start = row * self.width;
            let texels = self.texels.get(start..start + self.width);
            filtered(texels.unwrap_or_default(), weights, u)
        };
        if self.height() < 2 {
            return row(0);
        }
        let down = between(weights, v, self.height());
        mixed(row(down.before), row(down.after), down.share)
    }
}

/// What a sampler gives at u in one row of texels.
#[inline]
pub fn filtered<N: Num>(texels: &[[f32; 3]], weights: Weights, u: N) -> [N; 3] {
    let across = between(weights, u, texels.len());
    let texel = |column: usize| {
        let texel = texels.get(column).copied().unwrap_or_default();
        each_channel(|i| N::from_f64(f64::from(texel[i])))
    };
    mixed(texel(across.before), texel(across.after), across.share)
}

/// a (1 - share) + b share
#[inline]
fn mixed<N: Num>(a: [N; 3], b: [N; 3], share: N) -> [N; 3] {
    let rest = N::from_f64(1.0) - share;
    each_channel(|i| a[i] * rest + b[i] * share)
}

/// Where a coordinate lies among so many centres.
#[inline]
fn between<N: Num>(weights: Weights, coordinate: N, count: usize) -> TexelPair<N> {
    let last = count.saturating_sub(1);
    let number = |value: usize| N::from_f64(value as f64);
    let place = coordinate * number(count) - N::from_f64(0.5);
    let place = match weights {
        Weights::Exact => place,
        Weights::Steps256 => N::from_f64((place.to_f64() * 256.0).round() / 256.0),
    };
    // The smaller and the larger of a NaN and a number are the number.
    let place = place.max(number(0)).min(number(last));
    let before = place.to_f64().floor() as usize;
    TexelPair {
        before,
        after: (before + 1).min(last),
        share: place - number(before),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_between_four_centres_mixes_them() {
        let texels = Texels {
            width: 2,
            texels: [[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]].into(),
        };
        for (u, v, want) in [
            (0.25, 0.25, 0.0),
            (0.75, 0.25, 1.0),
            (0.25, 0.75, 2.0),
            (0.5, 0.5, 1.5),
            (-1.0, 9.0, 2.0),
            (f64::NAN, 0.25, 0.0),
        ] {
            for weights in [Weights::Exact, Weights::Steps256] {
                assert_eq!(texels.sample(weights, u, v), [want; 3], "{u} {v}");
            }
        }
        let third = texels.sample(Weights::Steps256, 0.25 + 0.5 / 3.0, 0.25);
        assert_eq!(third, [85.0 / 256.0; 3]);
        assert_eq!(Texels::row(&[]).sample(Weights::Exact, 0.5, 0.5), [0.0; 3]);
    }
}
