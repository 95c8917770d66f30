//! [`Dd`]: double-double, an unevaluated sum of two `f64`, about 106 significant bits.
//!
//! Sum, product and quotient are Algorithms 6, 12 and 17 of M. Joldes, J.-M. Muller, V. Popescu, *Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic*, ACM TOMS 44(2), 2017,
//! <https://doi.org/10.1145/3121432>; the square root is Algorithm 8 of V. Lefèvre, N. Louvet, J.-M. Muller,
//! J. Picot, L. Rideau, *Accurate calculation of Euclidean norms using double-word arithmetic*, ACM TOMS 49(1),
//! 2023, <https://doi.org/10.1145/3568672>. With u = 2⁻⁵³ their relative errors are below 3u², 4u², 15u² and
//! 25/8 u² (u² = 1.2e-32), where no low part underflows: magnitudes from about 1e-290 to 1e300.
//! `exp2` and `log2` are series, measured below 1e-31 relative.

use std::f64::consts::{FRAC_1_SQRT_2, LOG2_10, SQRT_2};
use std::ops::{Add, Div, Mul, Neg, Sub};

use fresnel_gen::physics::num::{Num, Truth};

/// π; the error of the pair is 3e-33.
const PI: Dd = Dd {
    hi: std::f64::consts::PI,
    lo: 1.2246467991473532e-16,
};

/// ln 2; the error of the pair is 6e-34.
const LN_2: Dd = Dd {
    hi: std::f64::consts::LN_2,
    lo: 2.3190468138462996e-17,
};

/// The sum `hi + lo`, with |lo| ≤ half an ulp of `hi`. When `hi` is infinite or a NaN, `lo` is 0.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Dd {
    hi: f64,
    lo: f64,
}

impl Dd {
    /// The leading part: the nearest `f64`.
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// (sin θ, cos θ) for θ from 0 to 90 degrees, the degrees taken as exact. Relative error below 1e-30 in both,
    /// also where they tend to 0; exact at 0 and 90.
    pub fn sin_cos_degrees(theta_degrees: f64) -> (Dd, Dd) {
        if theta_degrees > 45.0 {
            // Exact, as both lie within a factor of two (Sterbenz).
            let (sine, cosine) = Dd::sin_cos_degrees(90.0 - theta_degrees);
            return (cosine, sine);
        }
        let angle = Dd::from(theta_degrees) * PI / Dd::from(180.0);
        let square = angle * angle;
        (
            angle * alternating_series(square, 1),
            alternating_series(square, 0),
        )
    }

    /// The sine of x and so many right angles. x is reduced to ±π/4, which costs an absolute error of 1e-32 |x|.
    fn turned(self, quarters: i64) -> Dd {
        if !self.is_finite() {
            return Dd::from(f64::NAN);
        }
        let right = PI / Dd::from(2.0);
        let whole = (self.hi / right.hi).round();
        let rest = self - Dd::from(whole) * right;
        let square = rest * rest;
        let value = match (whole as i64 + quarters).rem_euclid(2) {
            0 => rest * alternating_series(square, 1),
            _ => alternating_series(square, 0),
        };
        if (whole as i64 + quarters).rem_euclid(4) < 2 {
            value
        } else {
            -value
        }
    }

    /// A result whose low part is meaningless when the high part is infinite or a NaN.
    fn finite_or_high(hi: f64, lo: f64) -> Dd {
        let lo = if hi.is_finite() { lo } else { 0.0 };
        Dd { hi, lo }
    }

    /// hi + lo where |hi| ≥ |lo| ("Fast2Sum").
    fn from_ordered(hi: f64, lo: f64) -> Dd {
        let sum = hi + lo;
        Dd::finite_or_high(sum, lo - (sum - hi))
    }

    fn is_finite(self) -> bool {
        self.hi.is_finite()
    }

    /// The value times 2^power; exact unless it leaves the range.
    fn scaled(self, power: i32) -> Dd {
        Dd::finite_or_high(libm::ldexp(self.hi, power), libm::ldexp(self.lo, power))
    }
}

