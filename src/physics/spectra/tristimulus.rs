//! X, Y and Z of light: its power, weighted by an observer and summed.
//!
//! ```text
//! XYZ = Σ x̄ȳz̄(λ) S(λ) R(λ) / Σ ȳ(λ) S(λ)        R: what a surface reflects; Y = 1 for a mirror; S: Illuminant::powers
//! ```
//!
//! Source: CIE 015:2018, *Colorimetry*, 4th edition, <https://doi.org/10.25039/TR.015.2018>. A plain sum over
//! equal steps, both ends counted in full. Domain: a light with some power at the wavelengths; without any, NaN.

use glam::DVec3;

use super::illuminant::Illuminant;
use super::observer::Observer;

/// How much reflectance at each wavelength (nm, in equal steps) adds to X, Y and Z: x̄ȳz̄ S / Σ ȳ S.
#[inline]
pub fn xyz_weights(observer: Observer, light: &Illuminant, wavelengths: &[f64]) -> Vec<DVec3> {
    let products = wavelengths
        .iter()
        .zip(light.powers(wavelengths))
        .map(|(nm, power)| observer.at(*nm) * power);
    let products: Vec<DVec3> = products.collect();
    let luminance: f64 = products.iter().map(|xyz| xyz.y).sum();
    products.into_iter().map(|xyz| xyz / luminance).collect()
}

/// Σ weight · value, from the first to the last.
#[inline]
pub fn weighted_sum(weights: &[DVec3], values: impl IntoIterator<Item = f64>) -> DVec3 {
    weights
        .iter()
        .zip(values)
        .fold(DVec3::ZERO, |sum, (weight, value)| sum + *weight * value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::spectra::{Space, Step};

    fn white(light: &Illuminant, step: Step) -> DVec3 {
        let wavelengths = step.wavelengths();
        let weights = xyz_weights(Observer::Cie1931, light, &wavelengths);
        weighted_sum(&weights, wavelengths.iter().map(|_| 1.0))
    }

    #[test]
    fn whites_of_the_illuminants() {
        // D65 in steps of 1 nm, computed apart with another program; then x and y as CIE publishes them, D65, E, A and
        // F11 in CIE 15:2004, LED-B3 in CIE 015:2018, of sums over a longer range.
        let d65 = white(&Illuminant::D65, Step::Nm1);
        assert!(
            d65.abs_diff_eq(DVec3::new(0.950423, 1.0, 1.088610), 5e-7),
            "{d65}"
        );
        for (light, x, y) in [
            (Illuminant::D65, 0.31272, 0.32903),
            (Illuminant::E, 0.33333, 0.33333),
            (Illuminant::A, 0.44758, 0.40745),
            (Illuminant::F11, 0.3805, 0.3769),
            (Illuminant::LedB3, 0.3756, 0.3723),
        ] {
            let xyz = white(&light, Step::Nm5);
            let sum = xyz.element_sum();
            let near = (xyz.x / sum - x).abs() < 1e-4 && (xyz.y / sum - y).abs() < 1e-4;
            assert!(near, "{light:?}: {} {}", xyz.x / sum, xyz.y / sum);
        }
    }

    #[test]
    fn without_adaptation_a_mirror_under_e_is_not_white() {
        let rgb = Space::Srgb.xyz_to_rgb() * white(&Illuminant::E, Step::Nm1);
        assert!(
            rgb.abs_diff_eq(DVec3::new(1.205, 0.948, 0.909), 5e-4),
            "{rgb}"
        );
    }
}
