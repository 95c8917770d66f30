//! A fit that misses what its method promises of the material's class, and the method that keeps within it.

use serde::Serialize;

use crate::generator::fit::{ModelError, model_error, rounded_up};
use crate::language::methods::{self, ALL, Method, by_class};
use crate::physics::num::Precision;

use super::bounds::Bounds;
use super::function::specialised_graph;
use crate::generator::reference::{LEAST_FITTED_N, MaterialInMedium};

/// What is missed, and what serves.
#[derive(Clone, Debug)]
pub struct Missed {
    /// The method that misses.
    pub method: &'static Method,
    /// The material's class.
    pub class: &'static str,
    /// What nine of ten of the class err at most.
    pub limit: f64,
    /// The method that errs no more: a fitted one where there is one, else the exact law. Where none does, the one that errs least.
    pub serves: &'static Method,
    /// What that errs.
    pub error: f64,
}

/// The same as reports have it: what the class keeps, the method that serves and its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MissedDetail {
    limit: f64,
    method: &'static str,
    max_abs: f64,
}

impl Missed {
    /// In words, for headers and reports.
    pub fn words(&self) -> String {
        let serves = if self.serves.name == self.method.name {
            "no other errs less".to_owned()
        } else {
            format!("{} errs by {}", self.serves.name, rounded_up(self.error))
        };
        format!(
            "{} errs more here than for nine of ten {} ({}); {serves}",
            self.method.name,
            plural(self.class),
            rounded_up(self.limit),
        )
    }

    /// For reports.
    pub fn detail(&self) -> MissedDetail {
        MissedDetail {
            limit: self.limit,
            method: self.serves.name,
            max_abs: self.error,
        }
    }
}

fn plural(class: &str) -> &'static str {
    match class {
        "metal" => "metals",
        "semiconductor" => "semiconductors",
        _ => "dielectrics of n 1.2 or more",
    }
}

/// Whether a fit with this error misses its class. Gases have no class: no fitted method is meant for them.
pub fn missed(subject: &MaterialInMedium, method: &'static Method, max_abs: f64) -> Option<Missed> {
    let class = subject.material.kind.name();
    let n = subject.effective.channels.n;
    let is_gas = class == "dielectric" && n.iter().any(|n| *n < LEAST_FITTED_N);
    let promise = by_class(method, class).filter(|_| !is_gas)?;
    let limit = promise.limit;
    if max_abs <= limit {
        return None;
    }
    let exact = methods::find(subject.exact_method());
    let fitted = ALL.iter().copied().filter(|other| other.is_fitted());
    let described = fitted.filter(|other| subject.is_described_by(other));
    let errors: Vec<(&'static Method, f64)> = described
        .chain(exact)
        .filter_map(|other| Some((other, fitted_error(subject, other)?.max_abs)))
        .collect();
    let holds = errors.iter().find(|(_, error)| *error <= limit);
    let least = errors.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let (serves, error) = *holds.or(least)?;
    Some(Missed {
        method,
        class,
        limit,
        serves,
        error,
    })
}

/// What a method errs for a material, with the coefficients of its specialised function.
pub fn fitted_error(subject: &MaterialInMedium, method: &'static Method) -> Option<ModelError> {
    let made = specialised_graph(method, subject, Precision::F32, &Bounds::default()).ok()?;
    Some(model_error(&made.function, &subject.truth_for(method)))
}
