//! Comparison of a user's function with our methods: which of them dominate it, with no larger error and no higher cost, and
//! which one it computes, with the same results at all angles for the same material.
//!
//! Functions differ in conventions more than in formulas: an index is n_t / n_i or n_i / n_t, the colour at 82 degrees is itself
//! or a tint. So where a function computes none of ours, its arguments are tried as the other quantities that their names may
//! stand for.

use serde::Serialize;

use super::bind::Bound;
use crate::generator::fit::values_for_material;
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::{CostAndError, Multiples, TIE};
use crate::language::ir::{Value, evaluate};
use crate::language::methods::{self, Contract, InputSource, Light, Method};

/// A method of ours for the same material.
#[derive(Clone, Debug)]
pub struct Competitor {
    /// Its name.
    pub method: &'static str,
    /// `library` or `specialised`.
    pub form: &'static str,
    /// How many numbers describe a material in it.
    pub inputs: usize,
    /// Whether it takes a number that a user's function does not have, and that does not follow from those it has.
    pub is_foreign: bool,
    /// Its cost on a GPU, and its largest error.
    pub point: CostAndError,
}

/// A user's function in a comparison.
#[derive(Clone, Copy, Debug)]
pub struct Own {
    /// How many numbers describe a material.
    pub inputs: usize,
    /// Its cost on a GPU, and its largest error.
    pub point: CostAndError,
    /// Whether a check fails. It is then not fit for use, whatever its cost and error.
    pub fails: bool,
}

/// A user's function against a method of ours.
#[derive(Clone, Debug)]
pub struct Comparison<'a> {
    /// The method.
    pub other: &'a Competitor,
    /// The user's cost and error divided by the method's. A cost below the smallest that a compiler reports counts as the smallest.
    pub times: Multiples,
    /// The user's cost where the method costs nothing, so that there is no ratio.
    cost_beside_none: Option<f64>,
}

impl Comparison<'_> {
    /// The user's cost divided by the method's. None where the method costs nothing.
    pub fn cost_times(&self) -> Option<f64> {
        let has_ratio = self.cost_beside_none.is_none();
        has_ratio.then_some(self.times.cost)
    }
}

/// The methods that are no worse than a user's function, the best first. The first list takes no more numbers than the function
/// does, and none that the function has not, and dominates it. The second takes more or others, and so pays for its gain and dominates
/// nothing.
pub fn dominating<'a>(
    own: &Own,
    competitors: &'a [Competitor],
) -> (Vec<Comparison<'a>>, Vec<Comparison<'a>>) {
    let all = competitors.iter().map(|other| Comparison {
        other,
        times: own.point.multiples_of(&other.point),
        cost_beside_none: other.point.costs_nothing().then_some(own.point.cost),
    });
    let mut found: Vec<Comparison> = all.filter(|one| one.times.is_dominated()).collect();
    let gain = |one: &Comparison| one.times.error * one.times.cost;
    found.sort_by(|a, b| {
        let by_name = a.other.method.cmp(b.other.method);
        gain(b).total_cmp(&gain(a)).then(by_name)
    });
    found
        .into_iter()
        .partition(|one| one.other.inputs <= own.inputs && !one.other.is_foreign)
}

/// A sentence: which method dominates a user's function, or that none does, and which would with more inputs.
pub fn sentence(own: &Own, competitors: &[Competitor]) -> String {
    let (dominating, with_more) = dominating(own, competitors);
    let among_as_few = match dominating.first() {
        Some(best) => {
            let (error, cost) = multiples(best);
            let method = best.other.method;
            format!("dominated by {method}: this function errs {error} and costs {cost}")
        }
        None => on_the_frontier(own, competitors),
    };
    let more = with_more.first().map(|best| {
        let (method, inputs, own) = (best.other.method, best.other.inputs, own.inputs);
        let (error, cost) = multiples(best);
        let takes = if inputs > own {
            format!("{inputs} inputs instead of {own}")
        } else {
            "other inputs, which do not follow from its own".to_owned()
        };
        format!("; beside {method} it errs {error} and costs {cost}, but {method} takes {takes}")
    });
    among_as_few + &more.unwrap_or_default()
}

