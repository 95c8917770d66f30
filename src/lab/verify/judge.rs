//! The result of running a function, and its verdict: both errors, which are never added, and which compilers accept its file.

use super::compilers::Verdict;
use super::effect_trial::EffectOutcome;
use super::requested::PlannedFile;
use super::row::{
    AllowedError, Answer, CodeErrorFigures, Emulation, ModelErrorFigures, SecondOpinion, Status,
    VerifyRow, finite,
};
use super::run::ExecutionPath;
use super::shipped::ShippedPage;
use super::{HalfError, Miss, Outcome};
use crate::generator::emit::{CodeBound, EmittedFunction, fingerprint};
use crate::generator::fit::{Measured, ModelError};
use crate::lab::fault::Fault;
use crate::physics::num::Precision;

/// The result of running a function by one execution path.
#[derive(Clone, Debug)]
pub struct PathRun {
    /// The number of cosines.
    pub points: usize,
    /// Their share of all numbers from 0 to 1.
    pub share: f64,
    /// The result.
    pub result: RunResult,
    /// The error against the reference, where there is one.
    pub model_error: Option<ModelError>,
    /// The device that it ran on.
    pub device: String,
}

/// The result of running a function, by what it is judged by.
#[derive(Clone, Debug)]
pub enum RunResult {
    /// In f32.
    Single {
        /// The device against f64.
        outcome: Outcome,
        /// The allowed difference, in ulp. None where nothing is promised.
        bound: Option<f64>,
    },
    /// In half precision.
    Half(HalfRun),
    /// Of an effect's function.
    Effect(EffectRun),
}

/// The result of running an effect's function.
#[derive(Clone, Debug)]
pub struct EffectRun {
    /// The device against f64.
    pub outcome: EffectOutcome,
    /// The allowed error.
    pub allowed: f64,
}

/// The result of running a function in half precision.
#[derive(Clone, Copy, Debug)]
pub struct HalfRun {
    /// The device against f64.
    pub error: HalfError,
    /// The device against f16 rounded after every operation.
    pub emulation: HalfError,
    /// The allowed difference from f64. Without a promise it is twice the error of the emulation.
    pub allowed: f64,
}

impl HalfRun {
    /// The precision in which the device computes. A result nearer to f64 than f16 can be was computed in f32. If no result
    /// was rounded, the precision is not known.
    fn computes_in(&self) -> Option<Precision> {
        const NEARER: f64 = 1e-5;
        let rounds = self.error.max_abs.max(self.emulation.max_abs) > 0.0;
        rounds.then_some(if self.error.max_abs < NEARER {
            Precision::F32
        } else {
            Precision::F16
        })
    }

    fn emulation(&self) -> Emulation {
        Emulation {
            max_abs: finite(self.emulation.max_abs),
            worst_cos: finite(self.emulation.worst_cos),
            device_computes_in: self
                .computes_in()
                .map(|precision| precision.name().to_owned()),
        }
    }
}

/// A function of a file, run.
pub struct RanFunction<'a> {
    /// The file.
    pub file: &'a PlannedFile,
    /// The function.
    pub emitted: &'a EmittedFunction,
    /// The material, as a user types it.
    pub material: &'a str,
    /// What compilers say of the file.
    pub accepts: &'a [(&'static str, Verdict)],
    /// The run by each execution path, its own first.
    pub runs: &'a [(ExecutionPath, Result<PathRun, Fault>)],
}

