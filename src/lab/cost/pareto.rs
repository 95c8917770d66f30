//! Error against cost: which functions nothing beats in both, and by how much one beats another.

use std::cmp::Ordering;

/// What a function costs, and how far it is from the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostAndError {
    /// What an evaluation costs, in any one unit.
    pub cost: f64,
    /// Its error, by any one measure.
    pub error: f64,
}

/// Smaller relative differences count as ties: compilers and single precision differ by as much.
pub const TIE: f64 = 0.01;
/// Errors below this are those of single precision, and count as none.
const LEAST_ERROR: f64 = 1e-6;
/// Cheaper functions count as this dear: a count is the least that a compiler reports.
const LEAST_COST: f64 = 1.0;

impl CostAndError {
    /// Cheaper first; of equal costs the smaller error first.
    pub fn by_cost(&self, other: &CostAndError) -> Ordering {
        let errors = || self.error.total_cmp(&other.error);
        self.cost.total_cmp(&other.cost).then_with(errors)
    }

    /// The smaller error first; of equal errors the cheaper first.
    pub fn by_error(&self, other: &CostAndError) -> Ordering {
        let costs = || self.cost.total_cmp(&other.cost);
        self.error.total_cmp(&other.error).then_with(costs)
    }

    /// Whether it costs less than the least that a compiler reports: nothing is a multiple of that.
    pub fn costs_nothing(&self) -> bool {
        self.cost < LEAST_COST
    }

    /// This function's cost and error as multiples of another's.
    pub fn multiples_of(&self, other: &CostAndError) -> Multiples {
        let ratio = |own: f64, other: f64, least: f64| own.max(least) / other.max(least);
        Multiples {
            cost: ratio(self.cost, other.cost, LEAST_COST),
            error: ratio(self.error, other.error, LEAST_ERROR),
        }
    }
}

/// How many times another function's cost and error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Multiples {
    /// Times the cost.
    pub cost: f64,
    /// Times the error.
    pub error: f64,
}

impl Multiples {
    /// Whether the other function is nowhere worse, and better in cost or error.
    pub fn is_dominated(&self) -> bool {
        self.error >= 1.0 - TIE && self.cost >= 1.0 - TIE && !self.is_tie()
    }

    /// Whether cost and error are the same as the other's.
    pub fn is_tie(&self) -> bool {
        let is_same = |times: f64| (times - 1.0).abs() <= TIE;
        is_same(self.error) && is_same(self.cost)
    }
}

/// The places of the functions that nothing beats, found by a walk from the cheapest: each has a smaller error than all before it,
/// by more than a tie. Two of the same cost and error are both on the frontier. What is not known takes no part.
pub fn pareto_frontier(points: &[Option<CostAndError>]) -> Vec<usize> {
    let places = points.iter().enumerate();
    let mut known: Vec<(usize, CostAndError)> = places
        .filter_map(|(place, point)| Some((place, (*point)?)))
        .collect();
    known.sort_by(|(_, a), (_, b)| a.by_cost(b));
    let mut best: Vec<(usize, CostAndError)> = Vec::new();
    for (place, point) in known {
        let is_better = |(_, last): &(usize, CostAndError)| {
            point == *last || point.error * (1.0 + TIE) < last.error
        };
        if best.last().is_none_or(is_better) {
            best.push((place, point));
        }
    }
    let mut places: Vec<usize> = best.into_iter().map(|(place, _)| place).collect();
    places.sort_unstable();
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn at(cost: f64, error: f64) -> Option<CostAndError> {
        Some(CostAndError { cost, error })
    }

    #[test]
    fn the_frontier_holds_what_nothing_beats() {
        type Case = (&'static [Option<CostAndError>], &'static [usize]);
        const CASES: [Case; 11] = [
            (&[], &[]),
            (&[None], &[]),
            (&[at(1.0, 1.0)], &[0]),
            // A staircase, and one behind it.
            (
                &[at(1.0, 3.0), at(2.0, 2.0), at(3.0, 1.0), at(3.0, 2.5)],
                &[0, 1, 2],
            ),
            // As dear and as wrong: both stand.
            (&[at(1.0, 1.0), at(1.0, 1.0)], &[0, 1]),
            // As dear and less wrong, or as wrong and cheaper, is enough.
            (&[at(1.0, 1.0), at(1.0, 0.5)], &[1]),
            (&[at(2.0, 0.5), at(1.0, 0.5)], &[1]),
            // Less wrong by nothing that counts is not worth a higher price; at the same price it is.
            (&[at(2.0, 0.999), at(1.0, 1.0)], &[1]),
            (&[at(1.0, 0.999), at(1.0, 1.0)], &[0]),
            // Small steps add up.
            (
                &[at(1.0, 1.0), at(2.0, 0.993), at(3.0, 0.987), at(4.0, 0.98)],
                &[0, 2],
            ),
            // One that is not known beats nothing.
            (&[at(2.0, 1.0), None, at(1.0, 2.0)], &[0, 2]),
        ];
        for (points, wanted) in CASES {
            assert_eq!(pareto_frontier(points), wanted, "{points:?}");
        }
    }
}
