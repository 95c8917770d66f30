//! Materials as numbers: the index, the values of each method's inputs, and the recorded errors and costs.

use std::collections::BTreeMap;

use serde::Serialize;

use super::packed::Packed;
use crate::generator::fit::{values, values_for_material};
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::lab::chart::{ChartData, ChartEntry};
use crate::language::methods::{Class, Light, Method, Values};
use crate::physics::materials::Channels;
use crate::physics::num::in_parallel;
use crate::physics::optics::COS_82;
use crate::pictures::frontier::four_digits;
use crate::pictures::plot::hex_colour;
use crate::pictures::scene::OpticalMaterial;

/// A material.
#[derive(Clone, Debug, Serialize)]
pub struct MaterialNumbers {
    /// Its name.
    pub name: String,
    /// What it is, in one line.
    pub summary: String,
    /// Its class.
    pub kind: &'static str,
    /// The argument on the command line that names it.
    pub argument: String,
    /// Where it was measured.
    pub reference: String,
    /// The method of adapters that follows it, if the page has it.
    pub method: Option<&'static str>,
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees.
    pub f82: [f64; 3],
    /// Both as sRGB.
    pub hex: [String; 2],
    /// A ball in a white room: the place between its middle and its rim in per cent, and the colour there.
    pub colours: Vec<(f64, String)>,
    /// n of red, green and blue as engines would take it, one index for a channel's reflectance and dip.
    pub effective_n: [f64; 3],
    /// The same: k.
    pub effective_k: [f64; 3],
    /// n of red, green and blue with which it is drawn.
    pub n: [f32; 3],
    /// k of red, green and blue.
    pub k: [f32; 3],
    /// Its absorption coefficient for red, green and blue, per metre.
    pub absorption: [f32; 3],
    /// The thickness of the film on it, in nanometres.
    pub film_nm: Option<f64>,
    /// The values of each method's inputs, in the order of the inputs.
    pub inputs: BTreeMap<&'static str, Vec<[f32; 3]>>,
    /// The errors of each method by each metric.
    pub errors: BTreeMap<&'static str, [Option<f64>; 4]>,
}

/// A method.
#[derive(Clone, Debug, Serialize)]
pub struct MethodNumbers {
    /// Its name.
    pub name: &'static str,
    /// What it is, in one line.
    pub summary: &'static str,
    /// Who published it.
    pub source: String,
    /// Its inputs.
    pub inputs: Vec<&'static str>,
    /// Where it breaks the function contract.
    pub fails: Option<String>,
    /// The cost of an evaluation on each axis.
    pub costs: Vec<Option<f64>>,
}

/// The values of inputs for an index that a reader chooses, the same for all channels.
#[derive(Clone, Debug, Serialize)]
pub struct OwnIndex {
    /// Whether light passes through such bodies.
    pub transparent: bool,
    /// The first n, the step, and the number of values.
    pub n: [f64; 3],
    /// The first k, the step, and the number of values.
    pub k: [f64; 3],
    /// For each method, the number of values per index, and the values: for each n those of each k.
    pub inputs: BTreeMap<&'static str, (usize, Packed)>,
}

/// The methods that the gallery shows: those for unpolarised light without a table. Those of films of one thickness serve no row.
pub fn shown_methods() -> impl Iterator<Item = &'static Method> {
    let all = crate::language::methods::ALL.iter().copied();
    all.filter(|method| {
        method.light == Light::Unpolarised && !method.is_textured() && method.class != Class::Film
    })
}

/// The methods with their costs.
pub fn method_numbers(data: &ChartData) -> Vec<MethodNumbers> {
    let numbers = |method: &'static Method| {
        let place = entry(data, method);
        let costs = data.costs.iter();
        MethodNumbers {
            name: method.name,
            summary: method.summary,
            source: method.source.line(),
            inputs: method.inputs.iter().map(|input| input.name).collect(),
            fails: place.and_then(|place| data.entries[place].fails().map(str::to_owned)),
            costs: costs.map(|axis| axis.costs[place?]).collect(),
        }
    };
    shown_methods().map(numbers).collect()
}

/// The index of a method in the chart's data.
fn entry(data: &ChartData, method: &Method) -> Option<usize> {
    let is_own = |entry: &ChartEntry| entry.name() == method.name;
    data.entries.iter().position(is_own)
}

/// The materials.
pub fn numbers(subjects: &[MaterialInMedium], data: &ChartData) -> Vec<MaterialNumbers> {
    let one = |i: usize| material(&subjects[i], data);
    in_parallel(subjects.len(), &one, &mut |_, _| {})
}

