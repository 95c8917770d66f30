//! A material under viewing conditions: its relative index at some wavelengths, and how these give three channels.
//!
//! ```text
//! R_c(θ) = Σ w_c(λ) R(λ, θ) / Σ w_c(λ)      R(λ, θ) by the exact law, from n(λ) and k(λ) relative to the medium
//! ```
//!
//! One wavelength a channel is the thesis's way. With the observer's curves times the illuminant, it is the colour of the
//! reflected light, where a perfect mirror is (1, 1, 1). [`Channels`] is n and k for red, green and blue.

use glam::DVec3;

use super::film::Film;
use super::formula::Extrapolate;
use super::material::{Index, Material};
use crate::physics::num::each_channel;
use crate::physics::optics::{
    Layer, Reflectance, dielectric, under_films, unpolarised, unpolarised_under_films,
};
use crate::physics::spectra::{FIRST_NM, Gamut, Integration, Integrator, LAST_NM, Step};

/// The conditions under which reflectance becomes three channels.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewingConditions {
    /// Observer, illuminant, working space, adaptation, step.
    pub integration: Integration,
    /// How colours outside the working space are treated.
    pub gamut: Gamut,
    /// Red, green and blue at one wavelength each, instead of the whole spectrum.
    pub wavelengths_nm: Option<[f64; 3]>,
    /// What is done outside the measured range.
    pub beyond: Extrapolate,
}

impl Default for ViewingConditions {
    fn default() -> ViewingConditions {
        ViewingConditions {
            integration: Integration::default(),
            gamut: Gamut::Clip,
            wavelengths_nm: None,
            beyond: Extrapolate::Refuse,
        }
    }
}

impl ViewingConditions {
    /// These conditions with wavelengths close enough for fringes, where films lie on the material: 1 nm.
    pub fn following(&self, material: &Material) -> ViewingConditions {
        let mut viewing = self.clone();
        if material.films.iter().any(|film| film.thickness_nm > 0.0) {
            viewing.integration.step = Step::Nm1;
        }
        viewing
    }

    /// The reference for a spectrum, in words.
    pub fn reference_in_words(&self) -> String {
        format!(
            "reflectance integrated over {}{}",
            self.integration.description(),
            in_gamut(self.gamut)
        )
    }
}

/// The greatest sum of n times thickness of films, in nanometres. Beyond it fringes are finer than 1 nm follows (`films` tests it).
const THICKEST_OPTICAL_NM: f64 = 6000.0;

/// The surface of a material in its medium, under viewing conditions.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The relative index at each of the integrator's wavelengths.
    pub indices: Vec<Index>,
    /// The films on it at each of these, outermost first; empty if there are none.
    pub films: Vec<Vec<Layer>>,
    /// From a spectrum to three channels.
    pub integrator: Integrator,
    /// How colours outside the working space are treated.
    pub gamut: Gamut,
    /// What its channels are, in words.
    pub seen: String,
    /// The lowest and the highest measured wavelength in nanometres, if the index was held beyond it.
    pub extrapolated_nm: (Option<f64>, Option<f64>),
}

/// The colour of light after a distance in a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attenuation {
    /// The distance in metres.
    pub distance_m: f64,
    /// What is left of each channel.
    pub colour: [f64; 3],
}

/// Why a material has no surface under these conditions.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{advice}", crate::physics::foreign::one_line(why))]
pub struct SurfaceError {
    /// The material, its measured range and the wavelength that is wanted.
    pub why: String,
    /// What can be done.
    pub advice: String,
}

