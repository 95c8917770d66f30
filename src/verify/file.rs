//! One file: every function of it run, and every compiler asked.

use std::cell::OnceCell;

use crate::emit::{CodeBound, Emitted, FunctionForm};
use crate::fit::{self, Measured, ModelError, values_for_material_in};
use crate::ir::{Column, Ty};
use crate::materials::Channels;
use crate::methods::{Contract, Method};
use crate::num::{Precision, each_channel};
use crate::reference::{MaterialInMedium, ReferenceCurve};
use crate::targets::Stack;
use crate::verify::compilers::{self, Verdict};
use crate::verify::run::{Devices, ExecutionPath, RunFault, Runnable, ShippedFunction};
use crate::verify::{
    Outcome, Trial, beyond, cosines_around, limits, nearest_half, share, worst_cases, worst_cosines,
};

use super::half_run;
use super::judge::{PathRun, RanFunction};
use super::plan::{PlannedFile, VerifyPlan};
use super::row::{self, VerifyRow};

/// How a file is tried.
#[derive(Clone, Copy, Debug)]
pub struct VerifyEffort {
    /// Cosines for each function and material.
    pub points: usize,
}

/// A trial of a function, with what it is about.
pub(super) struct TrialCase<'a> {
    material: &'a str,
    pub trial: Trial,
    limits: Vec<f32>,
    reference: Option<ReferenceCurve>,
}

/// The rows of a file.
pub fn file_rows(
    plan: &VerifyPlan,
    file: &PlannedFile,
    devices: &Devices,
    effort: VerifyEffort,
) -> Vec<VerifyRow> {
    let accepts = accepts(file);
    let mut rows = Vec::new();
    for (index, emitted) in file.functions.iter().enumerate() {
        if let Some(part) = emitted.effect {
            let tried = FileTrial::new(file, index, emitted, devices, effort);
            rows.push(tried.effect_row(plan, part, &accepts));
            continue;
        }
        let cases = cases(plan, file, emitted);
        let tried = FileTrial::new(file, index, emitted, devices, effort);
        for (place, case) in cases.iter().enumerate() {
            rows.push(tried.case_row(case, &accepts, place == 0));
        }
    }
    rows
}

/// What compilers say of all pages of a file: a refusal of one is a refusal, and says which page it is; without one a page that could
/// not be checked leaves the file unchecked.
fn accepts(file: &PlannedFile) -> Vec<(&'static str, Verdict)> {
    let mut all: Vec<(&'static str, Verdict)> = Vec::new();
    for page in &file.pages {
        for (name, verdict) in
            compilers::accepts_in(file.precision(), file.target, &page.path, &page.bytes)
        {
            let verdict = match verdict {
                Verdict::No(words) => {
                    Verdict::No(format!("{}: {name} refuses it: {words}", page.path))
                }
                other => other,
            };
            match all.iter_mut().find(|(other, _)| *other == name) {
                Some((_, Verdict::No(_))) => {}
                Some((_, known)) if *known == Verdict::Yes || matches!(verdict, Verdict::No(_)) => {
                    *known = verdict
                }
                Some(_) => {}
                None => all.push((name, verdict)),
            }
        }
    }
    all
}

/// The trials of a function: a library function with each material's values, and where it was worst so far.
fn cases<'a>(plan: &'a VerifyPlan, file: &PlannedFile, emitted: &Emitted) -> Vec<TrialCase<'a>> {
    if let Some(index) = file.subject {
        return vec![specialised(&plan.subjects[index], emitted)];
    }
    let method = emitted.method;
    let fits = |subject: &&MaterialInMedium| subject.is_described_by(method);
    let mut cases: Vec<TrialCase> = plan
        .trial_subjects()
        .iter()
        .filter(fits)
        .map(|subject| library(subject, emitted))
        .collect();
    if !emitted.precision.is_half() {
        cases.extend(known_worst(emitted));
    }
    cases
}

/// The trial of a function with a material's values.
pub fn material_trial(subject: &MaterialInMedium, emitted: &Emitted) -> Trial {
    match emitted.form {
        FunctionForm::Specialised => specialised(subject, emitted).trial,
        _ => library(subject, emitted).trial,
    }
}

