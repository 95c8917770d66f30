//! A sweep: every f32 from 0 to 1 through WGSL as it runs, each held against f64. Nothing is a sample.
//!
//! The device makes its own cosines and is read where it writes, block by block, so that memory stays small. A block is
//! cut into pieces that fit a processor's cache; of each piece the graph is evaluated in f64 over whole columns, and
//! only pieces with a difference that counts are looked at point by point.

use std::sync::Mutex;

use super::code_error::{ABSOLUTE_FLOOR, CodeError};
use super::harness;
use super::points::ALL;
use super::run::{Devices, Fault, Shown};
use super::trial::{Outcome, TEXTBOOK_FROM, Trial};
use crate::fit::Measured;
use crate::gpu::{Code, Program};

/// Points evaluated at once: columns of f64 that a cache holds.
const PIECE: usize = 512;

/// Runs a function of a WGSL file at all numbers. `progress` hears how many are done.
///
/// # Errors
/// There is no device, or it fails, or the text is refused.
pub fn sweep(
    devices: &Devices,
    shown: &Shown,
    trial: &Trial,
    progress: &mut dyn FnMut(u64),
) -> Result<Outcome, Fault> {
    let text = std::str::from_utf8(shown.bytes).map_err(|why| Fault::Failed(why.to_string()))?;
    let call = harness::Call::of(shown.function);
    let stream = devices.compute()?.prepare_stream(&Program {
        code: Code::Wgsl(&harness::wgsl_stream(text, &call)),
        entry: harness::ENTRY,
        uniforms: &[],
        textured: false,
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
    let mut outcome = Outcome::NONE;
    let mut done = 0;
    stream.run(first, count(trial), &[], None, |first, results| {
        outcome = outcome.worst(block(trial, bound, first, results));
        done += results.len() as u64;
        progress(done);
    })?;
    Ok(outcome)
}

/// How many numbers a trial is swept over: a textbook form promises nothing next to 0.
pub fn count(trial: &Trial) -> u64 {
    let first = if trial.is_guarded {
        0
    } else {
        TEXTBOOK_FROM.to_bits()
    };
    ALL - u64::from(first)
}

/// A block, shared among the processor's cores.
fn block(trial: &Trial, bound: f64, first: u32, results: &[[f32; 4]]) -> Outcome {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let share = results.len().div_ceil(cores).next_multiple_of(PIECE);
    let worst = Mutex::new(Outcome::NONE);
    std::thread::scope(|scope| {
        for (i, part) in results.chunks(share).enumerate() {
            let (worst, first) = (&worst, first + (i * share) as u32);
            scope.spawn(move || {
                let outcome = pieces(trial, bound, first, part);
                if let Ok(mut worst) = worst.lock() {
                    *worst = worst.worst(outcome);
                }
            });
        }
    });
    worst.into_inner().unwrap_or(Outcome::NONE)
}

fn pieces(trial: &Trial, bound: f64, first: u32, results: &[[f32; 4]]) -> Outcome {
    let mut outcome = Outcome::NONE;
    for (i, piece) in results.chunks(PIECE).enumerate() {
        let first = first + (i * PIECE) as u32;
        let bits = (first..).take(piece.len());
        let cosines: Vec<f32> = bits.map(f32::from_bits).collect();
        outcome = outcome.worst(one(trial, bound, &cosines, piece));
    }
    outcome
}

fn one(trial: &Trial, bound: f64, cosines: &[f32], results: &[[f32; 4]]) -> Outcome {
    let want = trial.run::<f64>(cosines);
    let mut largest = 0.0f64;
    for channel in 0..3 {
        let column = want.channel(channel);
        let mut total = 0.0;
        for (i, result) in results.iter().enumerate() {
            let difference = (f64::from(result[channel]) - column.at(i)).abs();
            largest = largest.max(difference);
            // `max` passes over a NaN, a sum does not.
            total += difference;
        }
        if !total.is_finite() {
            largest = f64::INFINITY;
        }
    }
    if largest <= ABSOLUTE_FLOOR {
        return Outcome {
            error: CodeError {
                max_abs: largest,
                ..CodeError::NONE
            },
            miss: None,
        };
    }
    let got: Vec<[f32; 3]> = results.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    let mut expected = trial.expected_of(cosines.to_vec(), want);
    expected.bound = bound;
    expected.judge(&got)
}
