//! Fits with coefficients in half precision, rounded within the optimisation: when one is rounded, those not yet rounded
//! compensate.
//!
//! The last coefficient is rounded to one of its two neighbours in half precision, the others are fitted again to the rest, and
//! so on to the first. All branches are tried except those that cannot become the best, since a form with free coefficients is
//! never worse than one with rounded ones.
//!
//! Source: Land and Doig, "An Automatic Method of Solving Discrete Programming Problems", Econometrica 28, 1960,
//! <https://doi.org/10.2307/1910129>, with two branches per coefficient.

use super::minimax::{Limit, Minimax, Points, minimax};
use crate::physics::num::Precision;

/// The share by which a number grows to reach its neighbour in half precision: more than half a unit in the last place and less
/// than one and a half, on both sides of a power of two.
const NEIGHBOUR: f64 = 0.6 / 1024.0;

/// The same as [`minimax`], with coefficients in half precision. None also where no rounding that is tried keeps the ranges.
pub fn rounded(points: Points) -> Option<Minimax> {
    let terms = points.rows.first()?.len();
    let rows = points.rows.iter();
    let first = |terms: usize| rows.clone().map(|row| row[..terms].to_vec()).collect();
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
            let limit = |limit: &Limit| {
                let (row, given) = (&limit.row[..terms - 1], limit.row[terms - 1] * value);
                limit.without(row.to_vec(), given)
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
        let pairs = wanted.iter().zip(self.weights);
        let errors = pairs.map(|(wanted, weight)| wanted.abs() * weight);
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

#[cfg(test)]
mod tests {
    use super::super::minimax::weighted_sum;
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
            let missed =
                |(row, wanted): (&Vec<f64>, &f64)| weighted_sum(row, coefficients) - wanted;
            let missed = rows.iter().zip(&wanted).map(missed);
            missed.fold(0.0, |most: f64, missed| most.max(missed.abs()))
        };
        let round = |c: &f64| Precision::F16.rounded(*c);
        let naive: Vec<f64> = free.coefficients.iter().map(round).collect();
        assert!(found.coefficients.iter().all(|c| round(c) == *c));
        assert!((error(&found.coefficients) - found.error).abs() < 1e-12);
        let [found, naive] = [found.error, error(&naive)].map(|error| error - free.error);
        assert!(found < 0.5 * naive, "{found} {naive}");
    }
}
