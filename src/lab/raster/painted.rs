//! A frame painted with reflectance: by a method, by the reference, and their difference.

use crate::generator::reference::ReferenceCurve;
use crate::language::ir::Checked;
use crate::physics::num::each_channel;

use super::draw::Frame;
use super::rendered_error::values;

/// How many times a difference is magnified, as in the thesis's figure 21.
pub const MAGNIFIED: f64 = 8.0;

/// A picture of three channels, row by row; what the object does not cover is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Painted {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The channels of every pixel, linear.
    pub pixels: Vec<[f64; 3]>,
}

impl Painted {
    /// cos θ in all three channels.
    pub fn angles(frame: &Frame) -> Painted {
        let cosines = frame.covered.iter().map(|(_, cos_theta)| [*cos_theta; 3]);
        Painted::new(frame, cosines)
    }

    /// The reference reflectance.
    pub fn reference(frame: &Frame, reference: &ReferenceCurve) -> Painted {
        let covered = frame.covered.iter();
        Painted::new(
            frame,
            covered.map(|(_, cos_theta)| reference.at(*cos_theta)),
        )
    }

    /// A function's reflectance.
    pub fn function(frame: &Frame, function: &Checked, reference: &ReferenceCurve) -> Painted {
        let cosines: Vec<f64> = frame.covered.iter().map(|(_, c)| *c).collect();
        Painted::new(frame, values(function, reference, &cosines).into_iter())
    }

    /// The magnitude of the difference from another picture of the same size, magnified.
    #[must_use]
    pub fn difference(&self, other: &Painted) -> Painted {
        let pixels = self.pixels.iter().zip(&other.pixels);
        let difference = pixels.map(|(a, b)| each_channel(|i| MAGNIFIED * (a[i] - b[i]).abs()));
        Painted {
            size: self.size,
            pixels: difference.collect(),
        }
    }

    fn new(frame: &Frame, values: impl Iterator<Item = [f64; 3]>) -> Painted {
        let [width, height] = frame.size.map(|side| side as usize);
        let mut pixels = vec![[0.0; 3]; width * height];
        for ((place, _), value) in frame.covered.iter().zip(values) {
            pixels[*place as usize] = value;
        }
        Painted {
            size: frame.size,
            pixels,
        }
    }
}
