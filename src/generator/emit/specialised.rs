//! A method specialised to a material: its graph, and the model error with which it may miss the promise for the material's
//! class ([`Missed`]). The header then names a method that keeps within it.

use serde::Serialize;

use super::code_bound::{Bounds, CodeBound, PLAIN_ULP};
use super::error::Error;
use crate::generator::fit::{
    Measured, ModelError, model_error, rounded_up, values_for_material_in,
};
use crate::generator::reference::{LEAST_FITTED_N, MaterialInMedium};
use crate::language::ir::Checked;
use crate::language::methods::{self, ALL, Method, Values};
use crate::physics::num::Precision;

/// A method's formula with a material's constants folded in, in the form that is written.
#[derive(Clone, Debug)]
pub struct Specialised {
    /// The graph.
    pub function: Checked,
    /// The values that were folded in.
    pub constants: Values,
    /// For a plain form: the operations of the stable one.
    pub plain_for: Option<usize>,
}

/// A method's formula specialised to a material, without its errors.
///
/// # Errors
/// The method does not describe this, or the graph with these constants breaks a rule of
/// [`crate::language::ir::RULES`].
pub fn specialised_graph(
    method: &Method,
    subject: &MaterialInMedium,
    precision: Precision,
    bounds: &Bounds,
) -> Result<Specialised, Error> {
    if !subject.is_described_by(method) {
        let serves = if method.is_fitted() {
            subject.fitted_method().unwrap_or("fitted_five")
        } else {
            subject.main_method()
        };
        let what = if subject.has_films() && !method.class.is_of_films() {
            format!("it describes bare media, and films lie on this; {serves} serves it")
        } else {
            format!("it describes {}; {serves} serves it", method.class.media())
        };
        return Err(Error::specialise(method, subject, what));
    }
    let constants = values_for_material_in(precision, subject, method);
    let stable = specialise(method, subject, precision, &constants)?;
    let plain = match precision {
        Precision::F32 => plain(method, &constants, &stable, bounds),
        Precision::F16 => None,
    };
    Ok(Specialised {
        plain_for: plain.as_ref().map(|_| stable.work()),
        function: plain.unwrap_or(stable),
        constants,
    })
}

/// A method's formula for a material as a function of the cosine alone, and of the table that it reads: what the material keeps as an
/// argument is folded in too.
///
/// # Errors
/// As [`specialised_graph`].
pub fn of_cosine(
    method: &Method,
    subject: &MaterialInMedium,
    precision: Precision,
    bounds: &Bounds,
) -> Result<Checked, Error> {
    let made = specialised_graph(method, subject, precision, bounds)?;
    if !method.keeps_inputs() {
        return Ok(made.function);
    }
    whole(method, subject, &made.constants)
}

/// The function of the cosine alone with these constants, those that the material keeps as arguments among them.
pub(super) fn whole(
    method: &Method,
    subject: &MaterialInMedium,
    constants: &Values,
) -> Result<Checked, Error> {
    let function = method.at(constants);
    function.map_err(|fault| Error::specialise(method, subject, fault.to_string()))
}

/// The stable form with these constants.
pub(super) fn specialise(
    method: &Method,
    subject: &MaterialInMedium,
    precision: Precision,
    constants: &Values,
) -> Result<Checked, Error> {
    let function = method.specialise_in(precision, constants);
    function.map_err(|fault| Error::specialise(method, subject, fault.to_string()))
}

/// The plain form, where it is cheaper and recorded as accurate.
fn plain(
    method: &Method,
    constants: &Values,
    stable: &Checked,
    bounds: &Bounds,
) -> Option<Checked> {
    let plain = method.specialise_plain(constants)?.ok()?;
    let bound = bounds.of(Precision::F32, &plain);
    let keeps = matches!(bound, Measured::Yes(CodeBound::Ulp(ulp)) if ulp <= PLAIN_ULP);
    (keeps && plain.work() < stable.work()).then_some(plain)
}

/// A fit that misses its class, and the method that serves instead. In reports: the class's limit, the method that serves and its
/// error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Missed {
    /// The method that misses.
    #[serde(skip)]
    pub method: &'static str,
    /// The material's class.
    #[serde(skip)]
    pub class: &'static str,
    /// The 90th percentile of the error over the class.
    pub limit: f64,
    /// The method with no larger error: a fitted one if there is one, else the exact law. If none keeps the limit, the one with
    /// the least error.
    #[serde(rename = "method")]
    pub serves: &'static str,
    /// The largest error of that method.
    #[serde(rename = "max_abs")]
    pub error: f64,
}

impl Missed {
    /// In words, for headers and reports.
    pub fn words(&self) -> String {
        let serves = if self.serves == self.method {
            "no other errs less".to_owned()
        } else {
            format!("{} errs by {}", self.serves, rounded_up(self.error))
        };
        format!(
            "{} errs more here than for nine of ten {} ({}); {serves}",
            self.method,
            plural(self.class),
            rounded_up(self.limit),
        )
    }
}

fn plural(class: &str) -> &'static str {
    match class {
        "metal" => "metals",
        "semiconductor" => "semiconductors",
        "film" => "materials under films",
        _ => "dielectrics of n 1.2 or more",
    }
}

/// Whether a fit with this error misses its class. Gases have no class: no fitted method is meant for them.
pub fn missed(subject: &MaterialInMedium, method: &'static Method, max_abs: f64) -> Option<Missed> {
    let class = subject.class();
    let n = subject.effective.channels.n;
    let is_gas = class == "dielectric" && n.iter().any(|n| *n < LEAST_FITTED_N);
    let promise = method.claims.for_class(class).filter(|_| !is_gas)?;
    let limit = promise.limit;
    if max_abs <= limit {
        return None;
    }
    let exact = methods::find(subject.main_method());
    let fitted = ALL.iter().copied().filter(|other| other.is_fitted());
    let described = fitted.filter(|other| subject.is_described_by(other));
    let errors: Vec<(&str, f64)> = described
        .chain(exact)
        .filter_map(|other| Some((other.name, fitted_error(subject, other)?.max_abs)))
        .collect();
    let holds = errors.iter().find(|(_, error)| *error <= limit);
    let least = errors.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let (serves, error) = *holds.or(least)?;
    Some(Missed {
        method: method.name,
        class,
        limit,
        serves,
        error,
    })
}

/// The model error of a method for a material, with the coefficients of its specialised function.
pub fn fitted_error(subject: &MaterialInMedium, method: &'static Method) -> Option<ModelError> {
    let function = of_cosine(method, subject, Precision::F32, &Bounds::default()).ok()?;
    Some(model_error(&function, &subject.truth_for(method)))
}
