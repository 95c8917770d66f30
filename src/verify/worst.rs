//! The worst inputs found so far, kept for ever: a line each, with how they were found.

use crate::fit::values;
use crate::ir::Ty;
use crate::materials::Channels;
use crate::methods::Method;
use crate::reference::Derivation;

static LIBRARY: &str = include_str!("../../data/worst-cases/library-code-error.csv");
static SPECIALISED: &str = include_str!("../../data/worst-cases/specialised-code-error.csv");

/// The cosines at which the specialised functions of a method were worst, whatever the material.
pub fn worst_cosines(method: &'static Method) -> impl Iterator<Item = f32> {
    SPECIALISED.lines().filter_map(|line| {
        let (name, rest) = line.split_once(',')?;
        let (_, cos_theta) = rest.split_once(',')?;
        let cos_theta = cos_theta.parse().ok()?;
        (name == method.name).then_some(cos_theta)
    })
}

/// The values of a library function's arguments, in f32, and the cosine.
pub fn worst_cases(method: &'static Method) -> impl Iterator<Item = (Vec<[f32; 3]>, f32)> {
    worst_media(method).map(|(channels, cos_theta)| (arguments(method, &channels), cos_theta))
}

/// The media and the cosine.
pub fn worst_media(method: &'static Method) -> impl Iterator<Item = (Channels, f32)> {
    LIBRARY.lines().filter_map(|line| {
        let (name, numbers) = line.split_once(',')?;
        let numbers: Vec<f64> = numbers
            .split(',')
            .filter_map(|cell| cell.parse().ok())
            .collect();
        match (name == method.name, numbers.as_slice()) {
            (true, [n, k, cos_theta]) => Some((
                Channels {
                    n: [*n; 3],
                    k: [*k; 3],
                },
                *cos_theta as f32,
            )),
            _ => None,
        }
    })
}

fn arguments(method: &Method, channels: &Channels) -> Vec<[f32; 3]> {
    let values = values(method, channels, &Derivation::default());
    let numbers = method.inputs.iter().filter(|input| input.ty != Ty::Texture);
    numbers
        .map(|input| values[input.name].map(|value| value as f32))
        .collect()
}
