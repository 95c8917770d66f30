//! Colour spaces of renderers ([`Space`]), colours outside the gamut ([`Gamut`]), and chromatic adaptation ([`Adaptation`]).
//!
//! A space is linear red, green and blue, defined by its primaries and its white:
//!
//! ```text
//! XYZ = P diag(P⁻¹ w) RGB      P: the primaries, w: the white, as columns (x/y, 1, (1 − x − y)/y)
//! ```
//!
//! Source: SMPTE RP 177-1993, *Derivation of Basic Television Color Equations*,
//! <https://doi.org/10.5594/SMPTE.RP177.1993>. The matrices are computed in f64 from the chromaticities. The rounded ones in
//! the standards move a white by up to 1e-4.
//!
//! Gamut: a reflectance may be above 1 or below 0, where the space has no such colour. Saturated gold has a red of 1.03 to
//! 1.06 in sRGB. That is right for the sum of light, but a path tracer gains energy by it, and a texture of unsigned numbers
//! cannot hold it.
//!
//! Adaptation: the eye takes the colour of the light for white, and so must a reflectance.
//!
//! ```text
//! XYZ' = B⁻¹ diag(B w' / B w) B XYZ      B: Bradford's cones, w: the light's white, w': the white to be seen
//! ```
//!
//! Source: K. M. Lam, *Metamerism and Colour Constancy*, thesis, University of Bradford, 1985; the matrix and this linear
//! form as in ICC.1:2022, annex E, <https://www.color.org/specification/ICC.1-2022-05.pdf>. Domain: lights with positive
//! cone responses. All lights near white have them; a single violet or red line may not. For gold under D65 both adaptations
//! differ by less than 2e-4, and far from D65 by more.

use std::str::FromStr;

use glam::{DMat3, DVec3};

use crate::physics::names::UnknownName;

/// A linear space of red, green and blue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// sRGB, and Rec. 709: IEC 61966-2-1:1999.
    #[default]
    Srgb,
    /// Display P3: the primaries of SMPTE EG 432-1:2010 with the white of sRGB.
    DisplayP3,
    /// Rec. 2020: ITU-R BT.2020-2 (2015), table 3.
    Rec2020,
    /// ACEScg: the primaries AP1 of the Academy's S-2014-004 (2016) with the white of ACES, near D60.
    AcesCg,
}

/// The tolerance for chromaticities in files, which round to three digits.
const ROUNDING: f64 = 1e-3;

/// D65 as rounded in the standards of displays.
const WHITE_D65: [f64; 2] = [0.3127, 0.3290];

/// The white of ACES: Academy TB-2018-001, *Derivation of the ACES White Point CIE Chromaticity Coordinates*.
const WHITE_ACES: [f64; 2] = [0.32168, 0.33767];

impl FromStr for Space {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Space, UnknownName> {
        let found = Space::ALL.into_iter().find(|space| space.name() == name);
        found.ok_or_else(|| UnknownName::new("space", name, &Space::ALL.map(Space::name)))
    }
}

