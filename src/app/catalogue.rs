//! The catalogue of fitted coefficients: those of every material that is known over the whole spectrum, as JSON and as an array
//! in each language. A run that names neither methods nor materials writes it.

use serde::Serialize;
use serde_json::{Value, json};

use crate::emit::{
    self, Average, Bounds, CATALOGUE, CatalogueRow, CloserFit, CommandLine, Emitted, Naming,
    OUTPUT_LICENCE,
};
use crate::methods::{self, Method};
use crate::num::in_parallel;
use crate::reference::MaterialInMedium;
use crate::report::{Origin, TOOL};

use super::artifact::Artifact;
use super::error::Error;
use super::generate::Generated;
use super::recorded;
use super::request::{Materials, Request, Source};

/// What stands for a target of the file that is for no language.
pub const JSON: &str = "json";

/// Adds the arrays of the run's languages, and in a run without flags `catalogue.json`, and makes them the run's own.
///
/// # Errors
/// A material cannot be seen as the request wants, or a language refuses a name.
pub fn add_catalogue(generated: &mut Generated, request: &Request) -> Result<(), Error> {
    let (rows, seen) = match recorded::recorded_rows(request) {
        Some(rows) => (rows, request.sight.reference_in_words()),
        None => derived_rows(request)?,
    };
    let seen = seen.as_str();
    for target in request.resolved_targets()? {
        let command = command(request, Some(target.name))?;
        let file = emit::catalogue(target, &rows, &request.naming(), seen, &command)?;
        generated.artifacts.extend(file.map(|file| {
            let path = format!("{}/{}", target.name, file.name);
            artifact(path, file.bytes, target.name, json!(file.detail))
        }));
    }
    if generated.scope.whole {
        generated.artifacts.push(as_json(&rows, seen, request)?);
        generated.scope.targets.insert(JSON.to_owned());
    }
    generated.artifacts.sort_by(|a, b| a.path.cmp(&b.path));
    generated.scope.shared = true;
    Ok(())
}

/// The materials that can be seen as the request wants. What is known at three wavelengths only has no spectrum.
fn subjects(request: &Request) -> Result<Vec<MaterialInMedium>, Error> {
    let ready = request.subjects()?.ready;
    let mut subjects: Vec<MaterialInMedium> =
        ready.into_iter().map(|(subject, _)| subject).collect();
    let of_spectra = request.sight.wavelengths_nm.is_none();
    subjects.retain(|subject| !of_spectra || subject.material.rgb_nm.is_none());
    Ok(subjects)
}

/// The rows of a request and what the truth is, derived from the spectra.
///
/// # Errors
/// A material cannot be seen as the request wants.
pub fn derived_rows(request: &Request) -> Result<(Vec<CatalogueRow>, String), Error> {
    let request = Request {
        materials: Materials::All,
        ..request.clone()
    };
    let subjects = subjects(&request)?;
    let rows = rows(&subjects, &request)?;
    Ok((rows, seen(&subjects).to_owned()))
}

/// The rows of those that a fitted method follows: first those of `fitted`, then those of `fitted_dielectric`, each by name.
fn rows(subjects: &[MaterialInMedium], request: &Request) -> Result<Vec<CatalogueRow>, Error> {
    let bounds = Bounds::recorded();
    let row = |i: usize| {
        let subject = &subjects[i];
        let method = methods::find(subject.fitted_with_four()?)?;
        Some(row(subject, method, request, &bounds))
    };
    let found = in_parallel(subjects.len(), &row, &mut |_, _| {});
    let mut rows = found
        .into_iter()
        .flatten()
        .collect::<Result<Vec<_>, Error>>()?;
    rows.sort_by(|a, b| (a.method.name, &a.name).cmp(&(b.method.name, &b.name)));
    Ok(rows)
}

fn row(
    subject: &MaterialInMedium,
    method: &'static Method,
    request: &Request,
    bounds: &Bounds,
) -> Result<CatalogueRow, Error> {
    let emitted = emit::specialised_function(method, subject, &request.naming(), bounds)?;
    let value = |input: &methods::Input| emitted.constants[input.name];
    Ok(CatalogueRow {
        name: subject.name.clone(),
        argument: subject.argument.clone(),
        class: subject.material.kind.name(),
        method,
        coefficients: method.inputs.iter().map(value).collect(),
        error: emitted
            .model_error
            .expect("a specialised function has its model error"),
        average: Average::of(&emitted).expect("a fitted method has a mean"),
        better: better(subject, &emitted, bounds, request)?,
        held: subject.truth.surface.held(),
    })
}

/// The method that follows a material more closely than its four coefficients do: the one of its class, or what serves where the
/// fit misses its class.
fn better(
    subject: &MaterialInMedium,
    emitted: &Emitted,
    bounds: &Bounds,
    request: &Request,
) -> Result<Option<CloserFit>, Error> {
    let own = subject.fitted_method().and_then(methods::find);
    let own = own.filter(|own| own.name != emitted.method.name);
    let serves = emitted.missed.as_ref().map(|missed| missed.serves);
    let Some(method) = own.or(serves) else {
        return Ok(None);
    };
    let made = emit::specialised_function(method, subject, &request.naming(), bounds)?;
    let fitted = method.inputs.iter().filter(|_| method.is_fitted());
    Ok(Some(CloserFit {
        method,
        coefficients: fitted.map(|input| made.constants[input.name]).collect(),
        max_abs: made.model_error.map_or(0.0, |error| error.max_abs),
    }))
}

