//! The coefficients of a fitted method for what is seen of a material: those with the least largest error over all angles,
//! channel by channel, without the clip to [0, 1] that comes after.
//!
//! What a coefficient multiplies is asked of the function itself: it is linear in them, and each alone stays within [0, 1].

use crate::ir::{Checked, Value, evaluate};
use crate::methods::unwarped;

use super::minimax::minimax;

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
    /// Each coefficient for three channels, as f32 holds it.
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

/// What each coefficient of a linear function multiplies at some cosines: a row for each cosine.
fn basis(function: &Checked, cosines: &[f64]) -> Vec<Vec<f64>> {
    let terms = function.params.len() - 1;
    let alone = |term: usize| {
        let one = |i: usize| Value::rgb([if i == term { 1.0 } else { 0.0 }; 3]);
        let cosines = [Value::each(cosines.to_vec())];
        let arguments: Vec<Value<f64>> = cosines.into_iter().chain((0..terms).map(one)).collect();
        evaluate(function, &arguments)
    };
    let columns: Vec<Value<f64>> = (0..terms).map(alone).collect();
    let row = |point: usize| columns.iter().map(|column| column.at(point)[0]).collect();
    (0..cosines.len()).map(row).collect()
}

/// Fits a function that is linear in all its arguments after `cos_theta`. None where its terms do not tell angles apart.
pub fn fit(function: &Checked, curve: &Curve) -> Option<Fit> {
    let rows = basis(function, &curve.cosines);
    let weights = vec![1.0; rows.len()];
    let channel = |i: usize| {
        let wanted: Vec<f64> = curve.seen.iter().map(|seen| seen[i]).collect();
        minimax(&rows, &wanted, &weights)
    };
    let [red, green, blue] = [channel(0)?, channel(1)?, channel(2)?];
    let single = |value: f64| f64::from(value as f32);
    let terms = 0..red.coefficients.len();
    let coefficient = |term: usize| [&red, &green, &blue].map(|c| single(c.coefficients[term]));
    Some(Fit {
        coefficients: terms.map(coefficient).collect(),
        max_abs: [red.error, green.error, blue.error],
    })
}
