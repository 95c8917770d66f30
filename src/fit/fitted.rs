//! The coefficients of a fitted method for what is seen of a material: those with the least largest error over all angles,
//! channel by channel, without the clip to [0, 1] that comes after.

use crate::methods::{Shape, unwarped};
use crate::num::Precision;

use super::minimax::minimax;
use super::rounded::rounded;

/// Cosines that a curve is fitted at: from 0 to 1, dense towards grazing as `--axis steep` is. Twice as many change no
/// error by a hundredth of it.
const POINTS: usize = 257;
const DENSE: f64 = 8.0;

/// What is seen of a material, at the cosines at which forms are fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The cosines, 0 first.
    pub cosines: Vec<f64>,
    /// What is seen there.
    pub seen: Vec<[f64; 3]>,
}

/// A form fitted to a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Each coefficient for three channels, as the precision holds it.
    pub coefficients: Vec<[f64; 3]>,
    /// The largest error of each channel at the curve's cosines, on paper.
    pub max_abs: [f64; 3],
}

impl Curve {
    /// The curve of what is seen at a cosine.
    pub fn new(seen: impl Fn(f64) -> [f64; 3]) -> Curve {
        let place = |i: usize| unwarped(DENSE, i as f64 / (POINTS - 1) as f64);
        let cosines: Vec<f64> = (0..POINTS).map(place).collect();
        Curve {
            seen: cosines.iter().map(|c| seen(*c)).collect(),
            cosines,
        }
    }
}

/// What each coefficient of a shape multiplies at a cosine.
fn row(shape: &Shape, cos_theta: f64) -> Vec<f64> {
    let mut row = vec![0.0; shape.terms()];
    shape.add(cos_theta, 1.0, &mut row);
    row
}

/// Fits a shape's coefficients: those of single precision are rounded afterwards, to 6e-8 of themselves. None where its terms do
/// not tell angles apart.
pub fn fit(shape: &Shape, curve: &Curve, precision: Precision) -> Option<Fit> {
    let rows: Vec<Vec<f64>> = curve.cosines.iter().map(|c| row(shape, *c)).collect();
    let weights = vec![1.0; rows.len()];
    let channel = |i: usize| {
        let wanted: Vec<f64> = curve.seen.iter().map(|seen| seen[i]).collect();
        match precision {
            Precision::F32 => minimax(&rows, &wanted, &weights),
            Precision::F16 => rounded(&rows, &wanted, &weights),
        }
    };
    let [red, green, blue] = [channel(0)?, channel(1)?, channel(2)?];
    let terms = 0..red.coefficients.len();
    let coefficient =
        |term: usize| [&red, &green, &blue].map(|c| precision.rounded(c.coefficients[term]));
    Some(Fit {
        coefficients: terms.map(coefficient).collect(),
        max_abs: [red.error, green.error, blue.error],
    })
}
