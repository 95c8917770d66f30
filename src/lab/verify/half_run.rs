//! A function in half precision as it runs: at every f16 from 0 to 1 and every exponent beyond, against f64 and against f16
//! rounded after every operation.

use crate::generator::fit::Measured;
use crate::lab::verify::run::{RunFault, Runnable, ShippedFunction};
use crate::lab::verify::{
    HalfError, HalfTrial, Outcome, Trial, halves, halves_beyond, result_range,
};
use crate::language::methods::Contract;
use crate::physics::num::Num;

use super::judge::{HalfRun, PathRun};

/// What a device may be further off than the emulation, which is what is promised: 2⁻¹¹, the last place below 1. A
/// device may fuse, reorder, divide and take roots in two steps, and take numbers below the smallest normal one for 0.
const FREEDOM: f64 = 1.0 / 2048.0;

/// Runs it. A function that promises nothing may be twice as far off as its emulation.
pub(super) fn run_in_half(
    runnable: &Runnable,
    shown: &ShippedFunction,
    trial: &Trial,
) -> Result<PathRun, RunFault> {
    let emitted = shown.function;
    let meaning = emitted.meaning();
    let meaning = meaning.map_err(|fault| RunFault::Failed(fault.to_string()))?;
    let half = HalfTrial {
        function: &emitted.function,
        meaning: &meaning,
        values: &trial.values,
        table: trial.table.as_ref(),
    };
    let mut cosines = halves();
    match emitted.method.contract {
        Contract::Kept => cosines.extend(halves_beyond()),
        // Nothing is promised at grazing, where most have no number.
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
                // Any reflectance is right. What is NaN counts as an infinite error.
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
        bound: None,
        outcome: Outcome::NONE,
        effect: None,
        half: Some(result),
        model_error: emitted.model_error,
        device: String::new(),
    })
}

/// Those within [0, 1]: beyond them the emulation has no error of its own, and NaN has none at all.
fn halves_of(cosines: &[f32]) -> Vec<f32> {
    let inside = |c: &&f32| (0.0..=1.0).contains(*c);
    cosines.iter().filter(inside).copied().collect()
}
