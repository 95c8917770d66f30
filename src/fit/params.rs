//! What an engine wants to know of a material: colours, index per channel, averages, and how well each is known.
//! Colours are unclipped: saturated gold has F0 above 1 in linear sRGB.

use crate::materials::{Extrapolate, Index, Kind, Material, Surface};
use crate::methods::Light;
use crate::optics;

use super::derive::{COS_82, edge_tint, schlick_82};
use super::effective::{Effective, effective};
use super::model_error::Truth;

/// The parameters of a material in a medium, three channels each, as seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees, cos θ = 1/7.
    pub f82: [f64; 3],
    /// F82 over Schlick's value there: the tint of the F82-tint model.
    pub f82_tint: [f64; 3],
    /// Reflectance at 90 degrees.
    pub f90: [f64; 3],
    /// n and k per channel, and how they were found.
    pub effective: Effective,
    /// Gulbrandsen's edge tint g of that index; his reflectivity r is F0.
    pub edge_tint: [f64; 3],
    /// Hemispherical reflectance: 2 ∫ R cos θ d(cos θ).
    pub average: [f64; 3],
}

/// The parameters of a surface. Its gamut should keep colours as they are.
pub fn params(surface: Surface, kind: Kind) -> Params {
    let truth = Truth::new(surface, Light::Unpolarised);
    let effective = effective(&truth, kind);
    let (f0, f82) = (truth.at(1.0), truth.at(COS_82));
    let (n, k) = (effective.channels.n, effective.channels.k);
    Params {
        f0,
        f82,
        f82_tint: [0, 1, 2].map(|i| f82[i] / schlick_82(f0[i])),
        f90: truth.at(0.0),
        effective,
        edge_tint: [0, 1, 2].map(|i| edge_tint(n[i], k[i])),
        average: truth.average(),
    }
}

/// Helium's d line and hydrogen's F and C in nanometres, as glass catalogues have them (ISO 7944).
const D_NM: f64 = 587.561_8;
const F_NM: f64 = 486.132_7;
const C_NM: f64 = 656.272_5;

/// n at the d line, where it is known.
pub fn ior_d(material: &Material) -> Option<f64> {
    n_at(material, D_NM)
}

/// Abbe's number (n_d - 1)/(n_F - n_C), where all three are known and differ.
pub fn abbe(material: &Material) -> Option<f64> {
    let dispersion = n_at(material, F_NM)? - n_at(material, C_NM)?;
    let number = (n_at(material, D_NM)? - 1.0) / dispersion;
    number.is_finite().then_some(number)
}

fn n_at(material: &Material, nm: f64) -> Option<f64> {
    material.n.at(nm, Extrapolate::Refuse).ok()
}

/// Reflectance at normal incidence at each of a surface's wavelengths.
pub fn normal_spectrum(surface: &Surface) -> Vec<f64> {
    let normal = |index: &Index| optics::normal_incidence(index.n, index.k);
    surface.indices.iter().map(normal).collect()
}
