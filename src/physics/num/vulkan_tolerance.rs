//! f64 with exponentials, logarithms, sines and cosines that err as much as Vulkan allows on a GPU.
//!
//! Source: Khronos, *Vulkan 1.3 Specification*, appendix "Precision of Core Standard Instructions", 2022,
//! <https://registry.khronos.org/vulkan/specs/latest/html/vkspec.html#spirvenv-precision-operation>: exp2 within
//! 3 + 2 |x| ulp; log2 within 3 ulp outside [0.5, 2], and within 2⁻²¹ inside; sin and cos within 2⁻¹¹ in [-π, π]. Beyond, where
//! nothing is stated, the same is taken.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Num, Truth, ulp_of};

/// A number. `LOG` and `EXP` are -1, 0 or 1: the sign of the errors of logarithms and cosines, and of exponentials and sines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VulkanTolerance<const LOG: i8, const EXP: i8>(f64);

/// 2⁻²¹: the error of log2 between 0.5 and 2.
const LOG_NEAR_ONE: f64 = 1.0 / 2_097_152.0;
/// 2⁻¹¹: the error of a sine or a cosine.
const WAVE: f64 = 1.0 / 2048.0;
/// The error of log2 elsewhere, in ulp.
const LOG_ULP: f64 = 3.0;

macro_rules! operator {
    ($trait:ident, $name:ident, $sign:tt) => {
        impl<const LOG: i8, const EXP: i8> $trait for VulkanTolerance<LOG, EXP> {
            type Output = Self;

            fn $name(self, other: Self) -> Self {
                VulkanTolerance(self.0 $sign other.0)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<const LOG: i8, const EXP: i8> Neg for VulkanTolerance<LOG, EXP> {
    type Output = Self;

    fn neg(self) -> Self {
        VulkanTolerance(-self.0)
    }
}

impl<const LOG: i8, const EXP: i8> Num for VulkanTolerance<LOG, EXP> {
    fn from_f64(x: f64) -> Self {
        VulkanTolerance(x)
    }

    fn to_f64(self) -> f64 {
        self.0
    }

    fn abs(self) -> Self {
        VulkanTolerance(self.0.abs())
    }

    fn min(self, other: Self) -> Self {
        VulkanTolerance(self.0.min(other.0))
    }

    fn max(self, other: Self) -> Self {
        VulkanTolerance(self.0.max(other.0))
    }

    fn sqrt(self) -> Self {
        VulkanTolerance(self.0.sqrt())
    }

    fn exp2(self) -> Self {
        let exact = libm::exp2(self.0);
        let ulp = 3.0 + 2.0 * self.0.abs();
        VulkanTolerance(exact + f64::from(EXP) * ulp * ulp_of(exact))
    }

    fn log2(self) -> Self {
        let exact = libm::log2(self.0);
        let error = if (0.5..=2.0).contains(&self.0) {
            LOG_NEAR_ONE
        } else {
            LOG_ULP * ulp_of(exact)
        };
        VulkanTolerance(exact + f64::from(LOG) * error)
    }

    fn sin(self) -> Self {
        VulkanTolerance(libm::sin(self.0) + f64::from(EXP) * WAVE)
    }

    fn cos(self) -> Self {
        VulkanTolerance(libm::cos(self.0) + f64::from(LOG) * WAVE)
    }

    fn less(self, other: Self) -> Truth {
        (self.0 < other.0).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_errs_by_what_the_specification_allows() {
        let up = VulkanTolerance::<1, 1>::from_f64;
        assert_eq!(up(8.0).log2().to_f64(), 3.0 + 3.0 * ulp_of(3.0));
        assert_eq!(up(1.0).log2().to_f64(), LOG_NEAR_ONE);
        assert_eq!(up(-2.0).exp2().to_f64(), 0.25 + 7.0 * ulp_of(0.25));
        assert_eq!(up(0.0).sin().to_f64(), WAVE);
        assert_eq!(up(0.0).cos().to_f64(), 1.0 + WAVE);
        let exact = VulkanTolerance::<0, 0>::from_f64;
        assert_eq!(exact(8.0).log2().to_f64(), 3.0);
        assert_eq!(exact(3.0).squared().to_f64(), 9.0);
        assert_eq!(exact(3.0).less(exact(4.0)), Truth::Yes);
    }
}
