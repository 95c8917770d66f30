//! Errors and costs in the words of headers: what methods promise, and what is known of one function.
//!
//! The code bounds of specialised functions are recorded in `data/code-bounds.csv`, and for half precision in
//! `data/code-bounds-f16.csv`. They are keyed by what the function computes, and a test measures them again. A function without a
//! record says so.
//!
//! A fit can exceed the error that its method promises for the material's class ([`Missed`]). The header then names a method that
//! keeps within it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::function::{EmittedFunction, specialised_graph};
use crate::generator::fit::{Measured, ModelError, model_error, rounded_up};
use crate::generator::reference::{LEAST_FITTED_N, MaterialInMedium};
use crate::language::ir::{Checked, Function, Op, print};
use crate::language::methods::{self, ALL, Colours, Input, Method, by_class};
use crate::physics::digest::sha256;
use crate::physics::num::Precision;
use crate::physics::records;

/// The code error of functions that read a texture: a sampler may round its weights to multiples of 1/256, or truncate them.
pub const FILTERED: &str = "at most 1/256 of the difference of two neighbouring texels, as samplers weigh them in so many steps";

/// What a method promises, one line each.
pub fn promises(method: &Method) -> Vec<String> {
    promises_in(Precision::F32, method)
}

/// What a method promises in half precision, or why it is not available there.
pub fn half_promise(method: &Method) -> String {
    match (method.half.claim(), method.half.refusal()) {
        (Some(claim), _) => {
            let media = method.media(claim.over);
            let beyond = match claim.beyond {
                "" => String::new(),
                beyond => format!("; {beyond}"),
            };
            format!(
                "Code error for {media}: {}{beyond}",
                absolute(claim.max_abs)
            )
        }
        (None, Some(why)) => format!("Code error: nothing is promised; {why}"),
        (None, None) => format!(
            "Code error: nothing is promised but for materials; {}",
            method.half.library_refusal().unwrap_or_default()
        ),
    }
}

/// The same in a precision.
pub(super) fn promises_in(precision: Precision, method: &Method) -> Vec<String> {
    let code = if precision.is_half() {
        half_promise(method)
    } else if method.is_textured() {
        format!("Code error: {FILTERED}")
    } else {
        let bound = bound(method.claims.code_ulp);
        format!("Code error for {}: {bound}", method.code_media())
    };
    let colours = method.claims.colours.filter(|_| !precision.is_half());
    let colours = colours.map(|colours| colours_line(method, colours));
    let coefficients = method.coefficients.filter(|_| !precision.is_half());
    let coefficients = coefficients.map(|finds| {
        let (media, bound) = (method.code_media(), unfused(finds.code_abs));
        format!("Code error of the coefficients for {media}: {bound}")
    });
    model_promises(method)
        .chain([code])
        .chain(colours)
        .chain(coefficients)
        .collect()
}

/// What a method promises of its model error, one line for each set of media.
pub(super) fn model_promises(method: &Method) -> impl Iterator<Item = String> {
    method.claims.model.iter().map(|claim| {
        let error = match claim.max_abs {
            0.0 => "none, it is the exact law".to_owned(),
            most => format!("at most {most}, worst at {} degrees", claim.at_degrees),
        };
        format!("Model error for {}: {error}", claim.over.text())
    })
}

/// What a method promises to artists, if colours outside its range may be far off.
pub(super) fn beyond_colours(method: &Method) -> Option<String> {
    let colours = method
        .claims
        .colours
        .filter(|colours| !colours.beyond.is_empty())?;
    Some(colours_line(method, colours))
}

/// What a method promises to artists.
fn colours_line(method: &Method, colours: Colours) -> String {
    let range = |input: &Input| format!("{} {}", input.name, colours.range(input).words());
    let ranges: Vec<String> = method.inputs.iter().map(range).collect();
    let beyond = match colours.beyond {
        "" => String::new(),
        beyond => format!("; {beyond}"),
    };
    format!(
        "Code error for colours with {}: at most {:e} absolute, unfused or fused{beyond}",
        ranges.join(", "),
        colours.max_abs
    )
}

/// The largest error after the words "at most": rounded up.
pub(super) fn at_most(error: &ModelError) -> String {
    format!("at most {}", rounded_up(error.max_abs))
}

pub(super) fn model_line(error: &ModelError) -> String {
    let undefined = match error.undefined {
        0 => String::new(),
        _ => "; where it gives no number it is not counted".to_owned(),
    };
    if error.max_abs < 1e-9 {
        return format!("Model error: none, it is the exact law{undefined}.");
    }
    let most = at_most(error);
    let degrees = libm::acos(error.worst_cos).to_degrees();
    let mean = match error.mean_rel {
        // For a reflectance next to 0, any relative error is large.
        Some(mean) if mean > 100.0 => "above 10000 % in the mean over angles".to_owned(),
        Some(mean) => format!("{:.2} % in the mean over angles", 100.0 * mean),
        None => "no relative mean, as a channel reflects nothing".to_owned(),
    };
    format!("Model error: {most} (at {degrees:.2} degrees), {mean}{undefined}.")
}

/// A line that says that a fit misses its class, and which method serves.
pub(super) fn missed_line(emitted: &EmittedFunction) -> Option<String> {
    let missed = emitted.missed.as_ref()?;
    Some(format!("Misses its class: {}.", missed.words()))
}

pub(super) fn code_line(emitted: &EmittedFunction) -> String {
    match &emitted.code {
        Measured::Yes(CodeBound::Ulp(ulp)) => format!("Code error: {}.", bound(*ulp)),
        Measured::Yes(CodeBound::Absolute(most)) if emitted.precision.is_half() => {
            format!("Code error: {}.", absolute(*most))
        }
        Measured::Yes(CodeBound::Absolute(most)) => format!("Code error: {}.", unfused(*most)),
        Measured::No(why) => format!("Code error: {why}."),
    }
}

