//! The inputs that minimise a method's largest error, whatever the inputs were meant to be. A rival method is charted with these
//! too, beside its intended inputs. Otherwise a comparison would only show that its inputs were not chosen for it.
//!
//! Each round linearises the method by its derivatives, takes the step of the exchange algorithm ([`minimax`]), and halves it
//! until the largest error falls. Where a method is linear in its inputs, the first step reaches the optimum. Elsewhere the
//! result is a local optimum.
//!
//! Source: Osborne, Watson, "An algorithm for minimax approximation in the nonlinear case", The Computer Journal 12(1), 1969,
//! 63-68, <https://doi.org/10.1093/comjnl/12.1.63>.

use std::ops::Range;

use super::minimax::{Points, minimax};
use super::problem::FitCurve;
use crate::generator::reference::FITTED_COSINES;
use crate::language::ir::{Checked, Ty, Value, evaluate};
use crate::language::methods::{Input, Method, Values};

/// The most rounds. After these, inputs no longer move visibly.
const ROUNDS: usize = 40;
const HALVINGS: usize = 16;
/// The step of a numerical derivative, relative to the input.
const STEP: f64 = 1e-5;
/// The least gain of a round, as a share of the error.
const GAIN: f64 = 1e-6;

struct InputSearch<'a> {
    function: &'a Checked,
    inputs: &'static [Input],
    curve: &'a FitCurve,
}

/// One number that may move: one channel of an input, or all its channels together.
#[derive(Clone, Copy)]
struct Free {
    name: &'static str,
    channel: Option<usize>,
}

/// The channel, or all where none is named.
fn channels(channel: Option<usize>) -> Range<usize> {
    channel.map_or(0..3, |channel| channel..channel + 1)
}

/// The inputs near the intended ones that minimise the largest error of a library function. None for a method that reads a texture.
pub fn best_inputs(
    (method, function): (&Method, &Checked),
    intended: &Values,
    curve: &FitCurve,
) -> Option<Values> {
    if method.is_textured() {
        return None;
    }
    let rival = InputSearch {
        function,
        inputs: method.inputs,
        curve,
    };
    let apart = rival.shared(intended.clone());
    Some(rival.by_channel(rival.together(apart)))
}

/// The values of a function of `cos_theta` and these inputs at some cosines.
pub fn values_at(
    function: &Checked,
    inputs: &[Input],
    values: &Values,
    cosines: &[f64],
) -> Value<f64> {
    let argument = |input: &Input| match input.ty {
        Ty::Scalar => Value::scalar(values[input.name][0]),
        _ => Value::rgb(values[input.name]),
    };
    let cosines = [Value::each(cosines.to_vec())].into_iter();
    let arguments: Vec<Value<f64>> = cosines.chain(inputs.iter().map(argument)).collect();
    evaluate(function, &arguments)
}

/// Inputs, and the error against the curve at each point.
type TriedInputs = (Values, Vec<f64>);

impl InputSearch<'_> {
    /// Improves the inputs of each channel separately.
    fn by_channel(&self, start: Values) -> Values {
        (0..3).fold(start, |best, channel| self.of_channel(best, channel))
    }

    /// Improves the inputs of one channel. Where they are not linearly independent over the angles, they move one after the
    /// other.
    fn of_channel(&self, start: Values, channel: usize) -> Values {
        let free = self.free(Some(channel));
        let as_they_are = |values: Values| {
            let missed = self.missed(&values, Some(channel));
            (values, missed)
        };
        let together = improved(start, &free, &as_they_are);
        let alone = |best: Values, one: &Free| improved(best, &[*one], &as_they_are);
        free.iter().fold(together, alone)
    }

    /// Improves the numbers that channels share, with each channel at its best for them.
    fn shared(&self, start: Values) -> Values {
        let at_their_best = |values: Values| {
            let best = self.by_channel(values);
            let missed = self.missed(&best, None);
            (best, missed)
        };
        match self.free(None).as_slice() {
            [] => start,
            free => improved(start, free, &at_their_best),
        }
    }

    /// Improves the shared numbers and those of each channel all at once. Where channels share a number, alternating steps may
    /// stop where no step of either kind alone gains.
    fn together(&self, start: Values) -> Values {
        let shared = self.free(None);
        if shared.is_empty() {
            return start;
        }
        let own = (0..3).flat_map(|channel| self.free(Some(channel)));
        let free: Vec<Free> = own.chain(shared).collect();
        // Channel after channel, with the points of each in order.
        let as_they_are = |values: Values| {
            let missed = (0..3).flat_map(|channel| self.missed(&values, Some(channel)));
            let missed = missed.collect();
            (values, missed)
        };
        improved(start, &free, &as_they_are)
    }

    /// The numbers of one channel, or those that channels share.
    fn free(&self, channel: Option<usize>) -> Vec<Free> {
        let ty = match channel {
            Some(_) => Ty::Vec3,
            None => Ty::Scalar,
        };
        let free = |input: &Input| Free {
            name: input.name,
            channel,
        };
        let own = self.inputs.iter().filter(|input| input.ty == ty);
        own.map(free).collect()
    }

    /// The error against the curve at each point: of one channel, or of all, point by point.
    fn missed(&self, values: &Values, channel: Option<usize>) -> Vec<f64> {
        let given = values_at(self.function, self.inputs, values, &FITTED_COSINES);
        let mut missed = Vec::new();
        for (point, seen) in self.curve.seen.iter().enumerate() {
            let given = given.at(point);
            missed.extend(channels(channel).map(|i| seen[i] - given[i]));
        }
        missed
    }
}