impl Surface {
    /// The surface of a material in air or in a medium. If either is known at three wavelengths only, these are used.
    ///
    /// # Errors
    /// The material or the medium was not measured at a wavelength of these conditions, or the light has no white in the space.
    pub fn new(
        material: &Material,
        medium: Option<&Material>,
        viewing: &ViewingConditions,
    ) -> Result<Surface, SurfaceError> {
        let viewing = &viewing.following(material);
        let three = viewing
            .wavelengths_nm
            .or_else(|| parts(material, medium).find_map(|part| part.rgb_nm));
        let integrator = match three {
            Some(rgb) => Integrator::three_wavelengths(rgb),
            None => Integrator::new(&viewing.integration).map_err(|fault| SurfaceError {
                why: fault.to_string(),
                advice: String::new(),
            })?,
        };
        let at = |nm: &f64| AtWavelength::new(material, medium, *nm, viewing.beyond);
        let wavelengths = integrator.wavelengths.iter();
        let all = wavelengths.map(at).collect::<Result<Vec<_>, String>>();
        let extrapolated_nm = extrapolated_beyond(material, medium, &integrator.wavelengths);
        let gamut = if three.is_some() {
            Gamut::Keep
        } else {
            viewing.gamut
        };
        let all = all.map_err(|why| SurfaceError {
            why,
            advice: advice(extrapolated_nm, three.is_some()),
        })?;
        check_fringes(material, &all, &integrator.wavelengths)?;
        let (indices, mut films): (_, Vec<_>) =
            all.into_iter().map(|at| (at.index, at.films)).unzip();
        if material.films.is_empty() {
            films.clear();
        }
        Ok(Surface {
            indices,
            films,
            extrapolated_nm,
            integrator,
            gamut,
            seen: match three {
                Some(rgb) => three_in_words(rgb),
                None => viewing.reference_in_words(),
            },
        })
    }

    /// The surface with these channels.
    pub fn of_channels(channels: &Channels) -> Surface {
        let index = |i: usize| Index {
            n: channels.n[i],
            k: channels.k[i],
        };
        Surface {
            indices: each_channel(index).to_vec(),
            films: Vec::new(),
            integrator: Integrator::three_wavelengths(super::THESIS_NM),
            gamut: Gamut::Keep,
            seen: "one index a channel".to_owned(),
            extrapolated_nm: (None, None),
        }
    }

    /// The channels, if each is one index: one wavelength, without films.
    pub fn channels(&self) -> Option<Channels> {
        if !self.films.is_empty() {
            return None;
        }
        let indices: [Index; 3] = self.indices.as_slice().try_into().ok()?;
        Some(Channels::of(indices))
    }

    /// Whether it is integrated over the spectrum. Otherwise each channel is one wavelength.
    pub fn is_spectral(&self) -> bool {
        self.integrator.wavelengths.len() != 3
    }

    /// The reflectance at each wavelength.
    fn spectrum(&self, cos_theta: f64) -> impl Iterator<Item = Reflectance<f64>> {
        let indices = self.indices.iter().enumerate();
        indices.map(move |(i, index)| under_films(self.films_at(i), index.n, index.k, cos_theta))
    }

    /// The films at one of the integrator's wavelengths.
    pub fn films_at(&self, place: usize) -> &[Layer] {
        self.films.get(place).map_or(&[], Vec::as_slice)
    }

    /// The reflectance of each channel in both polarisations, without gamut mapping.
    pub fn reflectance(&self, cos_theta: f64) -> Reflectance<DVec3> {
        let both: Vec<Reflectance<f64>> = self.spectrum(cos_theta).collect();
        let colour = |part: fn(&Reflectance<f64>) -> f64| {
            let spectrum: Vec<f64> = both.iter().map(part).collect();
            self.integrator.colour(&spectrum)
        };
        Reflectance {
            s: colour(|r| r.s),
            p: colour(|r| r.p),
        }
    }

    /// The reflectance of each channel for unpolarised light, without gamut mapping.
    pub fn unpolarised(&self, cos_theta: f64) -> DVec3 {
        self.integrator
            .colour(&self.unpolarised_spectrum(cos_theta))
    }

    /// The reflectance at each wavelength for unpolarised light.
    pub fn unpolarised_spectrum(&self, cos_theta: f64) -> Vec<f64> {
        if self.films.is_empty() {
            let indices = self.indices.iter();
            return indices
                .map(|index| unpolarised(index.n, index.k, cos_theta))
                .collect();
        }
        let bases = self.indices.iter().map(|index| (index.n, index.k));
        unpolarised_under_films(&self.films, &bases.collect::<Vec<_>>(), cos_theta)
    }

