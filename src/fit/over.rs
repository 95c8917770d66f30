//! Model error of library functions over stated sets of media: what methods' claims are held against.

use crate::ir::{Value, evaluate};
use crate::materials::Channels;
use crate::methods::{Method, Over};

use super::derive::{Derivation, values};
use super::model_error::{ANGLES, ModelError, Truth, cosines, difference};

/// Steps of eta, of n and of k, where model errors are taken over a set.
const STEPS: usize = 24;

/// The media of a set in so many steps of n and of k, three to a `Channels`.
fn media(over: Over, steps: usize) -> Vec<Channels> {
    let points: Vec<(f64, f64)> = match over {
        Over::Dielectrics => (0..=2 * steps)
            .map(|i| (between(1.3, 2.5, i, 2 * steps), 0.0))
            .collect(),
        Over::Metals => grid(steps)
            .map(|(i, j)| (geometric(0.05, 4.5, i, steps), between(1.5, 8.0, j, steps)))
            .collect(),
        Over::Wide => {
            let wide = |(i, j)| {
                (
                    1.0 + geometric(1e-4, 11.0, i, steps),
                    squared(13.0, j, steps),
                )
            };
            let mut all = channels(&grid(steps).map(wide).collect::<Vec<_>>());
            all.extend(media(Over::Metals, STEPS));
            return all;
        }
    };
    channels(&points)
}

fn channels(points: &[(f64, f64)]) -> Vec<Channels> {
    let three = |three: &[(f64, f64)]| {
        let point = |i: usize| three[i.min(three.len() - 1)];
        Channels {
            n: [0, 1, 2].map(|i| point(i).0),
            k: [0, 1, 2].map(|i| point(i).1),
        }
    };
    points.chunks(3).map(three).collect()
}

fn grid(steps: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=steps).flat_map(move |i| (0..=steps).map(move |j| (i, j)))
}

fn between(low: f64, high: f64, step: usize, steps: usize) -> f64 {
    low + (high - low) * step as f64 / steps as f64
}

/// Even in the logarithm.
fn geometric(low: f64, high: f64, step: usize, steps: usize) -> f64 {
    low * libm::pow(high / low, step as f64 / steps as f64)
}

/// Denser near 0, where absorption begins to matter.
fn squared(high: f64, step: usize, steps: usize) -> f64 {
    let share = step as f64 / steps as f64;
    high * share * share
}

/// The model error of a method's library function over a set of media.
pub fn model_error_over(method: &Method, over: Over) -> ModelError {
    let function = method
        .function(false)
        .expect("every method's function is well formed; a test builds all");
    let cosines = cosines(ANGLES / 4);
    let media = media(over, STEPS);
    let errors = media.iter().map(|channels| {
        let constants = values(method, channels, &Derivation::default());
        let arguments = method.inputs.iter().map(|input| {
            let value = constants[input.name];
            if input.ty.channels() == 3 {
                Value::rgb(value)
            } else {
                Value::scalar(value[0])
            }
        });
        let all: Vec<Value<f64>> = [Value::each(cosines.clone())]
            .into_iter()
            .chain(arguments)
            .collect();
        difference(
            &evaluate(&function, &all),
            &Truth {
                channels,
                light: method.light,
            },
            &cosines,
        )
    });
    errors
        .reduce(|worst, next| {
            if next.max_abs > worst.max_abs {
                next
            } else {
                worst
            }
        })
        .expect("a set has media")
}
