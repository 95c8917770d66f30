//! The effects' functions against what is known of them, evaluated in f64; their text in every language.

mod bounds;
mod coat;
mod functions;
mod image_light;
mod one_r;
mod sphere;
mod text;

use fresnel_gen::language::effects;
use fresnel_gen::language::ir::{Checked, Column, Ty, Value, evaluate};
use fresnel_gen::language::methods;

/// A function of an effect by its name, R by the exact law.
pub fn function(name: &str) -> Checked {
    function_by(name, effects::USUAL_METHOD)
}

/// The same with R by this method.
pub fn function_by(name: &str, method: &str) -> Checked {
    let method = methods::find(method).expect("a method");
    let functions = effects::ALL.iter().flat_map(|effect| effect.functions);
    let built = functions.flat_map(|function| function.built(method).expect("well formed"));
    let mut found = built.filter(|built| built.name == name);
    found.next().expect("a function of an effect").function
}

/// A vector, the same at every point.
pub fn vector(value: [f64; 3]) -> Value<f64> {
    Value::rgb(value)
}

/// A vector a point.
pub fn vectors(values: &[[f64; 3]]) -> Value<f64> {
    Value::Rgb([0, 1, 2].map(|i| Column::Each(values.iter().map(|value| value[i]).collect())))
}

/// A number a point.
pub fn numbers(values: &[f64]) -> Value<f64> {
    Value::each(values.to_vec())
}

/// Two, four or sixteen numbers, the same at every point.
pub fn many(values: &[f64]) -> Value<f64> {
    Value::Many(values.iter().map(|value| Column::Same(*value)).collect())
}

/// What a function gives at one point.
pub fn at_once(name: &str, arguments: &[Value<f64>]) -> [f64; 3] {
    let function = function(name);
    let result = evaluate(&function, arguments).at(0);
    match function.ty() {
        Ty::Scalar => [result[0], 0.0, 0.0],
        _ => result,
    }
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn add(a: [f64; 3], b: [f64; 3], times: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + times * b[i])
}

pub fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|part| part / dot(a, a).sqrt())
}