    /// What the surface adds to a clear coat of index `coat` that lies on it, at a cosine outside, without gamut mapping. A renderer draws
    /// `R_c + (1 - R_c) B` with R_c, what the coat reflects itself. All that both interfaces reflect, one after the other, is this with
    ///
    /// ```text
    /// B = Σ (1 - R_c)² R_b / (1 - R_c R_b) / Σ (1 - R_c)      sums over s and p; R_b relative to the coat, at the refracted angle
    /// ```
    ///
    /// Domain: cosine 0 to 1, `coat` from 1. At grazing nothing enters the coat, and B is 0. The coat absorbs nothing and is too thick for
    /// fringes: Born, Wolf, "Principles of Optics", 1999, section 7.6, <https://doi.org/10.1017/CBO9781139644181>.
    pub fn through_coat(&self, coat: f64, cos_theta: f64) -> DVec3 {
        let own = dielectric(coat, cos_theta);
        let entering = 2.0 - own.s - own.p;
        if entering <= 0.0 {
            return DVec3::ZERO;
        }
        let inside = (1.0 - (1.0 - cos_theta * cos_theta) / (coat * coat)).sqrt();
        let indices = self.indices.iter().enumerate();
        let added = indices.map(|(i, index)| {
            let films = self.films_at(i).iter().map(|film| film.within(coat));
            let films: Vec<Layer> = films.collect();
            let below = under_films(&films, index.n / coat, index.k / coat, inside);
            let part = |own: f64, below: f64| (1.0 - own).powi(2) * below / (1.0 - own * below);
            (part(own.s, below.s) + part(own.p, below.p)) / entering
        });
        let spectrum: Vec<f64> = added.collect();
        self.integrator.colour(&spectrum)
    }

    /// What passes a material, by Beer's law with k in the material itself:
    ///
    /// ```text
    /// T(λ) = e^(-4π k d / λ)        d: the distance at which the least of the three channels of T is one half
    /// ```
    ///
    /// A renderer raises the colour to the power of distance over d, so no channel may be near 0 there. d is rounded to hundredths of a
    /// millimetre. None where k is 0 or not known, where d is less, or more than 1000 km.
    pub fn attenuation(&self, material: &Material, beyond: Extrapolate) -> Option<Attenuation> {
        let wavelengths = self.integrator.wavelengths.iter();
        let per_metre = |nm: &f64| {
            let k = material.index(*nm, beyond).ok()?.k;
            Some(4.0 * core::f64::consts::PI * k / (nm * 1e-9))
        };
        let absorbed: Vec<f64> = wavelengths.map(per_metre).collect::<Option<_>>()?;
        let passed = |metres: f64| {
            let part = absorbed.iter().map(|each| libm::exp(-each * metres));
            self.integrator.colour(&part.collect::<Vec<f64>>())
        };
        let is_half = |exponent: f64| passed(libm::exp10(exponent)).min_element() <= 0.5;
        let (mut short, mut long) = (-5.0, 6.0);
        if absorbed.iter().all(|each| *each == 0.0) || !is_half(long) || is_half(short) {
            return None;
        }
        for _ in 0..64 {
            let middle = 0.5 * (short + long);
            *if is_half(middle) {
                &mut long
            } else {
                &mut short
            } = middle;
        }
        let distance_m = libm::round(libm::exp10(long) * 1e5) / 1e5;
        let colour = self.gamut.apply(passed(distance_m)).to_array();
        Some(Attenuation { distance_m, colour })
    }

    /// The wavelengths at which the index is extrapolated, in words; none if there are none.
    pub fn extrapolation(&self) -> Option<String> {
        extrapolation_in_words(self.extrapolated_nm)
    }

    /// The largest k at any of the wavelengths.
    pub fn most_k(&self) -> f64 {
        self.indices.iter().map(|index| index.k).fold(0.0, f64::max)
    }
}

fn extrapolation_in_words((below, above): (Option<f64>, Option<f64>)) -> Option<String> {
    let below = below.map(|nm| format!("below {nm} nm"));
    let above = above.map(|nm| format!("above {nm} nm"));
    let ends: Vec<String> = below.into_iter().chain(above).collect();
    (!ends.is_empty()).then(|| format!("{} the last measured index is held", ends.join(" and ")))
}

