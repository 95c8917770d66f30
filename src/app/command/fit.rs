//! `fit`: the coefficients of fitted methods.

use crate::app::args::FitFlags;
use crate::app::error::Error;
use crate::app::fault::RequestFault;
use crate::app::names::{family, unknown};
use crate::app::precision::named;
use crate::app::request::{Materials, Request};
use crate::app::sight::sight;
use crate::app::source::{materials, source};
use crate::cost::{Family, library_cost, records};
use crate::emit::missed;
use crate::fit::{
    Coefficients, Exact, FitCurve, FitObjective, Follows, Weight, error_from, model_error,
    values_at,
};
use crate::methods::{ALL, Class, Method};
use crate::num::in_parallel;
use crate::reference::MaterialInMedium;
use crate::report::Report;
use crate::report::fits::{FitRow, fits_text};

use super::{Output, Progress, report, search, try_places};

/// Fits.
pub fn run(flags: &FitFlags, progress: Progress) -> Result<Output, Error> {
    let gpu = family(&flags.gpu)?;
    let aim = aim(flags)?;
    if flags.search {
        return search::run(flags, aim, gpu, progress);
    }
    let forms = forms(flags.terms, gpu)?;
    try_places(flags.json.as_deref(), None)?;
    let (rows, left_out) = if flags.f0.is_empty() {
        of_materials(flags, aim, &forms, progress)?
    } else {
        (of_colours(flags, aim, &forms)?, Vec::new())
    };
    let text = fits_text(&rows, &flags.gpu);
    let json = Report::new(flags.command_line(&sight(&flags.sight.words(None))?), rows);
    let mut output = report(text, &json, flags.json.as_deref())?;
    output.remarks = left_out;
    Ok(output)
}

/// What is to be minimised and met.
fn aim(flags: &FitFlags) -> Result<FitObjective, Error> {
    let names = Weight::ALL.map(Weight::name);
    let weight = Weight::find(&flags.weight);
    let weight = weight.ok_or_else(|| unknown("weight", &flags.weight, &names))?;
    if weight.is_of_colours() && !flags.f0.is_empty() {
        let what = format!(
            "--weight {} wants a space, which --f0 and --f82 have not; absolute and relative go with them",
            weight.name()
        );
        return Err(Error::Usage { what });
    }
    let end = |end: &str| flags.exact.iter().any(|given| given == end);
    if let Some(other) = flags.exact.iter().find(|end| *end != "0" && *end != "90") {
        let what = format!("`{other}` is no end of the right angle; --exact is 0, 90, or 0,90");
        return Err(Error::Usage { what });
    }
    Ok(FitObjective {
        weight,
        precision: named(flags.precision.as_deref())?,
        exact: Exact {
            normal: end("0"),
            grazing: end("90"),
        },
        space: sight(&flags.sight.words(None))?.integration.space,
    })
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

/// The materials that are meant, as they are seen, with what was left out; a search is of all unless some are named.
pub(super) fn subjects(flags: &FitFlags) -> Result<(Vec<MaterialInMedium>, Vec<String>), Error> {
    let materials = match flags.search && flags.material.is_empty() {
        true => Materials::All,
        false => materials(&flags.material)?,
    };
    if materials == Materials::None {
        return Err(RequestFault::NoMaterial {
            why: "a fit is of materials; `none` leaves nothing to fit",
        }
        .into());
    }
    let request = Request {
        materials,
        medium: flags.medium.as_deref().map(source).transpose()?,
        sight: sight(&flags.sight.words(None))?,
        ..Request::default()
    };
    let found = request.subjects()?;
    let left_out = found.left_out_lines();
    Ok((found.materials(), left_out))
}

/// A row for each material and method that describes it, and what was left out.
fn of_materials(
    flags: &FitFlags,
    aim: FitObjective,
    forms: &[Form],
    progress: Progress,
) -> Result<(Vec<FitRow>, Vec<String>), Error> {
    let (subjects, mut remarks) = subjects(flags)?;
    let of = |i: usize| of_subject(&subjects[i], aim, forms);
    let found = in_parallel(subjects.len(), &of, &mut |done, whole| {
        progress(done, whole, "materials");
    });
    let mut rows = Vec::new();
    for (row, subject, form) in found.into_iter().flatten() {
        match row {
            Some(row) => rows.push(row),
            None => remarks.push(format!("left out: {subject} with {form}: {NO_FIT}")),
        }
    }
    Ok((rows, remarks))
}

/// Why there is no row.
const NO_FIT: &str = "under these weights its terms do not tell angles apart";

/// A row for each form that describes a material, none where it has no fit, with the names of both.
fn of_subject(
    subject: &MaterialInMedium,
    aim: FitObjective,
    forms: &[Form],
) -> Vec<(Option<FitRow>, String, &'static str)> {
    let curve = FitCurve::unclipped(subject);
    // Promises of classes are of the usual fit.
    let promised = aim.weight == Weight::Absolute && !aim.exact.is_any();
    let row = |form: &Form| {
        let fitted = Coefficients::fit(form.method, &curve, aim)?;
        let function = form.method.specialise(&fitted.values);
        let function = function.expect("a test specialises every method");
        let error = model_error(&function, &subject.truth_for(form.method));
        let missed = promised.then(|| missed(subject, form.method, error.max_abs));
        let row = FitRow::new(form.method, &fitted, &error, form.cost, aim.space.name());
        Some(row.of_material(subject, missed.flatten()))
    };
    let own = forms
        .iter()
        .filter(|form| subject.is_described_by(form.method));
    own.map(|form| (row(form), subject.argument.clone(), form.method.name))
        .collect()
}

/// A row for each method, fitted to two colours.
fn of_colours(flags: &FitFlags, aim: FitObjective, forms: &[Form]) -> Result<Vec<FitRow>, Error> {
    let (f0, f82) = (colour("f0", &flags.f0)?, colour("f82", &flags.f82)?);
    let follows = [0, 1, 2].map(|i| Follows::of(f0[i], f82[i]));
    let seen = |cos_theta: f64| follows.map(|channel| channel.at(cos_theta));
    let curve = FitCurve::new(seen);
    let row = |form: &Form| {
        let method = form.method;
        let fitted = Coefficients::fit(method, &curve, aim).ok_or_else(|| Error::Usage {
            what: format!("{} has no fit to these colours: {NO_FIT}", method.name),
        })?;
        let function = method.function(false);
        let function = function.expect("a test builds every method");
        let error = error_from(seen, &|cosines| {
            values_at(&function, method.inputs, &fitted.values, cosines)
        });
        let row = FitRow::new(method, &fitted, &error, form.cost, "any");
        Ok(row.of_colours(follows))
    };
    let of_any = forms.iter().filter(|form| form.method.class == Class::Any);
    of_any.map(row).collect()
}

fn colour(name: &str, numbers: &[f64]) -> Result<[f64; 3], Error> {
    let is_reflectance = |number: &f64| (0.0..=1.0).contains(number);
    let three = <[f64; 3]>::try_from(numbers).ok();
    let three = three.filter(|numbers| numbers.iter().all(is_reflectance));
    three.ok_or_else(|| Error::Usage {
        what: format!("--{name} is three reflectances from 0 to 1, linear: --{name} 0.9,0.6,0.3"),
    })
}
