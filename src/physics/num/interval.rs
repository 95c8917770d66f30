//! [`Interval`]: the values that a step of a formula can have, for range analysis.
//!
//! Every result contains each real number that the operation gives on members of its operands. An end that was
//! rounded is moved outward by one step of `f64`. An end that is exact stays, so 1 − [0, 1] is [0, 1]. `exp2`,
//! `log2`, `sin` and `cos` are widened by 1e-15 of their value, which is more than `libm`'s error of 1 ulp (2.2e-16). Ends may be
//! infinite but never NaN. The method is that of R. E. Moore, *Interval Analysis*, Prentice-Hall, 1966. Exactness is
//! tested in double-double arithmetic.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Num, Truth};

/// The relative widening of `exp2`, `log2`, `sin` and `cos`.
const FUNCTION_WIDENING: f64 = 1e-15;

/// Below this magnitude the exact error of a product may itself be rounded: 2⁻¹⁰²² · 2¹⁰⁶ and a margin.
const ERROR_IS_EXACT_ABOVE: f64 = 1e-270;

/// All real numbers from `lo` to `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

impl Interval {
    /// Every number.
    pub const EVERYTHING: Interval = Interval {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    };

    /// The numbers between two ends, given in either order. Everything, if an end is a NaN.
    #[inline]
    pub fn new(one_end: f64, other_end: f64) -> Interval {
        if one_end.is_nan() || other_end.is_nan() {
            return Interval::EVERYTHING;
        }
        Interval {
            lo: one_end.min(other_end),
            hi: one_end.max(other_end),
        }
    }

    /// The lower end.
    #[inline]
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// The upper end.
    #[inline]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// A sine or a cosine.
    fn wave(self, of: fn(f64) -> f64) -> Interval {
        if self.lo == self.hi && self.lo.is_finite() {
            let value = of(self.lo);
            return widened(value, value);
        }
        Interval::new(-1.0, 1.0)
    }

    /// Whether `x` lies in it; a NaN lies in none.
    #[inline]
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }
}

/// An end as computed, and whether it may differ from the exact one.
#[derive(Clone, Copy)]
struct End {
    value: f64,
    exact: bool,
}

impl End {
    /// A result with its exact error. The error of an infinite result is a NaN, hence not exact.
    #[inline]
    fn new(value: f64, error: f64) -> End {
        End {
            value,
            exact: error == 0.0,
        }
    }

    #[inline]
    fn lower(self) -> f64 {
        if self.exact {
            self.value
        } else {
            self.value.next_down()
        }
    }

    #[inline]
    fn upper(self) -> f64 {
        if self.exact {
            self.value
        } else {
            self.value.next_up()
        }
    }
}

#[inline]
fn sum(a: f64, b: f64) -> End {
    let sum = a + b;
    let rest = sum - a;
    End::new(sum, (a - (sum - rest)) + (b - rest))
}

/// 0 · ∞ is 0: an infinite end stands for arbitrarily large numbers.
#[inline]
fn product(a: f64, b: f64) -> End {
    if a == 0.0 || b == 0.0 {
        return End::new(0.0, 0.0);
    }
    let product = a * b;
    if product.abs() < ERROR_IS_EXACT_ABOVE {
        return End::new(product, f64::NAN);
    }
    End::new(product, a.mul_add(b, -product))
}

/// ∞ / ∞ is 0: the quotients of the other ends already span what lies between.
#[inline]
fn quotient(a: f64, b: f64) -> End {
    if a == 0.0 {
        return End::new(0.0, 0.0);
    }
    if b.is_infinite() {
        return End::new(0.0, f64::NAN);
    }
    let quotient = a / b;
    if a.abs() < ERROR_IS_EXACT_ABOVE {
        return End::new(quotient, f64::NAN);
    }
    End::new(quotient, (-quotient).mul_add(b, a))
}

#[inline]
fn root(x: f64) -> End {
    let root = x.max(0.0).sqrt();
    if x <= 0.0 {
        return End::new(root, 0.0);
    }
    if x < ERROR_IS_EXACT_ABOVE {
        return End::new(root, f64::NAN);
    }
    End::new(root, (-root).mul_add(root, x))
}

/// The interval between the least and the largest result of two ends.
#[inline]
fn hull(a: Interval, b: Interval, of: impl Fn(f64, f64) -> End) -> Interval {
    let ends = [
        of(a.lo, b.lo),
        of(a.lo, b.hi),
        of(a.hi, b.lo),
        of(a.hi, b.hi),
    ];
    Interval {
        lo: ends
            .map(End::lower)
            .into_iter()
            .fold(f64::INFINITY, f64::min),
        hi: ends
            .map(End::upper)
            .into_iter()
            .fold(f64::NEG_INFINITY, f64::max),
    }
}

#[inline]
fn widened(lo: f64, hi: f64) -> Interval {
    let margin = |x: f64| {
        if x.is_finite() {
            x.abs() * FUNCTION_WIDENING
        } else {
            0.0
        }
    };
    Interval::new((lo - margin(lo)).next_down(), (hi + margin(hi)).next_up())
}

impl Add for Interval {
    type Output = Interval;

    #[inline]
    fn add(self, other: Interval) -> Interval {
        let (lo, hi) = (sum(self.lo, other.lo), sum(self.hi, other.hi));
        Interval::new(lo.lower(), hi.upper())
    }
}

impl Sub for Interval {
    type Output = Interval;

    #[inline]
    fn sub(self, other: Interval) -> Interval {
        let (lo, hi) = (sum(self.lo, -other.hi), sum(self.hi, -other.lo));
        Interval::new(lo.lower(), hi.upper())
    }
}

impl Mul for Interval {
    type Output = Interval;

