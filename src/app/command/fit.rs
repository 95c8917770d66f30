//! `fit`: the coefficients of fitted methods.

use serde_json::{Value, json};

use crate::app::args::FitFlags;
use crate::app::error::Error;
use crate::app::names::{flag, quoted, unknown};
use crate::app::parallel::each;
use crate::app::request::{Materials, Request};
use crate::app::sight::{flags as sight_flags, sight};
use crate::app::source::{materials, source};
use crate::cost::{FAMILIES, records};
use crate::emit::Subject;
use crate::fit::{Follows, ModelError, error_from, fitted_values, model_error, values_at};
use crate::methods::{ALL, Class, Input, Method, Values};
use crate::report::fits::{Row, text};

use super::{Output, Progress, report, try_places};

/// Fits.
pub fn run(flags: &FitFlags, progress: Progress) -> Result<Output, Error> {
    let families: Vec<&str> = FAMILIES.iter().map(|family| family.name).collect();
    if !families.contains(&flags.gpu.as_str()) {
        return Err(unknown("GPU family", &flags.gpu, &families));
    }
    let methods = methods(flags.terms)?;
    try_places(flags.json.as_deref(), None)?;
    let (rows, left_out) = if flags.f0.is_empty() {
        of_materials(flags, &methods, progress)?
    } else {
        (of_colours(flags, &methods)?, Vec::new())
    };
    let json = json!({
        "tool": "fresnel-gen", "command": canonical(flags)?, "device": null,
        "rows": rows.iter().map(Row::json).collect::<Vec<Value>>(),
    });
    let mut output = report(text(&rows, &flags.gpu), &json, flags.json.as_deref())?;
    output.remarks = left_out;
    Ok(output)
}

/// The fitted methods with so many coefficients, the fewest first.
fn methods(terms: Option<usize>) -> Result<Vec<&'static Method>, Error> {
    let fitted = ALL.iter().copied().filter(|method| method.is_fitted());
    let mut chosen: Vec<&Method> = fitted
        .filter(|method| terms.is_none_or(|terms| method.inputs.len() == terms))
        .collect();
    if chosen.is_empty() {
        let what = "no form has so many coefficients; --terms is 4 or 5".to_owned();
        return Err(Error::Usage { what });
    }
    chosen.sort_by_key(|method| (method.inputs.len(), method.name));
    Ok(chosen)
}

/// A row for each material and method that describes it, and what was left out.
fn of_materials(
    flags: &FitFlags,
    methods: &[&'static Method],
    progress: Progress,
) -> Result<(Vec<Row>, Vec<String>), Error> {
    let materials = materials(&flags.material)?;
    if materials == Materials::None {
        let what = "a fit is of materials; `none` leaves nothing to fit".to_owned();
        return Err(Error::Usage { what });
    }
    let request = Request {
        materials,
        medium: flags.medium.as_deref().map(source).transpose()?,
        sight: sight(&flags.sight.words(None))?,
        ..Request::default()
    };
    let found = request.subjects()?;
    let subjects: Vec<Subject> = found
        .ready
        .into_iter()
        .map(|(subject, _)| subject)
        .collect();
    let space = request.sight.integration.space.name();
    let whole = subjects.len() as u64;
    let rows = each(
        &subjects,
        |subject| of_subject(subject, methods, space, &flags.gpu),
        &mut |done| progress(done as u64, whole, "materials"),
    );
    let left_out = found.left_out.iter();
    let left_out = left_out.map(|unseen| format!("left out: {}", unseen.why));
    Ok((rows.into_iter().flatten().collect(), left_out.collect()))
}

fn of_subject(
    subject: &Subject,
    methods: &[&'static Method],
    space: &'static str,
    gpu: &str,
) -> Vec<Row> {
    let transparent = subject.effective.channels.is_transparent();
    let fits = |method: &&&'static Method| method.class == Class::Any || transparent;
    let row = |method: &&'static Method| {
        let values = subject.values(method);
        let function = method
            .specialise(&values)
            .expect("a test specialises every method");
        let error = model_error(&function, &subject.truth_for(method));
        Row {
            material: Some(subject.argument.clone()),
            class: Some(subject.material.kind.name()),
            ..bare(method, &values, error, (space, gpu))
        }
    };
    methods.iter().filter(fits).map(row).collect()
}

fn bare(
    method: &'static Method,
    values: &Values,
    error: ModelError,
    (space, gpu): (&'static str, &str),
) -> Row {
    Row {
        material: None,
        class: None,
        follows: None,
        space,
        method,
        coefficients: method
            .inputs
            .iter()
            .map(|input: &Input| values[input.name])
            .collect(),
        max_abs: error.max_abs,
        mean_rel: error.mean_rel,
        cost: cost(method, gpu),
    }
}

/// What an evaluation of the library function costs: counted in the graph, or recorded.
fn cost(method: &Method, gpu: &str) -> Option<f64> {
    if gpu == "operations" {
        let function = method.function(false).expect("a test builds every method");
        return Some(function.work() as f64);
    }
    let figures = records(gpu).library(method.name)?;
    Some(figures.cost())
}

/// A row for each method, fitted to two colours.
fn of_colours(flags: &FitFlags, methods: &[&'static Method]) -> Result<Vec<Row>, Error> {
    let (f0, f82) = (colour("f0", &flags.f0)?, colour("f82", &flags.f82)?);
    let follows = [0, 1, 2].map(|i| Follows::of(f0[i], f82[i]));
    let seen = |cos_theta: f64| follows.map(|channel| channel.at(cos_theta));
    let row = |method: &&'static Method| {
        let values = fitted_values(method, seen);
        let function = method.function(false).expect("a test builds every method");
        let error = error_from(seen, &|cosines| {
            values_at(&function, method.inputs, &values, cosines)
        });
        Row {
            follows: Some(follows),
            ..bare(method, &values, error, ("any", &flags.gpu))
        }
    };
    let of_any = methods.iter().filter(|method| method.class == Class::Any);
    Ok(of_any.map(row).collect())
}

fn colour(name: &str, numbers: &[f64]) -> Result<[f64; 3], Error> {
    let is_reflectance = |number: &f64| (0.0..=1.0).contains(number);
    let three = <[f64; 3]>::try_from(numbers).ok();
    let three = three.filter(|numbers| numbers.iter().all(is_reflectance));
    three.ok_or_else(|| Error::Usage {
        what: format!("--{name} is three reflectances from 0 to 1, linear: --{name} 0.9,0.6,0.3"),
    })
}

fn canonical(flags: &FitFlags) -> Result<String, Error> {
    let terms: Vec<String> = flags.terms.iter().map(usize::to_string).collect();
    let numbers = |numbers: &[f64]| {
        let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
        if words.is_empty() {
            vec![]
        } else {
            vec![words.join(",")]
        }
    };
    let plain = |name: &str, words: Vec<String>| {
        let words = words.first().map(|word| format!(" --{name} {word}"));
        words.unwrap_or_default()
    };
    let medium = flags.medium.as_deref().map(quoted).into_iter().collect();
    Ok(format!(
        "fit{}{}{}{}{}{}",
        flag("material", &flags.material),
        plain("terms", terms),
        plain("f0", numbers(&flags.f0)),
        plain("f82", numbers(&flags.f82)),
        plain("medium", medium),
        sight_flags(&sight(&flags.sight.words(None))?),
    ))
}
