//! Fits that are exact at an end, 0 or 90 degrees. Each end removes one coefficient from the fit.
//!
//! At an end e, `Σ cᵢ bᵢ(e) = F(e)` gives `cⱼ = (F(e) - Σ cᵢ bᵢ(e)) / bⱼ(e)`, with the sum over all other i. We choose the j with
//! the largest `|bⱼ(e)|` and substitute its `cⱼ`. The exchange then fits the other coefficients to the rest of F. The result is
//! the best of all forms that are exact at the end.

use super::minimax::{Limit, Points, minimax, weighted_sum};
use crate::physics::num::Precision;

/// The ends, 0 and 90 degrees, at which a form equals the reference exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exact {
    /// At normal incidence, 0 degrees.
    pub normal: bool,
    /// At 90 degrees.
    pub grazing: bool,
}

/// The search for f32 coefficients that are exact at the ends moves a coefficient by at most this many units in the last place.
const STEPS: i32 = 24;
/// The search stops at this error at the ends: half a unit in the last place of f32 below 1.
const CLOSE: f64 = 3e-8;

impl Exact {
    /// Whether any end is to be exact.
    pub fn is_any(self) -> bool {
        self.normal || self.grazing
    }

    /// The angles in degrees, the smaller first.
    pub fn degrees(self) -> Vec<u32> {
        let normal = self.normal.then_some(0).into_iter();
        normal.chain(self.grazing.then_some(90)).collect()
    }

    /// The indices of the ends among points that run from 90 degrees to 0, the last first.
    pub(super) fn ends(self, points: usize) -> Vec<usize> {
        let normal = self.normal.then(|| points - 1).into_iter();
        normal.chain(self.grazing.then_some(0)).collect()
    }
}

/// Fits like [`minimax`], but only among forms that are exact at the points `ends`, given in descending order.
pub(super) fn fit_meeting(points: Points, ends: &[usize]) -> Option<Vec<f64>> {
    let Some((end, rest)) = ends.split_first() else {
        return minimax(points).map(|found| found.coefficients);
    };
    let (at, value) = (&points.rows[*end], points.wanted[*end]);
    let largest = (0..at.len()).max_by(|a, b| at[*a].abs().total_cmp(&at[*b].abs()))?;
    // A row without the eliminated coefficient, and the share of the end's value in it.
    let reduced = |row: &Vec<f64>| -> (Vec<f64>, f64) {
        let share = row[largest] / at[largest];
        let others = (0..row.len()).filter(|i| *i != largest);
        let others = others.map(|i| row[i] - share * at[i]);
        (others.collect(), share * value)
    };
    let (mut rows, given): (Vec<_>, Vec<_>) = points.rows.iter().map(reduced).unzip();
    let left = points.wanted.iter().zip(&given);
    let mut wanted: Vec<f64> = left.map(|(wanted, given)| wanted - given).collect();
    let mut weights = points.weights.to_vec();
    rows.remove(*end);
    wanted.remove(*end);
    weights.remove(*end);
    let limit = |limit: &Limit| {
        let (row, given) = reduced(&limit.row);
        limit.without(row, given)
    };
    let limits: Vec<Limit> = points.limits.iter().map(limit).collect();
    let reduced = Points {
        rows: &rows,
        wanted: &wanted,
        weights: &weights,
        limits: &limits,
    };
    let mut found = fit_meeting(reduced, rest)?;
    found.insert(largest, 0.0);
    found[largest] = (value - weighted_sum(at, &found)) / at[largest];
    Some(found)
}

