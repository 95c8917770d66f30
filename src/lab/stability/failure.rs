//! The ways in which a result can fail, and the amount of each failure.

use crate::physics::num::ulp_of;

/// A way to fail.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Failure {
    /// Not a number.
    NotANumber,
    /// Infinite.
    Infinite,
    /// Below 0.
    Negative,
    /// Above 1, or above F0 where that is larger.
    AboveOne,
    /// A step between neighbouring cosines that is larger than the slope allows.
    Jump,
    /// More than so many ulp from the same formula in f64 at this cosine or within two ulp of it, in single precision.
    Digits(f64),
    /// More than this absolute difference from the same formula in f64, in half precision, which has no digits to lose.
    Off(f64),
    /// More than this absolute difference between formula and law.
    Error(f64),
    /// Rises where the law falls, or falls where it rises.
    Monotony,
    /// The law falls below its value at 0 degrees, as it does for metals, and this does not.
    Minimum,
}

impl Failure {
    /// All failures, the gravest first, and the highest level of each kind first.
    pub const ALL: [Failure; 14] = [
        Failure::NotANumber,
        Failure::Infinite,
        Failure::Negative,
        Failure::AboveOne,
        Failure::Jump,
        Failure::Digits(1000.0),
        Failure::Digits(16.0),
        Failure::Off(0.1),
        Failure::Off(0.01),
        Failure::Error(0.2),
        Failure::Error(0.05),
        Failure::Error(0.01),
        Failure::Monotony,
        Failure::Minimum,
    ];

    /// In words.
    pub fn words(self) -> String {
        match self {
            Failure::NotANumber => "NaN".to_owned(),
            Failure::Infinite => "infinity".to_owned(),
            Failure::Negative => "negative".to_owned(),
            Failure::AboveOne => "above 1".to_owned(),
            Failure::Jump => "jump".to_owned(),
            Failure::Digits(ulp) => format!("more than {ulp} ulp off"),
            Failure::Off(level) => format!("more than {level} off"),
            Failure::Error(level) => format!("error above {level}"),
            Failure::Monotony => "wrong monotony".to_owned(),
            Failure::Minimum => "missed minimum".to_owned(),
        }
    }

    /// The end of a sentence about a result. Only for failures of a result by itself, without others to compare it with.
    pub fn predicate(self) -> Option<&'static str> {
        match self {
            Failure::NotANumber => Some("is NaN"),
            Failure::Infinite => Some("is infinite"),
            Failure::Negative => Some("is below 0"),
            Failure::AboveOne => Some("is above 1"),
            _ => None,
        }
    }

    /// The gravest failure of three channels by themselves. None if they are a reflectance. `limits` are the largest allowed
    /// values, and `rounding` the tolerance beyond their range.
    pub fn of_result(rgb: [f32; 3], limits: [f32; 3], rounding: f32) -> Option<Failure> {
        let holds = |failure: &&Failure| {
            let mut channels = rgb.into_iter().zip(limits);
            channels.any(|(value, limit)| match failure {
                Failure::NotANumber => value.is_nan(),
                Failure::Infinite => value.is_infinite(),
                Failure::Negative => value < -rounding,
                Failure::AboveOne => value > limit + rounding,
                _ => false,
            })
        };
        Failure::ALL.iter().find(holds).copied()
    }

    /// Whether it is the formula's fault, not that of its rounding. Such failures are reported for whole curves, since they
    /// depend mainly on the medium.
    pub fn is_of_the_model(self) -> bool {
        matches!(
            self,
            Failure::Error(_) | Failure::Monotony | Failure::Minimum
        )
    }
}

/// A result at a cosine and at the next one, and the expected values.
#[derive(Clone, Copy, Debug)]
pub struct ResultPoint {
    /// The cosine.
    pub cos_theta: f64,
    /// The result.
    pub got: f64,
    /// The result at the next cosine.
    pub next: f64,
    /// The value of the formula in f64.
    pub want: f64,
    /// The smallest and the largest value of the formula at this cosine and within [`NEAR`] ulp of it.
    pub around: (f64, f64),
    /// The value of the law, where there is a law.
    pub law: Option<f64>,
    /// The largest allowed result.
    pub limit: f64,
    /// The spacing of numbers of this precision, in units of that of f32.
    pub spacing: f64,
}

/// The tolerance in ulp of the cosine. At a square root's singularity (the critical angle) and at a zero (Brewster's angle) no
/// rounding could do better.
pub const NEAR: i32 = 2;
/// A step that no slope explains, in single precision.
const STEP: f64 = 1e-3;
/// Such a step in half precision, where one ulp near 1 is 5e-4.
const HALF_STEP: f64 = 1e-2;
/// Below this a reflectance counts as 0 and has no digits to lose.
const LEAST: f64 = 1e-20;

impl ResultPoint {
    /// By how much it fails in this way. 0 where it does not.
    pub fn amount(&self, failure: Failure) -> f64 {
        let above = |x: f64, level: f64| if x > level { x } else { 0.0 };
        match failure {
            Failure::NotANumber => f64::from(u8::from(self.got.is_nan())),
            Failure::Infinite => f64::from(u8::from(self.got.is_infinite())),
            Failure::Negative => above(-self.got, 0.0),
            Failure::AboveOne if self.got.is_infinite() => 0.0,
            Failure::AboveOne => above(self.got - self.limit, 0.0),
            Failure::Jump => above(
                (self.next - self.got).abs() - (self.around.1 - self.around.0),
                if self.is_single() { STEP } else { HALF_STEP },
            ),
            Failure::Digits(_) | Failure::Off(_) if !self.is_finite() => 0.0,
            Failure::Digits(ulp) if self.is_single() => above(self.digits(), ulp),
            Failure::Off(level) if !self.is_single() => above(self.off(), level),
            Failure::Digits(_) | Failure::Off(_) => 0.0,
            Failure::Error(level) => above(self.error(), level),
            Failure::Monotony | Failure::Minimum => 0.0,
        }
    }

    /// The absolute difference between formula and law.
    pub fn error(&self) -> f64 {
        self.law.map_or(0.0, |law| (self.want - law).abs())
    }

    fn is_single(&self) -> bool {
        self.spacing == 1.0
    }

    fn is_finite(&self) -> bool {
        self.got.is_finite() && self.around.0.is_finite() && self.around.1.is_finite()
    }

    /// How far the result lies outside the range of `around`.
    fn off(&self) -> f64 {
        let (least, most) = self.around;
        f64::max(least - self.got, self.got - most).max(0.0)
    }

    /// How far the result lies outside the range of `around`, in ulp.
    pub fn digits(&self) -> f64 {
        if is_flushed(self.cos_theta) || self.want.abs() < LEAST || !self.is_finite() {
            return 0.0;
        }
        self.off() / (ulp_of(self.want) * self.spacing)
    }
}

/// Whether a number is so small that a GPU may flush it to 0.
pub fn is_flushed(x: f64) -> bool {
    x != 0.0 && x.abs() < f64::from(f32::MIN_POSITIVE)
}
