//! Model error of library functions over given sets of media.

use fresnel_gen::generator::fit::{ModelError, difference, texels, values};
use fresnel_gen::generator::reference::{ANGLES, Derivation, cosines, reference_reflectance};
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::language::methods::{Input, MediaSet, Method};
use fresnel_gen::physics::materials::{Channels, Surface};
use fresnel_gen::physics::num::each_channel;

/// Steps of eta, of n and of k when model errors are taken over a set.
const STEPS: usize = 24;

/// The media of a set, three to a `Channels`; one for a method that takes one index for all channels.
fn media(over: MediaSet, method: &Method) -> Vec<Channels> {
    let share = |step: usize, steps: usize| step as f64 / steps as f64;
    let points: Vec<(f64, f64)> = match over {
        MediaSet::Dielectrics => (0..=2 * STEPS)
            .map(|i| over.medium(share(i, 2 * STEPS), 0.0))
            .collect(),
        MediaSet::Metals | MediaSet::Wide | MediaSet::Half => (0..=STEPS)
            .flat_map(|i| (0..=STEPS).map(move |j| over.medium(share(i, STEPS), share(j, STEPS))))
            .collect(),
    };
    let is_one = method
        .inputs
        .iter()
        .any(|input| input.name == Input::IOR.name);
    let together = if is_one { 1 } else { 3 };
    points.chunks(together).map(channels).collect()
}

/// Three media, with the last one repeated where there are fewer.
fn channels(three: &[(f64, f64)]) -> Channels {
    let point = |i: usize| three[i.min(three.len() - 1)];
    Channels {
        n: each_channel(|i| point(i).0),
        k: each_channel(|i| point(i).1),
    }
}

/// The model error of a method's library function over a set of media.
pub fn model_error_over(method: &Method, over: MediaSet) -> ModelError {
    let function = method
        .function(false)
        .expect("every method's function is well formed; a test builds all");
    let cosines = cosines(ANGLES / 4);
    let media = media(over, method);
    let errors = media.iter().map(|channels| {
        let constants = values(method, channels, &Derivation::default());
        let mut arguments = vec![Value::each(cosines.clone())];
        let surface = Surface::of_channels(channels);
        let table = texels(|c| reference_reflectance(&surface, method.light, c));
        arguments.extend(method.arguments(&constants, Some(&table)));
        let want: Vec<[f64; 3]> = cosines
            .iter()
            .map(|c| reference_reflectance(&surface, method.light, *c))
            .collect();
        difference(&evaluate(&function, &arguments), &want, &cosines)
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
