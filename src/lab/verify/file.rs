//! The verification of one file: all its functions are run, and all compilers are asked.
//!
//! Functions of effects are compared with what they mean. Functions in half precision run at every f16 from 0 to 1 and at every
//! exponent beyond. They are compared with f64 and with f16 rounded after every operation.

use std::cell::OnceCell;

use super::cases::{TrialCase, cases};
use super::effect_trial::EffectTrial;
use super::judge::{EffectRun, HalfRun, PathRun, RanFunction, RunResult};
use super::requested::{PlannedFile, VerifyPlan};
use super::row::VerifyRow;
use super::trial::Trial;
use crate::generator::emit::{EffectPart, EmittedFunction};
use crate::generator::fit::{self, Measured, ModelError, values_for_material_in};
use crate::generator::reference::ReferenceCurve;
use crate::lab::fault::Fault;
use crate::lab::verify::compilers::{self, Verdict};
use crate::lab::verify::run::{Devices, ExecutionPath, Runnable, ShippedFunction};
use crate::lab::verify::{
    HalfError, HalfTrial, beyond, cosines_around, halves, halves_beyond, result_range, share,
};
use crate::language::ir::Column;
use crate::language::methods::{Contract, Method};
use crate::language::targets::Stack;
use crate::physics::num::{Num, Precision, each_channel};

/// The rows of a file, with this number of cosines for each function and material.
pub fn file_rows(
    plan: &VerifyPlan,
    file: &PlannedFile,
    devices: &Devices,
    points: usize,
) -> Vec<VerifyRow> {
    let accepts = accepts(file);
    let mut rows = Vec::new();
    for (index, emitted) in file.functions.iter().enumerate() {
        if let Some(part) = emitted.effect {
            let tried = FileTrial::new(file, index, emitted, devices, points);
            rows.push(tried.effect_row(plan, part, &accepts));
            continue;
        }
        let cases = cases(plan, file, emitted);
        let tried = FileTrial::new(file, index, emitted, devices, points);
        for (place, case) in cases.iter().enumerate() {
            rows.push(tried.case_row(case, &accepts, place == 0));
        }
    }
    rows
}

/// What compilers say of all pages of a file. If one page is refused, the file is refused, and the words name the page. Otherwise
/// one page that could not be checked leaves the file unchecked.
fn accepts(file: &PlannedFile) -> Vec<(&'static str, Verdict)> {
    let mut all: Vec<(&'static str, Verdict)> = Vec::new();
    for page in &file.pages {
        for (name, verdict) in
            compilers::accepts(file.precision(), file.target, &page.path, &page.bytes)
        {
            let verdict = match verdict {
                Err(Fault::Failed(words)) => {
                    let place = &page.path;
                    Err(Fault::Failed(format!(
                        "{place}: {name} refuses it: {words}"
                    )))
                }
                other => other,
            };
            match all.iter_mut().find(|(other, _)| *other == name) {
                Some((_, Err(Fault::Failed(_)))) => {}
                Some((_, known)) if known.is_ok() || matches!(verdict, Err(Fault::Failed(_))) => {
                    *known = verdict
                }
                Some(_) => {}
                None => all.push((name, verdict)),
            }
        }
    }
    all
}

/// A function, and how it is run.
struct FileTrial<'a> {
    file: &'a PlannedFile,
    emitted: &'a EmittedFunction,
    entry: &'a str,
    devices: &'a Devices,
    points: usize,
    /// The text compiled for running, once for all cases.
    own: OnceCell<Result<Runnable, Fault>>,
}

impl<'a> FileTrial<'a> {
    fn new(
        file: &'a PlannedFile,
        index: usize,
        emitted: &'a EmittedFunction,
        devices: &'a Devices,
        points: usize,
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
            points,
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
        // Other paths are second opinions on the text: one material is enough.
        let paths = if is_first { paths } else { &paths[..1] };
        let runs: Vec<(ExecutionPath, Result<PathRun, Fault>)> = paths
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

    /// The function, if it may be run. A module that is not ours may not, nor may a text that holds a loop.
    fn shown_safely(&self, path: ExecutionPath) -> Result<ShippedFunction<'_>, Fault> {
        let page = self.file.run_page();
        if let (Some(fault), true) = (self.untrusted(), path == ExecutionPath::Own) {
            return Err(fault);
        }
        if let Some(holds_loop) = &page.holds_loop {
            let why = format!("{holds_loop}, which no function of ours does, and is not run");
            return Err(Fault::Failed(why));
        }
        Ok(ShippedFunction {
            target: self.file.target,
            bytes: &page.bytes,
            function: self.emitted,
            entry: self.entry,
        })
    }

    fn run(&self, case: &TrialCase, path: ExecutionPath) -> Result<PathRun, Fault> {
        let shown = self.shown_safely(path)?;
        let other;
        let runnable = if path == ExecutionPath::Own {
            let compiled = || self.devices.prepare(&shown, path, &case.trial);
            let own = self.own.get_or_init(compiled);
            own.as_ref().map_err(Fault::clone)?
        } else {
            other = self.devices.prepare(&shown, path, &case.trial)?;
            &other
        };
        if self.emitted.precision.is_half() {
            return run_in_half(runnable, &shown, &case.trial);
        }
        let mut points = cosines_around(self.points, &case.limits);
        points.extend(beyond());
        let expected = case.trial.expected(&points);
        let got = runnable.run(&case.trial, &expected.cosines)?;
        let model_error = match (&case.reference, path) {
            (Some(reference), ExecutionPath::Own) => {
                Some(self.model_error(runnable, case, reference)?)
            }
            _ => None,
        };
        Ok(PathRun {
            points: expected.cosines.len(),
            share: share(&expected.cosines),
            result: RunResult::Single {
                outcome: expected.judge(&got),
                bound: Some(expected.bound),
            },
            model_error,
            device: runnable.device.clone(),
        })
    }

