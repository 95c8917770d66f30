//! A table: reflectance at the centres of texels, along an axis.

use crate::generator::reference::ReferenceCurve;

use super::axis::TableAxis;
use super::error::Error;

/// Reflectance along an axis, cos θ = 0 first.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The material, with `_in_` and the medium's name where there is one.
    pub name: String,
    /// How cosines are spread.
    pub axis: TableAxis,
    /// Red, green and blue at each texel's centre, linear, in the gamut of the reference.
    pub texels: Vec<[f64; 3]>,
}

/// The fewest texels: both ends.
pub const LEAST_TEXELS: usize = 2;
/// The most texels: the longest side of a texture that all today's GPUs take (Direct3D 11's limit; WebGL 2 asks for 2048).
pub const MOST_TEXELS: usize = 16_384;

/// A number of texels that a texture can have.
///
/// # Errors
/// Fewer than [`LEAST_TEXELS`], more than [`MOST_TEXELS`].
pub fn check_size(texels: usize) -> Result<(), Error> {
    if (LEAST_TEXELS..=MOST_TEXELS).contains(&texels) {
        Ok(())
    } else {
        Err(Error::Size { texels })
    }
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
}

/// The cosine at the centre of a texel, or between two.
pub(super) fn centre(axis: TableAxis, texel: f64, texels: usize) -> f64 {
    axis.cosine(texel / (texels - 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
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
}
