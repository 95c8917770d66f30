//! Error against cost: the Pareto frontier of functions, and by how much one function beats another.

use std::cmp::Ordering;

/// The cost of a function, and its error against the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostAndError {
    /// The cost of an evaluation, in any unit.
    pub cost: f64,
    /// Its error, in any measure.
    pub error: f64,
}

/// Smaller relative differences count as ties. Compilers and single precision differ by as much.
pub const TIE: f64 = 0.01;
/// Smaller errors count as this one: they are those of single precision.
const LEAST_ERROR: f64 = 1e-6;
/// Smaller costs count as this one: one instruction is the least that a compiler reports.
const LEAST_COST: f64 = 1.0;

impl CostAndError {
    /// The cheaper first, then the smaller error.
    pub fn by_cost(&self, other: &CostAndError) -> Ordering {
        let errors = || self.error.total_cmp(&other.error);
        self.cost.total_cmp(&other.cost).then_with(errors)
    }

    /// The smaller error first, then the cheaper.
    pub fn by_error(&self, other: &CostAndError) -> Ordering {
        let costs = || self.cost.total_cmp(&other.cost);
        self.error.total_cmp(&other.error).then_with(costs)
    }

    /// Whether it costs less than the least that a compiler reports, so that ratios to it mean nothing.
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

/// A function's cost and error as multiples of another's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Multiples {
    /// Its cost divided by the other's.
    pub cost: f64,
    /// Its error divided by the other's.
    pub error: f64,
}

impl Multiples {
    /// Whether the other function is no worse in both, and better in cost or error.
    pub fn is_dominated(&self) -> bool {
        self.error >= 1.0 - TIE && self.cost >= 1.0 - TIE && !self.is_tie()
    }

    /// Whether cost and error are the same as the other's.
    pub fn is_tie(&self) -> bool {
        let is_same = |times: f64| (times - 1.0).abs() <= TIE;
        is_same(self.error) && is_same(self.cost)
    }
}

/// The indices of the functions on the frontier. From the cheapest on, each has a smaller error than all before it, by more than
/// a tie. Two of the same cost and error are both on the frontier. Unknown points are left out.
pub fn pareto_frontier(points: &[Option<CostAndError>]) -> Vec<usize> {
    let places = points.iter().enumerate();
    let mut known: Vec<(usize, CostAndError)> = places
        .filter_map(|(place, point)| Some((place, (*point)?)))
        .collect();
    known.sort_by(|(_, a), (_, b)| a.by_cost(b));
    let mut best = Vec::new();
    let mut last: Option<CostAndError> = None;
    for (place, point) in known {
        if last.is_none_or(|last| point == last || point.error * (1.0 + TIE) < last.error) {
            best.push(place);
            last = Some(point);
        }
    }
    best.sort_unstable();
    best
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
            // A staircase, and one point behind it.
            (
                &[at(1.0, 3.0), at(2.0, 2.0), at(3.0, 1.0), at(3.0, 2.5)],
                &[0, 1, 2],
            ),
            // Equal cost and error: both stay.
            (&[at(1.0, 1.0), at(1.0, 1.0)], &[0, 1]),
            // A smaller error at equal cost, or a lower cost at equal error, is enough.
            (&[at(1.0, 1.0), at(1.0, 0.5)], &[1]),
            (&[at(2.0, 0.5), at(1.0, 0.5)], &[1]),
            // An error that is smaller by less than a tie is not worth a higher cost, but wins at the same cost.
            (&[at(2.0, 0.999), at(1.0, 1.0)], &[1]),
            (&[at(1.0, 0.999), at(1.0, 1.0)], &[0]),
            // Small steps add up.
            (
                &[at(1.0, 1.0), at(2.0, 0.993), at(3.0, 0.987), at(4.0, 0.98)],
                &[0, 2],
            ),
            // An unknown point beats nothing.
            (&[at(2.0, 1.0), None, at(1.0, 2.0)], &[0, 2]),
        ];
        for (points, wanted) in CASES {
            assert_eq!(pareto_frontier(points), wanted, "{points:?}");
        }
    }
}
