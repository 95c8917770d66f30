//! The inputs that minimise a method's largest error, whatever the inputs were meant to be. A rival method is charted with these
//! too, beside its intended inputs. Otherwise a comparison would only show that its inputs were not chosen for it.
//!
//! Each round linearises the method by its derivatives, takes the step of the exchange algorithm ([`minimax`]), and halves it
//! until the largest error falls. Where a method is linear in its inputs, the first step reaches the optimum. Elsewhere the
//! result is a local optimum.
//!
//! Source: Osborne, Watson, "An algorithm for minimax approximation in the nonlinear case", The Computer Journal 12(1), 1969,
//! 63-68, <https://doi.org/10.1093/comjnl/12.1.63>.

use std::cell::RefCell;
use std::ops::Range;

use super::minimax::{Points, minimax};
use super::problem::FitCurve;
use crate::generator::reference::FITTED_COSINES;
use crate::language::ir::{Checked, Repeated, Ty, Value, evaluate};
use crate::language::methods::{Input, Method, Values};

/// The most rounds. After these, inputs no longer move visibly.
const ROUNDS: usize = 40;
const HALVINGS: usize = 16;
/// The step of a numerical derivative, relative to the input.
const STEP: f64 = 1e-5;
/// The least gain of a round, as a share of the error.
const GAIN: f64 = 1e-6;

struct InputSearch<'a> {
    inputs: &'static [Input],
    curve: &'a FitCurve,
    /// The function at the curve's cosines.
    run: RefCell<Repeated<'a, f64>>,
    /// Whether a channel depends on that channel of the inputs alone, so that it can be computed by itself.
    is_apart: bool,
}

/// One number that may move: one channel of an input, or all its channels together.
#[derive(Clone, Copy)]
struct Free {
    /// The place of the input among the method's inputs.
    input: usize,
    channel: Option<usize>,
}

/// The values of all inputs, in their order.
type Numbers = Vec<[f64; 3]>;

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
    let rival = InputSearch::new((method, function), curve);
    let apart = rival.shared(numbers(method.inputs, intended));
    let best = rival.by_channel(rival.together(apart));
    let names = method.inputs.iter().map(|input| input.name.to_owned());
    Some(names.zip(best).collect())
}

fn numbers(inputs: &[Input], values: &Values) -> Numbers {
    inputs.iter().map(|input| values[input.name]).collect()
}

/// The values of a function of `cos_theta` and these inputs at some cosines.
pub fn values_at(
    function: &Checked,
    inputs: &[Input],
    values: &Values,
    cosines: &[f64],
) -> Value<f64> {
    let (cosines, numbers) = (Value::each(cosines.to_vec()), numbers(inputs, values));
    evaluate(function, &arguments(inputs, &numbers, cosines, None))
}

/// The arguments of a function of `cos_theta` and these inputs. For one channel, colours are that channel's numbers.
fn arguments(
    inputs: &[Input],
    numbers: &[[f64; 3]],
    cosines: Value<f64>,
    channel: Option<usize>,
) -> Vec<Value<f64>> {
    let argument = |(input, value): (&Input, &[f64; 3])| match (input.ty, channel) {
        (Ty::Scalar, _) => Value::scalar(value[0]),
        (_, Some(channel)) => Value::scalar(value[channel]),
        (_, None) => Value::rgb(*value),
    };
    let inputs = inputs.iter().zip(numbers).map(argument);
    [cosines].into_iter().chain(inputs).collect()
}

/// Inputs, and the error against the curve at each point.
type TriedInputs = (Numbers, Vec<f64>);

impl<'a> InputSearch<'a> {
    fn new((method, function): (&Method, &'a Checked), curve: &'a FitCurve) -> InputSearch<'a> {
        let cosines = Value::each(FITTED_COSINES.clone());
        InputSearch {
            inputs: method.inputs,
            curve,
            run: RefCell::new(Repeated::new(function, &[cosines])),
            is_apart: function.keeps_channels_apart(),
        }
    }

    /// Improves the inputs of each channel separately.
    fn by_channel(&self, start: Numbers) -> Numbers {
        (0..3).fold(start, |best, channel| self.of_channel(best, channel))
    }

    /// Improves the inputs of one channel. Where they are not linearly independent over the angles, they move one after the
    /// other.
    fn of_channel(&self, start: Numbers, channel: usize) -> Numbers {
        let free = self.free(Some(channel));
        let as_they_are = |values: Numbers| {
            let missed = self.missed(&values, Some(channel));
            (values, missed)
        };
        let together = improved(as_they_are(start), &free, &as_they_are);
        if free.len() == 1 && together.is_settled {
            return together.best.0;
        }
        let alone = |best, one: &Free| improved(best, &[*one], &as_they_are).best;
        free.iter().fold(together.best, alone).0
    }

    /// Improves the numbers that channels share, with each channel at its best for them.
    fn shared(&self, start: Numbers) -> Numbers {
        let at_their_best = |values: Numbers| {
            let best = self.by_channel(values);
            let missed = self.missed(&best, None);
            (best, missed)
        };
        match self.free(None).as_slice() {
            [] => start,
            free => improved(at_their_best(start), free, &at_their_best).best.0,
        }
    }