    #[inline]
    fn mul(self, other: Interval) -> Interval {
        hull(self, other, product)
    }
}

impl Div for Interval {
    type Output = Interval;

    /// Everything, when the divisor contains 0.
    #[inline]
    fn div(self, other: Interval) -> Interval {
        if other.contains(0.0) {
            return Interval::EVERYTHING;
        }
        hull(self, other, quotient)
    }
}

impl Neg for Interval {
    type Output = Interval;

    #[inline]
    fn neg(self) -> Interval {
        Interval {
            lo: -self.hi,
            hi: -self.lo,
        }
    }
}

impl Num for Interval {
    /// The point x; everything, for a NaN.
    #[inline]
    fn from_f64(x: f64) -> Interval {
        Interval::new(x, x)
    }

    /// The midpoint; 0 for everything.
    #[inline]
    fn to_f64(self) -> f64 {
        if self == Interval::EVERYTHING {
            return 0.0;
        }
        0.5 * self.lo + 0.5 * self.hi
    }

    #[inline]
    fn abs(self) -> Interval {
        if self.contains(0.0) {
            Interval::new(0.0, self.hi.max(-self.lo))
        } else {
            Interval::new(self.lo.abs(), self.hi.abs())
        }
    }

    #[inline]
    fn min(self, other: Interval) -> Interval {
        Interval {
            lo: self.lo.min(other.lo),
            hi: self.hi.min(other.hi),
        }
    }

    #[inline]
    fn max(self, other: Interval) -> Interval {
        Interval {
            lo: self.lo.max(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// The negative part counts as 0.
    #[inline]
    fn sqrt(self) -> Interval {
        Interval::new(root(self.lo).lower().max(0.0), root(self.hi).upper())
    }

    #[inline]
    fn exp2(self) -> Interval {
        let wide = widened(libm::exp2(self.lo), libm::exp2(self.hi));
        Interval::new(wide.lo.max(0.0), wide.hi)
    }

    /// The part at or below 0 counts as 0, whose logarithm is −∞.
    #[inline]
    fn log2(self) -> Interval {
        widened(libm::log2(self.lo.max(0.0)), libm::log2(self.hi.max(0.0)))
    }

    /// [-1, 1], except at a point: a phase that varies passes through whole turns.
    #[inline]
    fn sin(self) -> Interval {
        self.wave(libm::sin)
    }

    #[inline]
    fn cos(self) -> Interval {
        self.wave(libm::cos)
    }

    /// Yes or No if it holds or fails for every pair of members, else Either.
    #[inline]
    fn less(self, other: Interval) -> Truth {
        if self.hi < other.lo {
            Truth::Yes
        } else if self.lo >= other.hi {
            Truth::No
        } else {
            Truth::Either
        }
    }

    /// Tighter than `self * self`, which treats the two factors as independent.
    #[inline]
    fn squared(self) -> Interval {
        let size = self.abs();
        size * size
    }

    /// It decreases, so the ends swap. An interval that reaches 0 gives one that reaches +∞.
    #[inline]
    fn inverse_sqrt(self) -> Interval {
        let root = self.sqrt();
        let (lo, hi) = (quotient(1.0, root.hi), quotient(1.0, root.lo));
        Interval::new(lo.lower().max(0.0), hi.upper())
    }

    /// The smallest interval that contains both.
    #[inline]
    fn either(self, other: Interval) -> Interval {
        Interval {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_ends_stay() {
        let unit = Interval::new(0.0, 1.0);
        let one = Interval::from_f64(1.0);
        assert_eq!(one - unit, unit);
        assert_eq!(unit * unit, unit);
        assert_eq!(Interval::new(-1.0, 1.0).squared(), unit);
        let both = Interval::new(-1.0, 1.0);
        assert_eq!(both * both, both);
        assert_eq!(Interval::new(-2.0, 4.0).sqrt(), Interval::new(0.0, 2.0));
        assert_eq!(
            Interval::new(0.0, 4.0).inverse_sqrt(),
            Interval::new(0.5, f64::INFINITY)
        );
        assert_eq!(Interval::new(-1.0, 3.0).saturate(), unit);
        let three = Interval::from_f64(3.0);
        assert_eq!(unit.either(three), Interval::new(0.0, 3.0));
    }

    #[test]
    fn comparisons() {
        let unit = Interval::new(0.0, 1.0);
        assert_eq!(unit.less(Interval::from_f64(2.0)), Truth::Yes);
        assert_eq!(unit.less(Interval::from_f64(0.0)), Truth::No);
        assert_eq!(unit.less(Interval::from_f64(1.0)), Truth::Either);
        assert_eq!(unit.less(unit), Truth::Either);
    }

    #[test]
    fn never_a_nan() {
        let (most, all) = (f64::MAX, f64::INFINITY);
        let ends = [-all, -most, -1.0, -5e-324, 0.0, 5e-324, 1.0, most, all];
        let beside = |lo: &f64| ends.map(|hi| Interval::new(*lo, hi));
        let pairs = || ends.iter().flat_map(beside);
        for (a, b) in pairs().flat_map(|a| pairs().map(move |b| (a, b))) {
            let of_one = [
                a.sqrt(),
                a.inverse_sqrt(),
                a.exp2(),
                a.log2(),
                a.sin(),
                a.cos(),
                a.squared(),
            ];
            for result in [a + b, a - b, a * b, a / b].into_iter().chain(of_one) {
                assert!(result.lo <= result.hi, "{a:?} {b:?} {result:?}");
            }
            assert!(!a.to_f64().is_nan());
        }
        assert_eq!(Interval::from_f64(f64::NAN), Interval::EVERYTHING);
    }
}