impl RanFunction<'_> {
    /// The row.
    pub fn verify_row(&self) -> VerifyRow {
        let mut opinions = self.runs.iter().map(|(path, run)| self.judged(*path, run));
        let mut row = row_without_run(self.file, self.emitted);
        row.material = Some(self.material.to_owned()).filter(|name| !name.is_empty());
        let own = opinions.next().expect("a function is run by its own path");
        row.device = own.device;
        row.points = own.points;
        row.share = own.share;
        row.bound = own.bound;
        row.code_error = own.code_error;
        row.model_error = own.model_error;
        row.emulation = own.emulation;
        row.second_opinions = opinions.collect();
        let (mut status, mut reasons) = (own.status, Vec::from_iter(own.reason));
        for opinion in &row.second_opinions {
            if opinion.status == Status::Fail {
                status = Status::Fail;
                reasons.extend(opinion.reason.clone());
            }
        }
        let refusals = self
            .accepts
            .iter()
            .filter_map(|(_, verdict)| match verdict {
                Err(Fault::Failed(words)) => Some(words),
                Ok(()) | Err(Fault::Absent(_)) => None,
            });
        let findings = self.file.pages.iter().flat_map(|page| &page.findings);
        let faults: Vec<&String> = refusals.chain(findings).collect();
        if !faults.is_empty() {
            status = Status::Fail;
            reasons.extend(faults.into_iter().cloned());
        }
        row.accepts = Some(answers(self.accepts));
        row.not_asked = not_asked(self.accepts);
        row.status = status;
        row.reason = (!reasons.is_empty()).then(|| reasons.join("\n"));
        row
    }

    /// The verdict on a run by an execution path.
    fn judged(&self, path: ExecutionPath, run: &Result<PathRun, Fault>) -> SecondOpinion {
        let without_figures = |status, reason| SecondOpinion {
            execution_path: path.name().to_owned(),
            device: None,
            points: None,
            share: None,
            bound: None,
            code_error: None,
            emulation: None,
            model_error: None,
            status,
            reason,
        };
        let run = match run {
            Err(Fault::Absent(why)) => {
                return without_figures(Status::NotChecked, Some(why.clone()));
            }
            Err(Fault::Failed(why)) => {
                let why = format!("{}: {}: {why}", self.page().path, self.emitted.name);
                return without_figures(Status::Fail, Some(why));
            }
            Ok(run) => run,
        };
        let (fault, emulation) = match &run.result {
            RunResult::Single { outcome, .. } => {
                (outcome.miss.map(|miss| self.missed(path, &miss)), None)
            }
            RunResult::Half(half) => (self.fault_in_half(half), Some(half.emulation())),
            RunResult::Effect(effect) => (self.fault_of_effect(path, effect), None),
        };
        let status = match fault {
            None => Status::Pass,
            Some(_) => Status::Fail,
        };
        let (bound, code_error) = self.errors(&run.result);
        SecondOpinion {
            device: Some(run.device.clone()),
            points: Some(run.points),
            share: finite(run.share),
            bound: Some(bound),
            code_error: Some(code_error),
            emulation,
            model_error: run.model_error.as_ref().map(ModelErrorFigures::from),
            ..without_figures(status, fault)
        }
    }

    /// The allowed and the measured difference.
    fn errors(&self, result: &RunResult) -> (AllowedError, CodeErrorFigures) {
        let text = bound_text(self.emitted);
        let absolute = |max_abs: f64, text| AllowedError::Absolute {
            max_abs: finite(max_abs),
            text,
        };
        match result {
            RunResult::Effect(effect) => (absolute(effect.allowed, text), (&effect.outcome).into()),
            RunResult::Half(half) => (absolute(half.allowed, text), (&half.error).into()),
            RunResult::Single { outcome, bound } => {
                let allowed = match (bound, &self.emitted.code) {
                    (Some(_), Measured::Yes(CodeBound::Absolute(most)))
                        if self.emitted.form.coefficient().is_some() =>
                    {
                        absolute(*most, text)
                    }
                    _ => AllowedError::Ulp {
                        ulp: bound.and_then(finite),
                        text,
                    },
                };
                (allowed, (&outcome.error).into())
            }
        }
    }

    fn page(&self) -> &ShippedPage {
        self.file.run_page()
    }

    /// The fault of a result in half precision.
    fn fault_in_half(&self, half: &HalfRun) -> Option<String> {
        // A device that gives NaN has an error that is infinite or NaN.
        let is_right = half.error.max_abs <= half.allowed;
        (!is_right).then(|| {
            format!(
                "{}: {}, {}: at cos_theta = {} it is {} off, and {} is allowed",
                self.page().path,
                self.emitted.name,
                self.material,
                half.error.worst_cos,
                half.error.max_abs,
                half.allowed
            )
        })
    }

    /// The fault of an effect's function.
    fn fault_of_effect(&self, path: ExecutionPath, effect: &EffectRun) -> Option<String> {
        let EffectRun { outcome, allowed } = effect;
        let is_right = outcome.max_abs <= *allowed;
        let path = by_path(path);
        (!is_right).then(|| {
            format!(
                "{}: {}{path}: {}: {:e} off, and {allowed:e} is allowed",
                self.page().path,
                self.emitted.name,
                outcome.worst,
                outcome.max_abs,
            )
        })
    }

    /// A miss in a form that people and editors read.
    fn missed(&self, path: ExecutionPath, miss: &Miss) -> String {
        let channel = ["red", "green", "blue"][miss.channel];
        let path = by_path(path);
        let edited = if self.page().is_current {
            ""
        } else {
            " The file is not what would be written today."
        };
        let expected = if miss.cos_theta.is_nan() {
            "expected any reflectance, since the cosine is NaN".to_owned()
        } else {
            format!("expected {:?}: {:.1} ulp off", miss.expected, miss.ulp)
        };
        format!(
            "{}: {}, {}{path}: at cos_theta = {:?} (0x{:08x}) {channel} is {:?} (0x{:08x}), {expected}.{edited}",
            self.page().path,
            self.emitted.name,
            self.material,
            miss.cos_theta,
            miss.cos_theta.to_bits(),
            miss.got,
            miss.got.to_bits(),
        )
    }
}

