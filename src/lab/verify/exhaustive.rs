//! Every f32 there is, all 2³² bit patterns, for functions specialised to materials, in WGSL: not a sample.

use crate::generator::emit::Emitted;
use crate::generator::fit::Measured;
use crate::generator::reference::MaterialInMedium;
use crate::lab::verify::run::{Devices, ExecutionPath, RunFault, ShippedFunction};
use crate::lab::verify::{Trial, WITHIN, count, sweep};
use crate::language::targets::Stack;
use super::row::Error;
use super::judge::{PathRun, RanFunction};
use super::requested::{PlannedFile, VerifyPlan};
use super::shard::{PlannedRows, Shard, ShardOutcome};
use super::machine::{self, MachineStatement};
use super::trial_case::specialised;

/// Hears how much is done, of how much, of what.
type Progress<'a> = &'a mut dyn FnMut(u64, u64, &str);

/// The rows of a shard's functions at all numbers, and how many points a second each took.
///
/// # Errors
/// Nothing of the plan can be swept.
pub fn exhaustive_rows(
    plan: &VerifyPlan,
    shard: Shard,
    devices: &Devices,
    progress: Progress,
) -> Result<(ShardOutcome, Vec<String>), Error> {
    let all = swept(plan);
    if all.is_empty() {
        return Err(Error::NothingExhaustive);
    }
    let mut speeds = Vec::new();
    let planned = all.iter().map(|(file, subject, emitted)| {
        let row = (emitted.name.as_str(), Some(subject.argument.as_str()));
        PlannedRows::new(file, &[row])
    });
    let mut outcome = ShardOutcome {
        plan: planned.collect(),
        ..ShardOutcome::default()
    };
    let dealt = all.into_iter().enumerate();
    for (place, (file, subject, emitted)) in dealt.filter(|(place, _)| shard.takes(*place)) {
        let (run, speed) = run(file, subject, emitted, devices, progress);
        let runs = [(ExecutionPath::Own, run)];
        let ran = RanFunction {
            file,
            emitted,
            material: &subject.argument,
            accepts: &[],
            runs: &runs,
        };
        outcome.add(place, file, vec![ran.verify_row()]);
        let own = &[ExecutionPath::Own];
        let machine = MachineStatement::of_devices(file.target, own, devices);
        outcome.machine.add(machine);
        speeds.push(format!(
            "{}: {speed:.1} million points a second",
            emitted.name
        ));
    }
    Ok((outcome, speeds))
}

/// A function that can be swept, with its file and its material.
type Swept<'a> = (&'a PlannedFile, &'a MaterialInMedium, &'a Emitted);

/// Every function of the plan that can be swept, in order.
fn swept(plan: &VerifyPlan) -> Vec<Swept<'_>> {
    let mut all = Vec::new();
    for file in &plan.files {
        let Some(subject) = file.subject.map(|index| &plan.subjects[index]) else {
            continue;
        };
        if matches!(file.target.stack, Stack::Wgpu(_)) {
            all.extend(
                file.functions
                    .iter()
                    .map(|emitted| (file, subject, emitted)),
            );
        }
    }
    all
}

/// A function at all numbers, and the millions of them a second.
fn run(
    file: &PlannedFile,
    subject: &MaterialInMedium,
    emitted: &Emitted,
    devices: &Devices,
    progress: Progress,
) -> (Result<PathRun, RunFault>, f64) {
    let trial: Trial = specialised(subject, emitted).trial;
    if trial.table.is_some() {
        let why = "a texture is filtered in steps: a sample tells all";
        return (Err(RunFault::Absent(why.to_owned())), 0.0);
    }
    let shown = ShippedFunction {
        target: file.target,
        bytes: &file.run_page().bytes,
        function: emitted,
        entry: "",
    };
    let all = count(&trial);
    let told = &mut |done: u64| progress(done / 1024, all / 1024, &emitted.name);
    let (swept, time) = machine::timed(|| sweep(devices, &shown, &trial, told));
    let run = swept.and_then(|outcome| {
        Ok(PathRun {
            points: all as usize,
            share: (all as f64 / WITHIN as f64).min(1.0),
            bound: match trial.bound {
                Measured::Yes(ulp) => Some(ulp),
                Measured::No(_) => None,
            },
            outcome,
            half: None,
            effect: None,
            model_error: emitted.model_error,
            device: devices
                .device_for(file.target, ExecutionPath::Own)?
                .adapter
                .to_string(),
        })
    });
    (run, all as f64 / time.as_secs_f64() / 1e6)
}
