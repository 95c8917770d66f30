//! [`Precision`], in which generated code computes, and the unit in the last place of `f32`, in which code error is measured.

use serde::{Deserialize, Serialize};

use super::{Half, Num};

/// The precision in which generated code computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// Single precision: `f32`, `float`, `highp`.
    #[default]
    F32,
    /// Half precision: `f16`, `half`, `mediump`.
    F16,
}

impl Precision {
    /// Both.
    pub const ALL: [Precision; 2] = [Precision::F32, Precision::F16];

    /// The name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F16 => "f16",
        }
    }

    /// The precision of this name.
    ///
    /// ```
    /// use fresnel_gen::Precision;
    ///
    /// assert_eq!(Precision::find("f16"), Some(Precision::F16));
    /// ```
    pub fn find(name: &str) -> Option<Precision> {
        let mut all = Precision::ALL.into_iter();
        all.find(|precision| precision.name() == name)
    }

    /// The suffix of names of functions and files.
    #[doc(hidden)]
    pub fn suffix(self) -> &'static str {
        match self {
            Precision::F32 => "",
            Precision::F16 => "_f16",
        }
    }

    /// Whether it is half precision.
    pub fn is_half(self) -> bool {
        self == Precision::F16
    }

    /// The smallest normal number. Hardware may flush smaller ones to 0.
    #[doc(hidden)]
    pub fn smallest(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::MIN_POSITIVE),
            Precision::F16 => 1.0 / 16_384.0,
        }
    }

    /// A constant rounded to this precision; infinite where it is too large.
    #[doc(hidden)]
    pub fn rounded(self, x: f64) -> f64 {
        match self {
            Precision::F32 => f64::from(x as f32),
            Precision::F16 => Half::from_f64(x).to_f64(),
        }
    }
}

/// The spacing of `f32` in the binade of |x|: 2^(e − 23) for 2^e ≤ |x| < 2^(e + 1), and 2⁻¹⁴⁹ below the smallest
/// normal number. From 2¹²⁸ on (and for infinities and NaN) the spacing of the last binade, 2¹⁰⁴.
pub fn ulp_of(x: f64) -> f64 {
    let biased_exponent = (x.to_bits() >> 52) & 0x7ff;
    let exponent = (biased_exponent as i64 - 1023).clamp(-126, 127);
    // 23 bits follow the leading one; the sum is the biased exponent of a normal f64.
    f64::from_bits(((exponent - 23 + 1023) as u64) << 52)
}

/// |got − want| in units of [`ulp_of`]`(want)`.
///
/// Where either is infinite or a NaN: 0 if `got` is what `want` rounds to (any NaN for a NaN), else infinity.
///
/// ```
/// use fresnel_gen::physics::num::ulp_distance;
///
/// assert_eq!(ulp_distance(1.0 + f32::EPSILON, 1.0), 1.0);
/// ```
pub fn ulp_distance(got: f32, want: f64) -> f64 {
    if got.is_finite() && want.is_finite() {
        return (f64::from(got) - want).abs() / ulp_of(want);
    }
    let nearest = want as f32;
    if got == nearest || (got.is_nan() && want.is_nan()) {
        0.0
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_again() {
        for precision in Precision::ALL {
            assert_eq!(Precision::find(precision.name()), Some(precision));
        }
        assert_eq!(Precision::find("f64"), None);
    }

    #[test]
    fn the_ends_of_half_precision() {
        let half = Precision::F16;
        assert_eq!(half.rounded(half.smallest()), half.smallest());
        assert_eq!(half.rounded(65_504.0), 65_504.0);
        assert_eq!(half.rounded(65_520.0), f64::INFINITY);
    }

    #[test]
    fn spacing_is_that_of_f32() {
        assert_eq!(ulp_of(1.0), f64::from(f32::EPSILON));
        assert_eq!(ulp_of(-1.999), f64::from(f32::EPSILON));
        assert_eq!(ulp_of(0.999), f64::from(f32::EPSILON) / 2.0);
        let smallest = f64::from(f32::from_bits(1));
        assert_eq!(ulp_of(0.0), smallest);
        assert_eq!(ulp_of(f64::from(f32::MIN_POSITIVE)), smallest);
        assert_eq!(ulp_of(1e-300), smallest);
        assert_eq!(ulp_of(f64::from(f32::MAX)), 104f64.exp2());
        assert_eq!(ulp_of(1e300), 104f64.exp2());
    }

    #[test]
    fn neighbours_are_one_apart() {
        for x in [1.0f32, 0.3, 1e-20, 1e-40, 3e38] {
            assert_eq!(ulp_distance(x.next_up(), f64::from(x)), 1.0, "{x}");
        }
        assert_eq!(ulp_distance(1.0, 1.0 + 2f64.powi(-24)), 0.5);
    }

    #[test]
    fn infinities_and_nans() {
        let (single, double) = (f32::INFINITY, f64::INFINITY);
        assert_eq!(ulp_distance(f32::NAN, 1.0), double);
        assert_eq!(ulp_distance(1.0, f64::NAN), double);
        assert_eq!(ulp_distance(f32::NAN, f64::NAN), 0.0);
        assert_eq!(ulp_distance(single, double), 0.0);
        assert_eq!(ulp_distance(single, 1e39), 0.0);
        assert_eq!(ulp_distance(single, 1.0), double);
        assert_eq!(ulp_distance(-single, double), double);
    }
}
