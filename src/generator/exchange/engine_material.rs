//! A material's numbers for exchange formats: colours in [0, 1], the tint, the index at the d line, Abbe's number.

use thiserror::Error;

use crate::generator::fit::{abbe_in, ior_in, known_film};
use crate::generator::reference::MaterialInMedium;
use crate::language::methods::{Input, KnownFilm, KnownSurface};
use crate::physics::foreign::Foreign;
use crate::physics::materials::{
    Attenuation, Extrapolate, Material, MaterialKind, ViewingConditions,
};
use crate::physics::num::each_channel;
use crate::physics::optics::{Layer, dielectric};
use crate::physics::spectra::{Gamut, Space, srgb_byte};

/// A material with the numbers that formats take.
#[derive(Clone, Debug)]
pub struct EngineMaterial<'a> {
    /// The material in its medium. Its reference is clipped to [0, 1].
    pub subject: &'a MaterialInMedium,
    /// The working space; none where each channel is one wavelength.
    pub space: Option<Space>,
    /// Reflectance at 0 degrees, clamped to [0, 1] and rounded as it is written.
    pub f0: [f64; 3],
    /// F82 over Schlick's value there, rounded as it is written. It may exceed 1.
    pub tint: [f64; 3],
    /// What lies below the surface.
    pub body: Body,
    /// The one film on it, with what lies below.
    pub film: Option<EngineFilm>,
    /// The index of the medium, if it is above that of air: then the medium may be a coat.
    pub medium_index: Option<f64>,
    /// The index of the clear coat on it. F0 and the tint are then those of what the base adds to the coat.
    pub coat: Option<f64>,
    remarks: Vec<String>,
}

/// A film, and the base without it, rounded as they are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngineFilm {
    /// Its index at 550 nm.
    pub ior: f64,
    /// Its thickness in nanometres, times the index of the medium outside: formats multiply it by the index that is relative to that
    /// medium, and compare with wavelengths in air.
    pub thickness_nm: f64,
    /// Reflectance of the base at 0 degrees, clamped to [0, 1].
    pub f0: [f64; 3],
    /// F82 of the base over Schlick's value there. It may exceed 1.
    pub tint: [f64; 3],
    /// The effective index of the base: n of each channel.
    pub n: [f64; 3],
    /// The same: k.
    pub k: [f64; 3],
}

/// A film with less k than this absorbs next to nothing.
const FAINT_K: f64 = 0.01;

/// What lies below the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A metal or a semiconductor: no light comes out again.
    Conductor,
    /// A dielectric.
    Dielectric {
        /// The index at the d line, rounded as it is written.
        ior: f64,
        /// Abbe's number, if known.
        abbe: Option<f64>,
        /// Whether light passes.
        is_clear: bool,
        /// The colour of light that passes, where k is known.
        attenuation: Option<Attenuation>,
    },
}

/// Light passes a body that halves it within no less than this, in metres.
const CLEAR_M: f64 = 1e-4;

/// A number rounded to five decimals, as it is written.
pub fn rounded(value: f64) -> f64 {
    // Adding 0 makes 0 of -0.
    libm::round(value * 1e5) / 1e5 + 0.0
}

/// Reflectance at 0 degrees of a real index.
pub fn f0_of(ior: f64) -> f64 {
    let root = (ior - 1.0) / (ior + 1.0);
    root * root
}

