//! The check that the limit tests of methods share: one evaluation in f64 against an expected value.
#![cfg(test)]

use super::method::Method;
use crate::language::ir::{Value, evaluate};

/// The value of the library function in f64. Each argument is the same in all channels.
pub fn value(method: &Method, cos_theta: f64, arguments: &[f64]) -> f64 {
    let function = method.function(false);
    let function = function.unwrap_or_else(|fault| panic!("{fault}"));
    let mut values = vec![Value::<f64>::scalar(cos_theta)];
    for (param, argument) in function.params.iter().skip(1).zip(arguments) {
        values.push(match param.ty.channels() {
            3 => Value::rgb([*argument; 3]),
            _ => Value::scalar(*argument),
        });
    }
    assert_eq!(values.len(), function.params.len(), "{}", method.name);
    evaluate(&function, &values).at(0)[0]
}

/// Checks one value to 1e-12.
#[track_caller]
pub fn check(method: &Method, cos_theta: f64, arguments: &[f64], expected: f64) {
    let got = value(method, cos_theta, arguments);
    let close = (got - expected).abs() <= 1e-12;
    assert!(
        close,
        "{}({cos_theta}, {arguments:?}) = {got:.17}, expected {expected:.17}",
        method.name
    );
}
