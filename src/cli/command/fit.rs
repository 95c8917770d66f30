//! `fit`: the coefficients of fitted methods.

use crate::cli::args::{End, FitFlags};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::request::{Materials, Request};
use crate::generator::emit::missed;
use crate::generator::fit::{Coefficients, Exact, FitCurve, FitObjective, Follows, Weight, error_from, model_error, values_at};
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::{library_cost, records};
use crate::language::methods::{ALL, Class, Method};
use crate::physics::num::{each_channel, in_parallel};
use crate::physics::spectra::Gamut;
use crate::generator::envelope::Report;
use crate::cli::fits_text::{FitRow, fits_text};

use crate::cli::command::{Output, Progress, report, search, try_places};

/// Fits.
pub fn run(flags: &FitFlags, progress: Progress) -> Result<Output, Error> {
    let aim = aim(flags)?;
    if flags.search {
        return search::run(flags, aim, progress);
    }
    let forms = forms(flags);
    try_places(flags.report.json(), None)?;
    let (rows, left_out) = match flags.f0.zip(flags.f82) {
        None => of_materials(flags, aim, &forms, progress)?,
        Some(colours) => (of_colours(colours, aim, &forms)?, Vec::new()),
    };
    let text = fits_text(&rows, flags.gpu.name);
    let json = Report::new(flags.command_line(&flags.gamut.conditions()?), rows);
    let mut output = report(text, &json, flags.report.json())?;
    output.remarks = left_out;
    Ok(output)
}

/// What is to be minimised and met.
fn aim(flags: &FitFlags) -> Result<FitObjective, Error> {
    if flags.weight.is_of_colours() && flags.f0.is_some() {
        let why = format!(
            "--weight {} wants a space, which --f0 and --f82 have not; absolute and relative go with them",
            flags.weight.name()
        );
        return Err(RequestFault::conflict(why).into());
    }
    Ok(FitObjective {
        weight: flags.weight,
        precision: flags.precision.unwrap_or_default(),
        exact: Exact {
            normal: flags.exact.contains(&End::Normal),
            grazing: flags.exact.contains(&End::Grazing),
        },
        space: flags.gamut.viewing.space.unwrap_or_default(),
        // Forms are compared by what they can follow. Where one is limited does not count.
        gamut: match flags.search {
            true => Gamut::Keep,
            false => flags.gamut.gamut.unwrap_or_default(),
        },
    })
}

/// A fitted method, and what an evaluation of its library function costs, where that is known.
struct Form {
    method: &'static Method,
    cost: Option<f64>,
}

/// The fitted methods with so many coefficients, the fewest first.
fn forms(flags: &FitFlags) -> Vec<Form> {
    let fitted = ALL.iter().copied().filter(|method| method.is_fitted());
    let mut chosen: Vec<&Method> = fitted
        .filter(|method| flags.terms.is_none_or(|terms| method.inputs.len() == terms))
        .collect();
    chosen.sort_by_key(|method| (method.inputs.len(), method.name));
    let record = records(flags.gpu.name);
    let cost = |method| library_cost(method, flags.gpu, &record);
    let form = |method: &'static Method| Form {
        method,
        cost: cost(method),
    };
    chosen.into_iter().map(form).collect()
}

/// The materials that are meant, as they are seen, with what was left out; a search is of all unless some are named.
pub(super) fn subjects(flags: &FitFlags) -> Result<(Vec<MaterialInMedium>, Vec<String>), Error> {
    let materials = match flags.search && flags.materials.material.is_empty() {
        true => Materials::All,
        false => flags.materials.materials()?,
    };
    if materials == Materials::None {
        return Err(RequestFault::NoMaterial {
            why: "a fit is of materials; `none` leaves nothing to fit",
        }
        .into());
    }
    let request = Request {
        materials,
        medium: flags.medium.source()?,
        viewing: flags.gamut.conditions()?,
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
            None => remarks.push(format!(
                "left out: {} with {form}: {NO_FIT}",
                crate::physics::foreign::Foreign(subject)
            )),
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
    let free = FitObjective {
        gamut: Gamut::Keep,
        ..aim
    };
    let (curve, before_gamut) = (FitCurve::of(subject), FitCurve::unclipped(subject));
    // Promises of classes are of functions, whose fit is the usual one without a gamut.
    let promised = aim.weight == Weight::Absolute && !aim.exact.is_any();
    let error = |method: &'static Method, fitted: &Coefficients| {
        let function = method.specialise(&fitted.values);
        let function = function.expect("a test specialises every method");
        model_error(&function, &subject.truth_for(method))
    };
    let row = |form: &Form| {
        let method = form.method;
        let fitted = Coefficients::fit(method, &curve, aim)?;
        let without_gamut = error(method, &Coefficients::fit(method, &before_gamut, free)?).max_abs;
        let missed = promised.then(|| missed(subject, method, without_gamut));
        let error = error(method, &fitted);
        let row = FitRow::new(method, &fitted, &error, form.cost, aim.space.name());
        Some(row.of_material(subject, missed.flatten(), without_gamut))
    };
    let own = forms
        .iter()
        .filter(|form| subject.is_described_by(form.method));
    own.map(|form| (row(form), subject.argument.clone(), form.method.name))
        .collect()
}

/// A row for each method, fitted to two colours.
fn of_colours(
    (f0, f82): ([f64; 3], [f64; 3]),
    aim: FitObjective,
    forms: &[Form],
) -> Result<Vec<FitRow>, Error> {
    let follows = each_channel(|i| Follows::of(f0[i], f82[i]));
    let seen = |cos_theta: f64| follows.map(|channel| channel.at(cos_theta));
    let curve = FitCurve::new(seen);
    let row = |form: &Form| {
        let method = form.method;
        let fitted = Coefficients::fit(method, &curve, aim).ok_or_else(|| Error::usage(format!("{} has no fit to these colours: {NO_FIT}", method.name)))?;
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
