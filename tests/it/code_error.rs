//! Code errors of functions over samples: unfused f32, or f16 rounded after every operation, against f64 at the same inputs.

use fresnel_gen::generator::fit::{Measured, values};
use fresnel_gen::generator::reference::Derivation;
use fresnel_gen::lab::verify::{
    ABSOLUTE_FLOOR, CodeError, HalfError, HalfTrial, Random, Trial, cosines, halves, nearest_half,
};
use fresnel_gen::language::ir::{Checked, Ty};
use fresnel_gen::language::methods::{self, Class, Contract, MediaSet, Method};
use fresnel_gen::physics::materials::Channels;
use fresnel_gen::physics::num::Precision;

/// The seed of the random media.
const SEED: u64 = 1;
/// The share of metals among the media of [`MediaSet::Wide`].
const METALS: f64 = 0.3;
/// The share of media without absorption among the rest.
const CLEAR: f64 = 0.1;
/// The points are a sample, and a bound must hold at all others too. So differences count from this share of the floor on.
const SAMPLED_FLOOR: f64 = 0.8;
const WELL_FORMED: &str = "every method's function is well formed; a test builds all";

/// The code error of a function of `cos_theta` alone, at about `points` cosines. Differences within four fifths of
/// [`ABSOLUTE_FLOOR`] do not count.
pub fn code_error(function: &Checked, points: usize) -> CodeError {
    let floor = SAMPLED_FLOOR * ABSOLUTE_FLOOR;
    compare(function, &cosines(points), &[], floor)
}

/// The largest distance in ulp, however small the result. Differences within [`ABSOLUTE_FLOOR`] count too.
pub fn digits_lost(function: &Checked, points: usize) -> f64 {
    compare(function, &cosines(points), &[], 0.0).max_ulp
}

/// The code error of a method's library function over so many random media of its claim, at about `points` cosines each.
pub fn library_code_error(method: &Method, media: usize, points: usize) -> CodeError {
    // A textbook method promises nothing at exactly 90 degrees.
    let inside = |c: &f32| method.contract == Contract::Kept || *c > 1e-6;
    let cosines: Vec<f32> = cosines(points).into_iter().filter(inside).collect();
    let mut random = Random(SEED);
    (0..media / 3).fold(CodeError::NONE, |worst, _| {
        let channels = random_channels(method, method.claims.code_over, &mut random);
        worst.worst(library_code_error_at(method, &channels, &cosines))
    })
}

/// As [`library_code_error`] for one triple of media, at these cosines. The method's inputs are derived and rounded to f32.
pub fn library_code_error_at(method: &Method, channels: &Channels, cosines: &[f32]) -> CodeError {
    let function = method.function(false).expect(WELL_FORMED);
    compare(
        &function,
        cosines,
        &arguments(method, channels),
        ABSOLUTE_FLOOR,
    )
}

/// The largest absolute difference of the coefficients that a method computes, over so many random media. None for methods that
/// compute none.
pub fn coefficient_code_error(method: &Method, media: usize) -> Option<f64> {
    let function = |place| {
        let coefficient = method.coefficient_in(Precision::F32, place)?;
        Some(coefficient.expect(WELL_FORMED))
    };
    let functions: Vec<Checked> = (0..4).map(function).collect::<Option<_>>()?;
    let mut random = Random(SEED);
    Some((0..media / 3).fold(0.0, |worst, _| {
        let channels = random_channels(method, method.claims.code_over, &mut random);
        let arguments = arguments(method, &channels);
        let off = |function: &Checked| compare(function, &[0.0], &arguments, 0.0).max_abs;
        functions.iter().map(off).fold(worst, f64::max)
    }))
}

/// The error of a method's library function in half precision over so many random media of its claim, at every f16 from 0 to 1.
/// None for a method that promises nothing.
pub fn library_half_error(method: &Method, media: usize) -> Option<HalfError> {
    let over = method.half.claim()?.over;
    let (cosines, mut random) = (halves(), Random(SEED));
    let errors = (0..media / 3).map(|_| {
        let channels = random_channels(method, over, &mut random);
        library_half_error_at(method, &channels, &cosines)
    });
    errors.reduce(|worst, error| {
        if error.max_abs > worst.max_abs {
            error
        } else {
            worst
        }
    })
}

/// As [`library_half_error`] for one triple of media, at these cosines. The method's inputs are derived and rounded to f16.
fn library_half_error_at(method: &Method, channels: &Channels, cosines: &[f32]) -> HalfError {
    let function = method
        .function_in(Precision::F16, false)
        .expect(WELL_FORMED);
    let meaning = method.function(false).expect(WELL_FORMED);
    let values = arguments(method, channels).into_iter();
    let values: Vec<[f32; 3]> = values.map(|value| value.map(nearest_half)).collect();
    let trial = HalfTrial {
        function: &function,
        meaning: &meaning,
        values: &values,
        table: None,
    };
    trial.error(cosines)
}

/// Three random media of a set.
fn random_channels(method: &Method, over: MediaSet, random: &mut Random) -> Channels {
    let [a, b, c] = [0; 3].map(|_| random_medium(method, over, random));
    Channels {
        n: [a.0, b.0, c.0],
        k: [a.1, b.1, c.1],
    }
}

/// n and k of a random medium of a set. In the wide sets some are metals, and some absorb nothing.
pub fn random_medium(method: &Method, over: MediaSet, random: &mut Random) -> (f64, f64) {
    let glass = method.class == Class::Dielectric;
    if over == MediaSet::Metals || !glass && random.unit() < METALS {
        return MediaSet::Metals.medium(random.unit(), random.unit());
    }
    let n_share = random.unit();
    let k_share = if glass {
        0.0
    } else {
        ((random.unit() - CLEAR) / (1.0 - CLEAR)).max(0.0)
    };
    over.medium(n_share, k_share)
}

/// The values of a method's inputs without textures, derived in f64 and rounded to f32.
fn arguments(method: &Method, channels: &Channels) -> Vec<[f32; 3]> {
    let values = values(method, channels, &Derivation::default());
    let numbers = method.inputs.iter().filter(|input| input.ty != Ty::Texture);
    numbers
        .map(|input| values[input.name].map(|value| value as f32))
        .collect()
}

fn compare(function: &Checked, cosines: &[f32], arguments: &[[f32; 3]], floor: f64) -> CodeError {
    let trial = Trial {
        function: function.clone(),
        values: arguments.to_vec(),
        table: None,
        bound: Measured::Yes(0.0),
        floor,
        is_guarded: true,
    };
    let (got, want) = (trial.run::<f32>(cosines), trial.run::<f64>(cosines));
    let mut error = CodeError::NONE;
    for (point, cos_theta) in cosines.iter().enumerate() {
        for (got, want) in got.at(point).into_iter().zip(want.at(point)) {
            error.include(got, want, *cos_theta, floor);
        }
    }
    error
}

#[test]
fn a_forced_textbook_form_has_no_number_at_grazing() {
    let method = methods::find("conductor_textbook").unwrap();
    let channels = Channels {
        n: [1.5; 3],
        k: [2.0; 3],
    };
    let error = library_half_error_at(method, &channels, &[0.0]);
    assert_eq!(error.max_abs, f64::INFINITY);
}
