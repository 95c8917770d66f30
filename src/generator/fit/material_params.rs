//! The parameters of a material for engines: colours, index per channel and averages, with colour errors and other measurements
//! to show how well each is known. Also two colours of a surface in air, converted to those under a coat.
//!
//! Colours are unclipped: saturated gold has F0 above 1 in linear sRGB.

use serde::Serialize;

use super::grey_tint::{GreyTint, grey_tint};
use crate::generator::reference::{Derivation, IndexSource, ReferenceCurve, effective};
use crate::language::methods::{Input, KnownSurface, Light};
use crate::physics::materials::{
    Channels, Extrapolate, Material, MaterialKind, Surface, SurfaceError, ViewingConditions,
    surfaces_of,
};
use crate::physics::num::each_channel;
use crate::physics::optics::{COS_82, UnderCoat, conductor, under_coat};
use crate::physics::spectra::{Gamut, Illuminant, Integration, colour_error};

/// The parameters of a material in a medium under viewing conditions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MaterialParams {
    /// The material's name.
    pub name: String,
    /// Its class.
    pub class: &'static str,
    /// The medium's name.
    pub medium: String,
    /// The working space. This and the next four are none where each channel is one wavelength.
    pub space: Option<&'static str>,
    /// The light.
    pub illuminant: Option<String>,
    /// The observer.
    pub observer: Option<&'static str>,
    /// The chromatic adaptation.
    pub adaptation: Option<&'static str>,
    /// The step of the sum over wavelengths, in nanometres.
    pub step_nm: Option<u16>,
    /// How colours outside the working space are treated.
    pub gamut: &'static str,
    /// What the reference reflectance is, in words.
    pub truth: String,
    /// In words, beyond which wavelengths its index was held constant; none if nowhere.
    pub extrapolated: Option<String>,
    /// A remark about the adaptation, for the user.
    #[serde(skip)]
    pub remark: Option<&'static str>,
    /// The parameters that engines take.
    #[serde(flatten)]
    pub params: Params,
    /// Its own index at the d line, if known.
    pub ior_d: Option<f64>,
    /// Abbe's number, for materials clear enough to have one.
    pub abbe: Option<f64>,
    /// Why there are no viewing conditions, if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
    /// The error of using three channels in place of a spectrum; none for materials known at only three wavelengths.
    pub colour_error: Option<ColourErrors>,
    /// How far the measurements of the substance differ.
    pub spread: MeasuredSpread,
    /// The best single tint of F82-tint for all channels.
    pub grey_f82_tint: GreyTint,
}

/// Colour errors in ΔE 2000, by light and number of bounces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourErrors {
    /// The numbers of bounces.
    pub bounces: [u32; 3],
    /// One row for each other light.
    pub rows: Vec<ColourErrorRow>,
}

/// The colour error under another light.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourErrorRow {
    /// The light.
    pub illuminant: String,
    /// The error for each number of bounces.
    pub delta_e2000: [f64; 3],
}

/// The range of F0 over all measurements of a substance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeasuredSpread {
    /// The minimum, including this measurement.
    pub f0_min: [f64; 3],
    /// The maximum, including this measurement.
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

