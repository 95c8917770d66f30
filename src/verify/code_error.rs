//! Code error: a function in unfused f32 against itself in f64, at the very same f32 inputs. Never to be added to
//! model error.

use serde::{Deserialize, Serialize};

use crate::fit::{Derivation, media, values};
use crate::ir::{Checked, Ty, Value, evaluate};
use crate::materials::Channels;
use crate::methods::{Class, Contract, Input, Method};
use crate::num::ulp_distance;

use super::points::cosines;

/// How far the code is from what it means.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CodeError {
    /// Largest distance in units of the last place; what lies within [`ABSOLUTE_FLOOR`] does not count.
    pub max_ulp: f64,
    /// Largest absolute difference.
    pub max_abs: f64,
    /// The cosine at which the largest distance in ulp stands.
    pub worst_cos: f64,
}

/// 2⁻²²: near a zero (Brewster's angle, the corrected method) ulp have no bound, and only this makes sense.
pub const ABSOLUTE_FLOOR: f64 = 1.0 / 4_194_304.0;

/// Steps of n and of k over which a library function is tried.
const STEPS: usize = 72;

impl CodeError {
    const NONE: CodeError = CodeError {
        max_ulp: 0.0,
        max_abs: 0.0,
        worst_cos: 0.0,
    };

    fn include(&mut self, got: f32, want: f64, cos_theta: f32) {
        let difference = (f64::from(got) - want).abs();
        self.max_abs = self.max_abs.max(difference);
        let ulp = ulp_distance(got, want);
        let counts = difference.is_nan() || difference > ABSOLUTE_FLOOR;
        if counts && ulp > self.max_ulp {
            (self.max_ulp, self.worst_cos) = (ulp, f64::from(cos_theta));
        }
    }

    fn worst(self, other: CodeError) -> CodeError {
        let max_abs = self.max_abs.max(other.max_abs);
        let worse = if other.max_ulp > self.max_ulp {
            other
        } else {
            self
        };
        CodeError { max_abs, ..worse }
    }
}

/// The code error of a function of `cos_theta` alone, at about `points` cosines.
pub fn code_error(function: &Checked, points: usize) -> CodeError {
    compare(function, &cosines(points), &[])
}

/// The code error of a method's library function over the media that its claim names, each with its inputs rounded to
/// f32, at about `points` cosines.
pub fn library_code_error(method: &Method, points: usize) -> CodeError {
    let function = method
        .function(false)
        .expect("every method's function is well formed; a test builds all");
    let cosines: Vec<f32> = cosines(points)
        .into_iter()
        .filter(|c| in_domain(method, *c))
        .collect();
    let glass = method.class == Class::Dielectric;
    // Below 1 and without absorption there is a critical angle, where the law itself is ill-conditioned.
    let fits = |channels: &Channels| !glass || channels.n.iter().all(|n| *n >= 1.0);
    let media = media(method.claims.code_over, STEPS)
        .into_iter()
        .filter(fits);
    media.fold(CodeError::NONE, |worst, channels| {
        let channels = if glass {
            Channels {
                k: [0.0; 3],
                ..channels
            }
        } else {
            channels
        };
        let constants = values(method, &channels, &Derivation::default());
        let single = |input: &Input| constants[input.name].map(|value| value as f32);
        let arguments: Vec<[f32; 3]> = method.inputs.iter().map(single).collect();
        worst.worst(compare(&function, &cosines, &arguments))
    })
}

/// A textbook method promises nothing at exactly 90 degrees.
fn in_domain(method: &Method, cos_theta: f32) -> bool {
    method.contract == Contract::Kept || cos_theta > 1e-6
}

fn compare(function: &Checked, cosines: &[f32], arguments: &[[f32; 3]]) -> CodeError {
    let mut single = vec![Value::each(cosines.to_vec())];
    let mut double = vec![Value::each(cosines.iter().map(|c| f64::from(*c)).collect())];
    for (param, argument) in function.params.iter().skip(1).zip(arguments) {
        let wide = argument.map(f64::from);
        single.push(if param.ty == Ty::Rgb {
            Value::rgb(wide)
        } else {
            Value::scalar(wide[0])
        });
        double.push(if param.ty == Ty::Rgb {
            Value::rgb(wide)
        } else {
            Value::scalar(wide[0])
        });
    }
    let (got, want) = (
        evaluate::<f32>(function, &single),
        evaluate::<f64>(function, &double),
    );
    let mut error = CodeError::NONE;
    for (point, cos_theta) in cosines.iter().enumerate() {
        for (got, want) in got.at(point).into_iter().zip(want.at(point)) {
            error.include(got, want, *cos_theta);
        }
    }
    error
}
