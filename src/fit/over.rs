//! Model error of library functions over stated sets of media: what methods' claims are held against.

use crate::ir::{Value, evaluate};
use crate::materials::Channels;
use crate::methods::{Method, Over};

use super::derive::{Derivation, values};
use super::model_error::{ANGLES, ModelError, cosines, difference};

/// Of each set, as many values of eta; as many of n, and of k.
const STEPS: usize = 24;

/// The media of a set, three to a `Channels`.
pub fn media(over: Over) -> Vec<Channels> {
    let points: Vec<(f64, f64)> = match over {
        Over::Dielectrics => (0..=2 * STEPS)
            .map(|i| (between(1.3, 2.5, i, 2 * STEPS), 0.0))
            .collect(),
        Over::Metals => (0..=STEPS)
            .flat_map(|i| (0..=STEPS).map(move |j| (i, j)))
            .map(|(i, j)| {
                (
                    0.05 * libm::pow(4.5 / 0.05, i as f64 / STEPS as f64),
                    between(1.5, 8.0, j, STEPS),
                )
            })
            .collect(),
        Over::Wide => (0..=STEPS)
            .flat_map(|i| (0..=STEPS).map(move |j| (i, j)))
            .map(|(i, j)| {
                let share = |step: usize| step as f64 / STEPS as f64;
                (
                    1.0 + 1e-4 * libm::pow(1.1e5, share(i)),
                    13.0 * share(j).powi(2),
                )
            })
            .collect(),
    };
    let channels = |three: &[(f64, f64)]| {
        let point = |i: usize| three[i.min(three.len() - 1)];
        Channels {
            n: [0, 1, 2].map(|i| point(i).0),
            k: [0, 1, 2].map(|i| point(i).1),
        }
    };
    points.chunks(3).map(channels).collect()
}

fn between(low: f64, high: f64, step: usize, steps: usize) -> f64 {
    low + (high - low) * step as f64 / steps as f64
}

/// The model error of a method's library function over a set of media.
pub fn model_error_over(method: &Method, over: Over) -> ModelError {
    let function = method
        .function(false)
        .expect("every method's function is well formed; a test builds all");
    let cosines = cosines(ANGLES / 4);
    let media = media(over);
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
        difference(&evaluate(&function, &all), channels, &cosines)
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
