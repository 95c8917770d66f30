//! The F0 of a surface under a coat of index η, from its F0 and F82 in air:
//!
//! ```text
//! F0' = 1 − 2 η / (h + η + (η² − 1)/(2 n)),   h = (1 + F0)/(1 − F0)
//! ```
//!
//! Source: h is (n² + k² + 1)/(2 n) by Fresnel's equations at normal incidence (Born, Wolf, *Principles of Optics*, 1999, section 14.2,
//! <https://doi.org/10.1017/CBO9781139644181>); of n/η and k/η it is h/η + (η² − 1)/(2 n η). So k is not needed, and n comes from F0
//! and F82 by [`index_from_f0_f82`].
//!
//! Domain: F0 and F82 from 0 to 1, η from 1. For a pair that no index gives, n is that of the nearest F82 that its F0 allows, and
//! `exact` is false. The same holds for F0 = 1, a mirror, which stays one. Error: none for one index. For a channel that represents
//! a spectrum it is .0002 in the median and .012 at most, over 75 metals and semiconductors at η = 1.5 (the test `effects::coat`).

use super::interface::{EffectiveIndex, index_from_f0_f82};

/// A surface's reflectance at normal incidence under a coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnderCoat {
    /// F0 relative to the coat.
    pub f0: f64,
    /// The surface's n and k in air.
    pub index: EffectiveIndex,
}

/// F0 under a coat of index `coat` from F0 and F82 in air.
///
/// ```
/// use fresnel_gen::physics::optics::{COS_82, conductor, normal_incidence, under_coat};
///
/// let f82 = conductor(0.2, 3.0, COS_82).unpolarised();
/// let found = under_coat(normal_incidence(0.2, 3.0), f82, 1.5);
/// assert!((found.f0 - normal_incidence(0.2 / 1.5, 3.0 / 1.5)).abs() < 1e-9);
/// ```
pub fn under_coat(f0: f64, f82: f64, coat: f64) -> UnderCoat {
    let index = index_from_f0_f82(f0, f82);
    // Not `clamp`: a NaN becomes 0.
    let f0 = if f0 > 0.0 { f0.min(1.0) } else { 0.0 };
    let ratio = (1.0 + f0) / (1.0 - f0);
    let whole = ratio + coat + (coat * coat - 1.0) / (2.0 * index.n);
    UnderCoat {
        f0: 1.0 - 2.0 * coat / whole,
        index,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics::{COS_82, conductor, normal_incidence};

    #[test]
    fn it_is_the_law_relative_to_the_coat() {
        for (n, k) in [
            (0.05, 3.0),
            (0.23, 3.94),
            (1.39, 1.72),
            (4.1, 0.5),
            (1.6, 7.9),
        ] {
            let f82 = conductor(n, k, COS_82).unpolarised();
            for coat in [1.0, 1.33, 1.5, 1.8, 2.4] {
                let found = under_coat(normal_incidence(n, k), f82, coat);
                let law = normal_incidence(n / coat, k / coat);
                let is_near = (found.f0 - law).abs() < 1e-9;
                assert!(found.index.exact && is_near, "{n} {k} {coat}");
            }
        }
    }

    #[test]
    fn a_coat_of_air_changes_nothing_and_a_mirror_stays_one() {
        for f0 in [0.0, 0.04, 0.5, 0.97] {
            let found = under_coat(f0, 0.9 * f0 + 0.1, 1.0);
            assert!((found.f0 - f0).abs() < 1e-15, "{f0}");
        }
        let mirror = under_coat(1.0, 1.0, 1.5);
        assert_eq!((mirror.f0, mirror.index.exact), (1.0, false));
    }

    #[test]
    fn glass_vanishes_in_a_coat_of_its_own_index() {
        let f82 = conductor(1.5, 0.0, COS_82).unpolarised();
        assert!(under_coat(0.04, f82, 1.5).f0.abs() < 1e-9);
        assert!(under_coat(0.04, f82, 1.4).f0 > 1e-4);
    }

    #[test]
    fn what_no_index_gives_takes_the_nearest() {
        for (f0, f82) in [
            (0.9, 0.1),
            (0.04, 1.1),
            (1.06, 0.98),
            (f64::NAN, 0.5),
            (-0.1, 0.5),
        ] {
            let found = under_coat(f0, f82, 1.5);
            assert!(!found.index.exact, "{f0} {f82}");
            assert!((0.0..=1.0).contains(&found.f0), "{f0} {f82}: {found:?}");
        }
    }
}
