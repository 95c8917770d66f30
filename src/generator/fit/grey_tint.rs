//! The one tint of F82-tint that serves all three channels of a material best. Textures of metallic-roughness materials have
//! one channel for the specular strength of dielectrics, which metals leave unused: this number fits there.
//!
//! At each angle F82-tint rises with the tint, so that the distance to the reference falls and then rises; so does the largest of
//! all distances, and a golden section finds where it is least. The tint lies in [0, 1], as a texture's channel does. 1 is
//! Schlick's approximation, so that no material is worse for it.

use serde::Serialize;

use crate::generator::reference::{ANGLES, ReferenceCurve, cosines};
use crate::language::ir::{Checked, Value};
use crate::language::methods::{self, Input, Method, Values};

use super::best_inputs::values_at;
use super::model_error::{difference, error_of};

/// A tint for all channels, and its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GreyTint {
    /// The tint, in [0, 1].
    pub tint: f64,
    /// The largest error of F82-tint with it, over angles and channels.
    pub max_abs: f64,
    /// The cosine there.
    pub worst_cos: f64,
    /// The largest error of Schlick's approximation, which is F82-tint with a tint of 1.
    pub schlick_max_abs: f64,
}

/// How often the interval is shortened, by this ratio, (√5 - 1)/2: to 1e-7.
const SECTIONS: usize = 34;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

struct Tinted<'a> {
    method: &'static Method,
    function: Checked,
    f0: [f64; 3],
    reference: &'a ReferenceCurve,
    cosines: Vec<f64>,
    seen: Vec<[f64; 3]>,
}

/// The best grey tint of a material as it is seen.
pub fn grey_tint(reference: &ReferenceCurve) -> GreyTint {
    let method = methods::find("f82_tint").expect("it is a method");
    let tinted = Tinted {
        method,
        function: method.function(false).expect("a test builds every method"),
        f0: reference.at(1.0),
        reference,
        cosines: cosines(ANGLES),
        seen: reference.table(),
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..SECTIONS {
        let [left, right] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        // Where the tint is so small that all is 0, both are equal, and the least lies above.
        if tinted.largest(left) < tinted.largest(right) {
            high = right;
        } else {
            low = left;
        }
    }
    let middle = 0.5 * (low + high);
    let best = [middle, 1.0].map(|tint| tinted.error(tint));
    let schlick_max_abs = best[1].max_abs;
    let [found, schlick] = best;
    let least = if found.max_abs < schlick.max_abs {
        found
    } else {
        schlick
    };
    GreyTint {
        schlick_max_abs,
        ..least
    }
}

impl Tinted<'_> {
    fn values(&self, tint: f64, cosines: &[f64]) -> Value<f64> {
        let values = [(Input::F0, self.f0), (Input::TINT, [tint; 3])];
        let values: Values = values
            .map(|(input, value)| (input.name.to_owned(), value))
            .into();
        values_at(&self.function, self.method.inputs, &values, cosines)
    }

    /// The largest error at the angles.
    fn largest(&self, tint: f64) -> f64 {
        difference(&self.values(tint, &self.cosines), &self.seen, &self.cosines).max_abs
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