fn in_gamut(gamut: Gamut) -> &'static str {
    match gamut {
        Gamut::Keep => "",
        Gamut::Clip => ", clipped to [0, 1]",
        Gamut::Scale => ", scaled into [0, 1]",
    }
}

fn three_in_words([red, green, blue]: [f64; 3]) -> String {
    format!("reflectance at {red}, {green} and {blue} nm for red, green and blue")
}

/// The advice for a measurement wholly outside the visible range.
const UNSEEN: &str = "; it holds nothing of what is seen: take another measurement, or, to take its nearest value all the same, add --extrapolate hold";

/// The advice for a material or medium that is not known everywhere; empty where the fault lies elsewhere.
fn advice(extrapolated: (Option<f64>, Option<f64>), three: bool) -> String {
    let hold = "to hold the last value beyond what was measured, add --extrapolate hold";
    match (extrapolated, three) {
        ((None, None), _) => String::new(),
        ((Some(from), _), _) if from >= LAST_NM => UNSEEN.to_owned(),
        ((_, Some(to)), _) if to <= FIRST_NM => UNSEEN.to_owned(),
        (_, true) => format!("; {hold}"),
        (_, false) => format!(
            ". The whole spectrum means {FIRST_NM} to {LAST_NM} nm; {hold}; to take three wavelengths instead, add \
             --wavelengths 685,535,475 or others inside"
        ),
    }
}

/// A material, its films and its medium.
fn parts<'a>(
    material: &'a Material,
    medium: Option<&'a Material>,
) -> impl Iterator<Item = &'a Material> {
    let films = material.films.iter().map(|film| &film.material);
    [material].into_iter().chain(films).chain(medium)
}

/// Refuses films whose fringes are too fine to be seen or integrated.
fn check_fringes(
    material: &Material,
    all: &[AtWavelength],
    wavelengths: &[f64],
) -> Result<(), SurfaceError> {
    let optical = |(at, nm): (&AtWavelength, &f64)| {
        let waves = at.films.iter().map(|film| film.n * film.waves);
        waves.sum::<f64>() * nm
    };
    let most = all.iter().zip(wavelengths).map(optical).fold(0.0, f64::max);
    if most <= THICKEST_OPTICAL_NM {
        return Ok(());
    }
    Err(SurfaceError {
        why: format!(
            "material `{}`: its films are {most:.0} nm thick by n times thickness",
            material.name
        ),
        advice: format!(
            "; {THICKEST_OPTICAL_NM} nm are allowed: of thicker ones no colours of interference are seen. A thick layer is a coat, and what lies \
             below has it as its --medium"
        ),
    })
}

/// A material in its medium at one wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct AtWavelength {
    /// The relative index of what lies below the films.
    pub index: Index,
    /// The films, outermost first.
    pub films: Vec<Layer>,
}

impl AtWavelength {
    /// A material in air or in a medium.
    ///
    /// # Errors
    /// The material, a film or the medium is not known at the wavelength.
    pub fn new(
        material: &Material,
        medium: Option<&Material>,
        nm: f64,
        beyond: Extrapolate,
    ) -> Result<AtWavelength, String> {
        let own = material.index(nm, beyond)?;
        let outside = medium.map(|medium| medium.index(nm, beyond)).transpose()?;
        let relative = |index: Index| outside.map_or(index, |outside| index.relative_to(outside));
        let layer = |film: &Film| {
            let Index { n, k } = relative(film.material.index(nm, beyond)?);
            let waves = film.thickness_nm * outside.map_or(1.0, |outside| outside.n) / nm;
            Ok(Layer { n, k, waves })
        };
        let films = material.films.iter().map(layer);
        Ok(AtWavelength {
            index: relative(own),
            films: films.collect::<Result<_, String>>()?,
        })
    }

