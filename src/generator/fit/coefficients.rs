//! Coefficients of a fitted method for a curve, and what they are worth in the measure that they minimise.

use crate::language::methods::{Method, Values};

use super::derive::coefficients_and_error;
use super::exact::Exact;
use super::problem::{FitCurve, FitObjective};

/// Coefficients with their errors, on paper and before the limit to [0, 1].
#[derive(Clone, Debug)]
pub struct Coefficients {
    /// The coefficients, by the names of inputs, as the aim's precision holds them.
    pub values: Values,
    /// What was minimised, and what is met exactly.
    pub aim: FitObjective,
    /// The largest error in the measure that was minimised.
    pub error: f64,
    /// The same without the ends that are met exactly, where there are any.
    pub error_without_exact: Option<f64>,
}

impl Coefficients {
    /// Fits a method; none where its terms do not tell the angles of the curve apart.
    pub fn fit(method: &Method, curve: &FitCurve, aim: FitObjective) -> Option<Coefficients> {
        let (values, error) = coefficients_and_error(method, curve, aim)?;
        let free = FitObjective {
            exact: Exact::default(),
            ..aim
        };
        let free = aim
            .exact
            .is_any()
            .then(|| coefficients_and_error(method, curve, free));
        Some(Coefficients {
            values,
            aim,
            error,
            error_without_exact: free.flatten().map(|(_, error)| error),
        })
    }
}
