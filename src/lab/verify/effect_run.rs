//! A function of an effect as it runs, against what it means.

use crate::generator::emit::EffectPart;
use crate::generator::fit::{Measured, values_for_material_in};
use crate::language::methods::Method;
use crate::physics::num::Precision;

use super::Outcome;
use super::compilers::Verdict;
use super::effect_trial::EffectTrial;
use super::file::FileTrial;
use super::judge::{EffectRun, PathRun, RanFunction};
use super::plan::VerifyPlan;
use super::row::VerifyRow;
use super::run::{ExecutionPath, RunFault};

/// The values of a method's inputs for the materials that library functions are run with.
fn input_values(plan: &VerifyPlan, method: &Method) -> Vec<Vec<(String, [f64; 3])>> {
    let subjects = plan.trial_subjects().iter();
    let described = subjects.filter(|subject| subject.is_described_by(method));
    described
        .map(|subject| {
            let values = values_for_material_in(Precision::F32, subject, method);
            values.into_iter().collect()
        })
        .collect()
}

impl FileTrial<'_> {
    /// The row of a function of an effect.
    pub(super) fn effect_row(
        &self,
        plan: &VerifyPlan,
        part: EffectPart,
        accepts: &[(&'static str, Verdict)],
    ) -> VerifyRow {
        let trial = EffectTrial::new(self.emitted, part, &input_values(plan, self.emitted.method));
        let paths = ExecutionPath::all_for_effect(self.file.target).iter();
        let runs: Vec<(ExecutionPath, Result<PathRun, RunFault>)> = paths
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

    fn run_effect(&self, trial: &EffectTrial, path: ExecutionPath) -> Result<PathRun, RunFault> {
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
            bound: None,
            outcome: Outcome::NONE,
            half: None,
            effect: Some(EffectRun { outcome, allowed }),
            model_error: None,
            device: device.adapter.to_string(),
        })
    }
}
