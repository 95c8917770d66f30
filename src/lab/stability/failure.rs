//! What can be wrong with a result, and by how much it is.

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
    /// Above 1, or above F0 where that is more.
    AboveOne,
    /// A step between neighbouring cosines that is larger than the slope allows.
    Jump,
    /// So many units of the last place from what the same formula gives in f64 at this cosine or within two last places of it.
    Digits(f64),
    /// So far from what the same formula gives in f64: what counts where numbers have no digits to lose.
    Off(f64),
    /// So far from the law.
    Error(f64),
    /// Rises where the law falls, or falls where it rises.
    Monotony,
    /// The law falls below its value at 0 degrees, as it does for metals, and this does not.
    Minimum,
}

impl Failure {
    /// All, the gravest first; of each kind the highest level first.
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

    /// As the end of a sentence about a result: only for what a result is by itself, without others to compare it with.
    pub fn predicate(self) -> Option<&'static str> {
        match self {
            Failure::NotANumber => Some("is NaN"),
            Failure::Infinite => Some("is infinite"),
            Failure::Negative => Some("is below 0"),
            Failure::AboveOne => Some("is above 1"),
            _ => None,
        }
    }

    /// What three channels are by themselves, where they are no reflectance: the gravest of their failures. `most` is what
    /// each channel may reach, and `rounding` how far beyond its range it may lie.
    pub fn of_result(rgb: [f32; 3], most: [f32; 3], rounding: f32) -> Option<Failure> {
        let holds = |failure: &&Failure| {
            let mut channels = rgb.into_iter().zip(most);
            channels.any(|(value, most)| match failure {
                Failure::NotANumber => value.is_nan(),
                Failure::Infinite => value.is_infinite(),
                Failure::Negative => value < -rounding,
                Failure::AboveOne => value > most + rounding,
                _ => false,
            })
        };
        Failure::ALL.iter().find(holds).copied()
    }

    /// Whether it is the formula's fault, not that of its rounding. It is then told of whole curves: where a formula is off, its
    /// medium says most.
    pub fn is_of_the_model(self) -> bool {
        matches!(
            self,
            Failure::Error(_) | Failure::Monotony | Failure::Minimum
        )
    }
}

/// A result at a cosine and at the next one, and what it should be.
#[derive(Clone, Copy, Debug)]
pub struct ResultPoint {
    /// The cosine.
    pub cos_theta: f64,
    /// What came.
    pub got: f64,
    /// What came at the next cosine.
    pub next: f64,
    /// What the formula means.
    pub want: f64,
    /// The least and the most that it means at this cosine and at those [`NEAR`] last places from it.
    pub around: (f64, f64),
    /// What the law says, where there is a law.
    pub law: Option<f64>,
    /// What a result may not exceed.
    pub limit: f64,
    /// The spacing of numbers of this kind, in that of f32.
    pub spacing: f64,
}

/// So many last places of the cosine a result may be off besides its own: at a square root's singularity (the critical
/// angle) and at a zero (Brewster's) no rounding could do better.
pub const NEAR: i32 = 2;
/// A step that no slope explains.
const STEP: f64 = 1e-3;
/// The same in half precision, where a last place near 1 is 5e-4.
const HALF_STEP: f64 = 1e-2;
/// Below this a reflectance is nothing, and has no digits to lose.
const LEAST: f64 = 1e-20;

impl ResultPoint {
    /// By how much it fails in this way; 0 where it does not.
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

    /// How far the formula is from the law.
    pub fn error(&self) -> f64 {
        self.law.map_or(0.0, |law| (self.want - law).abs())
    }

    fn is_single(&self) -> bool {
        self.spacing == 1.0
    }

    fn is_finite(&self) -> bool {
        self.got.is_finite() && self.around.0.is_finite() && self.around.1.is_finite()
    }

    /// How far the result is from what it may be.
    fn off(&self) -> f64 {
        let (least, most) = self.around;
        f64::max(least - self.got, self.got - most).max(0.0)
    }

    /// How many last places the result is off.
    pub fn digits(&self) -> f64 {
        if is_flushed(self.cos_theta) || self.want.abs() < LEAST || !self.is_finite() {
            return 0.0;
        }
        self.off() / (ulp_of(self.want) * self.spacing)
    }
}

/// Whether a number is so small that a GPU may take it for 0.
pub fn is_flushed(x: f64) -> bool {
    x != 0.0 && x.abs() < f64::from(f32::MIN_POSITIVE)
}
