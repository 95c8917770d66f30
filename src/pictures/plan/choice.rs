//! The choice of a function for each material at the least total cost. Pure.
//!
//! ```text
//! total = Σ over materials of cost × pixels + price × number of different functions
//! ```
//!
//! Specialised functions differ from material to material; a library function serves all materials that take it. The least total is
//! found by branch and bound over the library functions: exact, and quick because few of them can pay for themselves.

use core::cmp::Ordering;
use std::collections::BTreeSet;

/// A function that a material may get.
#[derive(Clone, Debug, PartialEq)]
pub struct Choosable {
    /// Its cost for all pixels of the material, without the price of a function.
    pub cost: f64,
    /// Its error.
    pub error: f64,
    /// Its name, the last tie-breaker. Library functions of one name are one function.
    pub name: String,
    /// Whether it is the material's own, and no library function.
    pub is_own: bool,
}

/// The index of the chosen function of each material, which has at least one. `price` is that of a function.
///
/// A function is chosen among those within the budget; if a material has none, among those with the least error. The functions
/// for a smaller budget are always among those for a larger one, so a smaller budget never makes a plan cheaper.
pub fn choose(materials: &[Vec<Choosable>], budget: f64, price: f64) -> Vec<usize> {
    let within: Vec<Vec<(usize, &Choosable)>> = materials
        .iter()
        .map(|functions| within(functions, budget))
        .collect();
    let library = within.iter().flatten().filter(|(_, one)| !one.is_own);
    let library: BTreeSet<&str> = library.map(|(_, one)| &*one.name).collect();
    let library: Vec<&str> = library.into_iter().collect();
    let open = within.into_iter().map(|functions| {
        let functions = functions.into_iter().map(|(place, function)| Open {
            place,
            function,
            library: library
                .binary_search(&&*function.name)
                .ok()
                .filter(|_| !function.is_own),
        });
        functions.collect()
    });
    let mut search = Search {
        materials: open.collect(),
        price,
        states: vec![State::Open; library.len()],
        best: None,
    };
    search.descend(0);
    let best = search.best.map(|best| best.functions).unwrap_or_default();
    best.iter().map(|one| one.place).collect()
}

/// A material's functions within a budget, with their indices; if there are none, those with the least error.
fn within(functions: &[Choosable], budget: f64) -> Vec<(usize, &Choosable)> {
    let errors = functions.iter().map(|one| one.error);
    let most = errors.fold(f64::INFINITY, f64::min).max(budget);
    let all = functions.iter().enumerate();
    all.filter(|(_, one)| one.error <= most).collect()
}

/// What functions cost together.
pub fn total_cost<'a>(chosen: impl Iterator<Item = &'a Choosable> + Clone, price: f64) -> f64 {
    let library = chosen.clone().filter(|one| !one.is_own);
    let library: BTreeSet<&str> = library.map(|one| &*one.name).collect();
    let own = chosen.clone().filter(|one| one.is_own).count();
    let sum: f64 = chosen.map(|one| one.cost).sum();
    sum + (own + library.len()) as f64 * price
}

/// A function within the budget.
#[derive(Clone, Copy)]
struct Open<'a> {
    /// Its index among the functions of its material.
    place: usize,
    function: &'a Choosable,
    /// The index of its library function; `None` where it is the material's own.
    library: Option<usize>,
}

/// Whether a library function is compiled.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Open,
    Taken,
    Left,
}

struct Search<'a> {
    materials: Vec<Vec<Open<'a>>>,
    price: f64,
    /// Of each library function.
    states: Vec<State>,
    best: Option<Choice<'a>>,
}

/// A function for each material. Ties of the cost are broken by the error, then by name.
struct Choice<'a> {
    functions: Vec<Open<'a>>,
    cost: f64,
    error: f64,
}

impl Choice<'_> {
    fn names(&self) -> impl Iterator<Item = &str> {
        self.functions.iter().map(|one| &*one.function.name)
    }

    fn order(&self, other: &Choice) -> Ordering {
        let alike = (self.cost - other.cost).abs() <= 1e-12 * self.cost.abs().max(other.cost.abs());
        let by_cost = if alike {
            Ordering::Equal
        } else {
            self.cost.total_cmp(&other.cost)
        };
        by_cost
            .then(self.error.total_cmp(&other.error))
            .then_with(|| self.names().cmp(other.names()))
    }
}

