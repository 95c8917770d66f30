//! The integrator, a table of weights that turns a reflectance spectrum into a colour ([`Integrator`]), and the choices that
//! define it ([`Integration`]).
//!
//! ```text
//! colour = Σ w(λ) R(λ) / Σ w(λ)        w(λ) = M A x̄ȳz̄(λ) S(λ) / Σ ȳ(λ) S(λ)
//! ```
//!
//! M maps XYZ to the space, A is the adaptation. Both sums run in the same order, so that R = 1 gives exactly (1, 1, 1), bit
//! for bit, for all choices. Source: CIE 015:2018, *Colorimetry*, <https://doi.org/10.25039/TR.015.2018>. Division by the
//! mirror is usual in tables for renderers since S. Lagarde, *Feeding a physically based shading model*,
//! 2011, <https://seblagarde.wordpress.com/2011/08/17/feeding-a-physical-based-lighting-mode/>.
//!
//! Error: steps of 5 nm differ from 1 nm by at most 2e-4 for 86 metals under D65. The rows of a user's light that lie between
//! the steps count too ([`super::Illuminant::powers`]): its lines are complete, and reflectance is taken as linear within a step.
//!
//! X, Y and Z of light are its power, weighted by an observer and summed:
//!
//! ```text
//! XYZ = Σ x̄ȳz̄(λ) S(λ) R(λ) / Σ ȳ(λ) S(λ)        R: what a surface reflects; Y = 1 for a mirror; S: Illuminant::powers
//! ```
//!
//! Source: CIE 015:2018, *Colorimetry*, 4th edition, <https://doi.org/10.25039/TR.015.2018>. It is a plain sum over
//! equal steps, both ends counted in full. Domain: a light with some power at the wavelengths; without any, NaN.

use glam::DVec3;

use super::illuminant::Illuminant;
use super::observer::Observer;
use super::space::{Adaptation, Space};
use super::spectrum::{FIRST_NM, LAST_NM, Step};

/// Wavelengths, and the weights of the reflectance at each in red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub struct Integrator {
    /// In nm. [`Integrator::colour`] takes reflectance at these.
    pub wavelengths: Vec<f64>,
    /// One for each wavelength.
    pub weights: Vec<DVec3>,
    /// Σ w(λ), the colour of a mirror before the division.
    pub mirror: DVec3,
}

/// A light with almost no red, green or blue in a space, so that no reflectance can be divided by it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "under the illuminant `{illuminant}` a mirror is {mirror} in {space}; a reflectance can only be divided by a colour that is above 0 in all channels. Choose another illuminant, a wider space, or the adaptation `bradford`"
)]
pub struct NoWhite {
    /// Its name.
    pub illuminant: String,
    /// The title of the space.
    pub space: &'static str,
    /// Red, green and blue of the light.
    pub mirror: DVec3,
}

impl Integrator {
    /// The table for these choices. All standard illuminants have one in all spaces. A user's nearly monochromatic light may
    /// have none.
    ///
    /// # Errors
    /// A mirror has a channel near zero under this light, so that weights cannot be divided by it.
    pub fn new(choices: &Integration) -> Result<Integrator, NoWhite> {
        let wavelengths = choices.step.wavelengths();
        let weights = xyz_weights(choices.observer, &choices.illuminant, &wavelengths);
        let light = weighted_sum(&weights, wavelengths.iter().map(|_| 1.0));
        let adapt = choices.adaptation.matrix(light, choices.space.white());
        let to_rgb = choices.space.xyz_to_rgb() * adapt;
        let weights = weights.into_iter().map(|xyz| to_rgb * xyz).collect();
        let integrator = Integrator::of(wavelengths, weights);
        if integrator.mirror.cmpge(DVec3::splat(LEAST_MIRROR)).all() {
            return Ok(integrator);
        }
        Err(NoWhite {
            illuminant: choices.illuminant.name().to_owned(),
            space: choices.space.title(),
            mirror: integrator.mirror,
        })
    }

    fn of(wavelengths: Vec<f64>, weights: Vec<DVec3>) -> Integrator {
        Integrator {
            mirror: weighted_sum(&weights, weights.iter().map(|_| 1.0)),
            wavelengths,
            weights,
        }
    }

