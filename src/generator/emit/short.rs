//! The short form of a header: one banner for a file, and above each function what it is, its largest error, its cost and its
//! source. Warnings stay. The rest is in the manifest and in the full form.

use super::average::coefficients_line;
use super::comment;
use super::figures::{
    FILTERED, beyond_colours, code_line, half_promise, missed_line, model_line, model_promises,
    operations,
};
use super::function::EmittedFunction;
use super::header::{
    MARK, OUTPUT_LICENCE, cosine_line, exemption, extrapolated, half_line, table_line,
    viewing_conditions,
};
use crate::generator::fit::Measured;
use crate::generator::reference::MaterialInMedium;
use crate::language::methods::{Method, TEXELS};
use crate::language::targets::Target;
use crate::physics::num::Precision;

/// The head of a library file.
pub fn library(
    target: &Target,
    method: &Method,
    functions: &[EmittedFunction],
    command: &str,
) -> Vec<String> {
    let first = &functions[0];
    let mut lines = banner(command);
    lines.push(format!("{}: {}", first.name, method.summary));
    lines.extend(promised(target, method, first.precision));
    lines.push(costs(functions));
    lines.extend(mean_line(functions));
    lines.extend(functions.iter().find_map(coefficients_line));
    lines.push(source(method));
    comment::lines(lines)
}

/// The head of a material's file.
pub fn material(
    target: &Target,
    subject: &MaterialInMedium,
    precision: Precision,
    command: &str,
) -> Vec<String> {
    let mut lines = banner(command);
    lines.push(format!("{}: {}", subject.name, subject.material.summary));
    lines.extend(subject.material.data_line());
    lines.extend(medium_line(subject));
    lines.extend(viewing_conditions(subject));
    lines.extend(half_line(target, precision));
    lines.push(cosine_line());
    comment::lines(lines)
}

/// The medium that light comes from, unless it is air.
fn medium_line(subject: &MaterialInMedium) -> Option<String> {
    let (_, medium) = subject.medium.as_ref()?;
    let name = &medium.name;
    Some(format!("Medium: {name}; the index is relative to {name}"))
}

/// The comment above one specialised function in a material's file.
pub fn specialised(emitted: &EmittedFunction) -> Vec<String> {
    let mut lines = vec![format!("{}: {}", emitted.name, emitted.method.summary)];
    lines.extend(exemption(emitted.method));
    lines.extend(known_of(emitted));
    comment::lines(lines)
}

/// The head of a function for pasting.
pub fn pasted(
    target: &Target,
    emitted: &EmittedFunction,
    subject: Option<&MaterialInMedium>,
    command: &str,
) -> Vec<String> {
    let method = emitted.method;
    let of = subject.map_or(String::new(), |subject| format!(", for {}", subject.name));
    let mut lines = vec![
        format!("{MARK}: {command}"),
        format!("{}{of}. {OUTPUT_LICENCE}", method.summary),
    ];
    match subject {
        Some(subject) => {
            lines.extend(half_line(target, emitted.precision));
            lines.extend(exemption(method));
            lines.extend(extrapolated(subject));
            lines.extend(known_of(emitted));
        }
        None => {
            lines.extend(promised(target, method, emitted.precision));
            lines.push(costs(std::slice::from_ref(emitted)));
            lines.extend(mean_line(std::slice::from_ref(emitted)));
            lines.push(source(method));
        }
    }
    comment::lines(lines)
}

/// The first lines of every file.
fn banner(command: &str) -> Vec<String> {
    vec![
        MARK.to_owned(),
        format!(
            "Licence of this file: {OUTPUT_LICENCE}. Formula, code error and more: manifest.json, or --header full"
        ),
        format!("Regenerate: {command}"),
        String::new(),
    ]
}

/// The figures of a specialised function: its largest error with its warnings, its cost and its source.
fn known_of(emitted: &EmittedFunction) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    if table_line(emitted).is_some() {
        lines.push(format!(
            "Table: as `fresnel-gen bake` writes it unless asked otherwise, {TEXELS} texels"
        ));
    }
    lines.extend(emitted.model_error.iter().map(model_line));
    lines.extend(missed_line(emitted));
    let is_warning = match &emitted.code {
        Measured::Yes(_) => emitted.precision.is_half(),
        Measured::No(why) => why != FILTERED,
    };
    lines.extend(is_warning.then(|| code_line(emitted)));
    lines.push(format!("Cost: {}", operations(emitted)));
    lines.push(source(emitted.method));
    lines
}

/// The arguments and promises of a library function.
fn promised(target: &Target, method: &Method, precision: Precision) -> Vec<String> {
    let mut lines = vec![arguments(method, precision)];
    lines.push(format!("Domain: {}", method.domain));
    lines.extend(half_line(target, precision));
    lines.extend(exemption(method));
    lines.extend(model_promises(method));
    if precision.is_half() {
        lines.push(half_promise(method));
    } else {
        lines.extend(beyond_colours(method));
    }
    lines
}

/// The arguments of a library function, in one paragraph. Coefficients of a fit are described together.
fn arguments(method: &Method, precision: Precision) -> String {
    let mut told = vec![
        "cos_theta, cosine of the angle of incidence, dot(half, view) for a microfacet".to_owned(),
    ];
    let range = |i: usize| method.range(&method.inputs[i], precision).words();
    if method.is_fitted() {
        let last = method.inputs.len() - 1;
        told.push(format!("c0 to c{last}, coefficients, {}", range(0)));
    } else {
        let inputs = method.inputs.iter().enumerate();
        told.extend(
            inputs.map(|(i, input)| format!("{}, {}, {}", input.name, input.meaning, range(i))),
        );
    }
    format!("Arguments: {}", told.join("; "))
}

fn costs(functions: &[EmittedFunction]) -> String {
    let (first, others) = (&functions[0], &functions[1..]);
    let others = others
        .iter()
        .map(|other| format!("; {} {}", other.name, other.function.work()));
    let others: String = others.collect();
    format!("Cost: {}{others}", operations(first))
}

/// What a mean over the hemisphere is, if one is among the functions.
fn mean_line(functions: &[EmittedFunction]) -> Option<String> {
    let mean = functions.iter().find(|emitted| emitted.form.is_mean())?;
    let error = mean.method.average.map_or(String::new(), |average| {
        format!("; off by at most {} for {}", average.max_abs, average.over)
    });
    Some(format!(
        "{}: the mean of F over the hemisphere, weighted by cosine, as compensation of multiple scattering takes it{error}",
        mean.name
    ))
}

/// The source of a method, in one line.
fn source(method: &Method) -> String {
    format!("Source: {}", method.source_in_short())
}