/// Improves some numbers: rounds of the exchange on the derivatives, until none gains.
fn improved(start: Values, free: &[Free], trial: &dyn Fn(Values) -> TriedInputs) -> Values {
    let (mut best, mut missed) = trial(start);
    let ones = vec![1.0; missed.len()];
    for _ in 0..ROUNDS {
        let points = Points {
            rows: &slopes(&best, free, trial),
            wanted: &missed,
            weights: &ones,
            limits: &[],
        };
        let Some(step) = minimax(points) else {
            break;
        };
        let before = most(&missed);
        let halved = (0..HALVINGS).map(|times| libm::exp2(-(times as f64)));
        let mut tried = halved.map(|share| trial(moved(&best, free, &step.coefficients, share)));
        let better = tried.find(|(_, missed)| most(missed) < before * (1.0 - GAIN));
        let Some(better) = better else {
            break;
        };
        (best, missed) = better;
    }
    best
}

/// The derivative of each point's value by each free number, by central differences.
fn slopes(values: &Values, free: &[Free], trial: &dyn Fn(Values) -> TriedInputs) -> Vec<Vec<f64>> {
    let column = |one: &Free| -> Vec<f64> {
        let step = STEP * (1.0 + values[one.name][one.channel.unwrap_or(0)].abs());
        let at = |sign: f64| trial(moved(values, &[*one], &[sign * step], 1.0)).1;
        let (above, below) = (at(1.0), at(-1.0));
        let pairs = above.iter().zip(&below);
        pairs.map(|(a, b)| (b - a) / (2.0 * step)).collect()
    };
    let columns: Vec<Vec<f64>> = free.iter().map(column).collect();
    let points = columns.first().map_or(0, Vec::len);
    let row = |point: usize| columns.iter().map(|column| column[point]).collect();
    (0..points).map(row).collect()
}

/// The values after a share of this step.
fn moved(values: &Values, free: &[Free], step: &[f64], share: f64) -> Values {
    let mut moved = values.clone();
    for (one, step) in free.iter().zip(step) {
        if let Some(numbers) = moved.get_mut(one.name) {
            for value in &mut numbers[channels(one.channel)] {
                *value += share * step;
            }
        }
    }
    moved
}

