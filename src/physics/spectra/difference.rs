//! Colour differences: CIELAB and CIEDE2000, and the colour error of three-channel reflectance.
//!
//! ```text
//! L* = 116 f(Y/Yw) − 16,  a* = 500 (f(X/Xw) − f(Y/Yw)),  b* = 200 (f(Y/Yw) − f(Z/Zw))
//! f(t) = ∛t for t > (6/29)³, else (841/108) t + 4/29
//! ```
//!
//! Source: CIE 015:2018, *Colorimetry*, <https://doi.org/10.25039/TR.015.2018>; CIEDE2000 with its test pairs in G. Sharma,
//! W. Wu, E. N. Dalal, *The CIEDE2000 Color-Difference Formula*, Color Research and Application 30(1), 2005, 21-30,
//! <https://doi.org/10.1002/col.20070>. Computed by the crate `palette`. Unit: about 1 is the least difference that is
//! visible side by side. Above 5 the formula was never fitted, and only says "much".
//!
//! # Colour error
//!
//! The colour error is what is lost by taking reflectance as three numbers. Red, green and blue of a reflectance hold for the
//! light that they were integrated under. A renderer multiplies them by any light, and again at each bounce. Spectra behave
//! differently in both cases:
//!
//! ```text
//! true     XYZ = Σ x̄ȳz̄(λ) S(λ) R(λ)^b / Σ ȳ(λ) S(λ)
//! rendered XYZ = M⁻¹ ((M w) RGB^b)             w: XYZ of the light S itself; M: XYZ to the space
//! error        = ΔE₀₀ of both, adapted by Bradford from w to the white of the space
//! ```
//!
//! The light enters the renderer with its own colour, not whitened. Then the eye adapts to it, and both colours are compared
//! relative to the white of the space, for which CIELAB and ΔE₀₀ were made. (Lab relative to w without Bradford gives a fifth
//! less.) From D65 to A, after one bounce, gold errs by 8.6, brass by 4.3, aluminium by 0.1.
//!
//! This is a third kind of error, caused by having three channels. It is never added to the model error or to the code error.

use glam::DVec3;
use palette::color_difference::Ciede2000;
use palette::convert::FromColorUnclamped;
use palette::white_point::E;

use super::illuminant::Illuminant;
use super::integrator::{Integration, weighted_sum, xyz_weights};
use super::space::bradford;

/// A colour in CIELAB: lightness, 0 for black and 100 for white, green to red, blue to yellow.
pub type Lab = palette::Lab<E, f64>;

/// The colour `xyz` relative to a white. Both have the same unit, and the white is above 0 in each of X, Y and Z.
pub fn xyz_to_lab(xyz: DVec3, white: DVec3) -> Lab {
    // `palette`'s white `E` is (1, 1, 1), so we divide by the white ourselves.
    let relative = xyz / white;
    Lab::from_color_unclamped(palette::Xyz::new(relative.x, relative.y, relative.z))
}

/// The difference ΔE₀₀ of two colours.
///
/// ```
/// use fresnel_gen::physics::spectra::{Lab, ciede2000};
///
/// let grey = Lab::new(50.0, 0.0, 0.0);
/// assert_eq!(ciede2000(grey, grey), 0.0);
/// ```
pub fn ciede2000(one: Lab, other: Lab) -> f64 {
    one.difference(other)
}