impl EngineMaterial<'_> {
    /// A material in its medium with the numbers that formats take. The viewing conditions are those it was made with, and they
    /// clip.
    ///
    /// # Errors
    /// It is a dielectric with an index below that of its medium.
    pub fn new<'a>(
        subject: &'a MaterialInMedium,
        viewing: &ViewingConditions,
    ) -> Result<EngineMaterial<'a>, ExchangeFault> {
        EngineMaterial::with_coat(subject, viewing, None)
    }

    /// A metal or a semiconductor below a clear coat of this index, in air.
    ///
    /// # Errors
    /// It is a dielectric, or lies in a medium.
    pub fn below_coat<'a>(
        subject: &'a MaterialInMedium,
        viewing: &ViewingConditions,
        coat: f64,
    ) -> Result<EngineMaterial<'a>, ExchangeFault> {
        if subject.material.kind == MaterialKind::Dielectric {
            return Err(ExchangeFault::CoatedDielectric {
                name: subject.name.clone(),
            });
        }
        if subject.medium.is_some() {
            return Err(ExchangeFault::CoatInMedium);
        }
        EngineMaterial::with_coat(subject, viewing, Some(coat))
    }

    fn with_coat<'a>(
        subject: &'a MaterialInMedium,
        viewing: &ViewingConditions,
        coat: Option<f64>,
    ) -> Result<EngineMaterial<'a>, ExchangeFault> {
        let is_spectral = subject.reference.surface.is_spectral();
        let space = is_spectral.then_some(viewing.integration.space);
        let known = known(subject, coat);
        let surface = &subject.reference.surface;
        let unclipped = match coat {
            Some(coat) => surface.through_coat(coat, 1.0).to_array(),
            None => subject.reference.clone().before_gamut().at(1.0),
        };
        let f0 = known.f0.map(|value| rounded(value.clamp(0.0, 1.0)));
        let tint = match coat {
            Some(coat) => tint_below_coat(subject, coat, f0),
            None => Input::TINT.value(&known).expect("a surface gives it"),
        };
        Ok(EngineMaterial {
            subject,
            space,
            f0,
            tint: tint.map(rounded),
            body: body(subject, viewing.beyond)?,
            film: film(subject).filter(|_| coat.is_none()),
            medium_index: medium_index(subject),
            coat,
            remarks: remarks(subject, viewing, unclipped),
        })
    }

    /// F0 as engines have it: a metal's colours, a dielectric's from its index, and what is seen of films.
    pub fn f0_in_engines(&self) -> [f64; 3] {
        match self.body {
            Body::Dielectric { ior, .. } if !self.subject.has_films() => [f0_of(ior); 3],
            _ => self.f0,
        }
    }

    /// F0 encoded as sRGB, if the space is sRGB.
    pub fn hex(&self) -> Option<String> {
        let [red, green, blue] = self.f0.map(srgb_byte);
        let hex = format!("#{red:02x}{green:02x}{blue:02x}");
        (self.space == Some(Space::Srgb)).then_some(hex)
    }

    /// The colour of light that passes, where the body is clear and k is known.
    pub fn attenuation(&self) -> Option<Attenuation> {
        match self.body {
            Body::Dielectric {
                is_clear: true,
                attenuation,
                ..
            } => attenuation,
            _ => None,
        }
    }

    /// What is seen at a cosine, clipped: of the surface, or of the coat and all that comes through it.
    pub fn truth(&self, cos_theta: f64) -> [f64; 3] {
        let Some(coat) = self.coat else {
            return self.subject.reference.at(cos_theta);
        };
        let surface = &self.subject.reference.surface;
        let own = dielectric(coat, cos_theta).unpolarised();
        let through = surface.through_coat(coat, cos_theta);
        surface.gamut.apply(own + (1.0 - own) * through).to_array()
    }

    /// The remarks that every format makes.
    pub fn remarks(&self) -> impl Iterator<Item = String> {
        self.remarks.clone().into_iter()
    }
}

/// The surface's channels under viewing conditions, clipped; below a coat, what it adds to the coat.
fn known(subject: &MaterialInMedium, coat: Option<f64>) -> KnownSurface {
    let channels = subject.effective.channels;
    let surface = &subject.reference.surface;
    let seen = |cos_theta| match coat {
        Some(coat) => {
            let through = surface.through_coat(coat, cos_theta);
            surface.gamut.apply(through).to_array()
        }
        None => subject.reference.at(cos_theta),
    };
    KnownSurface::with(
        channels.n,
        channels.k,
        seen,
        subject.derivation.matching_cos,
    )
}

/// The tint with which F82-tint of this F0 is nearest to what a base adds to a coat, by the squares over cosines of what is seen of the
/// base. F82-tint is 1 at grazing, where nothing enters a coat, so no one angle decides:
///
/// ```text
/// F = S - (1 - tint) K      S: Schlick's approximation      K = S(1/7) c (1 - c)^6 / ((1/7) (6/7)^6)
/// ```
fn tint_below_coat(subject: &MaterialInMedium, coat: f64, f0: [f64; 3]) -> [f64; 3] {
    const PARTS: usize = 1024;
    let surface = &subject.reference.surface;
    let schlick = |f0: f64, c: f64| f0 + (1.0 - f0) * libm::pow(1.0 - c, 5.0);
    let bump = |c: f64| c * libm::pow(1.0 - c, 6.0);
    let (mut products, mut squares) = ([0.0; 3], [0.0; 3]);
    for part in 1..=PARTS {
        let c = part as f64 / PARTS as f64;
        let seen = 1.0 - dielectric(coat, c).unpolarised();
        let base = surface
            .gamut
            .apply(surface.through_coat(coat, c))
            .to_array();
        for i in 0..3 {
            let k = seen * schlick(f0[i], 1.0 / 7.0) * bump(c) / bump(1.0 / 7.0);
            products[i] += k * seen * (schlick(f0[i], c) - base[i]);
            squares[i] += k * k;
        }
    }
    each_channel(|i| (1.0 - products[i] / squares[i]).clamp(0.0, 1.0))
}

/// The medium's index at the d line, or at 555 nm, where the eye is most sensitive.
fn medium_index(subject: &MaterialInMedium) -> Option<f64> {
    const GREEN_NM: f64 = 555.0;
    let (_, medium) = subject.medium.as_ref()?;
    let at_green = || medium.n.at(GREEN_NM, Extrapolate::Hold).ok();
    let index = ior_in(medium, None).or_else(at_green)?;
    (index > 1.0).then_some(index)
}

