//! Adaptation: the eye takes the colour of the light for white, and so must a reflectance.
//!
//! ```text
//! XYZ' = B⁻¹ diag(B w' / B w) B XYZ      B: Bradford's cones, w: the light's white, w': the white to be seen
//! ```
//!
//! Source: K. M. Lam, *Metamerism and Colour Constancy*, thesis, University of Bradford, 1985; the matrix and this linear
//! form as in ICC.1:2022, annex E, <https://www.color.org/specification/ICC.1-2022-05.pdf>. Domain: lights with positive
//! cone responses, as all lights near white have; a single violet or red line may not. For gold
//! under D65 both ways differ by less than 2e-4, far from D65 they differ more.

use glam::{DMat3, DVec3};

/// How the colour of a mirror becomes (1, 1, 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Adaptation {
    /// Red, green and blue are divided by those of a mirror.
    #[default]
    Scale,
    /// The light is adapted to the white of the space in the cones of Bradford; then a mirror is (1, 1, 1) up to
    /// rounding, and the division makes it exact.
    Bradford,
}

impl Adaptation {
    /// All of them.
    pub const ALL: [Adaptation; 2] = [Adaptation::Scale, Adaptation::Bradford];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Adaptation::Scale => "scale",
            Adaptation::Bradford => "bradford",
        }
    }

    /// The matrix on XYZ that this adaptation applies to a light of white `from`, seen in a space of white `to`.
    pub fn matrix(self, from: DVec3, to: DVec3) -> DMat3 {
        match self {
            Adaptation::Scale => DMat3::IDENTITY,
            Adaptation::Bradford => bradford(from, to),
        }
    }
}

/// The cone responses of Bradford, by rows: sharpened long, middle and short waves of XYZ.
const CONES: [[f64; 3]; 3] = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];

/// The matrix that turns XYZ under a light of white `from` into XYZ under one of white `to`.
pub fn bradford(from: DVec3, to: DVec3) -> DMat3 {
    let cones = DMat3::from_cols_array_2d(&CONES).transpose();
    cones.inverse() * DMat3::from_diagonal((cones * to) / (cones * from)) * cones
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::spectra::{Illuminant, Observer, Space, Step, weighted_sum, xyz_weights};

    #[test]
    fn white_becomes_white_and_back() {
        let wavelengths = Step::Nm5.wavelengths();
        for light in Illuminant::NAMED {
            let weights = xyz_weights(Observer::Cie1931, &light, &wavelengths);
            let from = weighted_sum(&weights, wavelengths.iter().map(|_| 1.0));
            for to in Space::ALL.map(Space::white) {
                assert!(
                    (bradford(from, to) * from).abs_diff_eq(to, 1e-14),
                    "{light:?}"
                );
                let back = bradford(to, from) * bradford(from, to);
                assert!(back.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{light:?}");
            }
        }
    }

    #[test]
    fn from_d65_to_d50_as_published() {
        // B. Lindbloom, Chromatic Adaptation, http://www.brucelindbloom.com/Eqn_ChromAdapt.html, from the same whites.
        let d65 = DVec3::new(0.95047, 1.0, 1.08883);
        let d50 = DVec3::new(0.96422, 1.0, 0.82521);
        let wanted = DMat3::from_cols_array_2d(&[
            [1.0478112, 0.0228866, -0.0501270],
            [0.0295424, 0.9904844, -0.0170491],
            [-0.0092345, 0.0150436, 0.7521316],
        ]);
        assert!(bradford(d65, d50).abs_diff_eq(wanted.transpose(), 1e-7));
    }
}
