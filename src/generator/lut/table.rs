//! A table: reflectance at the centres of texels along an axis, the same rounded to a depth ([`Stored`]), and its filtered lookup.
//!
//! The lookup is that of a linear sampler that clamps to the edge. The coordinate is computed as in a shader, in binary32 and
//! unfused. The texels are then mixed by [`filtered`].

use super::axis::TableAxis;
use super::texel::{Depth, Error, check_size};
use crate::generator::reference::ReferenceCurve;
use crate::language::ir::{Weights, filtered};
use crate::physics::num::{Num, each_channel};

/// Reflectance along an axis, cos θ = 0 first.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The material's name, followed by `_in_` and the medium's name if there is one.
    pub name: String,
    /// The axis of cosines.
    pub axis: TableAxis,
    /// Red, green and blue at each texel's centre, linear, in the gamut of the reference.
    pub texels: Vec<[f64; 3]>,
}

impl Table {
    /// The table of a reference.
    ///
    /// # Errors
    /// A size that no texture has: see [`check_size`].
    pub fn new(
        name: &str,
        reference: &ReferenceCurve,
        axis: TableAxis,
        texels: usize,
    ) -> Result<Table, Error> {
        check_size(texels)?;
        let texel = |i: usize| reference.at(centre(axis, i as f64, texels));
        Ok(Table {
            name: name.to_owned(),
            axis,
            texels: (0..texels).map(texel).collect(),
        })
    }

    /// The factor to store with tables in a depth: 1, or for integers the largest channel of all where that is above 1, rounded
    /// up to binary32.
    pub fn shared_scale(tables: &[&Table], depth: Depth) -> f32 {
        if depth.largest().is_none() {
            return 1.0;
        }
        let texels = tables.iter().flat_map(|table| &table.texels);
        let most = texels.flatten().copied().fold(1.0, f64::max);
        let near = most as f32;
        if f64::from(near) < most {
            near.next_up()
        } else {
            near
        }
    }
}

/// The cosine at the centre of a texel, or between two.
pub(super) fn centre(axis: TableAxis, texel: f64, texels: usize) -> f64 {
    axis.cosine(texel / (texels - 1) as f64)
}

/// A table as stored in a GPU texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Stored {
    /// The axis of cosines.
    pub axis: TableAxis,
    /// The number type.
    pub depth: Depth,
    /// value = texel × scale.
    pub scale: f32,
    /// The value of each texel that a sampler returns.
    pub texels: Vec<[f32; 3]>,
}

impl Stored {
    /// A table divided by its own scale and rounded.
    pub fn new(table: &Table, depth: Depth) -> Stored {
        Stored::scaled(table, depth, Table::shared_scale(&[table], depth))
    }

    /// A table divided by a scale that it may share with others, and rounded.
    pub fn scaled(table: &Table, depth: Depth, scale: f32) -> Stored {
        let rounded = |value: f64| depth.nearest(value / f64::from(scale));
        Stored {
            axis: table.axis,
            depth,
            scale,
            texels: table
                .texels
                .iter()
                .map(|texel| texel.map(rounded))
                .collect(),
        }
    }

    /// The filtered lookup at a cosine, scale included. A NaN is looked up at 0.
    pub fn lookup(&self, weights: Weights, cos_theta: f32) -> [f32; 3] {
        self.scaled_sample(weights, self.coordinate(cos_theta))
    }

    /// The filtered lookup at u, scale included.
    pub fn scaled_sample(&self, weights: Weights, u: f32) -> [f32; 3] {
        let sampled = self.sample(weights, u);
        each_channel(|i| sampled[i] * self.scale)
    }

    /// u of a cosine: clamped, warped, and inset by half a texel at each end.
    pub fn coordinate(&self, cos_theta: f32) -> f32 {
        let (scale, offset) = TableAxis::half_texel(self.texels.len());
        self.axis.warp(cos_theta.saturate()) * scale as f32 + offset as f32
    }

    /// The sampler's result at u, before the scale.
    pub fn sample(&self, weights: Weights, u: f32) -> [f32; 3] {
        let mixed = filtered(&self.texels, weights, f64::from(u));
        each_channel(|i| mixed[i] as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::lut::texel::MOST_TEXELS;
    use crate::language::methods::Light;
    use crate::physics::materials::{Channels, Surface};

    #[test]
    fn ends_are_grazing_and_normal() {
        let glass = Channels {
            n: [1.5; 3],
            k: [0.0; 3],
        };
        let reference = ReferenceCurve::new(Surface::of_channels(&glass), Light::Unpolarised);
        for axis in TableAxis::ALL {
            let table = Table::new("glass", &reference, axis, 5).unwrap();
            assert_eq!(table.texels.len(), 5);
            assert_eq!(table.texels[0], [1.0; 3]);
            assert!((table.texels[4][0] - 0.04).abs() < 1e-15);
        }
        for texels in [0, 1, MOST_TEXELS + 1, usize::MAX] {
            let error = Table::new("glass", &reference, TableAxis::Cos, texels).unwrap_err();
            assert!(error.to_string().contains("2 to 16384"), "{error}");
        }
    }

    #[test]
    fn integers_are_scaled_where_a_channel_is_above_one() {
        let table = |normal: [f64; 3]| Table {
            name: "invented".to_owned(),
            axis: TableAxis::Cos,
            texels: vec![[1.0; 3], normal],
        };
        let gold = table([1.058_7, 0.77, 0.31]);
        for depth in Depth::ALL {
            let stored = Stored::new(&gold, depth);
            let is_integer = depth.largest().is_some();
            assert_eq!(stored.scale > 1.0, is_integer, "{depth:?}");
            let most = f64::from(stored.texels[1][0]) * f64::from(stored.scale);
            assert!((most - 1.058_7).abs() < 4e-4, "{depth:?} {most}");
            assert!(!is_integer || stored.texels[1][0] == 1.0);
        }
        let glass = table([0.04; 3]);
        assert_eq!(Stored::new(&glass, Depth::Unorm8).scale, 1.0);
    }

    fn ramp(axis: TableAxis, texels: usize) -> Stored {
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
        for axis in TableAxis::ALL {
            for texels in [2, 3, 64, 255, 256, 1000, 16_384] {
                let ramp = ramp(axis, texels);
                for weights in [Weights::Exact, Weights::Steps256] {
                    let last = (texels - 1) as f32;
                    let at = |c: f32| ramp.lookup(weights, c)[0];
                    // u has 24 bits, some of which select the texel.
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
        let ramp = ramp(TableAxis::Cos, 5);
        let at = |weights, c| ramp.lookup(weights, c)[0];
        assert!((at(Weights::Exact, 0.3) - 1.2).abs() < 1e-6);
        // 1.2 lies between 307/256 and 308/256.
        assert_eq!(at(Weights::Steps256, 0.3), 307.0 / 256.0);
    }

    #[test]
    fn an_empty_table_is_black() {
        assert_eq!(
            ramp(TableAxis::Cos, 0).lookup(Weights::Exact, 0.5),
            [0.0; 3]
        );
    }
}