/// The film on it, if there is one and no other, of an index that formats take.
fn film(subject: &MaterialInMedium) -> Option<EngineFilm> {
    let [_] = subject.material.films.as_slice() else {
        return None;
    };
    let KnownFilm {
        thickness_nm,
        ior,
        outside,
        bare,
        ..
    } = *subject.film(0, known_film);
    let base = KnownSurface {
        f0: bare.f0,
        f82: bare.f82,
        ..KnownSurface::of_index(bare.n, bare.k, subject.derivation.matching_cos)
    };
    let tint = Input::TINT.value(&base).expect("a surface gives it");
    // Formats take no film that is optically rarer than what lies outside.
    (ior >= 1.0).then(|| EngineFilm {
        ior: rounded(ior),
        thickness_nm: rounded(outside * thickness_nm),
        f0: bare.f0.map(|value| rounded(value.clamp(0.0, 1.0))),
        tint: tint.map(rounded),
        n: bare.n.map(rounded),
        k: bare.k.map(rounded),
    })
}

fn body(subject: &MaterialInMedium, beyond: Extrapolate) -> Result<Body, ExchangeFault> {
    if subject.material.kind != MaterialKind::Dielectric {
        return Ok(Body::Conductor);
    }
    let medium: Option<&Material> = subject.medium.as_ref().map(|(_, medium)| medium);
    let own = subject.effective.channels.n;
    let middle = film(subject).map_or(own, |film| film.n)[1];
    let ior = rounded(ior_in(&subject.material, medium).unwrap_or(middle));
    if ior < 1.0 {
        return Err(ExchangeFault::Rarer {
            name: subject.name.clone(),
            index: format!("{ior}"),
        });
    }
    let attenuation = subject
        .reference
        .surface
        .attenuation(&subject.material, beyond);
    let k = film(subject).map_or(subject.effective.channels.k, |film| film.k);
    Ok(Body::Dielectric {
        ior,
        abbe: abbe_in(&subject.material, medium).filter(|abbe| *abbe > 0.0),
        is_clear: k == [0.0; 3] || attenuation.is_some_and(|light| light.distance_m >= CLEAR_M),
        attenuation,
    })
}

fn remarks(
    subject: &MaterialInMedium,
    viewing: &ViewingConditions,
    unclipped: [f64; 3],
) -> Vec<String> {
    let mut remarks = Vec::new();
    let surface = &subject.reference.surface;
    let written = unclipped.map(rounded);
    if surface.gamut == Gamut::Clip && written.iter().any(|value| !(0.0..=1.0).contains(value)) {
        let [red, green, blue] = written;
        remarks.push(format!(
            "the colour at normal incidence is ({red:?}, {green:?}, {blue:?}), and is clipped to [0, 1]; the error is told against the clipped spectrum"
        ));
    }
    if !surface.is_spectral() {
        remarks
            .push("each channel is one wavelength: the colours are in no colour space".to_owned());
    } else {
        remarks.extend(viewing.integration.adaptation_remark().map(str::to_owned));
    }
    let absorbs = |film: &Layer| film.k >= FAINT_K;
    if film(subject).is_some() && surface.films.iter().flatten().any(absorbs) {
        remarks.push("the film absorbs, and no format has a film that does".to_owned());
    }
    remarks.extend(
        surface
            .extrapolation()
            .map(|held| format!("extrapolated: {held}")),
    );
    remarks
}

/// Why a material cannot be exported to a format.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ExchangeFault {
    /// A dielectric under films, for a format that has no film, or more films than one.
    #[error(
        "`{}` is a dielectric under films: this format would have what lies below, without the films; the functions of `--material` have them, and blender, gltf, materialx and openpbr take one clear film that is not rarer than the medium",
        Foreign(name)
    )]
    Filmed {
        /// The material.
        name: String,
    },
    /// A dielectric with an index below that of its medium.
    #[error(
        "`{}` has an index of {index} relative to its medium; these formats take an index of 1 or more: choose a medium that \
         is optically rarer",
        Foreign(name)
    )]
    Rarer {
        /// The material.
        name: String,
        /// Its relative index.
        index: String,
    },
    /// A dielectric below a clear coat.
    #[error(
        "`{}` is a dielectric, which hardly shows below a clear coat; metals and semiconductors do",
        Foreign(name)
    )]
    CoatedDielectric {
        /// The material.
        name: String,
    },
    /// A coat in a medium.
    #[error("a clear coat lies in air: leave --medium out")]
    CoatInMedium,
    /// A format without a coat.
    #[error("--as {format} has no clear coat whose formula is known; --coat takes {allowed}")]
    NoCoat {
        /// The format.
        format: &'static str,
        /// The formats that have one.
        allowed: String,
    },
    /// A coat of an index that the format has not.
    #[error(
        "the clear coat of --as {format} has an index of 1.5, and not of {index}; {allowed} take other ones"
    )]
    CoatIndex {
        /// The format.
        format: &'static str,
        /// The index requested.
        index: f64,
        /// The formats that take it.
        allowed: String,
    },
    /// A working space that the format does not support.
    #[error("--as {format} takes colours in {allowed}, and not in {space}; change --space")]
    Space {
        /// The format.
        format: &'static str,
        /// The space requested.
        space: &'static str,
        /// The spaces that the format supports.
        allowed: String,
    },
}
