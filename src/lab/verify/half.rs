//! Code error in half precision: a function rounded to f16 after every operation, against what it means in f64 at the same f16
//! inputs, at every f16 from 0 to 1. Most desktop graphics stacks compute in f32 whatever the text says, so this emulation is the
//! judge.

use super::code_error::random_medium;
use super::points::Random;
use crate::generator::fit::values;
use crate::generator::reference::Derivation;
use crate::language::ir::{Checked, Param, Texels, Ty, Value, evaluate};
use crate::language::methods::Method;
use crate::physics::materials::Channels;
use crate::physics::num::{Half, Num, Precision};

/// The error of half precision against what is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfError {
    /// Largest absolute difference. Infinite where a result is NaN.
    pub max_abs: f64,
    /// Its cosine.
    pub worst_cos: f64,
}

/// The bits of 1 in f16.
const ONE: u16 = 0x3c00;
/// The seed of the random media.
const SEED: u64 = 1;

impl HalfError {
    /// No difference.
    pub const NONE: HalfError = HalfError {
        max_abs: 0.0,
        worst_cos: 0.0,
    };

    /// Includes a result.
    pub fn include(&mut self, got: f64, want: f64, cos_theta: f32) {
        let difference = (got - want).abs();
        let difference = if difference.is_nan() {
            f64::INFINITY
        } else {
            difference
        };
        if difference > self.max_abs {
            (self.max_abs, self.worst_cos) = (difference, f64::from(cos_theta));
        }
    }

    /// The larger of two.
    pub fn worst(self, other: HalfError) -> HalfError {
        if other.max_abs > self.max_abs {
            other
        } else {
            self
        }
    }
}

/// Every f16 from 0 to 1: 15361 of them.
pub fn halves() -> Vec<f32> {
    let value = |bits: u16| half::f16::from_bits(bits).to_f32();
    (0..=ONE).map(value).collect()
}

/// f16 outside [0, 1]: every exponent of both signs, the neighbour of 1, both infinities, NaN with several payloads.
pub fn halves_beyond() -> Vec<f32> {
    const FRACTIONS: [u16; 4] = [0, 1, 0x155, 0x3ff];
    let sizes = (0..32u16).flat_map(|exponent| FRACTIONS.map(|fraction| exponent << 10 | fraction));
    let above = sizes.clone().filter(|bits| *bits > ONE);
    let below = sizes.map(|bits| 1 << 15 | bits);
    let all = above.chain(below);
    all.map(|bits| half::f16::from_bits(bits).to_f32())
        .collect()
}

/// A number rounded to f16.
pub fn nearest_half(x: f32) -> f32 {
    Half::from_f32(x).to_f32()
}

/// A function in half precision with the values of its arguments after `cos_theta`, which f16 can represent.
#[derive(Clone, Copy, Debug)]
pub struct HalfTrial<'a> {
    /// The function as its text computes it.
    pub function: &'a Checked,
    /// What it means.
    pub meaning: &'a Checked,
    /// The values of its arguments, without the texture. A scalar is the first number.
    pub values: &'a [[f32; 3]],
    /// The texture that it reads.
    pub table: Option<&'a Texels>,
}

impl HalfTrial<'_> {
    fn run<N: Num>(&self, function: &Checked, cosines: &[f32]) -> Value<N> {
        let number = |c: &f32| N::from_f64(f64::from(*c));
        let mut values = self.values.iter().copied();
        let mut value = |param: &Param| match param.ty {
            Ty::Texture => Value::Texture(self.table.cloned()),
            Ty::Rgb => Value::rgb(values.next().unwrap_or_default().map(f64::from)),
            _ if param.is_cosine() => Value::each(cosines.iter().map(number).collect()),
            _ => Value::scalar(f64::from(values.next().unwrap_or_default()[0])),
        };
        let params = function.params.iter();
        let arguments: Vec<Value<N>> = params.map(&mut value).collect();
        evaluate(function, &arguments)
    }

    /// What it means at these cosines.
    pub fn want(&self, cosines: &[f32]) -> Value<f64> {
        self.run(self.meaning, cosines)
    }

    /// The results in f16, rounded after every operation.
    pub fn emulated(&self, cosines: &[f32]) -> Value<Half> {
        self.run(self.function, cosines)
    }

    /// The error of the emulation against what the function means.
    pub fn error(&self, cosines: &[f32]) -> HalfError {
        let (got, want) = (self.emulated(cosines), self.want(cosines));
        let mut error = HalfError::NONE;
        for (point, cos_theta) in cosines.iter().enumerate() {
            for (got, want) in got.at(point).into_iter().zip(want.at(point)) {
                error.include(got.to_f64(), want, *cos_theta);
            }
        }
        error
    }
}

/// The error of a method's library function over so many random media of its claim, at every f16 from 0 to 1. Infinite for a
/// method that promises nothing.
pub fn library_half_error(method: &Method, media: usize) -> HalfError {
    let Some(claim) = method.half.claim() else {
        return HalfError {
            max_abs: f64::INFINITY,
            worst_cos: 0.0,
        };
    };
    let (cosines, mut random) = (halves(), Random(SEED));
    (0..media / 3).fold(HalfError::NONE, |worst, _| {
        let [a, b, c] = [0; 3].map(|_| random_medium(method, claim.over, &mut random));
        let channels = Channels {
            n: [a.0, b.0, c.0],
            k: [a.1, b.1, c.1],
        };
        worst.worst(library_half_error_at(method, &channels, &cosines))
    })
}

/// As [`library_half_error`] for one triple of media, at these cosines. The method's inputs are derived and rounded to f16.
pub fn library_half_error_at(method: &Method, channels: &Channels, cosines: &[f32]) -> HalfError {
    let well_formed = "every method's function is well formed; a test builds all";
    let function = method.function_in(Precision::F16, false);
    let (function, meaning) = (
        function.expect(well_formed),
        method.function(false).expect(well_formed),
    );
    let derived = values(method, channels, &Derivation::default());
    let numbers = method.inputs.iter().filter(|input| input.ty != Ty::Texture);
    let single = numbers.map(|input| derived[input.name].map(|value| nearest_half(value as f32)));
    let trial = HalfTrial {
        function: &function,
        meaning: &meaning,
        values: &single.collect::<Vec<_>>(),
        table: None,
    };
    trial.error(cosines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods;

    #[test]
    fn all_halves_are_there() {
        let halves = halves();
        assert_eq!(halves.len(), 15_361);
        assert_eq!((halves[0], halves[15_360]), (0.0, 1.0));
        assert!(halves.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn a_number_that_is_none_is_an_infinite_error() {
        let mut error = HalfError::NONE;
        error.include(f64::NAN, 1.0, 0.25);
        assert_eq!((error.max_abs, error.worst_cos), (f64::INFINITY, 0.25));
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
}
