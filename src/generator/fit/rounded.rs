//! Fits with coefficients in half precision, rounded within the optimisation: when one is rounded, those not yet rounded
//! compensate. Also the texels of a table in half precision, as the method `table` reads it by default.
//!
//! The last coefficient is rounded to one of its two neighbours in half precision, the others are fitted again to the rest, and
//! so on to the first. All branches are tried except those that cannot become the best, since a form with free coefficients is
//! never worse than one with rounded ones.
//!
//! Source: Land and Doig, "An Automatic Method of Solving Discrete Programming Problems", Econometrica 28, 1960,
//! <https://doi.org/10.2307/1910129>, with two branches per coefficient.

use super::minimax::{Limit, Minimax, Points, minimax};
use crate::language::ir::{Function, Texels, Ty, Value};
use crate::language::methods::{TEXELS, WARP, unwarped};
use crate::physics::num::{Half, Num, Precision};

/// The share by which a number grows to reach its neighbour in half precision: more than half a unit in the last place and less
/// than one and a half, on both sides of a power of two.
const NEIGHBOUR: f64 = 0.6 / 1024.0;

/// The same as [`minimax`], with coefficients in half precision. None also where no rounding that is tried keeps the ranges.
pub fn rounded(points: Points) -> Option<Minimax> {
    let terms = points.rows.first()?.len();
    let first = |terms: usize| {
        points
            .rows
            .iter()
            .map(|row| row[..terms].to_vec())
            .collect()
    };
    let search = RoundingSearch {
        shorter: (0..=terms).map(first).collect(),
        weights: points.weights,
    };
    search.best(terms, points.wanted, points.limits, f64::INFINITY)
}

/// What all branches share.
struct RoundingSearch<'a> {
    /// The rows cut to no term, to the first one, and so on.
    shorter: Vec<Vec<Vec<f64>>>,
    weights: &'a [f64],
}

impl RoundingSearch<'_> {
    /// The best rounded fit with the first `terms` terms. None where nothing is better than `bound`.
    fn best(&self, terms: usize, wanted: &[f64], limits: &[Limit], bound: f64) -> Option<Minimax> {
        let free = self.free(terms, wanted, limits)?;
        if free.error >= bound {
            return None;
        }
        let Some(last) = free.coefficients.last() else {
            return Some(free);
        };
        let mut best: Option<Minimax> = None;
        for value in neighbours(*last) {
            let rows = self.shorter[terms].iter().zip(wanted);
            let left: Vec<f64> = rows.map(|(row, w)| w - row[terms - 1] * value).collect();
            let limit = |limit: &Limit| Limit {
                row: limit.row[..terms - 1].to_vec(),
                least: limit.least - limit.row[terms - 1] * value,
                most: limit.most - limit.row[terms - 1] * value,
            };
            let moved: Vec<Limit> = limits.iter().map(limit).collect();
            let bound = best.as_ref().map_or(bound, |best| best.error);
            if let Some(mut found) = self.best(terms - 1, &left, &moved, bound) {
                found.coefficients.push(value);
                best = Some(found);
            }
        }
        best
    }

    /// The best fit with the first `terms` terms, not rounded.
    fn free(&self, terms: usize, wanted: &[f64], limits: &[Limit]) -> Option<Minimax> {
        if terms > 0 {
            return minimax(Points {
                rows: &self.shorter[terms],
                wanted,
                weights: self.weights,
                limits,
            });
        }
        let is_kept = |limit: &Limit| limit.least <= 0.0 && limit.most >= 0.0;
        if !limits.iter().all(is_kept) {
            return None;
        }
        let errors = wanted
            .iter()
            .zip(self.weights)
            .map(|(w, weight)| w.abs() * weight);
        Some(Minimax {
            coefficients: Vec::new(),
            error: errors.fold(0.0, f64::max),
        })
    }
}

/// The two neighbouring numbers of half precision, the nearest first.
fn neighbours(x: f64) -> [f64; 2] {
    let nearest = Precision::F16.rounded(x);
    let step = NEIGHBOUR * nearest.abs();
    let beyond = if x < nearest { -step } else { step };
    [nearest, Precision::F16.rounded(nearest + beyond)]
}

/// The table of a function that gives reflectance at a cosine.
pub fn texels(seen: impl Fn(f64) -> [f64; 3]) -> Texels {
    let centre = |i: usize| unwarped(WARP, i as f64 / (TEXELS - 1) as f64);
    let half = |value: f64| Half::from_f64(value).to_f32();
    let texels: Vec<_> = (0..TEXELS).map(|i| seen(centre(i)).map(half)).collect();
    Texels::row(&texels)
}

/// The table that a specialised function reads, if it reads one.
pub fn table_of(function: &Function, seen: impl Fn(f64) -> [f64; 3]) -> Option<Texels> {
    let is_textured = function.params.iter().any(|param| param.ty == Ty::Texture);
    is_textured.then(|| texels(seen))
}

/// The arguments of a specialised function.
pub fn arguments<N: Num>(cosines: Vec<N>, table: Option<&Texels>) -> Vec<Value<N>> {
    let table = table.map(|table| Value::Texture(Some(table.clone())));
    [Value::each(cosines)].into_iter().chain(table).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_next_to_each_other() {
        let last = 1.0 / 1024.0;
        assert_eq!(neighbours(1.0 + 0.2 * last), [1.0, 1.0 + last]);
        assert_eq!(neighbours(1.0 - 0.1 * last), [1.0, 1.0 - last / 2.0]);
        assert_eq!(neighbours(2.0 - 0.9 * last), [2.0 - last, 2.0]);
        assert_eq!(neighbours(-1.0 - 0.9 * last), [-1.0 - last, -1.0]);
    }

    /// A cubic with large coefficients that cancel: rounding each to the nearest gives a many times larger error.
    #[test]
    fn others_make_up_for_what_is_rounded() {
        let xs: Vec<f64> = (0..=64).map(|i| f64::from(i) / 64.0).collect();
        let rows: Vec<Vec<f64>> = xs.iter().map(|x| vec![1.0, *x, x * x, x * x * x]).collect();
        let wanted: Vec<f64> = xs.iter().map(|x| libm::exp(-4.0 * x)).collect();
        let weights = vec![1.0; xs.len()];
        let points = Points {
            rows: &rows,
            wanted: &wanted,
            weights: &weights,
            limits: &[],
        };
        let free = minimax(points).unwrap();
        let found = rounded(points).unwrap();
        let error = |coefficients: &[f64]| {
            let at = |row: &[f64]| {
                row.iter()
                    .zip(coefficients)
                    .map(|(b, c)| b * c)
                    .sum::<f64>()
            };
            let each = rows
                .iter()
                .zip(&wanted)
                .map(|(row, wanted)| (at(row) - wanted).abs());
            each.fold(0.0, f64::max)
        };
        let naive: Vec<f64> = free
            .coefficients
            .iter()
            .map(|c| Precision::F16.rounded(*c))
            .collect();
        assert!(
            found
                .coefficients
                .iter()
                .all(|c| Precision::F16.rounded(*c) == *c)
        );
        assert!((error(&found.coefficients) - found.error).abs() < 1e-12);
        let lost = |error: f64| error - free.error;
        assert!(
            lost(found.error) < 0.5 * lost(error(&naive)),
            "{} {}",
            lost(found.error),
            lost(error(&naive))
        );
    }
}