/// What the truth is: the same for all; which ones hold a value beyond their range stands beside each.
fn seen(subjects: &[MaterialInMedium]) -> &str {
    let first = subjects.first();
    first.map_or("", |subject| &subject.truth.surface.seen)
}

/// The command that writes a target's array among its part of the tree, or all.
fn command(request: &Request, target: Option<&str>) -> Result<String, Error> {
    let medium = request.medium.as_ref();
    let medium = medium.map(Source::argument).transpose()?;
    let prefix = Some(&request.prefix).filter(|prefix| **prefix != Naming::default().prefix);
    Ok(CommandLine::new(TOOL)
        .list("target", target)
        .list("medium", medium)
        .list("prefix", prefix)
        .seen_as(&request.sight)
        .into())
}

/// `catalogue.json`: how its materials are seen, the methods, the materials with their coefficients.
#[derive(Serialize)]
struct Listed<'a> {
    #[serde(flatten)]
    origin: Origin,
    truth: &'a str,
    space: Option<&'static str>,
    licence: &'static str,
    methods: Vec<Value>,
    materials: Vec<Value>,
}

fn as_json(rows: &[CatalogueRow], seen: &str, request: &Request) -> Result<Artifact, Error> {
    let command = command(request, None)?;
    let about = |method: &Method| json!({ "name": method.name, "formula": method.formula, "source": method.source.line() });
    let is_spectral = request.sight.wavelengths_nm.is_none();
    let report = Listed {
        origin: Origin::new(command.clone()),
        truth: seen,
        space: is_spectral.then(|| request.sight.integration.space.name()),
        licence: OUTPUT_LICENCE,
        methods: emit::methods_of(rows).into_iter().map(about).collect(),
        materials: rows.iter().map(object).collect(),
    };
    let text = serde_json::to_string_pretty(&report).expect("a report has only text keys") + "\n";
    let detail = json!({ "command": command, "materials": rows.len(), "seen": seen, "licence": OUTPUT_LICENCE });
    let path = format!("{CATALOGUE}.{JSON}");
    Ok(artifact(path, text.into_bytes(), JSON, detail))
}

/// A material: a list of coefficients for each channel.
fn object(row: &CatalogueRow) -> Value {
    let better = row.better.as_ref().map(|better| {
        let own = Some(&better.coefficients).filter(|own| !own.is_empty());
        json!({
            "method": better.method.name, "max_abs": better.max_abs,
            "coefficients": own.map(|own| channels(own)),
        })
    });
    json!({
        "name": row.name, "class": row.class, "method": row.method.name,
        "coefficients": channels(&row.coefficients), "better": better,
        "max_abs": row.error.max_abs, "worst_cos": row.error.worst_cos, "mean_rel": row.error.mean_rel,
        "average": row.average.given, "average_unlimited": row.average.unlimited,
        "extrapolated": row.held,
    })
}

/// A list of coefficients for each channel.
fn channels(coefficients: &[[f64; 3]]) -> [Vec<f64>; 3] {
    let channel = |i: usize| coefficients.iter().map(|c| shortest(c[i])).collect();
    [0, 1, 2].map(channel)
}

/// The number that prints with the fewest digits of those that are the same in f32.
fn shortest(value: f64) -> f64 {
    let digits = (value as f32).to_string();
    digits.parse().expect("what is printed of a number is one")
}

fn artifact(path: String, bytes: Vec<u8>, target: &str, detail: Value) -> Artifact {
    Artifact {
        path,
        bytes,
        target: target.to_owned(),
        method: None,
        material: None,
        detail,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_names_nothing_writes_it() {
        let usual = Request::default();
        let named = |methods: &[&str]| methods.iter().map(|m| (*m).to_owned()).collect();
        assert!(usual.names_nothing());
        assert!(
            Request {
                targets: named(&["gles"]),
                ..usual.clone()
            }
            .names_nothing()
        );
        assert!(
            !Request {
                methods: named(&["fitted"]),
                ..usual.clone()
            }
            .names_nothing()
        );
        assert!(
            !Request {
                materials: Materials::None,
                ..usual.clone()
            }
            .names_nothing()
        );
        assert!(
            !Request {
                precision: crate::num::Precision::F16,
                ..usual
            }
            .names_nothing()
        );
    }

    #[test]
    fn digits_give_the_same_f32_back() {
        for value in [1.041_579_5_f32, -0.112_050_526, 1e-9, 0.1] {
            let short = shortest(f64::from(value));
            assert_eq!(short as f32, value);
            assert_eq!(short.to_string(), value.to_string());
        }
    }
}