/// The parameters of a material, compared with the other measurements of its substance in the catalogue. The gamut should keep
/// colours unclipped.
///
/// # Errors
/// The material or the medium is not known at the wavelengths needed.
pub fn material_params(
    material: &Material,
    medium: Option<&Material>,
    viewing: &ViewingConditions,
    catalogue: &[Material],
) -> Result<MaterialParams, SurfaceError> {
    // A material known at three wavelengths is compared with others at the same three.
    let own = material.rgb_nm.or(medium.and_then(|medium| medium.rgb_nm));
    let viewing = ViewingConditions {
        wavelengths_nm: viewing.wavelengths_nm.or(own),
        ..viewing.following(material)
    };
    let surface = Surface::new(material, medium, &viewing)?;
    let is_spectral = viewing.wavelengths_nm.is_none();
    let integration = Some(&viewing.integration).filter(|_| is_spectral);
    let one_wavelength = "one wavelength a channel: no spectrum is integrated";
    let errors = colour_errors(&surface, &viewing.integration);
    let (truth, extrapolated) = (surface.seen.clone(), surface.extrapolation());
    let grey_f82_tint = grey_tint(&clipped(surface.clone()));
    let params = params(surface, material.optical_kind());
    Ok(MaterialParams {
        name: material.name.clone(),
        class: material.class_name(),
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

/// The reference for the errors of methods: a spectrum is clipped.
fn clipped(surface: Surface) -> ReferenceCurve {
    let gamut = if surface.is_spectral() {
        Gamut::Clip
    } else {
        Gamut::Keep
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
        let all = |i: usize| others.iter().map(move |other| other.f0[i]);
        MeasuredSpread {
            f0_min: each_channel(|i| all(i).fold(f0[i], f64::min)),
            f0_max: each_channel(|i| all(i).fold(f0[i], f64::max)),
            others,
        }
    }
}

/// The parameters of a material in a medium, three channels each, under viewing conditions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Params {
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees, cos θ = 1/7.
    pub f82: [f64; 3],
    /// F82 over Schlick's value there: the tint of the F82-tint model.
    pub f82_tint: [f64; 3],
    /// Reflectance at 90 degrees.
    pub f90: [f64; 3],
    /// Gulbrandsen's reflectivity r of the index: F0 where the index has it, and never above 1.
    pub reflectivity: [f64; 3],
    /// Gulbrandsen's edge tint g of the index.
    pub edge_tint: [f64; 3],
    /// The effective n of each channel.
    pub n: [f64; 3],
    /// The effective k of each channel.
    pub k: [f64; 3],
    /// How n and k were found.
    pub nk_by: [&'static str; 3],
    /// Hemispherical reflectance: 2 ∫ R cos θ d(cos θ).
    pub average: [f64; 3],
}

/// The parameters of a surface. Its gamut should keep colours unclipped.
fn params(surface: Surface, kind: MaterialKind) -> Params {
    let reference = ReferenceCurve::new(surface, Light::Unpolarised);
    let effective = effective(&reference, kind);
    let matching_cos = Derivation::default().matching_cos;
    let Channels { n, k } = effective.channels;
    let known = KnownSurface::with(n, k, |cos_theta| reference.at(cos_theta), matching_cos);
    let value = |input: Input| input.value(&known).expect("a surface gives it");
    Params {
        f0: known.f0,
        f82: known.f82,
        f82_tint: value(Input::TINT),
        f90: reference.at(0.0),
        reflectivity: value(Input::REFLECTIVITY),
        edge_tint: value(Input::EDGE_TINT),
        n,
        k,
        nk_by: effective.by.map(IndexSource::text),
        average: reference.average(),
    }
}

/// The colour error in ΔE 2000 of a surface at normal incidence, after one, two and three bounces, under all named lights except
/// the one that it is integrated under. None for surfaces known at only three wavelengths.
pub fn colour_errors(
    surface: &Surface,
    integration: &Integration,
) -> Option<Vec<(Illuminant, [f64; 3])>> {
    if !surface.is_spectral() {
        return None;
    }
    let reflectance = surface.unpolarised_spectrum(1.0);
    let rgb = surface.unpolarised(1.0);
    let error = |light: &Illuminant| {
        BOUNCES.map(|bounces| colour_error(&reflectance, rgb, light, bounces, integration))
    };
    let others = Illuminant::NAMED
        .into_iter()
        .filter(|light| *light != integration.illuminant);
    Some(others.map(|light| (light.clone(), error(&light))).collect())
}

/// The numbers of successive reflections for which the colour error is given.
const BOUNCES: [u32; 3] = [1, 2, 3];

/// Helium's d line and hydrogen's F and C in nanometres, as glass catalogues have them (ISO 7944).
const D_NM: f64 = 587.561_8;
const F_NM: f64 = 486.132_7;
const C_NM: f64 = 656.272_5;

/// n at the d line relative to the medium, where both are known.
pub fn ior_in(material: &Material, medium: Option<&Material>) -> Option<f64> {
    relative_n(material, medium, D_NM)
}

/// Abbe's number (n_d - 1)/(n_F - n_C) of the relative index. None where one of the three is unknown, or where n_F = n_C.
pub fn abbe_in(material: &Material, medium: Option<&Material>) -> Option<f64> {
    let at = |nm: f64| relative_n(material, medium, nm);
    let number = (at(D_NM)? - 1.0) / (at(F_NM)? - at(C_NM)?);
    number.is_finite().then_some(number)
}

fn relative_n(material: &Material, medium: Option<&Material>, nm: f64) -> Option<f64> {
    let n = |material: &Material| material.n.at(nm, Extrapolate::Refuse).ok();
    Some(n(material)? / medium.map_or(Some(1.0), n)?)
}

/// The colours of a surface under a coat.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoatedRow {
    /// The coat's refractive index.
    pub index: f64,
    /// F0 in air, as given.
    pub f0: [f64; 3],
    /// F82 in air, as given.
    pub f82: [f64; 3],
    /// F0 relative to the coat.
    pub f0_in_coat: [f64; 3],
    /// Reflectance at 81.79 degrees within the coat, for methods that take it.
    pub f82_in_coat: [f64; 3],
    /// n in air of each channel.
    pub n: [f64; 3],
    /// k in air of each channel.
    pub k: [f64; 3],
    /// For each channel, whether an index gives both colours. Otherwise n and k are those of the nearest.
    pub exact: [bool; 3],
}

impl CoatedRow {
    /// The colours under a coat of this index.
    pub fn new(f0: [f64; 3], f82: [f64; 3], index: f64) -> CoatedRow {
        let under: [UnderCoat; 3] = [0, 1, 2].map(|i| under_coat(f0[i], f82[i], index));
        let in_coat = |i: usize| {
            let air = under[i].index;
            conductor(air.n / index, air.k / index, COS_82).unpolarised()
        };
        CoatedRow {
            index,
            f0,
            f82,
            f0_in_coat: under.map(|channel| channel.f0),
            f82_in_coat: each_channel(in_coat),
            n: under.map(|channel| channel.index.n),
            k: under.map(|channel| channel.index.k),
            exact: under.map(|channel| channel.index.exact),
        }
    }
}
