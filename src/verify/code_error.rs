//! Code error: a function in unfused f32 against itself in f64, at the very same f32 inputs. Never to be added to
//! model error.

use serde::{Deserialize, Serialize};

use crate::fit::{Derivation, values};
use crate::ir::{Checked, Ty, Value, evaluate};
use crate::materials::Channels;
use crate::methods::{Class, Contract, Method};
use crate::num::ulp_distance;

use super::points::{Random, cosines};

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
        let counts = difference > ABSOLUTE_FLOOR || difference.is_nan();
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

/// The code error of a method's library function: `media` random media of the sets that its claims are stated over,
/// its inputs derived from them and rounded to f32, at about `points` cosines each.
pub fn library_code_error(method: &Method, media: usize, points: usize) -> CodeError {
    let function = method
        .function(false)
        .expect("every method's function is well formed; a test builds all");
    let cosines: Vec<f32> = cosines(points)
        .into_iter()
        .filter(|c| in_domain(method, *c))
        .collect();
    let mut random = Random(1);
    let mut worst = CodeError::NONE;
    for _ in 0..media {
        let constants = values(method, &medium(method, &mut random), &Derivation::default());
        let arguments: Vec<[f32; 3]> = method
            .inputs
            .iter()
            .map(|i| constants[i.name].map(|v| v as f32))
            .collect();
        worst = worst.worst(compare(&function, &cosines, &arguments));
    }
    worst
}

/// A textbook method promises nothing at exactly 90 degrees.
fn in_domain(method: &Method, cos_theta: f32) -> bool {
    method.contract == Contract::Kept || cos_theta > 1e-6
}

/// Eta 1.0001 to 12, logarithmic in eta - 1; for methods that take absorption, k from 0 to 13 besides.
fn medium(method: &Method, random: &mut Random) -> Channels {
    let mut eta = || 1.0 + 1e-4 * libm::pow(1.1e5, random.unit());
    let n = [eta(), eta(), eta()];
    let mut k = || {
        if method.class == Class::Dielectric {
            0.0
        } else {
            13.0 * random.unit().powi(2)
        }
    };
    Channels {
        n,
        k: [k(), k(), k()],
    }
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
