//! An exhaustive sweep: functions specialised to materials, in WGSL, run at all 2³² bit patterns of f32 and compared with f64.
//! Beyond [0, 1] a function is constant, so one evaluation in f64 serves all equal results there.
//!
//! The device generates its own cosines. Results are read back block by block, so that memory stays small. A block is cut into
//! pieces that fit a processor's cache. The graph is evaluated in f64 over the columns of a piece, and only pieces with a
//! difference that counts are compared point by point.

use std::sync::Mutex;

use super::cases::specialised;
use super::error::Error;
use super::harness;
use super::judge::{PathRun, RanFunction, RunResult};
use super::machine::{self, MachineStatement};
use super::points::{WITHIN, cosines};
use super::requested::{PlannedFile, VerifyPlan};
use super::run::{Devices, ShippedFunction};
use super::shard::{PlannedRows, Shard, ShardOutcome};
use super::trial::{CodeError, Outcome, TEXTBOOK_FROM, Trial, result_range};
use crate::generator::emit::EmittedFunction;
use crate::generator::fit::Measured;
use crate::generator::reference::MaterialInMedium;
use crate::lab::fault::Fault;
use crate::lab::gpu::{Program, ShaderCode};
use crate::lab::verify::run::ExecutionPath;
use crate::language::ir::Value;
use crate::language::targets::Stack;

/// How many bit patterns there are.
const ALL: u64 = 1 << 32;
/// Points evaluated at once: columns of f64 that a cache holds.
const PIECE: usize = 512;

/// Runs a function of a WGSL file at all numbers. `progress` is told how many are done.
///
/// # Errors
/// There is no device, or it fails, or the text is refused.
fn sweep(
    devices: &Devices,
    shown: &ShippedFunction,
    trial: &Trial,
    progress: &mut dyn FnMut(u64),
) -> Result<Outcome, Fault> {
    let text = std::str::from_utf8(shown.bytes).map_err(|why| Fault::Failed(why.to_string()))?;
    let call = harness::Call::to_emitted(shown.function);
    let stream = devices.compute()?.prepare_stream(&Program {
        code: ShaderCode::Wgsl(&harness::stream(text, &call)),
        entry: harness::ENTRY,
        uniforms: &[],
        texture: None,
    })?;
    let bound = match trial.bound {
        Measured::Yes(ulp) => ulp,
        Measured::No(_) => f64::INFINITY,
    };
    let first = if trial.is_guarded {
        0
    } else {
        TEXTBOOK_FROM.to_bits()
    };
    let judge = Judge::new(trial, bound);
    let mut outcome = Outcome::NONE;
    let mut done = 0;
    stream.run(first, count(trial), &[], None, |first, results| {
        outcome = outcome.worst(block(&judge, first, results));
        done += results.len() as u64;
        progress(done);
    })?;
    Ok(outcome)
}

/// How many numbers a trial is swept over: a textbook form promises nothing next to 0 and beyond 1.
fn count(trial: &Trial) -> u64 {
    if trial.is_guarded {
        ALL
    } else {
        WITHIN - u64::from(TEXTBOOK_FROM.to_bits())
    }
}

/// What results are compared with.
struct Judge<'a> {
    trial: &'a Trial,
    /// In ulp.
    bound: f64,
    /// The smallest and the largest result: what a cosine that is NaN may give.
    range: [f64; 2],
}

/// Points at which a function's range is estimated.
const RANGE_POINTS: usize = 1000;

impl Judge<'_> {
    fn new(trial: &Trial, bound: f64) -> Judge<'_> {
        let cosines = cosines(RANGE_POINTS);
        let range = result_range(&cosines, &trial.run::<f64>(&cosines));
        Judge {
            trial,
            bound,
            range,
        }
    }

    fn judge(&self, cosines: &[f32], want: Value<f64>, got: &[[f32; 3]]) -> Outcome {
        let mut expected = self.trial.expected_of(cosines.to_vec(), want);
        expected.bound = self.bound;
        expected.range = self.range;
        expected.judge(got)
    }
}

