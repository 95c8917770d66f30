//! The choice of a function for each material at the least total cost, and the errors of the candidates. Pure.
//!
//! ```text
//! total = Σ over materials of cost × pixels + price × number of different functions
//! ```
//!
//! Specialised functions differ from material to material; a library function serves all materials that take it. The least total is
//! found by branch and bound over the library functions: exact, and quick because few of them can pay for themselves.
//!
//! Candidates are judged with the cheapest first. What costs more than a candidate within the budget cannot be chosen, and no
//! report states its error. So it is not judged, and its error is infinite.

use core::cmp::Ordering;

use super::curve::{Curve, PixelPlace, RoughRule, curves};
use super::metric::{JudgedPixels, ScenePixel, Screen};
use super::planned::{JudgedCandidate, JudgedMaterial};
use super::row::is_shared;
use crate::physics::num::in_parallel;

/// A function of a material, within its budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Choosable {
    /// Its cost for all pixels of the material, without the price of a function.
    pub cost: f64,
    /// Its error.
    pub error: f64,
    /// Its name, the last tie-breaker.
    pub name: String,
    /// The index of its library function; `None` where the function is the material's own.
    pub shared: Option<usize>,
}

/// The indices of a material's functions within a budget; if there are none, of those with the least error. The functions for a
/// smaller budget are always among those for a larger one, so a smaller budget never makes a plan cheaper.
pub fn within(functions: &[Choosable], budget: f64) -> Vec<usize> {
    let errors = functions.iter().map(|one| one.error);
    let most = errors.fold(f64::INFINITY, f64::min).max(budget);
    let all = 0..functions.len();
    all.filter(|i| functions[*i].error <= most).collect()
}

/// The index of the chosen function of each material, which has at least one. `price` is that of a function.
pub fn choose(materials: &[Vec<Choosable>], price: f64) -> Vec<usize> {
    let highest = materials
        .iter()
        .flatten()
        .filter_map(|one| one.shared)
        .max();
    let mut search = Search {
        materials,
        price,
        states: vec![State::Open; highest.map_or(0, |last| last + 1)],
        best: None,
    };
    search.descend(0);
    search.best.map(|(choice, _)| choice).unwrap_or_default()
}

/// Whether a library function is compiled.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Open,
    Taken,
    Left,
}

struct Search<'a> {
    materials: &'a [Vec<Choosable>],
    price: f64,
    states: Vec<State>,
    best: Option<(Vec<usize>, Total)>,
}

/// The total of a choice. Ties are broken by the error, then by name.
#[derive(Clone)]
struct Total {
    cost: f64,
    error: f64,
    names: Vec<String>,
}

impl Total {
    fn order(&self, other: &Total) -> Ordering {
        let alike = (self.cost - other.cost).abs() <= 1e-12 * self.cost.abs().max(other.cost.abs());
        let by_cost = if alike {
            Ordering::Equal
        } else {
            self.cost.total_cmp(&other.cost)
        };
        by_cost
            .then(self.error.total_cmp(&other.error))
            .then_with(|| self.names.cmp(&other.names))
    }
}

impl Search<'_> {
    fn descend(&mut self, next: usize) {
        if let Some((_, best)) = &self.best
            && self.bound() > best.cost * (1.0 + 1e-12)
        {
            return;
        }
        // Without a price sharing saves nothing: one pass decides.
        if next == self.states.len() || self.price == 0.0 {
            return self.enter();
        }
        for state in [State::Left, State::Taken] {
            self.states[next] = state;
            self.descend(next + 1);
        }
        self.states[next] = State::Open;
    }

    /// A lower bound of the cost of all choices below this node.
    fn bound(&self) -> f64 {
        let taken = self.states.iter().filter(|state| **state == State::Taken);
        let least = |material: &Vec<Choosable>| {
            let costs = material.iter().filter_map(|one| self.cost(one));
            costs.fold(f64::INFINITY, f64::min)
        };
        let own: f64 = self.materials.iter().map(least).sum();
        own + taken.count() as f64 * self.price
    }

    /// The cost that a function adds. It includes the price where the function is the material's own. `None` where the function
    /// is left out.
    fn cost(&self, one: &Choosable) -> Option<f64> {
        match one.shared {
            None => Some(one.cost + self.price),
            Some(function) => (self.states[function] != State::Left).then_some(one.cost),
        }
    }

    /// Records the best choice, once every library function is decided.
    fn enter(&mut self) {
        let mut choice = Vec::new();
        for material in self.materials {
            let open = (0..material.len()).filter_map(|i| Some((i, self.cost(&material[i])?)));
            let first = open.min_by(|(a, a_cost), (b, b_cost)| {
                let [a, b] = [*a, *b].map(|i| &material[i]);
                a_cost
                    .total_cmp(b_cost)
                    .then(a.error.total_cmp(&b.error))
                    .then_with(|| a.name.cmp(&b.name))
            });
            let Some((first, _)) = first else { return };
            choice.push(first);
        }
        let total = self.total(&choice);
        let is_better = |(_, best): &(Vec<usize>, Total)| total.order(best) == Ordering::Less;
        if self.best.as_ref().is_none_or(is_better) {
            self.best = Some((choice, total));
        }
    }

    fn total(&self, choice: &[usize]) -> Total {
        let chosen = self.materials.iter().zip(choice);
        let chosen: Vec<&Choosable> = chosen.map(|(material, i)| &material[*i]).collect();
        Total {
            cost: total_cost(chosen.iter().copied(), self.price),
            error: chosen.iter().map(|one| one.error).sum(),
            names: chosen.iter().map(|one| one.name.clone()).collect(),
        }
    }
}