/// The sentence where no method with as few inputs dominates it.
fn on_the_frontier(own: &Own, competitors: &[Competitor]) -> String {
    let is_same = |other: &&Competitor| {
        other.inputs <= own.inputs && own.point.multiples_of(&other.point).is_tie()
    };
    let why = match competitors.iter().find(is_same) {
        Some(same) => format!("it errs and costs as much as {}", same.method),
        None => "every method of ours with as few inputs errs more or costs more".to_owned(),
    };
    if own.fails {
        format!("on the frontier by error and cost alone, for a check fails: {why}")
    } else {
        format!("on the frontier: {why}")
    }
}

/// `9 times as much`, for errors and for costs. A cost stands alone where the other function costs nothing.
fn multiples(other: &Comparison) -> (String, String) {
    let cost = match other.cost_beside_none {
        Some(cost) => format!("{cost}, where that costs nothing"),
        None => times(other.times.cost),
    };
    (times(other.times.error), cost)
}

/// `9 times as much`, `as much`.
fn times(share: f64) -> String {
    if (share - 1.0).abs() <= TIE {
        return "as much".to_owned();
    }
    let text = match share {
        share if share < 1.1 => format!("{share:.2}"),
        share if share < 9.95 => format!("{share:.1}"),
        share => format!("{share:.0}"),
    };
    let short = text.strip_suffix(".0").unwrap_or(&text);
    format!("{short} times as much")
}

/// The angles that results are compared at.
const POINTS: u16 = 64;

/// Results that differ by less than this are the same. It allows for single precision and for forms that lose digits.
const NEAR: f64 = 5e-5;

/// An argument bound to another quantity, with which a function computes one of our methods.
#[derive(Clone, Debug, Serialize)]
pub struct ExactFit {
    /// The argument.
    pub argument: String,
    /// The quantity that it is bound to.
    pub quantity: &'static str,
    /// The method that the function computes then.
    pub method: &'static str,
    /// Its largest error then.
    pub max_abs: f64,
}

/// The cosines at which results are compared.
pub fn cosines() -> Vec<f32> {
    let part = |i: u16| f32::from(i) / f32::from(POINTS);
    (1..=POINTS).map(part).collect()
}

/// Which of our methods gives these results at [`cosines`].
pub fn recognised(
    results: &[[f32; 3]],
    bound: &Bound,
    subject: &MaterialInMedium,
) -> Option<&'static str> {
    let takes_what_is_bound = |method: &Method| {
        let has = |name: &str| {
            let mut arguments = bound.arguments.iter();
            arguments.any(|argument| {
                argument
                    .quantity
                    .is_some_and(|quantity| quantity.input.name == name)
            })
        };
        let is_artistic = |source| matches!(source, InputSource::Artist(_));
        let mut inputs = method.inputs.iter();
        inputs.all(|input| has(input.name) || is_artistic(input.source))
            && method.inputs.iter().any(|input| has(input.name))
    };
    let is_it = |method: &&&'static Method| {
        is_comparable(method)
            && subject.is_described_by(method)
            && takes_what_is_bound(method)
            && gives(method, results, subject)
    };
    methods::ALL.iter().find(is_it).map(|method| method.name)
}

/// Whether a method computes what users' functions do. One for polarised light computes something else. Counts of one that reads a
/// texture do not include the fetch, and one for any thickness of a film is no rival for one thickness.
pub fn is_comparable(method: &Method) -> bool {
    method.light == Light::Unpolarised
        && method.contract == Contract::Kept
        && !method.is_textured()
        && !method.keeps_inputs()
}