/// The places of a ball's colours: the radius at which an angle is seen is its sine.
const BALL: [f64; 9] = [0.0, 0.4, 0.6, 0.75, 0.87, 0.94, 0.975, 0.99, 1.0];

/// The material's argument with the films that lie on it.
fn argument(subject: &MaterialInMedium) -> String {
    let films = subject.material.film_arguments();
    let films = films.iter().map(|film| format!(" --film {film}"));
    subject.argument.clone() + &films.collect::<String>()
}

fn five_digits(value: f64) -> f64 {
    (value * 1e5).round() / 1e5
}

fn material(subject: &MaterialInMedium, data: &ChartData) -> MaterialNumbers {
    let optical = OpticalMaterial::of_surface(&subject.reference.surface);
    let set = data.sets.iter().find(|set| set.name == subject.label());
    let (mut inputs, mut errors) = (BTreeMap::new(), BTreeMap::new());
    for method in shown_methods().filter(|method| subject.is_described_by(method)) {
        let found = values_for_material(subject, method);
        inputs.insert(method.name, in_order(method, &found));
        let own = set.and_then(|set| set.errors.get(entry(data, method)?));
        errors.insert(method.name, own.map_or([None; 4], four_digits));
    }
    let seen = |cos_theta| subject.reference.at(cos_theta);
    let [f0, f82] = [1.0, COS_82].map(seen);
    let ball = BALL.iter().map(|r| {
        let colour = seen((1.0 - r * r).max(0.0).sqrt());
        (100.0 * r, hex_colour(colour))
    });
    MaterialNumbers {
        name: subject.name.clone(),
        summary: subject.material.summary.clone(),
        kind: subject.material.class_name(),
        argument: argument(subject),
        reference: subject.material.reference.clone(),
        method: subject
            .fitted_in_engines()
            .filter(|method| inputs.contains_key(method)),
        f0: f0.map(five_digits),
        f82: f82.map(five_digits),
        hex: [f0, f82].map(hex_colour),
        colours: ball.collect(),
        effective_n: subject.effective.channels.n.map(five_digits),
        effective_k: subject.effective.channels.k.map(five_digits),
        n: optical.n.as_vec3().to_array(),
        k: optical.k.as_vec3().to_array(),
        absorption: optical.absorption().as_vec3().to_array(),
        film_nm: subject.material.films.first().map(|film| film.thickness_nm),
        inputs,
        errors,
    }
}

fn in_order(method: &Method, values: &Values) -> Vec<[f32; 3]> {
    let inputs = method.inputs.iter();
    let found = inputs.map(|input| values.get(input.name).copied().unwrap_or([0.0; 3]));
    found.map(|value| value.map(|x| x as f32)).collect()
}

/// The indices that a reader may choose: of glasses, and of metals without the methods that need a fit.
pub fn own_indices() -> Vec<OwnIndex> {
    let glasses = [1.02, 0.02, 100.0];
    let metals = ([0.1, 0.1, 45.0], [0.5, 0.25, 31.0]);
    vec![
        own_index(true, glasses, [0.0, 0.0, 1.0]),
        own_index(false, metals.0, metals.1),
    ]
}

fn own_index(transparent: bool, n: [f64; 3], k: [f64; 3]) -> OwnIndex {
    let describes = |method: &&Method| match transparent {
        true => !method.keeps_inputs() && method.class != Class::Metal,
        false => method.class == Class::Any && !method.is_fitted(),
    };
    let methods: Vec<&Method> = shown_methods().filter(describes).collect();
    let at = |[first, step, _]: [f64; 3], i: usize| first + step * i as f64;
    let one = |i: usize| {
        let mut numbers = Vec::new();
        for a in 0..n[2] as usize {
            for b in 0..k[2] as usize {
                let channels = Channels {
                    n: [at(n, a); 3],
                    k: [at(k, b); 3],
                };
                let found = values(methods[i], &channels, &Derivation::default());
                numbers.extend(in_order(methods[i], &found).iter().map(|value| value[0]));
            }
        }
        (
            methods[i].name,
            (methods[i].inputs.len(), Packed::floats(&numbers)),
        )
    };
    let inputs = in_parallel(methods.len(), &one, &mut |_, _| {});
    OwnIndex {
        transparent,
        n,
        k,
        inputs: inputs.into_iter().collect(),
    }
}