/// What functions cost together.
pub fn total_cost<'a>(chosen: impl Iterator<Item = &'a Choosable> + Clone, price: f64) -> f64 {
    let mut shared: Vec<usize> = chosen.clone().filter_map(|one| one.shared).collect();
    shared.sort_unstable();
    shared.dedup();
    let own = chosen.clone().filter(|one| one.shared.is_none()).count();
    let sum: f64 = chosen.map(|one| one.cost).sum();
    sum + (own + shared.len()) as f64 * price
}

/// Functions that are judged together. The truth is the first. With three channels each they fill two blocks of columns.
const TOGETHER: usize = 5;

/// The shared inputs of judging all candidates of all materials.
pub(super) struct Judge {
    pub rule: RoughRule,
    pub screen: Screen,
    /// In stops.
    pub exposures: Vec<f64>,
}

/// A function to be judged: its values, and the least cost of its candidates.
struct Turn<'a> {
    cost: f64,
    place: usize,
    values: &'a [[f64; 3]],
}

impl Judge {
    /// The errors in some pixels, by this measure. Candidates with the same values, such as the forms of a method, have the same
    /// error. `is_enough` says whether, at this error of a candidate, those that cost more may be left out.
    pub fn errors(
        &self,
        judged: &JudgedMaterial,
        pixels: &[ScenePixel],
        is_enough: &dyn Fn(&JudgedCandidate, f64) -> bool,
        measure: impl Fn(&JudgedPixels, &Curve) -> f64 + Sync,
    ) -> Vec<f64> {
        let places: Vec<PixelPlace> = pixels.iter().map(PixelPlace::of).collect();
        let (distinct, place_of) = distinct_values(&judged.candidates);
        let turns = turns(judged, &distinct, &place_of);
        let mut errors = vec![f64::INFINITY; distinct.len()];
        let mut enough = f64::INFINITY;
        let mut seen = None;
        for batch in turns.chunks(TOGETHER) {
            if batch[0].cost > enough {
                break;
            }
            let functions: Vec<&[[f64; 3]]> = batch.iter().map(|turn| turn.values).collect();
            let curves = curves(&functions, &places, &self.rule);
            let is_first = seen.is_none();
            let seen: &JudgedPixels = seen.get_or_insert_with(|| {
                JudgedPixels::new(pixels, &places, &curves[0], &self.screen, &self.exposures)
            });
            let from = usize::from(is_first);
            let error = |i: usize| measure(seen, &curves[from + i]);
            let found = in_parallel(batch.len() - from, &error, &mut |_, _| {});
            for (turn, error) in batch[from..].iter().zip(found) {
                errors[turn.place] = error;
            }
            let all = judged.candidates.iter().zip(&place_of);
            enough = all
                .filter(|(one, place)| is_enough(one, errors[**place]))
                .map(|(one, _)| one.candidate.cost)
                .fold(f64::INFINITY, f64::min);
        }
        place_of.iter().map(|place| errors[*place]).collect()
    }
}

/// The truth, the shared function that the report compares the plan with, and all others by their cost.
fn turns<'a>(
    judged: &'a JudgedMaterial,
    distinct: &[&'a [[f64; 3]]],
    place_of: &[usize],
) -> Vec<Turn<'a>> {
    let turn = |(place, values): (usize, &&'a [[f64; 3]])| {
        let all = judged.candidates.iter().zip(place_of);
        let own = all.filter(|(_, of)| **of == place);
        let cost = own.map(|(one, _)| {
            if is_shared(&one.candidate) {
                f64::NEG_INFINITY
            } else {
                one.candidate.cost
            }
        });
        Turn {
            cost: cost.fold(f64::INFINITY, f64::min),
            place,
            values,
        }
    };
    let mut turns: Vec<Turn> = distinct.iter().enumerate().map(turn).collect();
    turns.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let truth = Turn {
        cost: f64::NEG_INFINITY,
        place: 0,
        values: &judged.truth,
    };
    turns.insert(0, truth);
    turns
}

