//! The trials of a function of a file: with the values of materials, and with the worst inputs that are known.

use super::half::nearest_half;
use super::points::{limits, worst_cases, worst_cosines};
use super::requested::{PlannedFile, VerifyPlan};
use super::row::WORST;
use super::trial::{ABSOLUTE_FLOOR, Trial};
use crate::generator::emit::{CodeBound, EmittedFunction, FunctionForm};
use crate::generator::fit::{self, Measured, values_for_material_in};
use crate::generator::reference::{MaterialInMedium, ReferenceCurve};
use crate::language::ir::{Texels, Ty};
use crate::language::methods::{Contract, Method};
use crate::physics::materials::Channels;
use crate::physics::num::Precision;

/// A trial of a function, with its material and reference.
pub struct TrialCase<'a> {
    /// The material, or another name for the values.
    pub material: &'a str,
    /// The trial.
    pub trial: Trial,
    /// Cosines around which points are dense.
    pub limits: Vec<f32>,
    /// The curve that its model error is measured against.
    pub reference: Option<ReferenceCurve>,
}

/// The trials of a function. A library function is tried with each material's values, and with its worst inputs so far.
pub fn cases<'a>(
    plan: &'a VerifyPlan,
    file: &PlannedFile,
    emitted: &EmittedFunction,
) -> Vec<TrialCase<'a>> {
    if let Some(index) = file.subject {
        return vec![specialised(&plan.subjects[index], emitted)];
    }
    let mut cases: Vec<TrialCase> = described(plan, emitted)
        .map(|subject| library(subject, emitted))
        .collect();
    if !emitted.precision.is_half() {
        cases.extend(known_worst(emitted));
    }
    cases
}

/// The materials of [`cases`], without the trials.
pub fn case_materials<'a>(
    plan: &'a VerifyPlan,
    file: &PlannedFile,
    emitted: &EmittedFunction,
) -> Vec<&'a str> {
    if let Some(index) = file.subject {
        return vec![&plan.subjects[index].argument];
    }
    let mut materials: Vec<&str> = described(plan, emitted)
        .map(|subject| subject.argument.as_str())
        .collect();
    if !emitted.precision.is_half() {
        materials.extend(worst_cases(emitted.method).map(|_| WORST));
    }
    materials
}

/// The materials with whose values a library function is run.
fn described<'a>(
    plan: &'a VerifyPlan,
    emitted: &EmittedFunction,
) -> impl Iterator<Item = &'a MaterialInMedium> {
    plan.trial_subjects(emitted.method)
}

/// The trial of a function with a material's values.
pub fn material_trial(subject: &MaterialInMedium, emitted: &EmittedFunction) -> Trial {
    match emitted.form {
        FunctionForm::Specialised => specialised(subject, emitted).trial,
        _ => library(subject, emitted).trial,
    }
}

pub fn specialised<'a>(subject: &'a MaterialInMedium, emitted: &EmittedFunction) -> TrialCase<'a> {
    let bound = match &emitted.code {
        _ if is_narrow(emitted.method, subject) => Measured::No(NARROW.to_owned()),
        Measured::Yes(CodeBound::Ulp(bound) | CodeBound::Absolute(bound)) => Measured::Yes(*bound),
        Measured::No(why) => Measured::No(why.clone()),
    };
    let reference = subject.truth_for(emitted.method);
    let table = fit::table_of(&emitted.function, |c| reference.at(c));
    let kept = emitted.method.kept();
    let kept = kept.map(|input| emitted.constants[input.name].map(|value| value as f32));
    TrialCase {
        material: &subject.argument,
        trial: trial(emitted, kept.collect(), table, bound),
        limits: limits_of(&subject.effective.channels)
            .into_iter()
            .chain(worst_cosines(emitted.method))
            .collect(),
        reference: Some(reference),
    }
}