/// A block, shared among the processor's cores.
fn block(judge: &Judge, first: u32, results: &[[f32; 4]]) -> Outcome {
    let share = results
        .len()
        .div_ceil(machine::cores())
        .next_multiple_of(PIECE);
    let worst = Mutex::new(Outcome::NONE);
    std::thread::scope(|scope| {
        for (i, part) in results.chunks(share).enumerate() {
            let (worst, first) = (&worst, first + (i * share) as u32);
            scope.spawn(move || {
                let outcome = part_of(judge, first, part);
                if let Ok(mut worst) = worst.lock() {
                    *worst = worst.worst(outcome);
                }
            });
        }
    });
    worst.into_inner().unwrap_or(Outcome::NONE)
}

/// Consecutive numbers: those from 0 to 1 piece by piece, the others by runs of equal results.
fn part_of(judge: &Judge, first: u32, results: &[[f32; 4]]) -> Outcome {
    let within = (WITHIN.saturating_sub(u64::from(first)) as usize).min(results.len());
    let (within, beyond) = results.split_at(within);
    let mut outcome = self::beyond(judge, first.wrapping_add(within.len() as u32), beyond);
    for (i, piece) in within.chunks(PIECE).enumerate() {
        let first = first + (i * PIECE) as u32;
        let bits = 0..piece.len() as u32;
        let cosines: Vec<f32> = bits.map(|i| f32::from_bits(first + i)).collect();
        outcome = outcome.worst(one(judge, &cosines, piece));
    }
    outcome
}

/// Numbers beyond [0, 1]: one is judged for each run of equal results on one side.
fn beyond(judge: &Judge, first: u32, results: &[[f32; 4]]) -> Outcome {
    if results.is_empty() {
        return Outcome::NONE;
    }
    let side = |cos_theta: f32| (cos_theta.is_nan(), cos_theta < 0.0);
    let bits = |result: &[f32; 4]| result.map(f32::to_bits);
    let (mut cosines, mut got, mut last) = (Vec::new(), Vec::new(), None);
    for (i, result) in results.iter().enumerate() {
        let cos_theta = f32::from_bits(first + i as u32);
        let this = Some((side(cos_theta), bits(result)));
        if this != last {
            cosines.push(cos_theta);
            got.push([result[0], result[1], result[2]]);
            last = this;
        }
    }
    let want = judge.trial.run::<f64>(&cosines);
    judge.judge(&cosines, want, &got)
}

fn one(judge: &Judge, cosines: &[f32], results: &[[f32; 4]]) -> Outcome {
    let want = judge.trial.run::<f64>(cosines);
    let mut largest = 0.0f64;
    for channel in 0..3 {
        let column = want.channel(channel);
        let mut total = 0.0;
        for (i, result) in results.iter().enumerate() {
            let difference = (f64::from(result[channel]) - column.at(i)).abs();
            largest = largest.max(difference);
            // `max` ignores a NaN, a sum does not.
            total += difference;
        }
        if !total.is_finite() {
            largest = f64::INFINITY;
        }
    }
    if largest <= judge.trial.floor {
        return Outcome {
            error: CodeError {
                max_abs: largest,
                ..CodeError::NONE
            },
            miss: None,
        };
    }
    let got: Vec<[f32; 3]> = results.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    judge.judge(cosines, want, &got)
}

/// Called with how much is done, of how much, and for which function.
type Progress<'a> = &'a mut dyn FnMut(u64, u64, &str);

/// The rows of a shard's functions at all numbers, and the points per second of each.
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
type Swept<'a> = (&'a PlannedFile, &'a MaterialInMedium, &'a EmittedFunction);

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