/// The distinct values of candidates, and for each candidate its index among them.
pub(super) fn distinct_values(candidates: &[JudgedCandidate]) -> (Vec<&[[f64; 3]]>, Vec<usize>) {
    let mut distinct: Vec<&[[f64; 3]]> = Vec::new();
    let mut places = Vec::new();
    for one in candidates {
        let values = &*one.candidate.values;
        let is_same = |known: &&[[f64; 3]]| std::ptr::eq(*known, values) || *known == values;
        let known = distinct.iter().position(is_same);
        places.push(known.unwrap_or(distinct.len()));
        if known.is_none() {
            distinct.push(values);
        }
    }
    (distinct, places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn one(cost: f64, error: f64, name: &str, shared: Option<usize>) -> Choosable {
        Choosable {
            cost,
            error,
            name: name.to_owned(),
            shared,
        }
    }

    #[test]
    fn the_cheapest_is_taken_and_ties_fall_to_the_error_then_the_name() {
        let material = vec![
            one(12.0, 0.5, "schlick", None),
            one(12.0, 0.4, "z", None),
            one(12.0, 0.4, "empirical", None),
            one(22.0, 0.1, "fitted", None),
        ];
        assert_eq!(choose(&[material], 0.0), [2]);
    }

    #[test]
    fn a_library_function_is_shared_where_functions_have_a_price() {
        let material = || {
            vec![
                one(10.0, 0.1, "own", None),
                one(14.0, 0.1, "fitted", Some(0)),
            ]
        };
        let two = [material(), material()];
        assert_eq!(choose(&two, 0.0), [0, 0]);
        assert_eq!(choose(&two, 7.0), [0, 0]);
        assert_eq!(choose(&two, 9.0), [1, 1]);
        let chosen = [&two[0][1], &two[1][1]];
        assert_eq!(total_cost(chosen.into_iter(), 9.0), 37.0);
    }

    fn materials() -> impl Strategy<Value = Vec<Vec<Choosable>>> {
        let function = (0_u8..40, 0_u8..20, prop::option::of(0_usize..4));
        let material = prop::collection::vec(function, 1..6);
        let named = |functions: Vec<(u8, u8, Option<usize>)>| {
            let each = functions.into_iter().enumerate();
            each.map(|(i, (cost, error, shared))| {
                one(f64::from(cost), f64::from(error), &i.to_string(), shared)
            })
            .collect()
        };
        prop::collection::vec(material.prop_map(named), 1..5)
    }

    /// The least total of all choices.
    fn least(materials: &[Vec<Choosable>], price: f64) -> f64 {
        fn visit<'a>(
            rest: &'a [Vec<Choosable>],
            chosen: &mut Vec<&'a Choosable>,
            found: &mut dyn FnMut(&[&Choosable]),
        ) {
            let Some((first, rest)) = rest.split_first() else {
                return found(chosen);
            };
            for candidate in first {
                chosen.push(candidate);
                visit(rest, chosen, found);
                chosen.pop();
            }
        }
        let mut best = f64::INFINITY;
        visit(materials, &mut Vec::new(), &mut |chosen| {
            best = best.min(total_cost(chosen.iter().copied(), price));
        });
        best
    }

    /// The cost of the plan for a budget.
    fn planned(materials: &[Vec<Choosable>], price: f64, budget: f64) -> f64 {
        let one = |functions: &Vec<Choosable>| -> Vec<Choosable> {
            let places = within(functions, budget).into_iter();
            places.map(|place| functions[place].clone()).collect()
        };
        let open: Vec<Vec<Choosable>> = materials.iter().map(one).collect();
        let chosen = open.iter().zip(choose(&open, price));
        let chosen: Vec<&Choosable> = chosen.map(|(all, i)| &all[i]).collect();
        let total = total_cost(chosen.iter().copied(), price);
        assert!((total - least(&open, price)).abs() < 1e-9, "{total}");
        total
    }

    proptest! {
        #[test]
        fn the_total_is_the_least_and_a_smaller_budget_is_never_cheaper(
            materials in materials(),
            price in 0_u8..30,
            budgets in (0_u8..20, 0_u8..20),
        ) {
            let price = f64::from(price);
            let [small, large] = [budgets.0.min(budgets.1), budgets.0.max(budgets.1)];
            let small = planned(&materials, price, f64::from(small));
            let large = planned(&materials, price, f64::from(large));
            prop_assert!(small >= large - 1e-9, "{small} is less than {large}");
        }
    }
}