    /// The fault of a module that is not ours and that no validator has checked: it may do anything to a driver.
    fn untrusted(&self) -> Option<Fault> {
        let page = self.file.run_page();
        if !matches!(self.file.target.stack, Stack::SpirvModule)
            || page.is_current
            || !page.is_shipped
        {
            return None;
        }
        let verdicts = compilers::accepts(
            self.file.precision(),
            self.file.target,
            &page.path,
            &page.bytes,
        );
        let refusal = verdicts.iter().find(|(_, verdict)| verdict.is_err())?;
        Some(match refusal {
            (name, Err(Fault::Failed(words))) => Fault::Failed(format!("{name}: {words}")),
            (name, _) => Fault::Absent(format!(
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
    ) -> Result<ModelError, Fault> {
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
            crate::language::ir::Value::Rgb(each_channel(channel))
        });
        fault.into_inner().map_or(Ok(error), Err)
    }
}

/// The values of a method's inputs for the materials that library functions are run with.
fn input_values(plan: &VerifyPlan, method: &Method) -> Vec<Vec<(String, [f64; 3])>> {
    plan.trial_subjects(method)
        .map(|subject| {
            let values = values_for_material_in(Precision::F32, subject, method);
            values.into_iter().collect()
        })
        .collect()
}

impl FileTrial<'_> {
    /// The row of a function of an effect.
    fn effect_row(
        &self,
        plan: &VerifyPlan,
        part: EffectPart,
        accepts: &[(&'static str, Verdict)],
    ) -> VerifyRow {
        let trial = EffectTrial::new(self.emitted, part, &input_values(plan, self.emitted.method));
        let paths = ExecutionPath::all_for_effect(self.file.target).iter();
        let runs: Vec<(ExecutionPath, Result<PathRun, Fault>)> = paths
            .map(|path| (*path, self.run_effect(&trial, *path)))
            .collect();
        RanFunction {
            file: self.file,
            emitted: self.emitted,
            material: "",
            accepts,
            runs: &runs,
        }
        .verify_row()
    }

    fn run_effect(&self, trial: &EffectTrial, path: ExecutionPath) -> Result<PathRun, Fault> {
        let shown = self.shown_safely(path)?;
        let got = self.devices.run_effect(&shown, path, trial)?;
        let (outcome, allowed) = match &self.emitted.code {
            Measured::Yes(bound) => (trial.judge(&got), bound.value()),
            Measured::No(_) => trial.judge_without_promise(&got),
        };
        let device = self.devices.device_for(shown.target, path)?;
        Ok(PathRun {
            points: outcome.points,
            share: f64::NAN,
            result: RunResult::Effect(EffectRun { outcome, allowed }),
            model_error: None,
            device: device.adapter.to_string(),
        })
    }
}

/// How much further off than the emulation, which is promised, a device may be: 2⁻¹¹, the last place below 1. A device may fuse,
/// reorder, divide and take roots in two steps, and flush denormals to 0.
const FREEDOM: f64 = 1.0 / 2048.0;

/// Runs a function in half precision. One that promises nothing may be twice as far off as its emulation.
fn run_in_half(
    runnable: &Runnable,
    shown: &ShippedFunction,
    trial: &Trial,
) -> Result<PathRun, Fault> {
    let emitted = shown.function;
    let meaning = emitted.meaning();
    let meaning = meaning.map_err(|fault| Fault::Failed(fault.to_string()))?;
    let half = HalfTrial {
        function: &emitted.function,
        meaning: &meaning,
        values: &trial.values,
        table: trial.table.as_ref(),
    };
    let mut cosines = halves();
    match emitted.method.contract {
        Contract::Kept => cosines.extend(halves_beyond()),
        // Nothing is promised at grazing angles, where most give NaN.
        Contract::Exempt(_) => cosines.retain(|c| *c > 0.1),
    }
    let got = runnable.run(trial, &cosines)?;
    let (want, emulated) = (half.want(&cosines), half.emulated(&cosines));
    let mut result = HalfRun {
        error: HalfError::NONE,
        emulation: HalfError::NONE,
        allowed: match trial.bound {
            Measured::Yes(most) => most + FREEDOM,
            Measured::No(_) => 2.0 * half.error(&halves_of(&cosines)).max_abs,
        },
    };
    let [least, most] = result_range(&cosines, &want);
    for (point, (cos_theta, got)) in cosines.iter().zip(&got).enumerate() {
        for channel in 0..3 {
            let got = f64::from(got[channel]);
            if cos_theta.is_nan() {
                // Any reflectance is right. NaN counts as an infinite error.
                let nearest = got.clamp(least, most);
                result.error.include(got, nearest, *cos_theta);
                continue;
            }
            result
                .error
                .include(got, want.at(point)[channel], *cos_theta);
            let rounded = emulated.at(point)[channel].to_f64();
            result.emulation.include(got, rounded, *cos_theta);
        }
    }
    Ok(PathRun {
        points: cosines.len(),
        share: 1.0,
        result: RunResult::Half(result),
        model_error: emitted.model_error,
        device: runnable.device.clone(),
    })
}

/// The cosines within [0, 1]. Beyond them the emulation has no error of its own, and for NaN none is defined.
fn halves_of(cosines: &[f32]) -> Vec<f32> {
    let inside = |c: &&f32| (0.0..=1.0).contains(*c);
    cosines.iter().filter(inside).copied().collect()
}
