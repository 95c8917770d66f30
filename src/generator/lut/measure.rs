//! The error of a table: its filtered lookup against the reference, between texels as well as on them.

use crate::generator::fit::{ModelError, error_of};
use crate::generator::reference::ReferenceCurve;
use crate::language::ir::{Column, Value};
use crate::physics::num::each_channel;

use super::axis::TableAxis;
use super::depth::Stored;
use super::table::centre;
use crate::language::ir::Weights;

/// Places between texels at which the reference is known: the error of filtering is largest there.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenTexels {
    points: Vec<(f64, [f64; 3])>,
}

/// Places between two texels: the middle, where a smooth curve is furthest from its chord, and others half a weight
/// step away from where weights of 1/256 are exact.
const SHARES: [f64; 4] = [
    0.5,
    0.5 + 1.0 / 512.1,
    0.3 + 1.0 / 512.1,
    0.75 - 1.0 / 512.1,
];

impl BetweenTexels {
    /// The reference between the texels of tables of this size.
    pub fn new(reference: &ReferenceCurve, axis: TableAxis, texels: usize) -> BetweenTexels {
        let place = |i: usize| SHARES.map(|share| centre(axis, i as f64 + share, texels));
        let places = (0..texels.saturating_sub(1)).flat_map(place);
        BetweenTexels {
            points: places.map(|c| (c, reference.at(c))).collect(),
        }
    }
}

/// The error of the lookup: the largest over angles, places between texels and channels, and the mean as [`ModelError`]
/// has it, even in angle.
pub fn table_error(
    stored: &Stored,
    weights: Weights,
    reference: &ReferenceCurve,
    between: &BetweenTexels,
) -> ModelError {
    let mut error = error_of(reference, &|cosines| looked_up(stored, weights, cosines));
    for (c, want) in &between.points {
        let got = stored.lookup(weights, *c as f32).map(f64::from);
        for (got, want) in got.iter().zip(want) {
            if (got - want).abs() > error.max_abs {
                (error.max_abs, error.worst_cos) = ((got - want).abs(), *c);
            }
        }
    }
    error
}

/// Lookups at these cosines.
fn looked_up(stored: &Stored, weights: Weights, cosines: &[f64]) -> Value<f64> {
    let values: Vec<[f32; 3]> = cosines
        .iter()
        .map(|c| stored.lookup(weights, *c as f32))
        .collect();
    let channel = |i: usize| values.iter().map(|value| f64::from(value[i])).collect();
    Value::Rgb(each_channel(|i| Column::Each(channel(i))))
}
