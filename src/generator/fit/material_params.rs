//! The parameters of a material for engines, and how well each is known: by the colour error, and by other measurements.

use serde::Serialize;

use crate::generator::reference::ReferenceCurve;
use crate::language::methods::Light;
use crate::physics::materials::{
    Material, MaterialKind, Surface, Unseen, ViewingConditions, surfaces_of,
};
use crate::physics::spectra::Gamut;

use super::grey_tint::{GreyTint, grey_tint};
use super::params::{BOUNCES, Params, abbe_in, colour_errors, ior_in, params};

/// The parameters of a material in a medium under viewing conditions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MaterialParams {
    /// The material's name.
    pub name: String,
    /// Its class.
    pub class: &'static str,
    /// The medium's name.
    pub medium: String,
    /// The working space; none, as of the next four, where each channel is one wavelength.
    pub space: Option<&'static str>,
    /// The light.
    pub illuminant: Option<String>,
    /// The observer.
    pub observer: Option<&'static str>,
    /// The chromatic adaptation.
    pub adaptation: Option<&'static str>,
    /// The step of the sum over wavelengths.
    pub step_nm: Option<u16>,
    /// What becomes of colours outside the working space.
    pub gamut: &'static str,
    /// What the reference reflectance is, in words.
    pub truth: String,
    /// Beyond which wavelengths its index was held, in words, where it was.
    pub extrapolated: Option<String>,
    /// What is to be said of the adaptation, for people.
    #[serde(skip)]
    pub remark: Option<&'static str>,
    /// What engines take.
    #[serde(flatten)]
    pub params: Params,
    /// Its own index at the d line, where it is known.
    pub ior_d: Option<f64>,
    /// Abbe's number, of what is clear enough to have one.
    pub abbe: Option<f64>,
    /// Why there are no viewing conditions, where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
    /// The error of three channels in place of a spectrum; none where three wavelengths are not a spectrum.
    pub colour_error: Option<ColourErrors>,
    /// How far the measurements of the substance lie apart.
    pub spread: MeasuredSpread,
    /// The one tint of F82-tint for all channels that serves best.
    pub grey_f82_tint: GreyTint,
}

/// Colour errors in ΔE 2000, by light and number of bounces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourErrors {
    /// The numbers of bounces.
    pub bounces: [u32; 3],
    /// A row for each other light.
    pub rows: Vec<ColourErrorRow>,
}

/// The colour error under another light.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourErrorRow {
    /// The light.
    pub illuminant: String,
    /// For each number of bounces.
    pub delta_e2000: [f64; 3],
}

/// How far the F0 of all measurements of a substance lie apart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeasuredSpread {
    /// The least of all, this one among them.
    pub f0_min: [f64; 3],
    /// The most of all.
    pub f0_max: [f64; 3],
    /// The other measurements, over the whole spectrum.
    pub others: Vec<OtherMeasurement>,
}

/// Another measurement of the same substance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OtherMeasurement {
    /// The material's name.
    pub name: String,
    /// Its reflectance at 0 degrees.
    pub f0: [f64; 3],
}

/// The parameters of a material, held against the other measurements of its substance in the catalogue. The gamut should keep
/// colours as they are.
///
/// # Errors
/// The material or the medium is not known where it is looked at.
pub fn material_params(
    material: &Material,
    medium: Option<&Material>,
    viewing: &ViewingConditions,
    catalogue: &[Material],
) -> Result<MaterialParams, Unseen> {
    // What is known at three wavelengths is compared with others at the same.
    let own = material.rgb_nm.or(medium.and_then(|medium| medium.rgb_nm));
    let viewing = ViewingConditions {
        wavelengths_nm: viewing.wavelengths_nm.or(own),
        ..viewing.clone()
    };
    let surface = Surface::new(material, medium, &viewing)?;
    let is_spectral = viewing.wavelengths_nm.is_none();
    let integration = Some(&viewing.integration).filter(|_| is_spectral);
    let one_wavelength = "one wavelength a channel: no spectrum is integrated";
    let errors = colour_errors(&surface, &viewing.integration);
    let (truth, extrapolated) = (surface.seen.clone(), surface.extrapolation());
    let grey_f82_tint = grey_tint(&clipped(surface.clone()));
    let params = params(surface, material.kind);
    Ok(MaterialParams {
        name: material.name.clone(),
        class: material.kind.name(),
        medium: medium.map_or("air", |medium| &medium.name).to_owned(),
        space: integration.map(|by| by.space.name()),
        illuminant: integration.map(|by| by.illuminant.name().to_owned()),
        observer: integration.map(|by| by.observer.name()),
        adaptation: integration.map(|by| by.adaptation.name()),
        step_nm: integration.map(|by| by.step.nm()),
        gamut: viewing.gamut.name(),
        truth,
        extrapolated,
        remark: integration.and_then(|by| by.adaptation_remark()),
        ior_d: ior_in(material, None),
        abbe: abbe_in(material, None).filter(|_| material.kind == MaterialKind::Dielectric),
        reason: (!is_spectral).then_some(one_wavelength),
        colour_error: errors.map(|errors| ColourErrors {
            bounces: BOUNCES,
            rows: errors
                .into_iter()
                .map(|(light, delta_e2000)| ColourErrorRow {
                    illuminant: light.name().to_owned(),
                    delta_e2000,
                })
                .collect(),
        }),
        spread: MeasuredSpread::new(params.f0, others(material, medium, &viewing, catalogue)),
        params,
        grey_f82_tint,
    })
}

/// The reference that errors of methods are told against: a spectrum is clipped.
fn clipped(surface: Surface) -> ReferenceCurve {
    let gamut = match surface.channels() {
        Some(_) => Gamut::Keep,
        None => Gamut::Clip,
    };
    ReferenceCurve::new(Surface { gamut, ..surface }, Light::Unpolarised)
}

/// The other measurements of a material's substance over the whole spectrum.
fn others(
    material: &Material,
    medium: Option<&Material>,
    viewing: &ViewingConditions,
    catalogue: &[Material],
) -> Vec<OtherMeasurement> {
    let measured = surfaces_of(&material.substance, catalogue, medium, viewing);
    let others = measured.filter(|(other, _)| other.name != material.name);
    let other = |(other, surface): (&Material, Surface)| OtherMeasurement {
        name: other.name.clone(),
        f0: surface.unpolarised(1.0).to_array(),
    };
    others.map(other).collect()
}

impl MeasuredSpread {
    fn new(f0: [f64; 3], others: Vec<OtherMeasurement>) -> MeasuredSpread {
        let (mut f0_min, mut f0_max) = (f0, f0);
        for other in &others {
            for (i, value) in other.f0.iter().enumerate() {
                f0_min[i] = f0_min[i].min(*value);
                f0_max[i] = f0_max[i].max(*value);
            }
        }
        MeasuredSpread {
            f0_min,
            f0_max,
            others,
        }
    }
}
