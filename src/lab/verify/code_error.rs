//! Code error: a function in unfused f32 against itself in f64, at the same f32 inputs. It is never added to model error.

use serde::{Deserialize, Serialize};

use super::points::{Random, cosines};
use crate::generator::fit::values;
use crate::generator::reference::Derivation;
use crate::language::ir::{Checked, Ty, Value, evaluate};
use crate::language::methods::{Class, Contract, Input, Method, Over};
use crate::physics::materials::Channels;
use crate::physics::num::{Precision, ulp_distance};

/// How far the code is from what it means.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CodeError {
    /// Largest distance in ulp. Differences within [`ABSOLUTE_FLOOR`] do not count.
    pub max_ulp: f64,
    /// Largest absolute difference.
    pub max_abs: f64,
    /// The cosine of the largest distance in ulp.
    pub worst_cos: f64,
}

/// 2⁻²². Near a zero (Brewster's angle, the corrected method) an error in ulp has no bound, so a floor is needed.
pub const ABSOLUTE_FLOOR: f64 = 1.0 / 4_194_304.0;

/// The seed of the random media.
const SEED: u64 = 1;
/// The share of metals among the media of [`Over::Wide`].
const METALS: f64 = 0.3;
/// The share of media without absorption among the rest.
const CLEAR: f64 = 0.1;

impl CodeError {
    pub(super) const NONE: CodeError = CodeError {
        max_ulp: 0.0,
        max_abs: 0.0,
        worst_cos: 0.0,
    };

    pub(super) fn include(&mut self, got: f32, want: f64, cos_theta: f32, floor: f64) {
        let difference = (f64::from(got) - want).abs();
        self.max_abs = self.max_abs.max(difference);
        let ulp = ulp_distance(got, want);
        let counts = difference.is_nan() || difference > floor;
        if counts && ulp > self.max_ulp {
            (self.max_ulp, self.worst_cos) = (ulp, f64::from(cos_theta));
        }
    }

    pub(super) fn worst(self, other: CodeError) -> CodeError {
        let max_abs = self.max_abs.max(other.max_abs);
        let worse = if other.max_ulp > self.max_ulp {
            other
        } else {
            self
        };
        CodeError { max_abs, ..worse }
    }
}

/// The points are a sample, and a bound must hold at all others too. So differences count from this share of the floor on.
const ROOM: f64 = 0.8;

/// The code error of a function of `cos_theta` alone, at about `points` cosines. Differences within four fifths of
/// [`ABSOLUTE_FLOOR`] do not count.
pub fn code_error(function: &Checked, points: usize) -> CodeError {
    compare(function, &cosines(points), &[], ROOM * ABSOLUTE_FLOOR)
}

/// The largest distance in ulp, however small the result. Differences within [`ABSOLUTE_FLOOR`] count too.
pub fn digits_lost(function: &Checked, points: usize) -> f64 {
    compare(function, &cosines(points), &[], 0.0).max_ulp
}

/// The code error of a method's library function over so many random media of its claim, at about `points` cosines each.
pub fn library_code_error(method: &Method, media: usize, points: usize) -> CodeError {
    let inside = |c: &f32| in_domain(method, *c);
    let cosines: Vec<f32> = cosines(points).into_iter().filter(inside).collect();
    let mut random = Random(SEED);
    (0..media / 3).fold(CodeError::NONE, |worst, _| {
        let channels = random_channels(method, &mut random);
        worst.worst(library_code_error_at(method, &channels, &cosines))
    })
}

/// Three random media of a method's claim.
fn random_channels(method: &Method, random: &mut Random) -> Channels {
    let over = method.claims.code_over;
    let [a, b, c] = [0; 3].map(|_| random_medium(method, over, random));
    Channels {
        n: [a.0, b.0, c.0],
        k: [a.1, b.1, c.1],
    }
}

/// As [`library_code_error`] for one triple of media, at these cosines. The method's inputs are derived and rounded to f32.
pub fn library_code_error_at(method: &Method, channels: &Channels, cosines: &[f32]) -> CodeError {
    let function = method
        .function(false)
        .expect("every method's function is well formed; a test builds all");
    compare(
        &function,
        cosines,
        &arguments(method, channels),
        ABSOLUTE_FLOOR,
    )
}

/// The values of a method's inputs, derived in f64 and rounded.
fn arguments(method: &Method, channels: &Channels) -> Vec<[f32; 3]> {
    let constants = values(method, channels, &Derivation::default());
    let single = |input: &Input| constants[input.name].map(|value| value as f32);
    method.inputs.iter().map(single).collect()
}

/// The largest absolute difference of the coefficients that a method computes, over so many random media. None for methods that
/// compute none.
pub fn coefficient_code_error(method: &Method, media: usize) -> Option<f64> {
    let function = |place| {
        let coefficient = method.coefficient_in(Precision::F32, place)?;
        Some(coefficient.expect("every method's function is well formed; a test builds all"))
    };
    let functions: Vec<Checked> = (0..4).map(function).collect::<Option<_>>()?;
    let mut random = Random(SEED);
    Some((0..media / 3).fold(0.0, |worst, _| {
        let arguments = arguments(method, &random_channels(method, &mut random));
        let off = |function: &Checked| compare(function, &[0.0], &arguments, 0.0).max_abs;
        functions.iter().map(off).fold(worst, f64::max)
    }))
}

/// n and k of a random medium of a set. In the wide sets some are metals, and some absorb nothing.
pub fn random_medium(method: &Method, over: Over, random: &mut Random) -> (f64, f64) {
    let glass = method.class == Class::Dielectric;
    if over == Over::Metals || !glass && random.unit() < METALS {
        return Over::Metals.medium(random.unit(), random.unit());
    }
    let n_share = random.unit();
    let k_share = if glass {
        0.0
    } else {
        ((random.unit() - CLEAR) / (1.0 - CLEAR)).max(0.0)
    };
    over.medium(n_share, k_share)
}

/// A textbook method promises nothing at exactly 90 degrees.
fn in_domain(method: &Method, cos_theta: f32) -> bool {
    method.contract == Contract::Kept || cos_theta > 1e-6
}

fn compare(function: &Checked, cosines: &[f32], arguments: &[[f32; 3]], floor: f64) -> CodeError {
    let (mut single, mut double) = (Vec::new(), Vec::new());
    let mut params = function.params.iter().peekable();
    // Coefficients and means take no cosine.
    if params.next_if(|param| param.is_cosine()).is_some() {
        single.push(Value::each(cosines.to_vec()));
        double.push(Value::each(cosines.iter().map(|c| f64::from(*c)).collect()));
    }
    for (param, argument) in params.zip(arguments) {
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
            error.include(got, want, *cos_theta, floor);
        }
    }
    error
}