pub(super) fn specialised<'a>(subject: &'a MaterialInMedium, emitted: &Emitted) -> TrialCase<'a> {
    let bound = match &emitted.code {
        Measured::Yes(CodeBound::Ulp(bound) | CodeBound::Absolute(bound)) => Measured::Yes(*bound),
        Measured::No(why) => Measured::No(why.clone()),
    };
    let reference = subject.truth_for(emitted.method);
    let table = fit::table_of(&emitted.function, |c| reference.at(c));
    TrialCase {
        material: &subject.argument,
        trial: trial(emitted, Vec::new(), table, bound),
        limits: limits_of(&subject.effective.channels)
            .into_iter()
            .chain(worst_cosines(emitted.method))
            .collect(),
        reference: Some(reference),
    }
}

fn library<'a>(subject: &'a MaterialInMedium, emitted: &Emitted) -> TrialCase<'a> {
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
            promised_for(emitted, &subject.effective.channels),
        ),
        limits: limits_of(&subject.effective.channels),
        reference: (emitted.form == FunctionForm::Library).then_some(reference),
    }
}

/// The worst inputs known of a method, kept for ever.
fn known_worst(emitted: &Emitted) -> Vec<TrialCase<'static>> {
    let case = |(values, cos_theta): (Vec<[f32; 3]>, f32)| TrialCase {
        material: row::WORST,
        trial: trial(emitted, values, None, promised(emitted.method)),
        limits: vec![cos_theta],
        reference: None,
    };
    worst_cases(emitted.method).map(case).collect()
}

/// What a library function promises for a material: its bound is stated over a set of media.
fn promised_for(emitted: &Emitted, channels: &Channels) -> Measured<f64> {
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

/// What a library function promises in ulp; a method that does not keep the contract promises nothing beyond its media.
fn promised(method: &Method) -> Measured<f64> {
    match method.contract {
        Contract::Kept if !method.is_textured() => Measured::Yes(method.claims.code_ulp),
        Contract::Kept => Measured::Yes(0.0),
        Contract::Exempt(why) => Measured::No(why.to_owned()),
    }
}

fn trial(
    emitted: &Emitted,
    values: Vec<[f32; 3]>,
    table: Option<crate::ir::Texels>,
    bound: Measured<f64>,
) -> Trial {
    // What reads a texture is as exact as its sampler, which the trial allows for.
    let bound = if emitted.method.is_textured() {
        Measured::Yes(0.0)
    } else {
        bound
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
        is_guarded: emitted.method.contract == Contract::Kept,
    }
}

fn limits_of(channels: &Channels) -> Vec<f32> {
    channels.n.iter().flat_map(|n| limits(*n)).collect()
}

/// A function, and how it is run.
pub(super) struct FileTrial<'a> {
    pub file: &'a PlannedFile,
    pub emitted: &'a Emitted,
    entry: &'a str,
    pub devices: &'a Devices,
    effort: VerifyEffort,
    /// The text compiled for running, once for all cases.
    own: OnceCell<Result<Runnable, RunFault>>,
}