/// The coefficients rounded to a precision. In f32 they are moved by some units in the last place if that makes the form exact at
/// the ends again. Each end is a row of the basis and the value that the form should have there.
pub(super) fn rounded_coefficients(
    coefficients: &[f64],
    ends: &[(&[f64], f64)],
    precision: Precision,
) -> Vec<f64> {
    let nearest: Vec<f64> = coefficients.iter().map(|c| precision.rounded(*c)).collect();
    if ends.is_empty() {
        return nearest;
    }
    let around = |steps: (i32, i32)| {
        let mut moved = nearest.clone();
        moved[1] = stepped(moved[1], steps.0);
        moved[2] = stepped(moved[2], steps.1);
        let missed = ends
            .iter()
            .map(|(row, value)| value - weighted_sum(row, &moved));
        let missed: f64 = missed.sum();
        moved[0] = Precision::F32.rounded(moved[0] + missed / ends.len() as f64);
        moved
    };
    let error_at_ends = |coefficients: &Vec<f64>| {
        let error = |(row, value): &(&[f64], f64)| (value - weighted_sum(row, coefficients)).abs();
        ends.iter().map(error).fold(0.0, f64::max)
    };
    let mut best = nearest.clone();
    for steps in (0..=STEPS).flat_map(ring) {
        let next = around(steps);
        if error_at_ends(&next) < error_at_ends(&best) {
            best = next;
        }
        if error_at_ends(&best) <= CLOSE {
            break;
        }
    }
    best
}

/// All pairs of steps whose larger magnitude is `size`.
fn ring(size: i32) -> impl Iterator<Item = (i32, i32)> {
    let all = (-size..=size).flat_map(move |a| (-size..=size).map(move |b| (a, b)));
    all.filter(move |(a, b)| a.abs().max(b.abs()) == size)
}

/// The f32 that is `steps` units in the last place further from 0, or nearer if negative.
fn stepped(value: f64, steps: i32) -> f64 {
    let bits = (value as f32).to_bits().saturating_add_signed(steps);
    let moved = f64::from(f32::from_bits(bits));
    if moved.is_finite() && moved.signum() == value.signum() {
        moved
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x² by a line through (1, 1): 1 + s (x - 1) has the error s - 1 at 0, and (1 - s / 2)² of the other sign at s / 2. Both are
    /// 3 - 2 √2 for s = 4 - 2 √2.
    #[test]
    fn a_line_through_an_end_is_the_best_of_those() {
        let at: Vec<f64> = (0..=2000).map(|i| f64::from(i) / 2000.0).collect();
        let rows: Vec<Vec<f64>> = at.iter().map(|x| vec![1.0, *x]).collect();
        let wanted: Vec<f64> = at.iter().map(|x| x * x).collect();
        let points = Points {
            rows: &rows,
            wanted: &wanted,
            weights: &vec![1.0; at.len()],
            limits: &[],
        };
        let found = fit_meeting(points, &[2000]).expect("a line");
        assert!((weighted_sum(&rows[2000], &found) - 1.0).abs() < 1e-14);
        let both = fit_meeting(points, &[2000, 0]);
        let both = both.expect("both ends say all");
        assert!(both[0].abs() < 1e-14 && (both[1] - 1.0).abs() < 1e-14);
        let error = at.iter().map(|x| (x * x - found[0] - found[1] * x).abs());
        let error = error.fold(0.0, f64::max);
        assert!(
            (error - (3.0 - 2.0 * 2.0_f64.sqrt())).abs() < 1e-6,
            "{error} {found:?}"
        );
    }

    #[test]
    fn single_precision_meets_the_ends_too() {
        let (grazing, normal) = (
            [1.0, 1.0, 0.094, 0.094, 0.0],
            [1.0, 4.9e-4, 5.3e-4, 2.6e-7, 2.6e-7],
        );
        let coefficients = [0.91 + 1e-9, 31.000_000_7, -401.123_456_789, 90.3, -2.0];
        let ends = [grazing, normal].map(|row| (row, weighted_sum(&row, &coefficients)));
        let ends = [(&ends[0].0[..], ends[0].1), (&ends[1].0[..], ends[1].1)];
        let found = rounded_coefficients(&coefficients, &ends, Precision::F32);
        for (row, value) in ends {
            assert!(
                (weighted_sum(row, &found) - value).abs() < 1e-7,
                "{found:?}"
            );
        }
        assert!(
            found.iter().all(|c| Precision::F32.rounded(*c) == *c),
            "{found:?}"
        );
        assert_eq!(
            rounded_coefficients(&[0.1, 0.2, 0.3], &[], Precision::F32)[0],
            f64::from(0.1f32)
        );
    }
}
