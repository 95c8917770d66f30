//! The choice of the cheapest function within a budget, with the errors of cheaper ones, and the reasons why none can be chosen.
//! Also how far published measurements of a material differ: fitting one of them better than this gains nothing. Pure.

use core::fmt;

use crate::generator::emit;
use crate::generator::fit::{FitCurve, rounded_up};
use crate::generator::reference::{MaterialInMedium, reference_reflectance};
use crate::lab::cost::CostAndError;
use crate::language::methods::{Light, Method};
use crate::physics::materials::{self, Material, Surface, ViewingConditions};
use crate::physics::num::each_channel;
use crate::physics::user_text::FileFault;

/// A function that could be chosen.
#[derive(Clone, Copy, Debug)]
pub struct BudgetCandidate {
    /// Its method.
    pub method: &'static Method,
    /// The cost of an evaluation, without texture fetches, and the largest error.
    pub point: CostAndError,
}

/// The result of a choice.
#[derive(Clone, Copy, Debug)]
pub struct CheapestFunction {
    /// The cheapest function within the budget, and the most accurate of equally cheap ones.
    pub chosen: BudgetCandidate,
    /// The most accurate of the cheaper functions.
    pub cheaper: Option<BudgetCandidate>,
    /// A function within the budget that reads a texture and costs less, not counting the texture fetch.
    pub textured: Option<BudgetCandidate>,
}

/// Chooses a function. One that reads a texture is chosen only where no other is within the budget, because counts do not include
/// the texture fetch.
pub fn cheapest(candidates: &[BudgetCandidate], budget: f64) -> Option<CheapestFunction> {
    let within = |is_textured: bool| {
        let own = candidates
            .iter()
            .filter(|one| one.method.is_textured() == is_textured && one.point.error <= budget);
        own.min_by(|a, b| a.point.by_cost(&b.point)).copied()
    };
    let (plain, textured) = (within(false), within(true));
    let chosen = plain.or(textured)?;
    let costs_less = |one: &BudgetCandidate| one.point.cost < chosen.point.cost;
    let is_textured = chosen.method.is_textured();
    let cheaper = candidates
        .iter()
        .filter(|one| costs_less(one) && one.method.is_textured() == is_textured);
    Some(CheapestFunction {
        cheaper: most_accurate(cheaper),
        textured: textured.filter(|one| !is_textured && costs_less(one)),
        chosen,
    })
}

/// The candidate with the smallest error, and the cheapest of equal ones.
pub fn most_accurate<'a>(
    candidates: impl Iterator<Item = &'a BudgetCandidate>,
) -> Option<BudgetCandidate> {
    candidates
        .min_by(|a, b| a.point.by_error(&b.point))
        .copied()
}

/// How far published measurements of a substance differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The largest difference of reflectance between two of them, at one angle in one channel.
    pub max_difference: f64,
    /// The number of measurements.
    pub sources: usize,
}

/// The spread of the catalogue's pages of a material's substance under these viewing conditions. None for a user's own file, for
/// data at three wavelengths only, for a material seen from itself, and where there is only one page.
pub fn spread(
    material: &MaterialInMedium,
    catalogue: &[Material],
    viewing: &ViewingConditions,
) -> Option<Spread> {
    let own = &material.material;
    if materials::source(&material.argument).is_none() || own.rgb_nm.is_some() {
        return None;
    }
    let medium = material.medium.as_ref().map(|(_, medium)| medium);
    if medium.is_some_and(|medium| medium.substance == own.substance) {
        return None;
    }
    let curve = |(_, surface): (_, Surface)| {
        FitCurve::new(|c| reference_reflectance(&surface, Light::Unpolarised, c)).seen
    };
    let pages = materials::surfaces_of(&own.substance, catalogue, medium, viewing);
    let curves: Vec<Vec<[f64; 3]>> = pages.map(curve).collect();
    (curves.len() > 1).then(|| Spread {
        max_difference: apart(&curves),
        sources: curves.len(),
    })
}

/// The largest difference of two curves, over all points and channels.
fn apart(curves: &[Vec<[f64; 3]>]) -> f64 {
    let points = curves.iter().map(Vec::len).min().unwrap_or(0);
    let at = |point: usize, channel: usize| {
        let values = curves.iter().map(move |curve| curve[point][channel]);
        let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| {
            (a.min(value), b.max(value))
        });
        most - least
    };
    let all = (0..points).flat_map(|point| each_channel(|channel| at(point, channel)));
    all.fold(0.0, f64::max)
}

/// The most materials without a function that an error names.
const NAMED: usize = 3;