/// A bound in ulp, with the absolute one that holds near zeros.
fn bound(ulp: f64) -> String {
    let ulp = if ulp > 0.0 {
        format!("{ulp} ulp or ")
    } else {
        String::new()
    };
    format!("at most {ulp}2^-22, unfused f32 against f64")
}

/// A bound in half precision. Rounded up: it says "at most".
fn absolute(most: f64) -> String {
    let most = (most * 1e5 - 1e-6).ceil() / 1e5;
    format!("at most {most} absolute, f16 rounded after every operation, against f64")
}

/// A bound of coefficients.
fn unfused(most: f64) -> String {
    format!("at most {most:e} absolute, unfused f32 against f64")
}

pub(super) fn operations(emitted: &EmittedFunction) -> String {
    let count = |ops: &[Op]| {
        ops.iter()
            .map(|op| emitted.function.count(*op))
            .sum::<usize>()
    };
    let counted = [
        (count(&[Op::Sqrt, Op::InverseSqrt]), "root", "roots"),
        (count(&[Op::Div]), "division", "divisions"),
        (
            count(&[Op::Exp2, Op::Log2]),
            "exponential or logarithm",
            "exponentials or logarithms",
        ),
    ];
    let named = counted.iter().filter(|(count, ..)| *count > 0);
    let parts: Vec<String> = named
        .map(|(count, one, many)| format!("{count} {}", if *count == 1 { one } else { many }))
        .collect();
    let among = if parts.is_empty() {
        String::new()
    } else {
        format!(", among them {}", parts.join(", "))
    };
    let fetches = match emitted.function.fetches() {
        0 => "",
        _ => ", and one texture fetch",
    };
    format!(
        "{} scalar operations{among}{fetches}",
        emitted.function.work()
    )
}

static RECORD: &str = include_str!("../../../data/code-bounds.csv");
static HALF_RECORD: &str = include_str!("../../../data/code-bounds-f16.csv");

/// What a function promises of its code error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CodeBound {
    /// In single precision: units in the last place, or 2⁻²² absolute.
    Ulp(f64),
    /// In half precision, and for coefficients: the absolute difference.
    Absolute(f64),
}

impl CodeBound {
    /// The number, in the bound's own unit.
    pub fn value(self) -> f64 {
        match self {
            CodeBound::Ulp(value) | CodeBound::Absolute(value) => value,
        }
    }
}

/// The largest error in ulp with which a plain form is written in place of the stable one.
pub const PLAIN_ULP: f64 = 10.0;

/// The recorded bounds, by fingerprint.
#[derive(Clone, Debug, Default)]
pub struct Bounds {
    ulp: BTreeMap<String, f64>,
    absolute: BTreeMap<String, f64>,
}

impl Bounds {
    /// The bounds recorded in the program.
    pub fn recorded() -> Bounds {
        let single: Vec<SingleBound> = records::rows(RECORD);
        let half = half_bounds().into_iter();
        Bounds {
            ulp: single
                .into_iter()
                .map(|row| (row.fingerprint, row.max_ulp))
                .collect(),
            absolute: half.map(|row| (row.fingerprint, row.max_abs)).collect(),
        }
    }

    /// The bound of a function in this precision.
    pub fn of(&self, precision: Precision, function: &Checked) -> Measured<CodeBound> {
        let mark = fingerprint(function);
        let bound = match precision {
            Precision::F32 => self.ulp.get(&mark).copied().map(CodeBound::Ulp),
            Precision::F16 => self.absolute.get(&mark).copied().map(CodeBound::Absolute),
        };
        let none = || Measured::No("not measured for this material".to_owned());
        bound.map_or_else(none, Measured::Yes)
    }
}

/// The bound of a specialised function in half precision.
#[derive(Clone, Debug, Deserialize)]
pub struct HalfBound {
    /// The fingerprint of what the function computes.
    pub fingerprint: String,
    /// Its material.
    pub material: String,
    /// Its method.
    pub method: String,
    /// The largest difference from the function's meaning.
    pub max_abs: f64,
}

/// The bound of a specialised function in single precision.
#[derive(Deserialize)]
struct SingleBound {
    fingerprint: String,
    max_ulp: f64,
}

/// The recorded bounds of half precision.
pub fn half_bounds() -> Vec<HalfBound> {
    records::rows(HALF_RECORD)
}

/// The fingerprint of what a function computes, in 16 hexadecimal digits: names of steps and reasons do not count.
pub fn fingerprint(function: &Checked) -> String {
    let mut bare: Function = (**function).clone();
    bare.name = "f".to_owned();
    bare.nodes.iter_mut().for_each(|node| node.label = None);
    sha256(print(&bare).as_bytes())[..16].to_owned()
}

/// A fit that misses its class, and the method that serves instead.
#[derive(Clone, Debug)]
pub struct Missed {
    /// The method that misses.
    pub method: &'static Method,
    /// The material's class.
    pub class: &'static str,
    /// The 90th percentile of the error over the class.
    pub limit: f64,
    /// The method with no larger error: a fitted one if there is one, else the exact law. If none keeps the limit, the one with
    /// the least error.
    pub serves: &'static Method,
    /// The largest error of that method.
    pub error: f64,
}

/// The same for reports: the class's limit, the method that serves and its error.
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

    /// The detail for reports.
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

/// The model error of a method for a material, with the coefficients of its specialised function.
pub fn fitted_error(subject: &MaterialInMedium, method: &'static Method) -> Option<ModelError> {
    let made = specialised_graph(method, subject, Precision::F32, &Bounds::default()).ok()?;
    Some(model_error(&made.function, &subject.truth_for(method)))
}
