//! The cheapest function within a budget, and the errors of cheaper ones. Pure.

use core::cmp::Ordering;

use crate::lab::cost::CostAndError;

/// A function that could be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BudgetCandidate {
    /// Its method.
    pub method: &'static str,
    /// What an evaluation costs, without its texture fetches, and its largest error.
    pub point: CostAndError,
    /// Whether it reads a texture.
    pub is_textured: bool,
}

/// What comes of a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheapestFunction {
    /// The cheapest function within the budget; of equally cheap ones the most accurate.
    pub chosen: BudgetCandidate,
    /// The most accurate of those that cost less.
    pub cheaper: Option<BudgetCandidate>,
    /// A function within the budget that reads a texture and costs less, not counting the texture fetch.
    pub textured: Option<BudgetCandidate>,
}

/// Chooses. A function that reads a texture is taken only where no other is within the budget, because counts do not include the
/// texture fetch.
pub fn cheapest(candidates: &[BudgetCandidate], budget: f64) -> Option<CheapestFunction> {
    let within = |is_textured: bool| {
        let own = candidates
            .iter()
            .filter(|one| one.is_textured == is_textured && one.point.error <= budget);
        first(own, CostAndError::by_cost)
    };
    let (plain, textured) = (within(false), within(true));
    let chosen = plain.or(textured)?;
    let costs_less = |one: &BudgetCandidate| one.point.cost < chosen.point.cost;
    let cheaper = candidates
        .iter()
        .filter(|one| costs_less(one) && one.is_textured == chosen.is_textured);
    Some(CheapestFunction {
        cheaper: most_accurate(cheaper),
        textured: textured.filter(|one| !chosen.is_textured && costs_less(one)),
        chosen,
    })
}

/// The candidate with the smallest error; of equal ones the cheapest.
pub fn most_accurate<'a>(
    candidates: impl Iterator<Item = &'a BudgetCandidate>,
) -> Option<BudgetCandidate> {
    first(candidates, CostAndError::by_error)
}

fn first<'a>(
    candidates: impl Iterator<Item = &'a BudgetCandidate>,
    order: fn(&CostAndError, &CostAndError) -> Ordering,
) -> Option<BudgetCandidate> {
    candidates.min_by(|a, b| order(&a.point, &b.point)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [BudgetCandidate; 6] = [
        of("gaussian", 0.024, 10.0, false),
        of("schlick", 0.022, 12.0, false),
        of("rescaled", 0.021, 12.0, false),
        of("fitted", 0.0019, 22.0, false),
        of("five", 0.0007, 30.0, false),
        of("table", 0.0005, 18.0, true),
    ];

    const fn of(method: &'static str, error: f64, cost: f64, is_textured: bool) -> BudgetCandidate {
        BudgetCandidate {
            method,
            point: CostAndError { cost, error },
            is_textured,
        }
    }

    #[track_caller]
    fn check(budget: f64, chosen: &str, cheaper: Option<&str>, textured: Option<&str>) {
        let choice = cheapest(&ALL, budget).unwrap();
        let name = |candidate: Option<BudgetCandidate>| candidate.map(|c| c.method);
        assert_eq!(choice.chosen.method, chosen);
        assert_eq!(name(choice.cheaper), cheaper);
        assert_eq!(name(choice.textured), textured);
    }

    #[test]
    fn the_cheapest_within_the_budget_is_chosen() {
        check(1.0, "gaussian", None, None);
        check(0.023, "rescaled", Some("gaussian"), None);
        check(0.0215, "rescaled", Some("gaussian"), None);
        check(0.002, "fitted", Some("rescaled"), Some("table"));
        check(0.0019, "fitted", Some("rescaled"), Some("table"));
        check(0.0018, "five", Some("fitted"), Some("table"));
        check(0.0006, "table", None, None);
    }

    #[test]
    fn where_nothing_is_within_the_budget_nothing_is_chosen() {
        assert_eq!(cheapest(&ALL, 1e-6), None);
        assert_eq!(cheapest(&[], 1.0), None);
        assert_eq!(most_accurate(ALL.iter()).map(|c| c.method), Some("table"));
        assert_eq!(most_accurate([].iter()), None);
    }
}
