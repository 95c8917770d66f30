//! What an engine wants to know of a material: colours, index per channel, averages, and how well each is known.
//! Colours are unclipped: saturated gold has F0 above 1 in linear sRGB.

use serde::Serialize;

use crate::language::methods::{Input, KnownSurface, Light};
use crate::physics::materials::{Channels, Extrapolate, Index, Material, MaterialKind, Surface};
use crate::physics::optics;
use crate::physics::spectra::{Illuminant, Integration, colour_error};

use crate::generator::reference::{By, Derivation, ReferenceCurve, effective};

/// The parameters of a material in a medium, three channels each, as seen.
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
    /// Gulbrandsen's reflectivity r of that index: F0 where the index has it, and never above 1.
    pub reflectivity: [f64; 3],
    /// Gulbrandsen's edge tint g of that index.
    pub edge_tint: [f64; 3],
    /// The effective n of each channel.
    pub n: [f64; 3],
    /// The effective k of each channel.
    pub k: [f64; 3],
    /// How they were found.
    pub nk_by: [&'static str; 3],
    /// Hemispherical reflectance: 2 ∫ R cos θ d(cos θ).
    pub average: [f64; 3],
}

/// The parameters of a surface. Its gamut should keep colours as they are.
pub(super) fn params(surface: Surface, kind: MaterialKind) -> Params {
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
        nk_by: effective.by.map(By::text),
        average: reference.average(),
    }
}

/// The colour error of a surface at normal incidence under all named lights but the one that it is integrated under,
/// after one, two and three bounces, in ΔE 2000; none where three wavelengths are no spectrum.
pub fn colour_errors(
    surface: &Surface,
    integration: &Integration,
) -> Option<Vec<(Illuminant, [f64; 3])>> {
    if surface.channels().is_some() {
        return None;
    }
    let reflectance = normal_spectrum(surface);
    let rgb = surface.unpolarised(1.0);
    let error = |light: &Illuminant| {
        BOUNCES.map(|bounces| colour_error(&reflectance, rgb, light, bounces, integration))
    };
    let others = Illuminant::NAMED
        .into_iter()
        .filter(|light| *light != integration.illuminant);
    Some(others.map(|light| (light.clone(), error(&light))).collect())
}

/// Reflections one after the other, for which the colour error is told.
pub(super) const BOUNCES: [u32; 3] = [1, 2, 3];

/// Helium's d line and hydrogen's F and C in nanometres, as glass catalogues have them (ISO 7944).
const D_NM: f64 = 587.561_8;
const F_NM: f64 = 486.132_7;
const C_NM: f64 = 656.272_5;

/// n at the d line relative to the medium, where both are known.
pub fn ior_in(material: &Material, medium: Option<&Material>) -> Option<f64> {
    relative_n(material, medium, D_NM)
}

/// Abbe's number (n_d - 1)/(n_F - n_C) of the relative index, where all three are known and differ.
pub fn abbe_in(material: &Material, medium: Option<&Material>) -> Option<f64> {
    let at = |nm: f64| relative_n(material, medium, nm);
    let number = (at(D_NM)? - 1.0) / (at(F_NM)? - at(C_NM)?);
    number.is_finite().then_some(number)
}

fn relative_n(material: &Material, medium: Option<&Material>, nm: f64) -> Option<f64> {
    let around = medium.map_or(Some(1.0), |medium| n_at(medium, nm));
    Some(n_at(material, nm)? / around?)
}

fn n_at(material: &Material, nm: f64) -> Option<f64> {
    material.n.at(nm, Extrapolate::Refuse).ok()
}

/// Reflectance at normal incidence at each of a surface's wavelengths.
fn normal_spectrum(surface: &Surface) -> Vec<f64> {
    let normal = |index: &Index| optics::normal_incidence(index.n, index.k);
    surface.indices.iter().map(normal).collect()
}