fn by_path(path: ExecutionPath) -> String {
    match path {
        ExecutionPath::Own => String::new(),
        path => format!(", by {}", path.name()),
    }
}

/// What a function promises, in words.
fn bound_text(emitted: &EmittedFunction) -> String {
    match &emitted.code {
        Measured::Yes(CodeBound::Ulp(ulp)) => {
            format!("{ulp} ulp or 2^-22; powers as Vulkan allows exp2 and log2")
        }
        Measured::Yes(CodeBound::Absolute(most)) if emitted.effect.is_some() => {
            format!(
                "{most:e} beyond what the last bits of the arguments and a sampler's weights turn"
            )
        }
        Measured::Yes(CodeBound::Absolute(most)) if emitted.form.coefficient().is_some() => {
            format!("{most:e} absolute: the terms of a coefficient cancel")
        }
        Measured::Yes(CodeBound::Absolute(most)) => {
            format!("{most} absolute, and 2^-11 for what a device is free to do")
        }
        Measured::No(why) => why.clone(),
    }
}

fn answers(verdicts: &[(&'static str, Verdict)]) -> Vec<(String, Answer)> {
    let answer = |(name, verdict): &(&'static str, Verdict)| ((*name).to_owned(), verdict.into());
    verdicts.iter().map(answer).collect()
}

/// Why compilers were not asked.
fn not_asked(verdicts: &[(&'static str, Verdict)]) -> Vec<(String, String)> {
    let reason = |(name, verdict): &(&'static str, Verdict)| match verdict {
        Err(Fault::Absent(why)) => Some(((*name).to_owned(), why.clone())),
        Ok(()) | Err(Fault::Failed(_)) => None,
    };
    verdicts.iter().filter_map(reason).collect()
}

/// What is known of a function before it is run.
fn row_without_run(file: &PlannedFile, emitted: &EmittedFunction) -> VerifyRow {
    let page = file.run_page();
    VerifyRow {
        target: file.target.name.to_owned(),
        effect: emitted.effect.map(|part| part.effect.name.to_owned()),
        method: emitted.method.name.to_owned(),
        material: None,
        variant: emitted.method.variant.to_owned(),
        form: emitted.form,
        precision: emitted.precision,
        function: emitted.name.clone(),
        file: page.path.clone(),
        fingerprint: fingerprint(&emitted.function),
        shipped: page.is_shipped,
        current: page.is_current,
        device: None,
        points: None,
        share: None,
        bound: None,
        code_error: None,
        model_error: None,
        accepts: None,
        not_asked: Vec::new(),
        second_opinions: Vec::new(),
        status: Status::Fail,
        reason: None,
        remark: file.pages.iter().find_map(|page| page.remark.clone()),
        emulation: None,
    }
}

/// The rows of a file whose run timed out or crashed.
pub fn unfinished(file: &PlannedFile, why: &str) -> Vec<VerifyRow> {
    let row = |emitted: &EmittedFunction| VerifyRow {
        reason: Some(format!("{}: {}: {why}", file.run_page().path, emitted.name)),
        ..row_without_run(file, emitted)
    };
    file.functions.iter().map(row).collect()
}