    /// Improves the shared numbers and those of each channel all at once. Where channels share a number, alternating steps may
    /// stop where no step of either kind alone gains.
    fn together(&self, start: Numbers) -> Numbers {
        let shared = self.free(None);
        if shared.is_empty() {
            return start;
        }
        let own = (0..3).flat_map(|channel| self.free(Some(channel)));
        let free: Vec<Free> = own.chain(shared).collect();
        // Channel after channel, with the points of each in order.
        let as_they_are = |values: Numbers| {
            let missed = (0..3).flat_map(|channel| self.missed(&values, Some(channel)));
            let missed = missed.collect();
            (values, missed)
        };
        improved(as_they_are(start), &free, &as_they_are).best.0
    }

    /// The numbers of one channel, or those that channels share.
    fn free(&self, channel: Option<usize>) -> Vec<Free> {
        let ty = match channel {
            Some(_) => Ty::Vec3,
            None => Ty::Scalar,
        };
        let places = 0..self.inputs.len();
        let own = places.filter(|input| self.inputs[*input].ty == ty);
        own.map(|input| Free { input, channel }).collect()
    }

    /// The error against the curve at each point: of one channel, or of all, point by point.
    fn missed(&self, values: &[[f64; 3]], channel: Option<usize>) -> Vec<f64> {
        let alone = channel.filter(|_| self.is_apart);
        // The cosines do not vary, so that this argument is not read.
        let arguments = arguments(self.inputs, values, Value::each(Vec::new()), alone);
        let mut run = self.run.borrow_mut();
        let given = run.result(&arguments);
        let own = channels(channel);
        let mut missed = Vec::with_capacity(own.len() * self.curve.seen.len());
        for (point, seen) in self.curve.seen.iter().enumerate() {
            for i in own.clone() {
                missed.push(seen[i] - given.channel(i).at(point));
            }
        }
        missed
    }
}

/// The result of a search.
struct Improved {
    best: TriedInputs,
    /// Whether no further round gains.
    is_settled: bool,
}

/// Improves some numbers: rounds of the exchange on the derivatives, until none gains.
fn improved(
    (mut best, mut missed): TriedInputs,
    free: &[Free],
    trial: &dyn Fn(Numbers) -> TriedInputs,
) -> Improved {
    let ones = vec![1.0; missed.len()];
    let mut is_settled = true;
    for round in 1..=ROUNDS {
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
        is_settled = round < ROUNDS;
    }
    Improved {
        best: (best, missed),
        is_settled,
    }
}

/// The derivative of each point's value by each free number, by central differences.
fn slopes(
    values: &[[f64; 3]],
    free: &[Free],
    trial: &dyn Fn(Numbers) -> TriedInputs,
) -> Vec<Vec<f64>> {
    let column = |one: &Free| -> Vec<f64> {
        let step = STEP * (1.0 + values[one.input][one.channel.unwrap_or(0)].abs());
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
fn moved(values: &[[f64; 3]], free: &[Free], step: &[f64], share: f64) -> Numbers {
    let mut moved = values.to_vec();
    for (one, step) in free.iter().zip(step) {
        for value in &mut moved[one.input][channels(one.channel)] {
            *value += share * step;
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
            InputSearch::new((self.method, &self.function), &self.curve)
        }

        /// The largest error with these inputs, each channel at its best.
        fn by_channel(&self, values: &Values) -> f64 {
            let search = self.search();
            let best = search.by_channel(numbers(self.method.inputs, values));
            most(&search.missed(&best, None))
        }

        /// The largest error with these inputs.
        fn largest(&self, values: &Values) -> f64 {
            let numbers = numbers(self.method.inputs, values);
            most(&self.search().missed(&numbers, None))
        }
    }

    /// What is computed once, and what is computed for one channel, is what the whole function gives, to the bit.
    #[test]
    fn a_channel_by_itself_is_what_it_is_beside_the_others() {
        let mut apart = 0;
        for method in ALL.iter().filter(|method| !method.is_textured()) {
            let Channels { n, k } = GOLD;
            let curve = FitCurve::new(|c| [0, 1, 2].map(|i| optics::unpolarised(n[i], k[i], c)));
            let intended = values(method, &GOLD, &Derivation::default());
            let function = method.function(false).expect("it builds");
            let search = InputSearch::new((method, &function), &curve);
            let numbers = numbers(method.inputs, &intended);
            let whole = values_at(&function, method.inputs, &intended, &FITTED_COSINES);
            for _ in 0..2 {
                for channel in 0..3 {
                    let seen = curve.seen.iter().map(|seen| seen[channel]);
                    let missed = search.missed(&numbers, Some(channel)).into_iter();
                    for (point, (seen, missed)) in seen.zip(missed).enumerate() {
                        let want = seen - whole.at(point)[channel];
                        assert_eq!(missed.to_bits(), want.to_bits(), "{}", method.name);
                    }
                }
                assert_eq!(search.missed(&numbers, None).len(), 3 * curve.seen.len());
            }
            apart += usize::from(search.is_apart);
        }
        assert!(apart > 20, "{apart}");
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
                    let near = case.by_channel(&near);
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
            case.by_channel(&given)
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
