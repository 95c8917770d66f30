//! The worst inputs found so far, kept for ever: a line each, with how they were found.

use serde::Deserialize;

use crate::generator::fit::values;
use crate::generator::reference::Derivation;
use crate::language::ir::Ty;
use crate::language::methods::Method;
use crate::physics::materials::Channels;
use crate::physics::records;

static LIBRARY: &str = include_str!("../../../data/worst-cases/library-code-error.csv");
static SPECIALISED: &str = include_str!("../../../data/worst-cases/specialised-code-error.csv");

/// A line of the library functions' record.
#[derive(Deserialize)]
struct WorstMedium {
    method: String,
    n: f64,
    k: f64,
    cos_theta: f64,
}

/// A line of the specialised functions' record.
#[derive(Deserialize)]
struct WorstCosine {
    method: String,
    cos_theta: f32,
}

/// The cosines at which the specialised functions of a method were worst, whatever the material.
pub fn worst_cosines(method: &'static Method) -> impl Iterator<Item = f32> {
    let rows: Vec<WorstCosine> = records::rows(SPECIALISED);
    let own = rows.into_iter().filter(|row| row.method == method.name);
    own.map(|row| row.cos_theta)
}

/// The values of a library function's arguments, in f32, and the cosine.
pub fn worst_cases(method: &'static Method) -> impl Iterator<Item = (Vec<[f32; 3]>, f32)> {
    worst_media(method).map(|(channels, cos_theta)| (arguments(method, &channels), cos_theta))
}

/// The media and the cosine.
pub fn worst_media(method: &'static Method) -> impl Iterator<Item = (Channels, f32)> {
    let rows: Vec<WorstMedium> = records::rows(LIBRARY);
    let own = rows.into_iter().filter(|row| row.method == method.name);
    own.map(|row| {
        let channels = Channels {
            n: [row.n; 3],
            k: [row.k; 3],
        };
        (channels, row.cos_theta as f32)
    })
}

fn arguments(method: &Method, channels: &Channels) -> Vec<[f32; 3]> {
    let values = values(method, channels, &Derivation::default());
    let numbers = method.inputs.iter().filter(|input| input.ty != Ty::Texture);
    numbers
        .map(|input| values[input.name].map(|value| value as f32))
        .collect()
}