/// The rounded sum and its exact error ("2Sum").
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let rest = sum - a;
    (sum, (a - (sum - rest)) + (b - rest))
}

/// The rounded product and its exact error.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// Algorithm 6, `AccurateDWPlusDW`.
fn sum(a: Dd, b: Dd) -> Dd {
    let (high, high_error) = two_sum(a.hi, b.hi);
    if !high.is_finite() {
        return Dd::from(high);
    }
    let (low, low_error) = two_sum(a.lo, b.lo);
    let partial = Dd::from_ordered(high, high_error + low);
    Dd::from_ordered(partial.hi, low_error + partial.lo)
}

/// Algorithm 12, `DWTimesDW3`.
fn product(a: Dd, b: Dd) -> Dd {
    let (high, error) = two_product(a.hi, b.hi);
    if !high.is_finite() {
        return Dd::from(high);
    }
    let cross = a.lo.mul_add(b.hi, a.hi.mul_add(b.lo, a.lo * b.lo));
    Dd::from_ordered(high, error + cross)
}

/// Algorithm 7, `DWTimesFP1`.
fn product_with_f64(a: Dd, b: f64) -> Dd {
    let (high, error) = two_product(a.hi, b);
    let partial = Dd::from_ordered(high, a.lo * b);
    Dd::from_ordered(partial.hi, partial.lo + error)
}

/// Algorithm 17, `DWDivDW2`.
fn quotient(a: Dd, b: Dd) -> Dd {
    let high = a.hi / b.hi;
    if !high.is_finite() || !b.is_finite() {
        return Dd::from(high);
    }
    let back = product_with_f64(b, high);
    let rest = (a.hi - back.hi) + (a.lo - back.lo);
    Dd::from_ordered(high, rest / b.hi)
}

/// Σ (−square)ⁱ / (2i + first)! · first!, i from 0: cos x for `first` = 0 and sin x / x for `first` = 1, with
/// square = x². Sixteen terms leave less than 1e-38 for x ≤ π/4.
fn alternating_series(square: Dd, first: u32) -> Dd {
    let one = Dd::from(1.0);
    (1..=16).rev().fold(one, |total, i| {
        let last = 2 * i + first;
        one - square * total / Dd::from(f64::from(last * (last - 1)))
    })
}

/// eˣ for |x| ≤ ln 2 / 2: 26 terms of the Taylor series leave less than 1e-39.
fn exp_near_zero(x: Dd) -> Dd {
    let one = Dd::from(1.0);
    (1..=26)
        .rev()
        .fold(one, |total, i| one + x * total / Dd::from(f64::from(i)))
}

/// ln x = 2 artanh((x − 1)/(x + 1)) for x from 1/√2 to √2: 24 terms of the series leave less than 1e-37,
/// relative to the result.
fn ln_near_one(x: Dd) -> Dd {
    let one = Dd::from(1.0);
    let z = (x - one) / (x + one);
    let square = z * z;
    let series = (0..24).rev().fold(Dd::from(0.0), |total, i| {
        total * square + one / Dd::from(f64::from(2 * i + 1))
    });
    Dd::from(2.0) * z * series
}

impl From<f64> for Dd {
    fn from(x: f64) -> Dd {
        Dd { hi: x, lo: 0.0 }
    }
}

impl Add for Dd {
    type Output = Dd;

    fn add(self, other: Dd) -> Dd {
        sum(self, other)
    }
}

impl Sub for Dd {
    type Output = Dd;

    fn sub(self, other: Dd) -> Dd {
        sum(self, -other)
    }
}

impl Mul for Dd {
    type Output = Dd;

    fn mul(self, other: Dd) -> Dd {
        product(self, other)
    }
}

impl Div for Dd {
    type Output = Dd;

    fn div(self, other: Dd) -> Dd {
        quotient(self, other)
    }
}

impl Neg for Dd {
    type Output = Dd;