fn library<'a>(subject: &'a MaterialInMedium, emitted: &EmittedFunction) -> TrialCase<'a> {
    let values = values_for_material_in(emitted.precision, subject, emitted.method);
    let numbers = emitted
        .method
        .inputs
        .iter()
        .filter(|input| input.ty != Ty::Texture);
    let single = numbers.map(|input| values[input.name].map(|value| value as f32));
    let reference = subject.truth_for(emitted.method);
    let table = fit::table_of(&emitted.function, |c| reference.at(c));
    TrialCase {
        material: &subject.argument,
        trial: trial(
            emitted,
            single.collect(),
            table,
            if is_narrow(emitted.method, subject) {
                Measured::No(NARROW.to_owned())
            } else {
                promised_for(emitted, &subject.effective.channels)
            },
        ),
        limits: limits_of(&subject.effective.channels),
        reference: (emitted.form == FunctionForm::Library).then_some(reference),
    }
}

/// Whether the fringes of a film are narrower than a cosine's rounding near grazing.
fn is_narrow(method: &Method, subject: &MaterialInMedium) -> bool {
    method.claims.code_abs > 0.0 && subject.has_films()
}

/// Why no bound is held at every cosine.
const NARROW: &str = "near grazing fringes of a film are as narrow as the cosine is small";

/// The trials of a method at its worst known inputs, which are kept for ever.
fn known_worst(emitted: &EmittedFunction) -> Vec<TrialCase<'static>> {
    let case = |(values, cos_theta): (Vec<[f32; 3]>, f32)| TrialCase {
        material: WORST,
        trial: trial(emitted, values, None, promised(emitted.method)),
        limits: vec![cos_theta],
        reference: None,
    };
    worst_cases(emitted.method).map(case).collect()
}

/// What a library function promises for a material. Its bound is stated over a set of media.
fn promised_for(emitted: &EmittedFunction, channels: &Channels) -> Measured<f64> {
    let method = emitted.method;
    let over = match (emitted.precision, method.half.claim()) {
        (Precision::F32, _) => method.claims.code_over,
        (Precision::F16, Some(claim)) => claim.over,
        (Precision::F16, None) => {
            let why = method.half.library_refusal().unwrap_or_default();
            return Measured::No(why.to_owned());
        }
    };
    let holds = |i: usize| over.holds(channels.n[i], channels.k[i]);
    if !(0..3).all(holds) {
        Measured::No(format!("its bound is stated over {}", over.text()))
    } else if let (Precision::F16, Some(claim)) = (emitted.precision, method.half.claim()) {
        Measured::Yes(claim.max_abs)
    } else {
        promised(method)
    }
}

/// The absolute difference that is no error. What coefficients promise is absolute.
fn floor(emitted: &EmittedFunction) -> f64 {
    match emitted.code {
        Measured::Yes(CodeBound::Absolute(most)) if !emitted.precision.is_half() => most,
        _ => ABSOLUTE_FLOOR,
    }
}

/// What a library function promises in ulp. A method that does not keep the contract promises nothing beyond its media.
fn promised(method: &Method) -> Measured<f64> {
    match method.contract {
        Contract::Kept if !method.is_textured() => Measured::Yes(method.claims.code_ulp),
        Contract::Kept => Measured::Yes(0.0),
        Contract::Exempt(why) => Measured::No(why.to_owned()),
    }
}

fn trial(
    emitted: &EmittedFunction,
    values: Vec<[f32; 3]>,
    table: Option<Texels>,
    bound: Measured<f64>,
) -> Trial {
    // A function that reads a texture is as exact as its sampler, which the trial allows for. What coefficients promise is
    // absolute, and so are some methods' promises in single precision: `floor` has them.
    let is_absolute = emitted.method.claims.code_abs > 0.0 && !emitted.precision.is_half();
    let is_coefficient = emitted.form.coefficient().is_some();
    let has_no_ulp = emitted.method.is_textured() || is_coefficient || is_absolute;
    let bound = match bound {
        Measured::Yes(_) if has_no_ulp => Measured::Yes(0.0),
        Measured::No(_) if emitted.method.is_textured() => Measured::Yes(0.0),
        bound => bound,
    };
    let values = if emitted.precision.is_half() {
        values.iter().map(|value| value.map(nearest_half)).collect()
    } else {
        values
    };
    Trial {
        function: emitted.function.clone(),
        values,
        table,
        bound,
        floor: floor(emitted),
        is_guarded: emitted.method.contract == Contract::Kept,
    }
}

fn limits_of(channels: &Channels) -> Vec<f32> {
    channels.n.iter().flat_map(|n| limits(*n)).collect()
}
