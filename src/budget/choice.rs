//! The cheapest function within a budget, and what the cheaper ones would cost in error. Pure.

/// A function that could be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BudgetCandidate {
    /// Its method.
    pub method: &'static str,
    /// Its largest error.
    pub error: f64,
    /// What an evaluation costs, without what a texture fetch does.
    pub cost: f64,
    /// Whether it reads a texture.
    pub is_textured: bool,
}

/// What comes of a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheapestFunction {
    /// The cheapest within the budget; of equal ones the one that errs least.
    pub chosen: BudgetCandidate,
    /// Of those that cost less, the one that errs least.
    pub cheaper: Option<BudgetCandidate>,
    /// One that counts as cheaper and is within the budget, but reads a texture, which no count holds.
    pub textured: Option<BudgetCandidate>,
}

/// Chooses. What reads a texture is taken only where nothing else is within the budget, because no count holds what a fetch costs.
pub fn cheapest(candidates: &[BudgetCandidate], budget: f64) -> Option<CheapestFunction> {
    let within = |is_textured: bool| {
        let own = candidates
            .iter()
            .filter(move |c| c.is_textured == is_textured);
        own.filter(|c| c.error <= budget)
            .min_by(|a, b| a.cost.total_cmp(&b.cost).then(a.error.total_cmp(&b.error)))
    };
    let (plain, textured) = (within(false), within(true));
    let chosen = *plain.or(textured)?;
    let cheaper = candidates
        .iter()
        .filter(|c| c.cost < chosen.cost && c.is_textured == chosen.is_textured);
    Some(CheapestFunction {
        cheaper: nearest(cheaper),
        textured: textured
            .filter(|c| !chosen.is_textured && c.cost < chosen.cost)
            .copied(),
        chosen,
    })
}

/// The one that errs least; of equal ones the cheapest.
pub fn nearest<'a>(
    candidates: impl Iterator<Item = &'a BudgetCandidate>,
) -> Option<BudgetCandidate> {
    let order = |a: &&BudgetCandidate, b: &&BudgetCandidate| {
        a.error.total_cmp(&b.error).then(a.cost.total_cmp(&b.cost))
    };
    candidates.min_by(order).copied()
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
            error,
            cost,
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
        assert_eq!(nearest(ALL.iter()).map(|c| c.method), Some("table"));
        assert_eq!(nearest([].iter()), None);
    }
}