/// Whether a method gives these results.
fn gives(method: &Method, results: &[[f32; 3]], subject: &MaterialInMedium) -> bool {
    let Ok(graph) = method.function(false) else {
        return false;
    };
    let cosines = cosines().into_iter().map(f64::from).collect();
    let others: Vec<Value<f64>> = method.arguments(&values_for_material(subject, method), None);
    let arguments: Vec<Value<f64>> = [Value::each(cosines)].into_iter().chain(others).collect();
    let own = evaluate(&graph, &arguments);
    let mut points = results.iter().enumerate();
    points.all(|(point, result)| {
        let mut pairs = result.iter().zip(own.at(point));
        pairs.all(|(result, own)| {
            (f64::from(*result).clamp(0.0, 1.0) - own.clamp(0.0, 1.0)).abs() < NEAR
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn competitors() -> [Competitor; 3] {
        let competitor = |method, inputs, error, cost| Competitor {
            method,
            form: "library",
            inputs,
            is_foreign: false,
            point: CostAndError { cost, error },
        };
        [
            competitor("exact", 6, 1e-7, 100.0),
            competitor("fitted", 12, 0.01, 20.0),
            competitor("schlick", 3, 0.1, 10.0),
        ]
    }

    fn own(inputs: usize, error: f64, cost: f64) -> Own {
        Own {
            inputs,
            point: CostAndError { cost, error },
            fails: false,
        }
    }

    #[track_caller]
    fn check(error: f64, cost: f64, expected: &str) {
        assert_eq!(sentence(&own(12, error, cost), &competitors()), expected);
    }

    #[test]
    fn the_sentence_says_by_how_much() {
        check(
            0.09,
            28.0,
            "dominated by fitted: this function errs 9 times as much and costs 1.4 times as much",
        );
        check(
            0.1,
            12.0,
            "dominated by schlick: this function errs as much and costs 1.2 times as much",
        );
        check(
            0.01,
            20.0,
            "on the frontier: it errs and costs as much as fitted",
        );
        check(
            0.05,
            12.0,
            "on the frontier: every method of ours with as few inputs errs more or costs more",
        );
        check(
            3e-7,
            130.0,
            "dominated by exact: this function errs as much and costs 1.3 times as much",
        );
    }

    /// `constant_f0` costs nothing, so 44 is no multiple of it.
    #[test]
    fn beside_what_costs_nothing_a_cost_has_no_ratio() {
        let free = Competitor {
            method: "constant_f0",
            form: "library",
            inputs: 3,
            is_foreign: false,
            point: CostAndError {
                cost: 0.0,
                error: 0.66,
            },
        };
        let own = own(3, 0.66, 44.0);
        assert_eq!(
            sentence(&own, std::slice::from_ref(&free)),
            "dominated by constant_f0: this function errs as much and costs 44, where that costs nothing"
        );
        let (found, _) = dominating(&own, std::slice::from_ref(&free));
        assert_eq!(found[0].cost_times(), None);
    }

    /// A place on the frontier does not recommend a function whose results are not all reflectances.
    #[test]
    fn the_frontier_says_that_a_check_fails() {
        let failing = Own {
            fails: true,
            ..own(12, 0.05, 12.0)
        };
        let says = sentence(&failing, &competitors());
        assert!(
            says.starts_with("on the frontier by error and cost alone, for a check fails: every"),
            "{says}"
        );
    }

    #[test]
    fn all_that_dominate_are_listed_the_farthest_first() {
        let competitors = competitors();
        let (found, with_more) = dominating(&own(12, 0.2, 40.0), &competitors);
        assert!(with_more.is_empty());
        let names: Vec<&str> = found.iter().map(|one| one.other.method).collect();
        assert_eq!(names, ["fitted", "schlick"]);
    }

    /// Functions with different numbers of inputs are not compared as equals.
    #[test]
    fn what_takes_more_numbers_dominates_nothing_and_is_named() {
        let (few, competitors) = (own(3, 0.09, 28.0), competitors());
        let (found, with_more) = dominating(&few, &competitors);
        assert!(found.is_empty());
        assert_eq!(with_more[0].other.method, "fitted");
        assert_eq!(
            sentence(&few, &competitors),
            "on the frontier: every method of ours with as few inputs errs more or costs more; beside fitted it errs 9 times as much and costs 1.4 times as much, but fitted takes 12 inputs instead of 3"
        );
        let (found, _) = dominating(&own(3, 0.2, 28.0), &competitors);
        assert_eq!(found.len(), 1);
        assert_eq!(
            sentence(&own(3, 0.2, 28.0), &competitors),
            "dominated by schlick: this function errs 2 times as much and costs 2.8 times as much; beside fitted it errs 20 times as much and costs 1.4 times as much, but fitted takes 12 inputs instead of 3"
        );
    }
    /// A method whose numbers nobody can make from the function's own dominates nothing, though it takes no more of them.
    #[test]
    fn a_method_of_other_inputs_dominates_nothing() {
        let mut all = competitors();
        all[2].is_foreign = true;
        let said = sentence(&own(3, 0.2, 28.0), &all[2..]);
        assert_eq!(
            said,
            "on the frontier: every method of ours with as few inputs errs more or costs more; beside schlick it errs 2 times as much and costs 2.8 times as much, but schlick takes other inputs, which do not follow from its own"
        );
    }
}
