//! [`Num`] for [`Half`] (IEEE 754 binary16, rounded after every operation), and for `f32` and `f64`.
//!
//! Each operation of [`Half`] is done in `f32` and the result rounded to 11 bits. For `+ - * /` and `sqrt` the two
//! roundings equal one, because 24 ≥ 2·11 + 2 (S. A. Figueroa, *When is double rounding innocuous?*, ACM
//! SIGNUM Newsletter 30(3), 1995, <https://doi.org/10.1145/221332.221334>). `exp2`, `log2`, `sin` and `cos` are `libm`'s `f32`
//! functions, then rounded: at most 0.501 ulp of binary16.
//!
//! In `f32` and `f64`, `+ - * /` and `sqrt` round correctly (IEEE 754). `exp2`, `log2`, `sin` and `cos` come from the `libm` crate, with
//! errors below 1 ulp. The standard library's call the platform's C library and may differ between machines.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Num, Truth};

/// A binary16 number: 11 significant bits, largest value 65504, smallest normal 2⁻¹⁴.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Half(::half::f16);

impl Half {
    /// The nearest binary16 to `x`, ties to even.
    pub fn from_f32(x: f32) -> Half {
        Half(::half::f16::from_f32(x))
    }

    /// The same value; exact.
    pub fn to_f32(self) -> f32 {
        self.0.to_f32()
    }
}

/// `x` truncated to `f32`, with the last bit set when anything was lost ("round to odd"). A second rounding then
/// gives the same as a single one. `half::f16::from_f64` drops the low 32 bits instead, and so misses ties.
fn rounded_to_odd(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) == x || x.is_nan() {
        return near;
    }
    let beyond = f64::from(near).abs() > x.abs();
    f32::from_bits((near.to_bits() - u32::from(beyond)) | 1)
}

macro_rules! operator {
    ($operation:ident, $method:ident, $sign:tt) => {
        impl $operation for Half {
            type Output = Half;

            fn $method(self, other: Half) -> Half {
                Half::from_f32(self.to_f32() $sign other.to_f32())
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Half {
    type Output = Half;

    fn neg(self) -> Half {
        Half(-self.0)
    }
}

impl Num for Half {
    fn from_f64(x: f64) -> Half {
        Half::from_f32(rounded_to_odd(x))
    }

    fn to_f64(self) -> f64 {
        self.0.to_f64()
    }

    fn abs(self) -> Half {
        Half::from_f32(self.to_f32().abs())
    }

    fn min(self, other: Half) -> Half {
        Half::from_f32(self.to_f32().min(other.to_f32()))
    }

    fn max(self, other: Half) -> Half {
        Half::from_f32(self.to_f32().max(other.to_f32()))
    }

    fn inverse_sqrt(self) -> Half {
        Half::from_f32(1.0 / self.to_f32().sqrt())
    }

    fn sqrt(self) -> Half {
        Half::from_f32(self.to_f32().sqrt())
    }

    fn exp2(self) -> Half {
        Half::from_f32(libm::exp2f(self.to_f32()))
    }

    fn log2(self) -> Half {
        Half::from_f32(libm::log2f(self.to_f32()))
    }

    fn sin(self) -> Half {
        Half::from_f32(libm::sinf(self.to_f32()))
    }

    fn cos(self) -> Half {
        Half::from_f32(libm::cosf(self.to_f32()))
    }

    fn less(self, other: Half) -> Truth {
        (self < other).into()
    }
}

macro_rules! native {
    ($float:ty, $exp2:path, $log2:path, $sin:path, $cos:path) => {
        impl Num for $float {
            #[inline]
            fn from_f64(x: f64) -> Self {
                x as $float
            }

            #[inline]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            #[inline]
            fn abs(self) -> Self {
                <$float>::abs(self)
            }

            #[inline]
            fn min(self, other: Self) -> Self {
                <$float>::min(self, other)
            }

            #[inline]
            fn max(self, other: Self) -> Self {
                <$float>::max(self, other)
            }

            #[inline]
            fn sqrt(self) -> Self {
                <$float>::sqrt(self)
            }

            #[inline]
            fn exp2(self) -> Self {
                $exp2(self)
            }

            #[inline]
            fn log2(self) -> Self {
                $log2(self)
            }

            #[inline]
            fn sin(self) -> Self {
                $sin(self)
            }

            #[inline]
            fn cos(self) -> Self {
                $cos(self)
            }

            #[inline]
            fn less(self, other: Self) -> Truth {
                (self < other).into()
            }
        }
    };
}

native!(f32, libm::exp2f, libm::log2f, libm::sinf, libm::cosf);
native!(f64, libm::exp2, libm::log2, libm::sin, libm::cos);

#[cfg(test)]
mod tests {
    use super::*;

    const ULP: f64 = 1.0 / 1024.0;

    #[track_caller]
    fn check_rounding(x: f64, expected: f64) {
        assert_eq!(Half::from_f64(x).to_f64(), expected, "{x:e}");
        assert_eq!(Half::from_f64(-x).to_f64(), -expected, "-{x:e}");
    }

    #[test]
    fn rounds_once_to_nearest_even() {
        check_rounding(1.0 + 0.5 * ULP, 1.0);
        check_rounding(1.0 + 1.5 * ULP, 1.0 + 2.0 * ULP);
        // Above the tie by less than half an ulp of f32: rounding twice would lose it.
        check_rounding(1.0 + 0.5 * ULP + 1e-15, 1.0 + ULP);
        check_rounding(1.0 + 1.5 * ULP - 1e-15, 1.0 + ULP);
    }

    #[test]
    fn keeps_the_ends_of_the_range() {
        check_rounding(65504.0, 65504.0);
        check_rounding(65519.999, 65504.0);
        check_rounding(65520.0, f64::INFINITY);
        check_rounding(1e300, f64::INFINITY);
        check_rounding((-24f64).exp2(), (-24f64).exp2());
        check_rounding(1e-300, 0.0);
        assert!(Half::from_f64(f64::NAN).to_f64().is_nan());
    }

    #[test]
    fn every_operation_rounds() {
        let third = Half::from_f64(1.0) / Half::from_f64(3.0);
        assert_eq!(third.to_f64(), 0.333_251_953_125);
        // The exact sum is 1 − 2⁻¹², a tie.
        assert_eq!((third + third + third).to_f64(), 1.0);
        assert_eq!(Half::from_f64(2.0).sqrt().to_f64(), 1.4140625);
        assert_eq!(Half::from_f64(0.5).exp2().to_f64(), 1.4140625);
        assert_eq!(Half::from_f64(10.0).log2().to_f64(), 3.322_265_625);
        let square = Half::from_f64(300.0) * Half::from_f64(300.0);
        assert_eq!(square.to_f64(), f64::INFINITY);
    }
}
