//! The best single F82 tint for all three channels of a material, and reflectance from two colours.
//!
//! Textures of metallic-roughness materials have one channel for the specular strength of dielectrics, which metals leave unused:
//! a single tint fits there. At each angle, F82-tint rises with the tint, so the distance to the reference falls and then rises.
//! So does the largest distance, and a golden-section search finds its minimum. The tint lies in [0, 1], as a texture's channel
//! does. 1 is Schlick's approximation, so no material is worse for it.
//!
//! [`Follows`] gives reflectance at every angle from two colours alone, as artists give them: at 0 and at 81.79 degrees. Where an
//! index has both ([`index_from_f0_f82`]), the result is that index's, by the exact law. Where none has them, or where F0 is so
//! large that F82 decides between indices far from any metal, the result is that of the method `f82_tint`, which matches any two.

use std::sync::LazyLock;

use serde::Serialize;

use super::best_inputs::values_at;
use super::model_error::{difference, error_of};
use crate::generator::reference::{COSINES, ReferenceCurve};
use crate::language::ir::{Checked, Value, evaluate};
use crate::language::methods::{self, Input, Method, Values, schlick_82};
use crate::physics::optics::{self, EffectiveIndex, index_from_f0_f82};

/// The tint for all channels, and its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GreyTint {
    /// The tint, in [0, 1].
    pub tint: f64,
    /// Its largest error, over angles and channels.
    pub max_abs: f64,
    /// The cosine of the largest error.
    pub worst_cos: f64,
    /// The largest error of Schlick's approximation, which is F82-tint with a tint of 1.
    pub schlick_max_abs: f64,
}

/// The steps of the golden-section search, each by the ratio (√5 - 1)/2: to 1e-7.
const SECTIONS: usize = 34;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

struct Tinted<'a> {
    method: &'static Method,
    function: Checked,
    f0: [f64; 3],
    reference: &'a ReferenceCurve,
    seen: Vec<[f64; 3]>,
}

/// The best grey tint of a material under viewing conditions.
pub fn grey_tint(reference: &ReferenceCurve) -> GreyTint {
    let method = methods::find("f82_tint").expect("it is a method");
    let tinted = Tinted {
        method,
        function: method.function(false).expect("a test builds every method"),
        f0: reference.at(1.0),
        reference,
        seen: reference.table(),
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..SECTIONS {
        let [left, right] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        // Where the tint is so small that every value is 0, both are equal and the minimum lies above.
        if tinted.largest(left) < tinted.largest(right) {
            high = right;
        } else {
            low = left;
        }
    }
    let [found, schlick] = [0.5 * (low + high), 1.0].map(|tint| tinted.error(tint));
    let least = if found.max_abs < schlick.max_abs {
        found
    } else {
        schlick
    };
    GreyTint {
        schlick_max_abs: schlick.max_abs,
        ..least
    }
}

impl Tinted<'_> {
    fn values(&self, tint: f64, cosines: &[f64]) -> Value<f64> {
        let values = [(Input::F0, self.f0), (Input::TINT, [tint; 3])];
        let values: Values = values.map(|(input, v)| (input.name.to_owned(), v)).into();
        values_at(&self.function, self.method.inputs, &values, cosines)
    }

    /// The largest error at the angles.
    fn largest(&self, tint: f64) -> f64 {
        difference(&self.values(tint, &COSINES), &self.seen, &COSINES).max_abs
    }

    fn error(&self, tint: f64) -> GreyTint {
        let error = error_of(self.reference, &|cosines| self.values(tint, cosines));
        GreyTint {
            tint,
            max_abs: error.max_abs,
            worst_cos: error.worst_cos,
            schlick_max_abs: error.max_abs,
        }
    }
}

/// The largest F0 for which an index is solved. Above it, a hundredth of F82 moves n by more than its half.
const LARGEST_SOLVED_F0: f64 = 0.985;

/// The reflectance curve of a channel with two given colours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Follows {
    /// The exact law of an index.
    Law {
        /// Its real part.
        n: f64,
        /// Its extinction coefficient.
        k: f64,
    },
    /// The method `f82_tint`: no index has these colours.
    F82Tint {
        /// Reflectance at 0 degrees.
        f0: f64,
        /// Reflectance at 81.79 degrees, divided by Schlick's value there.
        tint: f64,
    },
}

impl Follows {
    /// The curve through two reflectances, at 0 and at 81.79 degrees.
    pub fn of(f0: f64, f82: f64) -> Follows {
        let EffectiveIndex { n, k, exact } = index_from_f0_f82(f0, f82);
        if exact && f0 < LARGEST_SOLVED_F0 {
            return Follows::Law { n, k };
        }
        let tint = f82 / schlick_82(f0);
        Follows::F82Tint { f0, tint }
    }

    /// The reflectance at a cosine.
    pub fn at(&self, cos_theta: f64) -> f64 {
        match *self {
            Follows::Law { n, k } => optics::conductor(n, k, cos_theta).unpolarised(),
            Follows::F82Tint { f0, tint } => {
                let arguments = [cos_theta, f0, tint].map(Value::scalar);
                evaluate::<f64>(&F82_TINT, &arguments).at(0)[0]
            }
        }
    }
}

/// The method `f82_tint` for one channel: of the cosine, F0 and the tint.
static F82_TINT: LazyLock<Checked> = LazyLock::new(|| {
    let method = methods::find("f82_tint").expect("a test follows it");
    method.function(true).expect("a test builds every method")
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_colours_are_met_by_whatever_is_followed() {
        for (f0, f82, is_law) in [
            (0.04, 0.46, true),
            (0.9, 0.9, true),
            (0.95, 0.97, true),
            // Darker at 82 degrees than any index with this F0, and too bright at 0.
            (0.9, 0.2, false),
            (0.99, 0.99, false),
        ] {
            let follows = Follows::of(f0, f82);
            assert_eq!(
                matches!(follows, Follows::Law { .. }),
                is_law,
                "{follows:?}"
            );
            assert!((follows.at(1.0) - f0).abs() < 1e-9, "{follows:?}");
            assert!(
                (follows.at(optics::COS_82) - f82).abs() < 1e-9,
                "{follows:?}"
            );
        }
    }
}