/// The colour error, as ΔE₀₀, of a reflectance under the light `other` after some bounces (1 to 3 are useful; 0 is no
/// surface at all, and the error is 0).
///
/// `reflectance` is given at the wavelengths of the integration's step. `rgb` is its colour by the same integration, after
/// gamut mapping. A list of another length, or a light without power, gives NaN.
pub fn colour_error(
    reflectance: &[f64],
    rgb: DVec3,
    other: &Illuminant,
    bounces: u32,
    integration: &Integration,
) -> f64 {
    let wavelengths = integration.step.wavelengths();
    if reflectance.len() != wavelengths.len() {
        return f64::NAN;
    }
    let space = integration.space;
    let bounced = |share: f64| libm::pow(share, f64::from(bounces));
    let weights = xyz_weights(integration.observer, other, &wavelengths);
    let light = weighted_sum(&weights, wavelengths.iter().map(|_| 1.0));
    let reference = weighted_sum(&weights, reflectance.iter().map(|share| bounced(*share)));
    let rendered = space.rgb_to_xyz() * (space.xyz_to_rgb() * light * rgb.map(bounced));
    let adapt = bradford(light, space.white());
    let seen = |xyz| xyz_to_lab(adapt * xyz, space.white());
    ciede2000(seen(reference), seen(rendered))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics;
    use crate::physics::spectra::{Integrator, Space, Spectrum};
    use glam::DVec2;

    /// L, a, b of two colours and their difference: table 1 of Sharma, Wu and Dalal.
    #[rustfmt::skip]
    const PAIRS: [[f64; 7]; 34] = [
        [50.0, 2.6772, -79.7751, 50.0, 0.0, -82.7485, 2.0425],
        [50.0, 3.1571, -77.2803, 50.0, 0.0, -82.7485, 2.8615],
        [50.0, 2.8361, -74.02, 50.0, 0.0, -82.7485, 3.4412],
        [50.0, -1.3802, -84.2814, 50.0, 0.0, -82.7485, 1.0],
        [50.0, -1.1848, -84.8006, 50.0, 0.0, -82.7485, 1.0],
        [50.0, -0.9009, -85.5211, 50.0, 0.0, -82.7485, 1.0],
        [50.0, 0.0, 0.0, 50.0, -1.0, 2.0, 2.3669],
        [50.0, -1.0, 2.0, 50.0, 0.0, 0.0, 2.3669],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.0009, 7.1792],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.001, 7.1792],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.0011, 7.2195],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.0012, 7.2195],
        [50.0, -0.001, 2.49, 50.0, 0.0009, -2.49, 4.8045],
        [50.0, -0.001, 2.49, 50.0, 0.001, -2.49, 4.8045],
        [50.0, -0.001, 2.49, 50.0, 0.0011, -2.49, 4.7461],
        [50.0, 2.5, 0.0, 50.0, 0.0, -2.5, 4.3065],
        [50.0, 2.5, 0.0, 73.0, 25.0, -18.0, 27.1492],
        [50.0, 2.5, 0.0, 61.0, -5.0, 29.0, 22.8977],
        [50.0, 2.5, 0.0, 56.0, -27.0, -3.0, 31.903],
        [50.0, 2.5, 0.0, 58.0, 24.0, 15.0, 19.4535],
        [50.0, 2.5, 0.0, 50.0, 3.1736, 0.5854, 1.0],
        [50.0, 2.5, 0.0, 50.0, 3.2972, 0.0, 1.0],
        [50.0, 2.5, 0.0, 50.0, 1.8634, 0.5757, 1.0],
        [50.0, 2.5, 0.0, 50.0, 3.2592, 0.335, 1.0],
        [60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644],
        [63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.263],
        [61.2901, 3.7196, -5.3901, 61.4292, 2.248, -4.962, 1.8731],
        [35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645],
        [22.7233, 20.0904, -46.694, 23.0331, 14.973, -42.5619, 2.0373],
        [36.4612, 47.858, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146],
        [90.8027, -2.0831, 1.441, 91.1528, -1.6435, 0.0447, 1.4441],
        [90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381],
        [6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377],
        [2.0776, 0.0795, -1.135, 0.9033, -0.0636, -0.5514, 0.9082],
    ];

    #[test]
    fn the_published_pairs_come_out_both_ways() {
        assert_eq!(PAIRS.len(), 34);
        for [l1, a1, b1, l2, a2, b2, wanted] in PAIRS {
            let (one, other) = (Lab::new(l1, a1, b1), Lab::new(l2, a2, b2));
            for got in [ciede2000(one, other), ciede2000(other, one)] {
                assert!((got - wanted).abs() < 1e-4, "{one:?} {other:?}");
            }
            assert_eq!(ciede2000(one, one), 0.0);
        }
    }

    #[test]
    fn lab_of_white_grey_and_black() {
        let white = DVec3::new(0.95, 1.0, 1.09);
        let check = |share: f64, l: f64| {
            let lab = xyz_to_lab(white * share, white);
            let off = [lab.l - l, lab.a, lab.b];
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{lab:?}");
        };
        check(1.0, 100.0);
        check(0.125, 42.0);
        check(0.001, 116.0 * (0.841 / 108.0 + 4.0 / 29.0) - 16.0);
        check(0.0, 0.0);
    }

    /// Gold, n and k by wavelength in nm: P. B. Johnson, R. W. Christy, Phys. Rev. B 6, 4370, 1972, table I, as given by
    /// refractiveindex.info (CC0), main/Au/nk/Johnson.
    const GOLD: [(f64, [f64; 2]); 16] = [
        (367.9, [1.48, 1.895]),
        (381.5, [1.46, 1.933]),
        (397.4, [1.47, 1.952]),
        (413.3, [1.46, 1.958]),
        (430.5, [1.45, 1.948]),
        (450.9, [1.38, 1.914]),
        (471.4, [1.31, 1.849]),
        (495.9, [1.04, 1.833]),
        (520.9, [0.62, 2.081]),
        (548.6, [0.43, 2.455]),
        (582.1, [0.29, 2.863]),
        (616.8, [0.21, 3.272]),
        (659.5, [0.14, 3.697]),
        (704.5, [0.13, 4.103]),
        (756.0, [0.14, 4.542]),
        (821.1, [0.16, 5.083]),
    ];

    fn gold(wavelengths: &[f64]) -> Vec<f64> {
        let points = GOLD.iter().map(|(nm, nk)| (*nm, DVec2::from(*nk)));
        let index = Spectrum::new(points.collect()).unwrap();
        let at = |nm: &f64| index.at(*nm).unwrap();
        let reflectance = |nk: DVec2| optics::conductor(nk.x, nk.y, 1.0).unpolarised();
        wavelengths.iter().map(at).map(reflectance).collect()
    }

    #[test]
    fn gold_under_an_incandescent_lamp() {
        let integration = Integration::default();
        let integrator = Integrator::new(&integration).unwrap();
        let reflectance = gold(&integrator.wavelengths);
        let rgb = integrator.colour(&reflectance);
        let error =
            |bounces| colour_error(&reflectance, rgb, &Illuminant::A, bounces, &integration);
        // Computed independently by another program.
        assert!((error(1) - 8.605).abs() < 1e-3, "{}", error(1));
        assert!((error(2) - 15.852).abs() < 1e-3, "{}", error(2));
        assert!(error(0) < 1e-9);
    }

    #[test]
    fn grey_and_its_own_light_have_none() {
        for space in Space::ALL {
            let integration = Integration {
                space,
                ..Integration::default()
            };
            let integrator = Integrator::new(&integration).unwrap();
            let grey = vec![0.4; integrator.wavelengths.len()];
            for light in Illuminant::NAMED {
                for bounces in 1..=3 {
                    let rgb = integrator.colour(&grey);
                    let error = colour_error(&grey, rgb, &light, bounces, &integration);
                    assert!(error < 1e-9, "{light:?} {error:e}");
                }
            }
            let reflectance = gold(&integrator.wavelengths);
            let rgb = integrator.colour(&reflectance);
            let d65 = Illuminant::D65;
            let error = |bounces| colour_error(&reflectance, rgb, &d65, bounces, &integration);
            assert!(error(1) < 1e-9, "{space:?} {:e}", error(1));
            assert!(error(2) > 0.01 && error(3) > error(2), "{space:?}");
        }
    }

    #[test]
    fn wrong_lists_have_no_error_to_tell() {
        let integration = Integration::default();
        for reflectance in [&[0.5][..], &[f64::NAN; 81]] {
            let error = colour_error(reflectance, DVec3::ONE, &Illuminant::A, 1, &integration);
            assert!(error.is_nan());
        }
    }
}