/// The run of a function at all numbers, and its speed in millions of numbers a second.
fn run(
    file: &PlannedFile,
    subject: &MaterialInMedium,
    emitted: &EmittedFunction,
    devices: &Devices,
    progress: Progress,
) -> (Result<PathRun, Fault>, f64) {
    let trial: Trial = specialised(subject, emitted).trial;
    if trial.table.is_some() {
        let why = "a texture is filtered in steps: a sample tells all";
        return (Err(Fault::Absent(why.to_owned())), 0.0);
    }
    let shown = ShippedFunction {
        target: file.target,
        bytes: &file.run_page().bytes,
        function: emitted,
        entry: "",
    };
    let all = count(&trial);
    let report = &mut |done: u64| progress(done / 1024, all / 1024, &emitted.name);
    let (swept, time) = machine::timed(|| sweep(devices, &shown, &trial, report));
    let run = swept.and_then(|outcome| {
        Ok(PathRun {
            points: all as usize,
            share: (all as f64 / WITHIN as f64).min(1.0),
            result: RunResult::Single {
                outcome,
                bound: match trial.bound {
                    Measured::Yes(ulp) => Some(ulp),
                    Measured::No(_) => None,
                },
            },
            model_error: emitted.model_error,
            device: devices
                .device_for(file.target, ExecutionPath::Own)?
                .adapter
                .to_string(),
        })
    });
    (run, all as f64 / time.as_secs_f64() / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::verify::trial::ABSOLUTE_FLOOR;
    use crate::language::methods;

    fn trial() -> Trial {
        let method = methods::find("schlick").unwrap();
        Trial {
            function: method.function(false).unwrap(),
            values: vec![[0.04, 0.5, 1.0]],
            table: None,
            bound: Measured::Yes(method.claims.code_ulp),
            floor: ABSOLUTE_FLOOR,
            is_guarded: true,
        }
    }

    /// The outcome of numbers from these bits on, with one result changed.
    fn changed(first: u32, at: usize, result: [f32; 4]) -> Outcome {
        let trial = trial();
        let bits: Vec<f32> = (0..2000).map(|i| f32::from_bits(first + i)).collect();
        let got = trial.run::<f32>(&bits);
        let mut results: Vec<[f32; 4]> = (0..bits.len())
            .map(|i| {
                let [r, g, b] = if bits[i].is_nan() {
                    [0.5; 3]
                } else {
                    got.at(i)
                };
                [r, g, b, 1.0]
            })
            .collect();
        results[at] = result;
        block(&Judge::new(&trial, 6.0), first, &results)
    }

    #[test]
    fn all_numbers_are_swept() {
        assert_eq!(count(&trial()), 1 << 32);
        let textbook = Trial {
            is_guarded: false,
            ..trial()
        };
        assert!(count(&textbook) < WITHIN);
    }

    #[test]
    fn one_wrong_result_is_found_wherever_it_stands() {
        // About 1, 2, infinity, the smallest negative number, negative infinity, and the last numbers there are.
        for first in [
            1f32.to_bits() - 1000,
            0x4000_0000,
            0x7F7F_FC18,
            0x8000_0000,
            0xFF7F_FC18,
            u32::MAX - 1999,
        ] {
            let right = [0.3, 0.5, 1.0, 1.0];
            assert!(
                changed(first, 1500, [0.3, 0.5, f32::NAN, 1.0])
                    .miss
                    .is_some(),
                "{first:x}"
            );
            let wrong = changed(first, 999, right).miss;
            let is_nan = f32::from_bits(first + 999).is_nan();
            assert_eq!(
                wrong.is_none(),
                is_nan,
                "{first:x}: any reflectance is right for NaN only"
            );
        }
    }

    #[test]
    fn what_is_right_passes() {
        let last = (1.0 - 0.04f32).mul_add(0.0, 0.04);
        for first in [0x4000_0000, 0x7F7F_FC18] {
            assert_eq!(changed(first, 0, [last, 0.5, 1.0, 1.0]).miss, None);
        }
    }
}