/// Why no function can be chosen.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A budget that is not a positive number.
    #[error("--budget is {max_error}; it is an error of reflectance, above 0, such as 0.001")]
    OutOfRange {
        /// The budget.
        max_error: f64,
    },
    /// GPUs for which no costs are recorded.
    #[error("no costs are recorded of {gpu}: {reason}; name another --gpu")]
    NoCosts {
        /// The family.
        gpu: &'static str,
        /// Why not.
        reason: &'static str,
    },
    /// None of the methods can be chosen by a budget.
    #[error(
        "--budget chooses among methods for unpolarised light that keep the contract; none of --method is one"
    )]
    NoMethod,
    /// Materials without a function within the budget.
    #[error("nothing is within --budget {max_error}; {}", named(faults))]
    NothingWithin {
        /// The budget.
        max_error: f64,
        /// The materials.
        faults: Vec<NoFunction>,
    },
    /// A function cannot be made.
    #[error(transparent)]
    Function(#[from] emit::Error),
    /// A material of the catalogue has a fault.
    #[error(transparent)]
    Material(FileFault),
}

/// A material without a function within the budget.
#[derive(Clone, Debug)]
pub struct NoFunction {
    /// The material's name.
    pub material: String,
    /// The GPUs whose costs decide.
    pub gpu: &'static str,
    /// The function with the smallest error. None where no cost is known.
    pub best: Option<BudgetCandidate>,
}

impl fmt::Display for NoFunction {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let NoFunction {
            material,
            gpu,
            best,
        } = self;
        match best {
            None => write!(
                to,
                "{material}: no method that describes it has a known cost on {gpu}"
            ),
            Some(best) => write!(
                to,
                "{material}: {} has the smallest error, {}, and costs {} on {gpu}",
                best.method.name,
                rounded_error(best.point.error),
                best.point.cost
            ),
        }
    }
}

/// An error rounded up, or with two digits where it is below 1e-4.
pub fn rounded_error(error: f64) -> String {
    if error < 1e-4 {
        format!("{error:.1e}")
    } else {
        rounded_up(error)
    }
}

/// The first faults, and how many more there are.
fn named(faults: &[NoFunction]) -> String {
    let named = faults.iter().take(NAMED);
    let named: Vec<String> = named.map(NoFunction::to_string).collect();
    let more = match faults.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    named.join("; ") + &more
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::find;

    fn all() -> [BudgetCandidate; 6] {
        [
            ("schlick_spherical_gaussian", 0.024, 10.0),
            ("schlick", 0.022, 12.0),
            ("schlick_rescaled", 0.021, 12.0),
            ("fitted", 0.0019, 22.0),
            ("fitted_five", 0.0007, 30.0),
            ("table", 0.0005, 18.0),
        ]
        .map(|(name, error, cost)| BudgetCandidate {
            method: find(name).unwrap(),
            point: CostAndError { cost, error },
        })
    }

    #[track_caller]
    fn check(budget: f64, chosen: &str, cheaper: Option<&str>, textured: Option<&str>) {
        let choice = cheapest(&all(), budget).unwrap();
        let name = |candidate: Option<BudgetCandidate>| candidate.map(|c| c.method.name);
        assert_eq!(choice.chosen.method.name, chosen);
        assert_eq!(name(choice.cheaper), cheaper);
        assert_eq!(name(choice.textured), textured);
    }

    #[test]
    fn the_cheapest_within_the_budget_is_chosen() {
        let (gaussian, rescaled) = ("schlick_spherical_gaussian", "schlick_rescaled");
        check(1.0, gaussian, None, None);
        check(0.023, rescaled, Some(gaussian), None);
        check(0.0215, rescaled, Some(gaussian), None);
        check(0.002, "fitted", Some(rescaled), Some("table"));
        check(0.0019, "fitted", Some(rescaled), Some("table"));
        check(0.0018, "fitted_five", Some("fitted"), Some("table"));
        check(0.0006, "table", None, None);
    }

    #[test]
    fn where_nothing_is_within_the_budget_nothing_is_chosen() {
        assert!(cheapest(&all(), 1e-6).is_none());
        assert!(cheapest(&[], 1.0).is_none());
        let best = most_accurate(all().iter()).unwrap();
        assert_eq!(best.method.name, "table");
        assert!(most_accurate([].iter()).is_none());
    }

    #[test]
    fn curves_lie_as_far_apart_as_at_their_worst_point() {
        let grey = |values: &[f64]| values.iter().map(|v| [*v; 3]).collect::<Vec<_>>();
        let (a, b, c) = (grey(&[0.5, 0.9]), grey(&[0.25, 0.8]), grey(&[0.625, 0.9]));
        assert_eq!(apart(&[a.clone(), b.clone()]), 0.25);
        assert_eq!(apart(&[a.clone(), b, c]), 0.375);
        assert_eq!(apart(&[a]), 0.0);
        assert_eq!(apart(&[]), 0.0);
    }

    #[test]
    fn an_error_is_not_rounded_down() {
        assert_eq!(rounded_error(0.001_931), "0.00194");
        assert_eq!(rounded_error(6.0e-8), "6.0e-8");
    }
}
