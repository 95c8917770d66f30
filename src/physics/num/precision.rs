//! [`Precision`]: what generated code computes in.

use super::{Half, Num};

/// The kind of number that generated code computes with.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    serde::Serialize,
    serde::Deserialize,
)]
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
            Precision::F32 => f32::NAME,
            Precision::F16 => Half::NAME,
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
        Precision::ALL
            .into_iter()
            .find(|precision| precision.name() == name)
    }

    /// What the names of functions and files end in.
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

    /// The smallest normal number: hardware may take what is smaller for 0.
    #[doc(hidden)]
    pub fn smallest(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::MIN_POSITIVE),
            Precision::F16 => 1.0 / 16_384.0,
        }
    }

    /// The number that a constant becomes; infinite where it is too large.
    #[doc(hidden)]
    pub fn rounded(self, x: f64) -> f64 {
        match self {
            Precision::F32 => f64::from(x as f32),
            Precision::F16 => Half::from_f64(x).to_f64(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Precision;

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
}
