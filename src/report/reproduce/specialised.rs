//! Methods specialised to the thesis's materials, or to one index of refraction.

use crate::fit::{self, Derivation};
use crate::ir::{Checked, Value, evaluate};
use crate::materials::{self, Channels, THESIS_NM};
use crate::methods::{self, Method};

/// A method of the registry.
pub fn method(name: &str) -> &'static Method {
    methods::find(name).expect("the names are constants, and a test reproduces every part")
}

/// The channels of a material that the thesis measures.
pub fn channels(material: &str) -> Channels {
    let found = materials::find(&format!("{material}_thesis")).and_then(Result::ok);
    let channels = found.and_then(|material| material.channels(THESIS_NM).ok());
    channels.expect("the thesis's materials are in the catalogue, at its wavelengths")
}

/// The same index in all three channels.
pub fn grey([n, k]: [f64; 2]) -> Channels {
    Channels {
        n: [n; 3],
        k: [k; 3],
    }
}

/// A method with a material's constants folded in, a function of `cos_theta` alone.
pub fn function(name: &str, channels: &Channels, derivation: &Derivation) -> Checked {
    let method = method(name);
    let specialised = method.specialise(&fit::values(method, channels, derivation));
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