/// The largest error. NaN counts as larger than any number.
fn most(missed: &[f64]) -> f64 {
    if missed.iter().any(|error| error.is_nan()) {
        return f64::INFINITY;
    }
    missed.iter().fold(0.0, |most, error| most.max(error.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::fit::values;
    use crate::generator::reference::Derivation;
    use crate::language::methods::{self, ALL};
    use crate::physics::materials::Channels;
    use crate::physics::optics;

    const GOLD: Channels = Channels {
        n: [0.18, 0.42, 1.37],
        k: [3.43, 2.35, 1.77],
    };

    const PLATINUM: Channels = Channels {
        n: [2.38, 2.08, 1.85],
        k: [4.26, 3.63, 3.07],
    };

    /// A method with its intended inputs and its best ones.
    struct Case {
        method: &'static Method,
        function: Checked,
        curve: FitCurve,
        intended: Values,
        best: Values,
    }

    impl Case {
        fn new(method: &'static Method, Channels { n, k }: &Channels) -> Case {
            let law = |c| [0, 1, 2].map(|i| optics::conductor(n[i], k[i], c).unpolarised());
            let curve = FitCurve::new(law);
            let intended = values(method, &Channels { n: *n, k: *k }, &Derivation::default());
            let function = method.function(false).expect("it builds");
            let best = best_inputs((method, &function), &intended, &curve).expect("it has inputs");
            Case {
                method,
                function,
                curve,
                intended,
                best,
            }
        }

        fn named(name: &str, index: &Channels) -> Case {
            Case::new(methods::find(name).expect("it is there"), index)
        }

        fn search(&self) -> InputSearch<'_> {
            InputSearch {
                function: &self.function,
                inputs: self.method.inputs,
                curve: &self.curve,
            }
        }

        /// The largest error with these inputs.
        fn largest(&self, values: &Values) -> f64 {
            most(&self.search().missed(values, None))
        }
    }

    #[test]
    fn no_method_is_worse_for_it() {
        for method in ALL.iter().filter(|method| !method.is_textured()) {
            let case = Case::new(method, &GOLD);
            let (before, after) = (case.largest(&case.intended), case.largest(&case.best));
            assert!(after <= before, "{}: {before} became {after}", method.name);
        }
    }

    /// A method that includes another one is no worse.
    #[test]
    fn more_numbers_do_no_harm() {
        let best = |name: &str| {
            let case = Case::named(name, &GOLD);
            case.largest(&case.best)
        };
        assert!(best("schlick_f90") < best("schlick"));
        assert!(best("schlick_generalised") < 1.01 * best("schlick_f90"));
        assert!((best("schlick_rescaled") / best("schlick") - 1.0).abs() < 1e-3);
    }

    /// For every method, no input near those found is better, by any step from a thousandth to a tenth, with the other inputs at
    /// their best.
    #[test]
    fn no_inputs_near_the_best_are_better() {
        for method in ALL
            .iter()
            .filter(|method| !method.is_textured() && !method.is_fitted())
            .filter(|method| !method.keeps_inputs())
        {
            let case = Case::new(method, &PLATINUM);
            let found = case.largest(&case.best);
            for input in method.inputs.iter().filter(|input| input.ty == Ty::Scalar) {
                for step in [-0.1, -0.03, -0.01, -0.001, 0.001, 0.01, 0.03, 0.1] {
                    let mut near = case.best.clone();
                    let numbers = near.get_mut(input.name).expect("an input");
                    numbers.iter_mut().for_each(|value| *value *= 1.0 + step);
                    let near = case.largest(&case.search().by_channel(near));
                    assert!(
                        near > found * (1.0 - 2e-3),
                        "{}: {found}, and {near} where {} is {step} more",
                        method.name,
                        input.name
                    );
                }
            }
        }
    }

    /// Schlick's form with F90 for platinum: compares with a search over F90, with F0 at its best for each.
    #[test]
    fn the_best_f90_is_that_of_a_search_over_all() {
        let case = Case::named("schlick_f90", &PLATINUM);
        let found = case.largest(&case.best);
        let least = (700..1100).map(|f90| {
            let mut given = case.intended.clone();
            given.insert("f90".to_owned(), [f64::from(f90) / 1000.0; 3]);
            case.largest(&case.search().by_channel(given))
        });
        let least = least.fold(f64::INFINITY, f64::min);
        assert!(found <= least + 1e-9, "{found}, and {least} is possible");
    }

    /// Schlick's form is linear in f0: no f0 near the one found is better, in any channel.
    #[test]
    fn the_best_f0_is_the_optimum() {
        let case = Case::named("schlick", &GOLD);
        let found = case.largest(&case.best);
        assert!(found < 0.7 * case.largest(&case.intended));
        for channel in 0..3 {
            let near = [-1e-4, 1e-4].map(|by| {
                let mut near = case.best.clone();
                near.get_mut("f0").expect("it is an input")[channel] += by;
                case.largest(&near)
            });
            assert!(near.into_iter().all(|near| near >= found - 1e-9));
        }
    }
}
