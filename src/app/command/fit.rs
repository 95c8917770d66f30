//! `fit`: the coefficients of fitted methods.

use serde_json::{Value, json};

use crate::app::args::FitFlags;
use crate::app::error::Error;
use crate::app::names::{family, flag, quoted};
use crate::app::request::{Materials, Request};
use crate::app::sight::{flags as sight_flags, sight};
use crate::app::source::{materials, source};
use crate::cost::{Family, library_cost, records};
use crate::emit::Subject;
use crate::fit::{Follows, ModelError, error_from, fitted_values, model_error, values_at};
use crate::methods::{ALL, Class, Method, Values};
use crate::num::{Precision, in_parallel};
use crate::report::fits::{Row, text};

use super::{Output, Progress, report, try_places};

/// Fits.
pub fn run(flags: &FitFlags, progress: Progress) -> Result<Output, Error> {
    let forms = forms(flags.terms, family(&flags.gpu)?)?;
    try_places(flags.json.as_deref(), None)?;
    let (rows, left_out) = if flags.f0.is_empty() {
        of_materials(flags, &forms, progress)?
    } else {
        (of_colours(flags, &forms)?, Vec::new())
    };
    let json = json!({
        "tool": "fresnel-gen", "command": canonical(flags)?, "device": null,
        "rows": rows.iter().map(Row::json).collect::<Vec<Value>>(),
    });
    let mut output = report(text(&rows, &flags.gpu), &json, flags.json.as_deref())?;
    output.remarks = left_out;
    Ok(output)
}

/// A fitted method, and what an evaluation of its library function costs, where that is known.
struct Form {
    method: &'static Method,
    cost: Option<f64>,
}

/// The fitted methods with so many coefficients, the fewest first.
fn forms(terms: Option<usize>, gpu: &Family) -> Result<Vec<Form>, Error> {
    let fitted = ALL.iter().copied().filter(|method| method.is_fitted());
    let mut chosen: Vec<&Method> = fitted
        .filter(|method| terms.is_none_or(|terms| method.inputs.len() == terms))
        .collect();
    if chosen.is_empty() {
        let what = "no form has so many coefficients; --terms is 4 or 5".to_owned();
        return Err(Error::Usage { what });
    }
    chosen.sort_by_key(|method| (method.inputs.len(), method.name));
    let record = records(gpu.name);
    let cost = |method| library_cost(method, gpu, &record);
    let form = |method: &'static Method| Form {
        method,
        cost: cost(method),
    };
    Ok(chosen.into_iter().map(form).collect())
}

/// A row for each material and method that describes it, and what was left out.
fn of_materials(
    flags: &FitFlags,
    forms: &[Form],
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
    let of = |i: usize| of_subject(&subjects[i], forms, space);
    let rows = in_parallel(subjects.len(), &of, &mut |done, whole| {
        progress(done, whole, "materials");
    });
    let left_out = found.left_out.iter();
    let left_out = left_out.map(|unseen| format!("left out: {}", unseen.why));
    Ok((rows.into_iter().flatten().collect(), left_out.collect()))
}

fn of_subject(subject: &Subject, forms: &[Form], space: &'static str) -> Vec<Row> {
    let row = |form: &Form| {
        let values = subject.values(form.method);
        let function = form.method.specialise(&values);
        let function = function.expect("a test specialises every method");
        let error = model_error(&function, &subject.truth_for(form.method));
        Row {
            material: Some(subject.argument.clone()),
            class: Some(subject.material.kind.name()),
            ..bare(form, &values, error, space)
        }
    };
    let own = forms
        .iter()
        .filter(|form| subject.is_described_by(form.method));
    own.map(row).collect()
}

fn bare(form: &Form, values: &Values, error: ModelError, space: &'static str) -> Row {
    let inputs = form.method.inputs.iter();
    Row {
        material: None,
        class: None,
        follows: None,
        space,
        method: form.method,
        coefficients: inputs.map(|input| values[input.name]).collect(),
        max_abs: error.max_abs,
        mean_rel: error.mean_rel,
        cost: form.cost,
    }
}

/// A row for each method, fitted to two colours.
fn of_colours(flags: &FitFlags, forms: &[Form]) -> Result<Vec<Row>, Error> {
    let (f0, f82) = (colour("f0", &flags.f0)?, colour("f82", &flags.f82)?);
    let follows = [0, 1, 2].map(|i| Follows::of(f0[i], f82[i]));
    let seen = |cos_theta: f64| follows.map(|channel| channel.at(cos_theta));
    let row = |form: &Form| {
        let (method, values) = (
            form.method,
            fitted_values(form.method, Precision::F32, seen),
        );
        let function = method.function(false);
        let function = function.expect("a test builds every method");
        let error = error_from(seen, &|cosines| {
            values_at(&function, method.inputs, &values, cosines)
        });
        Row {
            follows: Some(follows),
            ..bare(form, &values, error, "any")
        }
    };
    let of_any = forms.iter().filter(|form| form.method.class == Class::Any);
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
