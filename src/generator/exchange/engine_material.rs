//! A material's numbers for exchange formats: colours in [0, 1], the tint, the index at the d line, Abbe's number.

use thiserror::Error;

use crate::generator::fit::{abbe_in, ior_in, known_film};
use crate::generator::reference::MaterialInMedium;
use crate::language::methods::{Input, KnownFilm, KnownSurface};
use crate::physics::foreign::Foreign;
use crate::physics::materials::{Extrapolate, Material, MaterialKind, ViewingConditions};
use crate::physics::optics::Layer;
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
    },
}

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
        let is_spectral = subject.reference.surface.is_spectral();
        let space = is_spectral.then_some(viewing.integration.space);
        let known = known(subject);
        let unclipped = subject.reference.clone().before_gamut().at(1.0);
        let f0 = known.f0.map(|value| rounded(value.clamp(0.0, 1.0)));
        let tint = Input::TINT.value(&known).expect("a surface gives it");
        Ok(EngineMaterial {
            subject,
            space,
            f0,
            tint: tint.map(rounded),
            body: body(subject)?,
            film: film(subject),
            coat: coat(subject),
            remarks: remarks(subject, viewing, unclipped),
        })
    }

    /// F0 encoded as sRGB, if the space is sRGB.
    pub fn hex(&self) -> Option<String> {
        let [red, green, blue] = self.f0.map(srgb_byte);
        let hex = format!("#{red:02x}{green:02x}{blue:02x}");
        (self.space == Some(Space::Srgb)).then_some(hex)
    }

    /// The remarks that every format makes.
    pub fn remarks(&self) -> impl Iterator<Item = String> {
        self.remarks.clone().into_iter()
    }
}

/// The surface's channels under viewing conditions, clipped.
fn known(subject: &MaterialInMedium) -> KnownSurface {
    let channels = subject.effective.channels;
    let seen = |cos_theta| subject.reference.at(cos_theta);
    KnownSurface::with(
        channels.n,
        channels.k,
        seen,
        subject.derivation.matching_cos,
    )
}

/// The medium's index at the d line, or at 555 nm, where the eye is most sensitive.
fn coat(subject: &MaterialInMedium) -> Option<f64> {
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

fn body(subject: &MaterialInMedium) -> Result<Body, ExchangeFault> {
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
    Ok(Body::Dielectric {
        ior,
        abbe: abbe_in(&subject.material, medium).filter(|abbe| *abbe > 0.0),
        is_clear: film(subject).map_or(subject.effective.channels.k, |film| film.k) == [0.0; 3],
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
            "F0 is ({red:?}, {green:?}, {blue:?}), and is clipped to [0, 1]; the error is told against the clipped spectrum"
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
#[derive(Clone, Debug, PartialEq, Eq, Error)]
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