impl Space {
    /// All of them.
    pub const ALL: [Space; 4] = [Space::Srgb, Space::DisplayP3, Space::Rec2020, Space::AcesCg];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Space::Srgb => "srgb",
            Space::DisplayP3 => "p3",
            Space::Rec2020 => "rec2020",
            Space::AcesCg => "acescg",
        }
    }

    /// In words, for headers of files.
    pub fn title(self) -> &'static str {
        match self {
            Space::Srgb => "linear sRGB",
            Space::DisplayP3 => "linear Display P3",
            Space::Rec2020 => "linear Rec. 2020",
            Space::AcesCg => "ACEScg",
        }
    }

    /// Chromaticities (x, y) of red, green and blue.
    pub fn primaries(self) -> [[f64; 2]; 3] {
        match self {
            Space::Srgb => [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]],
            Space::DisplayP3 => [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]],
            Space::Rec2020 => [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]],
            Space::AcesCg => [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]],
        }
    }

    /// Chromaticity (x, y) of white.
    pub fn white_xy(self) -> [f64; 2] {
        match self {
            Space::Srgb | Space::DisplayP3 | Space::Rec2020 => WHITE_D65,
            Space::AcesCg => WHITE_ACES,
        }
    }

    /// Whether chromaticities (x, y) of red, green, blue and white are this space's, up to the rounding in files.
    pub fn has(self, primaries: &[[f64; 2]; 3], white: &[f64; 2]) -> bool {
        let is_near =
            |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < ROUNDING;
        let own = self.primaries();
        let mut pairs = primaries.iter().zip(&own);
        pairs.all(|(a, b)| is_near(a, b)) && is_near(white, &self.white_xy())
    }

    /// XYZ of white, Y = 1.
    pub fn white(self) -> DVec3 {
        xyz_of(self.white_xy())
    }

    /// The matrix from RGB to XYZ; (1, 1, 1) becomes [`Space::white`].
    pub fn rgb_to_xyz(self) -> DMat3 {
        rgb_to_xyz(self.primaries(), self.white_xy())
    }

    /// The matrix from XYZ to RGB.
    pub fn xyz_to_rgb(self) -> DMat3 {
        self.rgb_to_xyz().inverse()
    }
}

/// The matrix from red, green and blue of these chromaticities (x, y) to XYZ; (1, 1, 1) becomes this white, Y = 1. It is not
/// finite where they are collinear.
pub fn rgb_to_xyz(primaries: [[f64; 2]; 3], white: [f64; 2]) -> DMat3 {
    let [red, green, blue] = primaries.map(xyz_of);
    let primaries = DMat3::from_cols(red, green, blue);
    primaries * DMat3::from_diagonal(primaries.inverse() * xyz_of(white))
}

/// XYZ of a chromaticity (x, y), Y = 1.
pub fn xyz_of([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

/// A linear channel, clamped to [0, 1], as an 8-bit sRGB value: IEC 61966-2-1:1999.
///
/// ```
/// use fresnel_gen::physics::spectra::srgb_byte;
///
/// assert_eq!([0.0, 0.214, 1.0].map(srgb_byte), [0, 127, 255]);
/// ```
pub fn srgb_byte(linear: f64) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    };
    (255.0 * encoded).round() as u8
}

/// The linear value of a channel in [0, 1] with sRGB encoding: the inverse of [`srgb_byte`] without its quantisation.
pub fn srgb_linear(encoded: f64) -> f64 {
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        libm::pow((encoded + 0.055) / 1.055, 2.4)
    }
}

/// What to do with colours outside [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gamut {
    /// They are kept.
    Keep,
    /// Each channel is clamped to [0, 1]: the hue changes, the other channels stay right.
    #[default]
    Clip,
    /// The colour is divided by its largest channel if that is above 1, and negative channels become 0. The hue
    /// stays, but all channels are too dark. Gold in Lagarde's table is made this way.
    Scale,
}

impl Gamut {
    /// All of them.
    pub const ALL: [Gamut; 3] = [Gamut::Keep, Gamut::Clip, Gamut::Scale];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Gamut::Keep => "keep",
            Gamut::Clip => "clip",
            Gamut::Scale => "scale",
        }
    }

    /// The colour that is written. A NaN stays one.
    pub fn apply(self, rgb: DVec3) -> DVec3 {
        match self {
            Gamut::Keep => rgb,
            Gamut::Clip => rgb.map(|channel| channel.clamp(0.0, 1.0)),
            Gamut::Scale => {
                let largest = rgb.max_element().max(1.0);
                rgb.map(|channel| (channel / largest).clamp(0.0, 1.0))
            }
        }
    }
}

/// How the colour of a mirror becomes (1, 1, 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Adaptation {
    /// Red, green and blue are divided by those of a mirror.
    #[default]
    Scale,
    /// The light is adapted to the white of the space in Bradford's cone space. A mirror is then (1, 1, 1) up to
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

