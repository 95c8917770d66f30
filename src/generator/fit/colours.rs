//! Reflectance at every angle from two colours alone, as artists give them: at 0 degrees and at 81.79.
//!
//! Where an index has both ([`index_from_f0_f82`]) it is that index's, by the exact law. Where none has them, or F0 is so large that
//! F82 decides between indices far from any metal, it is that of the method `f82_tint`, which meets any two.

use std::sync::LazyLock;

use crate::language::ir::{Checked, Value, evaluate};
use crate::language::methods::{self, schlick_82};
use crate::physics::optics::{self, EffectiveIndex, index_from_f0_f82};

/// The largest F0 that is taken for an index's. From here on a hundredth of F82 moves n by more than its half.
pub const LARGEST_SOLVED_F0: f64 = 0.985;

/// What a channel follows between its two colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follows {
    /// The exact law of this index.
    Law(EffectiveIndex),
    /// The method `f82_tint`: no index has these colours.
    Tint {
        /// At 0 degrees.
        f0: f64,
        /// At 81.79 degrees, over Schlick's value there.
        tint: f64,
    },
}

impl Follows {
    /// What a channel of these two reflectances follows.
    pub fn of(f0: f64, f82: f64) -> Follows {
        let index = index_from_f0_f82(f0, f82);
        if index.exact && f0 < LARGEST_SOLVED_F0 {
            return Follows::Law(index);
        }
        let tint = f82 / schlick_82(f0);
        Follows::Tint { f0, tint }
    }

    /// The reflectance at a cosine.
    pub fn at(&self, cos_theta: f64) -> f64 {
        match *self {
            Follows::Law(index) => optics::conductor(index.n, index.k, cos_theta).unpolarised(),
            Follows::Tint { f0, tint } => tinted(f0, tint, cos_theta),
        }
    }
}

/// The method `f82_tint` for one channel: of the cosine, F0 and the tint.
static F82_TINT: LazyLock<Checked> = LazyLock::new(|| {
    let method = methods::find("f82_tint").expect("a test follows it");
    method.function(true).expect("a test builds every method")
});

fn tinted(f0: f64, tint: f64, cos_theta: f64) -> f64 {
    let arguments = [cos_theta, f0, tint].map(Value::scalar);
    evaluate::<f64>(&F82_TINT, &arguments).at(0)[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_colours_are_met_by_whatever_is_followed() {
        for (f0, f82, is_law) in [
            (0.04, 0.46, true),
            (0.9, 0.9, true),
            (0.95, 0.97, true),
            // Darker than any index of this F0 is at 82 degrees; and too bright at 0.
            (0.9, 0.2, false),
            (0.99, 0.99, false),
        ] {
            let follows = Follows::of(f0, f82);
            assert_eq!(matches!(follows, Follows::Law(_)), is_law, "{follows:?}");
            assert!((follows.at(1.0) - f0).abs() < 1e-9, "{follows:?}");
            assert!(
                (follows.at(optics::COS_82) - f82).abs() < 1e-9,
                "{follows:?}"
            );
        }
    }
}