    /// The same at each of some wavelengths.
    ///
    /// # Errors
    /// The material, a film or the medium is not known at one of them.
    pub fn each(
        material: &Material,
        medium: Option<&Material>,
        wavelengths_nm: &[f64],
        beyond: Extrapolate,
    ) -> Result<Vec<AtWavelength>, SurfaceError> {
        for part in parts(material, medium) {
            let Some(rgb) = part.rgb_nm else { continue };
            if let Some(nm) = wavelengths_nm.iter().find(|nm| !rgb.contains(nm)) {
                let [red, green, blue] = rgb;
                let name = &part.name;
                return Err(SurfaceError {
                    why: format!(
                        "material `{name}`: known at {red}, {green} and {blue} nm only, and {nm} nm is wanted"
                    ),
                    advice: String::new(),
                });
            }
        }
        let at = |nm: &f64| AtWavelength::new(material, medium, *nm, beyond);
        let all: Result<_, String> = wavelengths_nm.iter().map(at).collect();
        all.map_err(|why| SurfaceError {
            why,
            advice: advice(extrapolated_beyond(material, medium, wavelengths_nm), true),
        })
    }

    /// Beyond which wavelengths the last measured index was held at some of these, in words; none if nowhere.
    pub fn extrapolation(
        material: &Material,
        medium: Option<&Material>,
        wavelengths_nm: &[f64],
    ) -> Option<String> {
        extrapolation_in_words(extrapolated_beyond(material, medium, wavelengths_nm))
    }

    /// Its reflectance.
    pub fn reflectance(&self, cos_theta: f64) -> Reflectance<f64> {
        under_films(&self.films, self.index.n, self.index.k, cos_theta)
    }
}

/// The ends of the measured range beyond which an index is extrapolated.
fn extrapolated_beyond(
    material: &Material,
    medium: Option<&Material>,
    wavelengths: &[f64],
) -> (Option<f64>, Option<f64>) {
    let all = || parts(material, medium);
    let inside = |nm: f64| all().all(|material| material.covers(nm, nm));
    let (from, to) = all()
        .map(Material::range_nm)
        .fold((0.0, f64::INFINITY), |(low, high), (from, to)| {
            (f64::max(low, from), f64::min(high, to))
        });
    let outside = |end: f64, beyond: &dyn Fn(f64) -> bool| {
        wavelengths
            .iter()
            .any(|nm| beyond(*nm) && !inside(*nm))
            .then_some(end)
    };
    (outside(from, &|nm| nm < from), outside(to, &|nm| nm > to))
}

/// The materials that are spectra of this substance and have a surface under these conditions, each with its surface.
pub fn surfaces_of<'a>(
    substance: &'a str,
    catalogue: &'a [Material],
    medium: Option<&'a Material>,
    viewing: &'a ViewingConditions,
) -> impl Iterator<Item = (&'a Material, Surface)> {
    let same = catalogue
        .iter()
        .filter(|other| other.is_spectrum_of(substance));
    same.filter_map(move |other| Some((other, Surface::new(other, medium, viewing).ok()?)))
}

/// Red, green and blue in nanometres, as in the thesis: the middles of the three bands.
pub const THESIS_NM: [f64; 3] = [685.0, 535.0, 475.0];

/// The relative index of refraction per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channels {
    /// Real part.
    pub n: [f64; 3],
    /// Extinction coefficient.
    pub k: [f64; 3],
}

impl Material {
    /// n and k at three wavelengths, linearly interpolated.
    ///
    /// # Errors
    /// A wavelength lies outside the measured range, or an index outside its limits.
    pub fn channels(&self, wavelengths_nm: [f64; 3]) -> Result<Channels, String> {
        let [red, green, blue] = wavelengths_nm.map(|nm| self.index(nm, Extrapolate::Refuse));
        Ok(Channels::of([red?, green?, blue?]))
    }
}

impl Channels {
    /// The channels from an index each.
    pub fn of(indices: [Index; 3]) -> Channels {
        Channels {
            n: indices.map(|index| index.n),
            k: indices.map(|index| index.k),
        }
    }

    /// Whether all k are 0.
    pub fn is_transparent(&self) -> bool {
        self.k == [0.0; 3]
    }
}