/// Bradford's matrix from XYZ to sharpened responses of the long, middle and short cones, by rows.
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
    use crate::physics::spectra::{Illuminant, Observer, Step, weighted_sum, xyz_weights};

    #[test]
    fn encoding_is_that_of_the_standard() {
        for (linear, byte) in [
            (0.0, 0),
            (-1.0, 0),
            (f64::NAN, 0),
            (0.0025, 8),
            (0.215_860_5, 128),
            (0.5, 188),
            (1.0, 255),
            (7.0, 255),
        ] {
            assert_eq!(srgb_byte(linear), byte, "{linear}");
            assert_eq!(srgb_byte(srgb_linear(f64::from(byte) / 255.0)), byte);
        }
    }

    #[test]
    fn white_is_one_one_one() {
        for space in Space::ALL {
            let (white, one) = (
                space.rgb_to_xyz() * DVec3::ONE,
                space.xyz_to_rgb() * space.white(),
            );
            assert!(white.abs_diff_eq(space.white(), 1e-15), "{space:?}");
            assert!(one.abs_diff_eq(DVec3::ONE, 1e-14), "{space:?}");
        }
    }

    /// The matrices of the standards, row by row, to the digits that they print.
    #[test]
    fn the_matrices_are_the_printed_ones() {
        for (space, rows, digits) in [
            (
                Space::Srgb,
                [
                    [0.4124, 0.3576, 0.1805],
                    [0.2126, 0.7152, 0.0722],
                    [0.0193, 0.1192, 0.9505],
                ],
                1e-4,
            ),
            (
                Space::Rec2020,
                [
                    [0.6370, 0.1446, 0.1689],
                    [0.2627, 0.6780, 0.0593],
                    [0.0, 0.0281, 1.0610],
                ],
                1e-4,
            ),
            (
                Space::AcesCg,
                [
                    [0.662_454_181_1, 0.134_004_206_5, 0.156_187_687_0],
                    [0.272_228_716_8, 0.674_081_765_8, 0.053_689_517_4],
                    [-0.005_574_649_5, 0.004_060_733_5, 1.010_339_100_3],
                ],
                1e-10,
            ),
        ] {
            let wanted = DMat3::from_cols_array_2d(&rows).transpose();
            let got = space.rgb_to_xyz();
            assert!(got.abs_diff_eq(wanted, digits), "{space:?} {got}");
        }
    }

    #[track_caller]
    fn check(rgb: [f64; 3], clip: [f64; 3], scale: [f64; 3]) {
        assert_eq!(Gamut::Keep.apply(rgb.into()).to_array(), rgb);
        assert_eq!(Gamut::Clip.apply(rgb.into()).to_array(), clip);
        assert_eq!(Gamut::Scale.apply(rgb.into()).to_array(), scale);
    }

    #[test]
    fn each_way() {
        check([0.0, 0.5, 1.0], [0.0, 0.5, 1.0], [0.0, 0.5, 1.0]);
        check([1.25, 0.5, -0.25], [1.0, 0.5, 0.0], [1.0, 0.4, 0.0]);
        check([0.5, -0.1, 0.2], [0.5, 0.0, 0.2], [0.5, 0.0, 0.2]);
        check([2.0, 4.0, 1.0], [1.0, 1.0, 1.0], [0.5, 1.0, 0.25]);
        check([-1.0, -2.0, -3.0], [0.0; 3], [0.0; 3]);
        for gamut in Gamut::ALL {
            assert!(gamut.apply(DVec3::NAN).is_nan());
        }
    }

    #[test]
    fn white_becomes_white_and_back() {
        let wavelengths = Step::Nm5.wavelengths();
        for light in Illuminant::NAMED {
            let weights = xyz_weights(Observer::Cie1931, &light, &wavelengths);
            let from = weighted_sum(&weights, wavelengths.iter().map(|_| 1.0));
            for to in Space::ALL.map(Space::white) {
                let there = bradford(from, to);
                assert!((there * from).abs_diff_eq(to, 1e-14), "{light:?}");
                let back = bradford(to, from) * there;
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