    /// Red, green and blue at one wavelength each (nm), as in tables of n and k for three channels.
    pub fn three_wavelengths(nm: [f64; 3]) -> Integrator {
        Integrator::of(nm.to_vec(), vec![DVec3::X, DVec3::Y, DVec3::Z])
    }

    /// The colour of a surface whose reflectance at each of `wavelengths` is given. A list of another length has no
    /// colour: NaN.
    pub fn colour(&self, reflectance: &[f64]) -> DVec3 {
        if reflectance.len() != self.weights.len() {
            return DVec3::NAN;
        }
        weighted_sum(&self.weights, reflectance.iter().copied()) / self.mirror
    }
}

/// The least channel of a light, relative to its Y, that colours are divided by. Below it, the sum of positive and negative
/// weights keeps few digits. The least of the standard illuminants is A's blue in sRGB, 0.22.
const LEAST_MIRROR: f64 = 1e-3;

/// The weights of reflectance at each wavelength (nm, in equal steps) in X, Y and Z: x̄ȳz̄ S / Σ ȳ S.
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

/// Σ weight · value, in order.
#[inline]
pub fn weighted_sum(weights: &[DVec3], values: impl IntoIterator<Item = f64>) -> DVec3 {
    weights
        .iter()
        .zip(values)
        .fold(DVec3::ZERO, |sum, (weight, value)| sum + *weight * value)
}

/// The choices that turn a spectrum into a colour. The default is CIE 1931, D65, sRGB, division by the mirror, 5 nm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Integration {
    /// The standard observer.
    pub observer: Observer,
    /// The light.
    pub illuminant: Illuminant,
    /// The colour space of the result.
    pub space: Space,
    /// How a mirror becomes (1, 1, 1).
    pub adaptation: Adaptation,
    /// The distance between wavelengths.
    pub step: Step,
}

impl Integration {
    /// One line for headers and reports.
    pub fn description(&self) -> String {
        let adapted = match self.adaptation {
            Adaptation::Scale => "",
            Adaptation::Bradford => "adapted by Bradford, ",
        };
        format!(
            "{FIRST_NM}-{LAST_NM} nm in steps of {} nm, {}, {}, {adapted}{}, mirror = 1",
            self.step.nm(),
            self.observer.title(),
            self.illuminant.name(),
            self.space.title(),
        )
    }

    /// A remark on the adaptation for colours in this space, if one is due.
    pub fn adaptation_remark(&self) -> Option<&'static str> {
        let is_other = self.space == Space::AcesCg && self.adaptation != Adaptation::Bradford;
        is_other.then_some(ACES_ADAPTS)
    }
}

/// The remark where ACES pipelines use another adaptation.
const ACES_ADAPTS: &str = "a mirror is made white by dividing each channel; ACES pipelines adapt by Bradford: --adaptation bradford";

#[cfg(test)]
mod tests {
    use super::*;

    /// All combinations of named choices.
    fn all_choices() -> Vec<Integration> {
        let mut all = Vec::new();
        for observer in Observer::ALL {
            for illuminant in Illuminant::NAMED {
                for space in Space::ALL {
                    for adaptation in Adaptation::ALL {
                        all.extend(Step::ALL.map(|step| Integration {
                            observer,
                            illuminant: illuminant.clone(),
                            space,
                            adaptation,
                            step,
                        }));
                    }
                }
            }
        }
        all
    }

    #[test]
    fn a_mirror_is_exactly_white_and_nothing_is_black() {
        let all = all_choices();
        assert_eq!(all.len(), 160);
        for choices in all {
            let integrator = Integrator::new(&choices).expect("a named light has a white");
            let flat = |share: f64| integrator.colour(&vec![share; integrator.wavelengths.len()]);
            assert_eq!(flat(1.0), DVec3::ONE, "{choices:?}");
            assert_eq!(flat(0.0), DVec3::ZERO, "{choices:?}");
            let is_grey = flat(0.3).abs_diff_eq(DVec3::splat(0.3), 1e-14);
            assert!(is_grey, "{choices:?} {}", flat(0.3));
            if choices.adaptation == Adaptation::Bradford && choices.observer == Observer::Cie1931 {
                let is_white = integrator.mirror.abs_diff_eq(DVec3::ONE, 1e-13);
                assert!(is_white, "{choices:?}");
            }
        }
    }

