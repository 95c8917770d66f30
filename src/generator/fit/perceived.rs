//! Perceived error: of luminance, and of colour by CIEDE2000 beside a perfect mirror under the white of the space.

use glam::{DMat3, DVec3};
use serde::Serialize;

use crate::generator::reference::{ANGLES, COSINES, ReferenceCurve};
use crate::language::ir::Value;
use crate::physics::spectra::{Lab, Space, ciede2000, xyz_to_lab};

/// The stride over the angles: errors are smooth, so not every angle is needed.
const EVERY: usize = 8;

/// The largest perceived errors over the angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Perceived {
    /// The difference in the space's luminance. An excess in one channel makes up for a lack in another.
    pub luminance: f64,
    /// ΔE₀₀; about 1 is just noticeable.
    pub de2000: f64,
}

/// The perceived errors of three channels that are given at some cosines, against the reference. Values that are not numbers are
/// left out.
pub fn perceived(
    reference: &ReferenceCurve,
    space: Space,
    values: &dyn Fn(&[f64]) -> Value<f64>,
) -> Perceived {
    SeenReference::new(&reference.table(), space).perceived(values)
}

/// A reference as colours, against which several methods are seen.
pub(super) struct SeenReference {
    beside: BesideWhite,
    wanted: Vec<(DVec3, Lab)>,
}

impl SeenReference {
    /// The reference with this reflectance at [`COSINES`].
    pub fn new(table: &[[f64; 3]], space: Space) -> SeenReference {
        let beside = BesideWhite::of_space(space);
        let wanted = table[..ANGLES].iter().step_by(EVERY);
        let seen = |rgb: &[f64; 3]| (DVec3::from(*rgb), beside.lab(DVec3::from(*rgb)));
        SeenReference {
            wanted: wanted.map(seen).collect(),
            beside,
        }
    }

    /// The perceived errors of three channels that are given at some cosines.
    pub fn perceived(&self, values: &dyn Fn(&[f64]) -> Value<f64>) -> Perceived {
        let at = COSINES[..ANGLES].iter().copied().step_by(EVERY);
        let given = values(&at.collect::<Vec<f64>>());
        let mut largest = Perceived::default();
        for (point, wanted) in self.wanted.iter().enumerate() {
            let given = DVec3::from(given.at(point));
            if given.is_finite() {
                largest.include(given, *wanted, &self.beside);
            }
        }
        largest
    }
}

impl Perceived {
    fn include(&mut self, given: DVec3, (wanted, lab): (DVec3, Lab), beside: &BesideWhite) {
        let luminance = beside.to_xyz.row(1).dot(given - wanted).abs();
        self.luminance = self.luminance.max(luminance);
        let seen = ciede2000(beside.lab(given), lab);
        self.de2000 = self.de2000.max(seen);
    }
}

/// What makes three channels a colour beside the white of their space.
struct BesideWhite {
    to_xyz: DMat3,
    white: DVec3,
}

impl BesideWhite {
    fn of_space(space: Space) -> BesideWhite {
        BesideWhite {
            to_xyz: space.rgb_to_xyz(),
            white: space.white(),
        }
    }

    fn lab(&self, rgb: DVec3) -> Lab {
        xyz_to_lab(self.to_xyz * rgb, self.white)
    }
}

/// Three channels as a colour beside the white of their space.
pub(super) fn lab(rgb: DVec3, space: Space) -> Lab {
    BesideWhite::of_space(space).lab(rgb)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::Light;
    use crate::physics::materials::{Channels, Surface};

    /// A grey mirror that reflects .50 instead of .52: .02 of luminance, and ΔE₀₀ from L* 76.07 to 77.28 by hand: 1.21 / (1 +
    /// .015 · 26.68² / √(20 + 26.68²)) = .864.
    #[test]
    fn a_grey_that_is_too_dark_by_a_little() {
        let n = (1.0 + 0.52_f64.sqrt()) / (1.0 - 0.52_f64.sqrt());
        let channels = Channels {
            n: [n; 3],
            k: [0.0; 3],
        };
        let reference = ReferenceCurve::new(Surface::of_channels(&channels), Light::Unpolarised);
        let darker = |cosines: &[f64]| {
            let at = cosines.iter().map(|c| reference.at(*c)[0] - 0.02);
            Value::each(at.collect())
        };
        let found = perceived(&reference, Space::Srgb, &darker);
        assert!((found.luminance - 0.02).abs() < 1e-9, "{found:?}");
        // The darkest angle, where the law's Brewster dip lies, weighs most; at normal incidence it is the figure above.
        assert!(found.de2000 > 0.864 && found.de2000 < 1.1, "{found:?}");
        assert_eq!(
            perceived(&reference, Space::Srgb, &|cosines| {
                let at = cosines.iter().map(|c| reference.at(*c)[0]);
                Value::each(at.collect())
            }),
            Perceived::default()
        );
    }

    /// Red too bright and green too dark by the same luminance: no error is left. Channels taken separately would give .0426.
    #[test]
    fn what_one_channel_has_too_much_makes_up_for_another() {
        let shares = Space::Srgb.rgb_to_xyz().row(1);
        let wanted = DVec3::new(0.9, 0.7, 0.4);
        let given = wanted + DVec3::new(0.1, -0.1 * shares.x / shares.y, 0.0);
        let (mut found, beside) = (Perceived::default(), BesideWhite::of_space(Space::Srgb));
        found.include(given, (wanted, beside.lab(wanted)), &beside);
        assert!(found.luminance < 1e-12 && found.de2000 > 1.0, "{found:?}");
    }
}