impl Search<'_> {
    fn descend(&mut self, next: usize) {
        if let Some(best) = &self.best
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
        let least = |material: &Vec<Open>| {
            let costs = material.iter().filter_map(|one| self.cost(one));
            costs.fold(f64::INFINITY, f64::min)
        };
        let own: f64 = self.materials.iter().map(least).sum();
        own + taken.count() as f64 * self.price
    }

    /// The cost that a function adds. It includes the price where the function is the material's own. `None` where the function
    /// is left out.
    fn cost(&self, one: &Open) -> Option<f64> {
        match one.library {
            None => Some(one.function.cost + self.price),
            Some(function) => (self.states[function] != State::Left).then_some(one.function.cost),
        }
    }

    /// Records the best choice, once every library function is decided.
    fn enter(&mut self) {
        let mut functions = Vec::new();
        for material in &self.materials {
            let open = material
                .iter()
                .filter_map(|one| Some((one, self.cost(one)?)));
            let first = open.min_by(|(a, a_cost), (b, b_cost)| {
                let [a, b] = [a, b].map(|one| one.function);
                a_cost
                    .total_cmp(b_cost)
                    .then(a.error.total_cmp(&b.error))
                    .then_with(|| a.name.cmp(&b.name))
            });
            let Some((first, _)) = first else { return };
            functions.push(*first);
        }
        let chosen = functions.iter().map(|one| one.function);
        let choice = Choice {
            cost: total_cost(chosen.clone(), self.price),
            error: chosen.map(|one| one.error).sum(),
            functions,
        };
        let is_better = |best: &Choice| choice.order(best) == Ordering::Less;
        if self.best.as_ref().is_none_or(is_better) {
            self.best = Some(choice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn one(cost: f64, error: f64, name: &str) -> Choosable {
        Choosable {
            cost,
            error,
            name: name.to_owned(),
            is_own: true,
        }
    }

    fn library(cost: f64, error: f64, name: &str) -> Choosable {
        Choosable {
            is_own: false,
            ..one(cost, error, name)
        }
    }

    #[test]
    fn the_cheapest_is_taken_and_ties_fall_to_the_error_then_the_name() {
        let material = vec![
            one(12.0, 0.5, "schlick"),
            one(12.0, 0.4, "z"),
            one(12.0, 0.4, "empirical"),
            one(22.0, 0.1, "fitted"),
        ];
        assert_eq!(choose(&[material], 1.0, 0.0), [2]);
    }

    #[test]
    fn a_library_function_is_shared_where_functions_have_a_price() {
        let material = || vec![one(10.0, 0.1, "own"), library(14.0, 0.1, "fitted")];
        let two = [material(), material()];
        assert_eq!(choose(&two, 1.0, 0.0), [0, 0]);
        assert_eq!(choose(&two, 1.0, 7.0), [0, 0]);
        assert_eq!(choose(&two, 1.0, 9.0), [1, 1]);
        let chosen = [&two[0][1], &two[1][1]];
        assert_eq!(total_cost(chosen.into_iter(), 9.0), 37.0);
    }

    fn materials() -> impl Strategy<Value = Vec<Vec<Choosable>>> {
        let function = (0_u8..40, 0_u8..20, prop::option::of(0_usize..4));
        let material = prop::collection::vec(function, 1..6);
        let named = |functions: Vec<(u8, u8, Option<usize>)>| {
            let each = functions.into_iter().enumerate();
            each.map(|(i, (cost, error, shared))| {
                let (cost, error) = (f64::from(cost), f64::from(error));
                match shared {
                    None => one(cost, error, &i.to_string()),
                    Some(place) => library(cost, error, &format!("library {place}")),
                }
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

    /// The cost of the plan for a budget, which is the least of all choices within it.
    fn planned(materials: &[Vec<Choosable>], price: f64, budget: f64) -> f64 {
        let chosen = materials.iter().zip(choose(materials, budget, price));
        let chosen: Vec<&Choosable> = chosen.map(|(all, i)| &all[i]).collect();
        let total = total_cost(chosen.iter().copied(), price);
        let open = |functions: &Vec<Choosable>| -> Vec<Choosable> {
            let within = within(functions, budget).into_iter();
            within.map(|(_, one)| one.clone()).collect()
        };
        let open: Vec<Vec<Choosable>> = materials.iter().map(open).collect();
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