    #[test]
    fn the_mirror_of_d65_before_the_division() {
        let choices = Integration {
            step: Step::Nm1,
            ..Integration::default()
        };
        let mirror = Integrator::new(&choices).unwrap().mirror;
        let wanted = DVec3::new(1.00012, 1.00001, 0.99952);
        assert!(mirror.abs_diff_eq(wanted, 5e-6), "{mirror}");
    }

    /// A smooth edge at 520 nm, much like gold's.
    fn edge(nm: f64) -> f64 {
        0.35 + 0.6 / (1.0 + libm::exp((520.0 - nm) / 12.0))
    }

    #[test]
    fn the_step_hardly_matters() {
        let colour = |step| {
            let choices = Integration {
                step,
                ..Integration::default()
            };
            let integrator = Integrator::new(&choices).unwrap();
            let reflectance = integrator.wavelengths.iter().map(|nm| edge(*nm));
            integrator.colour(&reflectance.collect::<Vec<f64>>())
        };
        let (coarse, fine) = (colour(Step::Nm5), colour(Step::Nm1));
        assert!(coarse.abs_diff_eq(fine, 2e-4), "{coarse} {fine}");
        assert!(fine.x > fine.y && fine.y > fine.z);
    }

    #[test]
    fn three_wavelengths_are_three_channels() {
        let integrator = Integrator::three_wavelengths([685.0, 535.0, 475.0]);
        assert_eq!(integrator.wavelengths, [685.0, 535.0, 475.0]);
        let colour = integrator.colour(&[0.9, 0.5, 0.1]);
        assert_eq!(colour, DVec3::new(0.9, 0.5, 0.1));
        assert_eq!(integrator.colour(&[1.0; 3]), DVec3::ONE);
        assert!(integrator.colour(&[1.0; 4]).is_nan());
    }

    #[test]
    fn a_light_of_one_wavelength_has_no_white() {
        let under = |text: &str| {
            Integrator::new(&Integration {
                illuminant: Illuminant::parse("laser.csv", text).expect("it is a light"),
                ..Integration::default()
            })
        };
        let error = under("380,0\n519,0\n520,1\n521,0\n780,0\n").expect_err("no white");
        let error = error.to_string();
        let names_both = error.contains("`laser.csv`") && error.contains("linear sRGB");
        assert!(names_both, "{error}");
        // The light's only line lies between the wavelengths of the sum, where there is nothing to divide by.
        assert!(under("380,0\n521,0\n522,1\n523,0\n780,0\n").is_err());
    }

    fn white(light: &Illuminant, step: Step) -> DVec3 {
        let wavelengths = step.wavelengths();
        let weights = xyz_weights(Observer::Cie1931, light, &wavelengths);
        weighted_sum(&weights, wavelengths.iter().map(|_| 1.0))
    }

    #[test]
    fn whites_of_the_illuminants() {
        // D65 in steps of 1 nm, computed independently by another program. Then x and y as CIE publishes them, for sums over a
        // longer range: D65, E, A and F11 in CIE 15:2004, LED-B3 in CIE 015:2018.
        let d65 = white(&Illuminant::D65, Step::Nm1);
        let computed = DVec3::new(0.950423, 1.0, 1.088610);
        assert!(d65.abs_diff_eq(computed, 5e-7), "{d65}");
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
        let wanted = DVec3::new(1.205, 0.948, 0.909);
        assert!(rgb.abs_diff_eq(wanted, 5e-4), "{rgb}");
    }

    #[test]
    fn one_line_says_all() {
        let default = Integration::default();
        assert_eq!(
            default.description(),
            "380-780 nm in steps of 5 nm, CIE 1931 2 degree observer, D65, linear sRGB, mirror = 1"
        );
        let other = Integration {
            illuminant: Illuminant::A,
            adaptation: Adaptation::Bradford,
            step: Step::Nm1,
            ..default
        };
        assert_eq!(other.adaptation_remark(), None);
        assert_eq!(
            other.description(),
            "380-780 nm in steps of 1 nm, CIE 1931 2 degree observer, A, adapted by Bradford, linear sRGB, mirror = 1"
        );
        let aces = |adaptation| Integration {
            space: Space::AcesCg,
            adaptation,
            ..Integration::default()
        };
        assert!(aces(Adaptation::Scale).adaptation_remark().is_some());
        assert_eq!(aces(Adaptation::Bradford).adaptation_remark(), None);
    }
}
