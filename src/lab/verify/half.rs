//! Code error in half precision: a function rounded to f16 after every operation, against what it means in f64 at the same f16
//! inputs, at every f16 from 0 to 1. Most desktop graphics stacks compute in f32 whatever the text says, so this emulation is the
//! judge.

use super::trial::arguments;
use crate::language::ir::{Checked, Texels, Value, evaluate};
use crate::physics::num::{Half, Num};

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
        let arguments = arguments(function, self.values, self.table, cosines);
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
