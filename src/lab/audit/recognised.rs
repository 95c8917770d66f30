//! Which method of ours a user's function computes: where its results at all angles are those of the method, for the same material.
//!
//! Functions differ in conventions more than in formulas: an index is n_t / n_i or n_i / n_t, the colour at 82 degrees is itself or a
//! tint. So where a function computes none of ours, its arguments are tried as the other quantities that their names may stand for.

use serde::Serialize;

use crate::generator::fit::values_for_material;
use crate::generator::reference::MaterialInMedium;
use crate::language::ir::{Value, evaluate};
use crate::language::methods::{self, Contract, InputSource, Light, Method};

use super::bind::Bound;

/// The angles that results are compared at.
const POINTS: u16 = 64;

/// Results that are nearer than this are the same: single precision, and forms that lose digits.
const NEAR: f64 = 5e-5;

/// An argument as another quantity, with which a function computes a method of ours.
#[derive(Clone, Debug, Serialize)]
pub struct ExactFit {
    /// The argument.
    pub argument: String,
    /// What it is then.
    pub quantity: &'static str,
    /// The method that the function computes then.
    pub method: &'static str,
    /// Its largest error then.
    pub max_abs: f64,
}

/// The cosines at which results are compared.
pub fn cosines() -> Vec<f32> {
    let part = |i: u16| f32::from(i) / f32::from(POINTS);
    (1..=POINTS).map(part).collect()
}

/// The method of ours that gives these results at [`cosines`].
pub fn recognised(
    results: &[[f32; 3]],
    bound: &Bound,
    subject: &MaterialInMedium,
) -> Option<&'static str> {
    let takes_what_is_bound = |method: &&&'static Method| {
        let has = |name: &str| {
            let mut arguments = bound.arguments.iter();
            arguments.any(|argument| {
                argument
                    .quantity
                    .is_some_and(|quantity| quantity.input.name == name)
            })
        };
        let is_artistic = |source| matches!(source, InputSource::Artist(_));
        let mut inputs = method.inputs.iter();
        inputs.all(|input| has(input.name) || is_artistic(input.source))
            && method.inputs.iter().any(|input| has(input.name))
    };
    let is_comparable = |method: &&&'static Method| {
        method.light == Light::Unpolarised
            && method.contract == Contract::Kept
            && !method.is_textured()
            && subject.is_described_by(method)
    };
    let mut methods = methods::ALL
        .iter()
        .filter(is_comparable)
        .filter(takes_what_is_bound);
    let found = methods.find(|method| gives(method, results, subject))?;
    Some(found.name)
}

/// Whether a method gives these results.
fn gives(method: &Method, results: &[[f32; 3]], subject: &MaterialInMedium) -> bool {
    let Ok(graph) = method.function(false) else {
        return false;
    };
    let cosines = cosines().into_iter().map(f64::from).collect();
    let others: Vec<Value<f64>> = method.arguments(&values_for_material(subject, method), None);
    let arguments: Vec<Value<f64>> = [Value::each(cosines)].into_iter().chain(others).collect();
    let own = evaluate(&graph, &arguments);
    let mut points = results.iter().enumerate();
    points.all(|(point, result)| {
        let mut pairs = result.iter().zip(own.at(point));
        pairs.all(|(result, own)| {
            (f64::from(*result).clamp(0.0, 1.0) - own.clamp(0.0, 1.0)).abs() < NEAR
        })
    })
}
