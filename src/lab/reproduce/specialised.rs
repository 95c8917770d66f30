//! Methods specialised to the thesis's materials, or to one index of refraction.

use crate::generator::fit;
use crate::generator::reference::{Derivation, THESIS_MATCHING_COS};
use crate::language::ir::{Checked, Value, evaluate};
use crate::language::methods::{self, Method};
use crate::physics::materials::{self, Channels, Material, THESIS_NM};

/// A method of the registry.
pub fn method(name: &str) -> &'static Method {
    methods::find(name).expect("the names are constants, and a test reproduces every part")
}

/// A material of the catalogue, by name.
pub fn material(name: &str) -> Material {
    let found = materials::find(name).and_then(Result::ok);
    found.expect("the names are constants, and a test reproduces every part")
}

/// The channels of a material with the thesis's rounded indices.
pub fn channels(name: &str) -> Channels {
    unrounded(&format!("{name}_thesis"))
}

/// The channels of a material of the catalogue at the thesis's wavelengths, with all digits.
pub fn unrounded(name: &str) -> Channels {
    let channels = material(name).channels(THESIS_NM);
    channels.expect("what is reproduced is known at the thesis's wavelengths")
}

/// The same index in all three channels.
pub fn grey([n, k]: [f64; 2]) -> Channels {
    Channels {
        n: [n; 3],
        k: [k; 3],
    }
}

/// A method specialised to a material: a function of `cos_theta` alone. λ is matched at 81.37 degrees.
pub fn function(name: &str, channels: &Channels) -> Checked {
    matched_at(THESIS_MATCHING_COS, name, channels)
}

/// A method specialised to a material, with λ matched at this cosine.
pub fn matched_at(matching_cos: f64, name: &str, channels: &Channels) -> Checked {
    let method = method(name);
    let derivation = Derivation { matching_cos };
    let specialised = method.specialise(&fit::values(method, channels, &derivation));
    specialised
        .expect("every method takes the thesis's materials, and a test tries each that is used")
}

/// The first channel of a function at these cosines.
pub fn curve(function: &Checked, cosines: Vec<f64>) -> Vec<f64> {
    let points = cosines.len();
    let values = evaluate(function, &[Value::each(cosines)]);
    (0..points).map(|point| values.at(point)[0]).collect()
}

/// A method's reflectance for one index at one cosine.
pub fn at(function: &Checked, cos_theta: f64) -> f64 {
    evaluate(function, &[Value::scalar(cos_theta)]).at(0)[0]
}
