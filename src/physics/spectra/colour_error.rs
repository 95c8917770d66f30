//! Colour error: what is lost by taking reflectance as three numbers.
//!
//! Red, green and blue of a reflectance hold for the light that they were integrated under. A renderer multiplies them
//! with any light, and again at each bounce, and neither is what spectra do:
//!
//! ```text
//! true     XYZ = Σ x̄ȳz̄(λ) S(λ) R(λ)^b / Σ ȳ(λ) S(λ)
//! rendered XYZ = M⁻¹ ((M w) RGB^b)             w: XYZ of the light S itself; M: XYZ to the space
//! error        = ΔE₀₀ of both, adapted by Bradford from w to the white of the space
//! ```
//!
//! The light enters the renderer with its own colour, not whitened; then the eye adapts to it, and both colours are seen
//! beside the white of the space, for which CIELAB and ΔE₀₀ were made. (Lab relative to w without Bradford gives a fifth
//! less.) From D65 to A, after one bounce, gold errs by 8.6, brass by 4.3, aluminium by 0.1.
//!
//! A third error: it is the fault of three channels, never added to the model error or to the code error.

use glam::DVec3;

use super::adaptation::bradford;
use super::difference::{Lab, ciede2000};
use super::illuminant::Illuminant;
use super::integration::Integration;
use super::tristimulus::{weighted_sum, xyz_weights};

/// The colour error, as ΔE₀₀, of a reflectance under the light `other` after some bounces (1 to 3 are of use; 0 is no
/// surface at all, and the error is 0).
///
/// `reflectance` stands at the wavelengths of the integration's step, `rgb` is its colour by the same integration, after
/// whatever was done about the gamut. A list of another length, or a light without power, gives NaN.
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
    let seen = |xyz| Lab::from_xyz(adapt * xyz, space.white());
    ciede2000(seen(reference), seen(rendered))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics;
    use crate::physics::spectra::{Integrator, Space, Spectrum};
    use glam::DVec2;

    /// Gold, n and k by wavelength in nm: P. B. Johnson, R. W. Christy, Phys. Rev. B 6, 4370, 1972, table I, as
    /// refractiveindex.info tells it (CC0), main/Au/nk/Johnson.
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
        // Computed apart with another program.
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
            let error =
                |bounces| colour_error(&reflectance, rgb, &Illuminant::D65, bounces, &integration);
            assert!(error(1) < 1e-9, "{space:?} {:e}", error(1));
            assert!(error(2) > 0.01 && error(3) > error(2), "{space:?}");
        }
    }

    #[test]
    fn wrong_lists_have_no_error_to_tell() {
        let integration = Integration::default();
        assert!(colour_error(&[0.5], DVec3::ONE, &Illuminant::A, 1, &integration).is_nan());
        assert!(
            colour_error(&[f64::NAN; 81], DVec3::ONE, &Illuminant::A, 1, &integration).is_nan()
        );
    }
}