impl<'a> FileTrial<'a> {
    fn new(
        file: &'a PlannedFile,
        index: usize,
        emitted: &'a Emitted,
        devices: &'a Devices,
        effort: VerifyEffort,
    ) -> FileTrial<'a> {
        let entry = file
            .run_page()
            .entries
            .get(index)
            .map_or("main", String::as_str);
        FileTrial {
            file,
            emitted,
            entry,
            devices,
            effort,
            own: OnceCell::new(),
        }
    }

    fn case_row(
        &self,
        case: &TrialCase,
        accepts: &[(&'static str, Verdict)],
        is_first: bool,
    ) -> VerifyRow {
        let paths = ExecutionPath::all_for(self.file.target, self.emitted.precision);
        // Other paths are second opinions on the text: one material tells.
        let paths = if is_first { paths } else { &paths[..1] };
        let runs: Vec<(ExecutionPath, Result<PathRun, RunFault>)> = paths
            .iter()
            .map(|path| (*path, self.run(case, *path)))
            .collect();
        RanFunction {
            file: self.file,
            emitted: self.emitted,
            material: case.material,
            accepts,
            runs: &runs,
        }
        .verify_row()
    }

    /// The function as it may be run: a module that is not ours, and a text that holds a loop, may not.
    pub(super) fn shown_safely(
        &self,
        path: ExecutionPath,
    ) -> Result<ShippedFunction<'_>, RunFault> {
        let page = self.file.run_page();
        if let (Some(fault), true) = (self.untrusted(), path == ExecutionPath::Own) {
            return Err(fault);
        }
        if let Some(holds_loop) = &page.holds_loop {
            let why = format!("{holds_loop}, which no function of ours does, and is not run");
            return Err(RunFault::Failed(why));
        }
        Ok(ShippedFunction {
            target: self.file.target,
            bytes: &page.bytes,
            function: self.emitted,
            entry: self.entry,
        })
    }

    fn run(&self, case: &TrialCase, path: ExecutionPath) -> Result<PathRun, RunFault> {
        let shown = self.shown_safely(path)?;
        let other;
        let runnable = if path == ExecutionPath::Own {
            let compiled = || self.devices.prepare(&shown, path, &case.trial);
            let own = self.own.get_or_init(compiled);
            own.as_ref().map_err(RunFault::clone)?
        } else {
            other = self.devices.prepare(&shown, path, &case.trial)?;
            &other
        };
        if self.emitted.precision.is_half() {
            let ran = half_run::run_in_half(runnable, &shown, &case.trial)?;
            let device = self
                .devices
                .device_for(shown.target, path)?
                .adapter
                .to_string();
            return Ok(PathRun { device, ..ran });
        }
        let mut points = cosines_around(self.effort.points, &case.limits);
        points.extend(beyond());
        let expected = case.trial.expected(&points);
        let got = runnable.run(&case.trial, &expected.cosines)?;
        let outcome: Outcome = expected.judge(&got);
        let model_error = match (&case.reference, path) {
            (Some(reference), ExecutionPath::Own) => {
                Some(self.model_error(runnable, case, reference)?)
            }
            _ => None,
        };
        Ok(PathRun {
            points: expected.cosines.len(),
            share: share(&expected.cosines),
            bound: Some(expected.bound),
            outcome,
            half: None,
            effect: None,
            model_error,
            device: self
                .devices
                .device_for(shown.target, path)?
                .adapter
                .to_string(),
        })
    }

    /// A module that is not ours may do anything to a driver, unless a validator has looked at it.
    fn untrusted(&self) -> Option<RunFault> {
        let page = self.file.run_page();
        if !matches!(self.file.target.stack, Stack::SpirvModule)
            || page.is_current
            || !page.is_shipped
        {
            return None;
        }
        let verdicts = compilers::accepts_in(
            self.file.precision(),
            self.file.target,
            &page.path,
            &page.bytes,
        );
        let refusal = verdicts
            .iter()
            .find(|(_, verdict)| *verdict != Verdict::Yes)?;
        Some(match refusal {
            (name, Verdict::No(words)) => RunFault::Failed(format!("{name}: {words}")),
            (name, _) => RunFault::Absent(format!(
                "it is not what would be written today, and no {name} is here to say that it is safe to run"
            )),
        })
    }

    /// The error of the method as it runs, against the reference.
    fn model_error(
        &self,
        runnable: &Runnable,
        case: &TrialCase,
        reference: &ReferenceCurve,
    ) -> Result<ModelError, RunFault> {
        let fault = OnceCell::new();
        let error = fit::error_of(reference, &|cosines| {
            let single: Vec<f32> = cosines.iter().map(|c| *c as f32).collect();
            let got = runnable.run(&case.trial, &single);
            let got = got.unwrap_or_else(|why| {
                let _ = fault.set(why);
                vec![[f32::NAN; 3]; single.len()]
            });
            let channel =
                |i: usize| Column::Each(got.iter().map(|rgb| f64::from(rgb[i])).collect());
            crate::ir::Value::Rgb(each_channel(channel))
        });
        fault.into_inner().map_or(Ok(error), Err)
    }
}
