//! Numbers: the trait that a formula computes with, and the number types that implement it.
//!
//! Code error is measured by evaluating one formula in several precisions. The same graph runs in [`Half`] (rounded after
//! every operation), `f32` and `f64`, and in [`Interval`], which gives the range of each step. Tests also run it in double-double.

mod complex;
mod decimal_comma;
mod half;
mod interval;
mod legendre;
mod parallel;
mod precision;
pub mod statistics;
mod vulkan_tolerance;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

pub use complex::Complex;
pub use decimal_comma::{POINT_NOT_COMMA, has_decimal_commas};
pub use half::Half;
pub use interval::Interval;
pub use legendre::Legendre;
pub use parallel::in_parallel;
pub use precision::{Precision, ulp_distance, ulp_of};
pub use vulkan_tolerance::VulkanTolerance;

/// The result of a comparison. It is undecided where intervals overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Certainly not.
    No,
    /// Certainly.
    Yes,
    /// It depends on where inside the intervals the values lie.
    Either,
}

impl From<bool> for Truth {
    #[inline]
    fn from(value: bool) -> Truth {
        if value { Truth::Yes } else { Truth::No }
    }
}

/// A value for each of three channels. It is inlined where [`array::map`] is not.
#[inline]
pub fn each_channel<T>(mut of: impl FnMut(usize) -> T) -> [T; 3] {
    [of(0), of(1), of(2)]
}

/// A number that a formula computes with.
///
/// Every operation rounds once, to the nearest representable value, except `inverse_sqrt` (twice), `exp2`, `log2`, `sin` and `cos`, and all
/// of [`Interval`], whose errors each implementation states. A comparison with a NaN is
/// [`Truth::No`]; `min` and `max` return the other operand when one is a NaN, as IEEE 754-2008 `minNum` does.
pub trait Num:
    Copy
    + Debug
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The nearest value to `x`.
    fn from_f64(x: f64) -> Self;
    /// The nearest `f64` (for an interval, its midpoint).
    fn to_f64(self) -> f64;
    /// |x|
    fn abs(self) -> Self;
    /// The smaller of two.
    fn min(self, other: Self) -> Self;
    /// The larger of two.
    fn max(self, other: Self) -> Self;
    /// √x
    fn sqrt(self) -> Self;
    /// 2ˣ
    fn exp2(self) -> Self;
    /// log₂ x
    fn log2(self) -> Self;
    /// sin x, x in radians
    fn sin(self) -> Self;
    /// cos x, x in radians
    fn cos(self) -> Self;
    /// Whether `self < other`.
    fn less(self, other: Self) -> Truth;

    /// x². For an interval it is tighter than `self * self`, since both factors are the same number.
    #[inline]
    fn squared(self) -> Self {
        self * self
    }

    /// 1/√x
    #[inline]
    fn inverse_sqrt(self) -> Self {
        Self::from_f64(1.0) / self.sqrt()
    }

    /// x limited to [0, 1]; a NaN becomes 0.
    #[inline]
    fn saturate(self) -> Self {
        self.max(Self::from_f64(0.0)).min(Self::from_f64(1.0))
    }

    /// An unknown value: a NaN, or the interval of all numbers.
    #[inline]
    fn unknown() -> Self {
        Self::from_f64(f64::NAN)
    }

    /// A value that covers both, for a select whose comparison is undecided. Only intervals leave one undecided.
    #[inline]
    fn either(self, _other: Self) -> Self {
        self
    }
}