    fn neg(self) -> Dd {
        Dd {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl Num for Dd {
    fn from_f64(x: f64) -> Dd {
        Dd::from(x)
    }

    fn to_f64(self) -> f64 {
        self.hi
    }

    fn abs(self) -> Dd {
        if self.hi.is_sign_negative() {
            -self
        } else {
            self
        }
    }

    fn min(self, other: Dd) -> Dd {
        if other < self || self.hi.is_nan() {
            other
        } else {
            self
        }
    }

    fn max(self, other: Dd) -> Dd {
        if other > self || self.hi.is_nan() {
            other
        } else {
            self
        }
    }

    /// Algorithm 8, `SQRTDWtoDW`.
    fn sqrt(self) -> Dd {
        let high = self.hi.sqrt();
        if high == 0.0 || !high.is_finite() {
            return Dd::from(high);
        }
        let rest = self.lo + (-high).mul_add(high, self.hi);
        Dd::from_ordered(high, rest / (2.0 * high))
    }

    /// 2ˣ = 2ⁱ e^(f ln 2), x = i + f.
    fn exp2(self) -> Dd {
        // Outside the range of f64 the native function already gives 0, ∞ or NaN.
        if self.hi.abs() >= 1100.0 || self.hi.is_nan() {
            return Dd::from(libm::exp2(self.hi));
        }
        let whole = self.hi.round();
        exp_near_zero((self - Dd::from(whole)) * LN_2).scaled(whole as i32)
    }

    /// log₂ x = i + ln(x / 2ⁱ) / ln 2. The result keeps its relative accuracy near x = 1.
    fn log2(self) -> Dd {
        if self.hi <= 0.0 || !self.is_finite() {
            return Dd::from(libm::log2(self.hi));
        }
        let (fraction, exponent) = libm::frexp(self.hi);
        let power = exponent - i32::from(fraction < FRAC_1_SQRT_2);
        Dd::from(f64::from(power)) + ln_near_one(self.scaled(-power)) / LN_2
    }

    fn sin(self) -> Dd {
        self.turned(0)
    }

    fn cos(self) -> Dd {
        self.turned(1)
    }

    fn less(self, other: Dd) -> Truth {
        (self < other).into()
    }
}

/// Expected values are (hi, lo) of the value at 300 bits (mpmath 1.3.0).
#[track_caller]
fn check(got: Dd, hi: f64, lo: f64) {
    let error = (got - Dd { hi, lo }).hi.abs() / hi.abs();
    assert!(error < 1e-30, "{got:?}: {error:e} from ({hi:e}, {lo:e})");
}

#[test]
fn arithmetic_against_known_digits() {
    check(Dd::from(2.0).sqrt(), SQRT_2, -9.667293313452913e-17);
    check(
        Dd::from(0.1).sqrt(),
        0.31622776601683794,
        8.004969469767158e-19,
    );
    check(
        Dd::from(1.0) / Dd::from(3.0),
        0.3333333333333333,
        1.850371707708594e-17,
    );
    let third = Dd::from(1.0) / Dd::from(3.0);
    check(third + third + third, 1.0, 0.0);
    check(third * Dd::from(3.0), 1.0, 0.0);
    let small = Dd::from(1e-25);
    assert_eq!((Dd::from(1.0) + small) - Dd::from(1.0), small);
    check(PI / PI, 1.0, 0.0);
    check((PI * PI).sqrt(), PI.hi, PI.lo);
}

#[test]
fn waves_against_known_digits() {
    check(
        Dd::from(1.0).sin(),
        0.8414709848078965,
        1.776845092935536e-18,
    );
    check(
        Dd::from(1.0).cos(),
        0.5403023058681398,
        -4.760954612604417e-17,
    );
    check(
        Dd::from(-20.5).sin(),
        -0.9968297942787993,
        5.1500577974843045e-18,
    );
    check(
        Dd::from(100.0).cos(),
        0.8623188722876839,
        4.334809858136501e-17,
    );
}

#[test]
fn exp2_against_known_digits() {
    check(
        Dd::from(0.1).exp2(),
        1.0717734625362931,
        3.7228133986653606e-17,
    );
    check(
        Dd::from(-0.3).exp2(),
        0.8122523963562356,
        -5.534680269627686e-17,
    );
    check(
        Dd::from(1.5).exp2(),
        2.8284271247461903,
        -1.9334586626905827e-16,
    );
    check(
        Dd::from(100.7).exp2(),
        2.0593044755556034e+30,
        -39899919515258.91,
    );
    check(
        Dd::from(-40.25).exp2(),
        7.647908344131015e-13,
        3.728478086751009e-29,
    );
    check(
        Dd::from(1e-9).exp2(),
        1.000000000693147,
        8.55237134015003e-17,
    );
}

#[test]
fn log2_against_known_digits() {
    check(
        Dd::from(3.0).log2(),
        1.584962500721156,
        1.0579781240112554e-16,
    );
    check(Dd::from(0.1).log2(), -LOG2_10, -8.607608910198627e-17);
    check(
        Dd::from(1.0000001).log2(),
        1.4426949695965583e-07,
        6.897421541207991e-24,
    );
    check(
        Dd::from(1e-300).log2(),
        -996.5784284662087,
        1.591283017612134e-14,
    );
    check(
        Dd::from(0.9999).log2(),
        -0.00014427671804501932,
        4.184500412756758e-21,
    );
    check(
        Dd::from(SQRT_2).log2(),
        0.5000000000000001,
        -1.2402429953768678e-17,
    );
    check(Dd::from(10.0).log2(), LOG2_10, 1.661617516973592e-16);
    assert_eq!(Dd::from(8.0).log2(), Dd::from(3.0));
}

#[track_caller]
fn check_angle(theta_degrees: f64, sine: (f64, f64), cosine: (f64, f64)) {
    let (s, c) = Dd::sin_cos_degrees(theta_degrees);
    check(s, sine.0, sine.1);
    check(c, cosine.0, cosine.1);
}

#[test]
fn sin_cos_against_known_digits() {
    let root3_half = (0.8660254037844386, 5.0175421109034514e-17);
    let root_half = (FRAC_1_SQRT_2, -4.833646656726457e-17);
    check_angle(30.0, (0.5, 0.0), root3_half);
    check_angle(60.0, root3_half, (0.5, 0.0));
    check_angle(45.0, root_half, root_half);
    check_angle(
        89.999,
        (0.9999999998476913, 1.1299821185438429e-17),
        (1.7453292519140536e-05, 1.9719574240956787e-22),
    );
    check_angle(
        1e-5,
        (1.745329251994321e-07, -6.184061021004098e-24),
        (0.9999999999999848, -2.0815551970749192e-17),
    );
    check_angle(
        41.81031489577862,
        (0.666666666666667, -4.345957372048854e-17),
        (0.7453559924999297, -3.0942808468523818e-18),
    );
    assert_eq!(Dd::sin_cos_degrees(0.0), (Dd::from(0.0), Dd::from(1.0)));
    assert_eq!(Dd::sin_cos_degrees(90.0), (Dd::from(1.0), Dd::from(0.0)));
}

#[test]
fn infinities_zeros_and_nans() {
    let (zero, one, infinity) = (Dd::from(0.0), Dd::from(1.0), Dd::from(f64::INFINITY));
    assert_eq!(zero.sqrt(), zero);
    assert_eq!(infinity.sqrt(), infinity);
    assert_eq!(one / zero, infinity);
    assert_eq!(one / infinity, zero);
    assert_eq!(infinity + PI, infinity);
    assert_eq!(PI * infinity, infinity);
    assert_eq!(Dd::from(1e200) * Dd::from(1e200), infinity);
    assert_eq!(zero.log2(), -infinity);
    assert_eq!(infinity.exp2(), infinity);
    assert_eq!((-infinity).exp2(), zero);
    assert!(Dd::from(-1.0).sqrt().hi.is_nan());
    assert!(Dd::from(f64::NAN).exp2().hi.is_nan());
    assert!(PI > Dd::from(PI.hi) && Dd::from(PI.hi).less(PI) == Truth::Yes);
}
