//! The formulas, one file each. To add one, write its file and run `tests/lists`, which writes the list below.
//! Each file begins with `use super::*`, which brings the words that a formula is written with.

use super::affine::Affine;
use super::claims::{ByClass, Claim, Claims, ColourClaim};
use super::input::{
    Input, InputSource, Inputs, POWERS, POWERS_AND_BEYOND, Range, SHARES, SHARES_AND_BEYOND,
};
#[cfg(test)]
use super::limits::{check, value};
use super::media::{Class, MediaSet};
use super::method::{
    CoefficientsFromInputs, Contract, FittedAverage, Forms, Light, Method, Origin, Values,
};
use super::shape::{Factor, Shape};
use crate::language::ir::Expr;
use crate::language::methods::claims::InHalf;
use crate::language::methods::input::{BELCOUR_COSINES, COS_60, KnownSurface, mean};
use crate::physics::cite::Citation;
use crate::physics::num::{Precision, each_channel};
use crate::physics::optics;

// BEGIN list (written by tests/lists)
mod airy_materialx;
mod belcour_decomposition;
mod conductor_artistic;
mod conductor_exact;
mod conductor_exact_metal;
mod conductor_exact_p;
mod conductor_exact_s;
mod conductor_from_f0_f82;
mod conductor_textbook;
mod constant_f0;
mod dielectric_exact;
mod dielectric_exact_p;
mod dielectric_exact_s;
mod dielectric_textbook;
mod dielectric_tinted;
mod empirical;
mod f82_tint;
mod film_spectral_six;
mod film_spectral_three;
mod fitted;
mod fitted_dielectric;
mod fitted_dielectric_rational;
mod fitted_dielectric_tinted;
mod fitted_f82;
mod fitted_f82_metal;
mod fitted_film;
mod fitted_film_eight;
mod fitted_five;
mod fitted_rational;
mod hoffman_f82;
mod iridescence_khr;
mod schlick;
mod schlick_corrected;
mod schlick_f82_f90;
mod schlick_f90;
mod schlick_generalised;
mod schlick_ior;
mod schlick_rescaled;
mod schlick_spherical_gaussian;
mod table;

/// Every method, by name.
#[rustfmt::skip]
pub static ALL: &[&Method] = &[
    &airy_materialx::METHOD,
    &belcour_decomposition::METHOD,
    &conductor_artistic::METHOD,
    &conductor_exact::METHOD,
    &conductor_exact_metal::METHOD,
    &conductor_exact_p::METHOD,
    &conductor_exact_s::METHOD,
    &conductor_from_f0_f82::METHOD,
    &conductor_textbook::METHOD,
    &constant_f0::METHOD,
    &dielectric_exact::METHOD,
    &dielectric_exact_p::METHOD,
    &dielectric_exact_s::METHOD,
    &dielectric_textbook::METHOD,
    &dielectric_tinted::METHOD,
    &empirical::METHOD,
    &f82_tint::METHOD,
    &film_spectral_six::METHOD,
    &film_spectral_three::METHOD,
    &fitted::METHOD,
    &fitted_dielectric::METHOD,
    &fitted_dielectric_rational::METHOD,
    &fitted_dielectric_tinted::METHOD,
    &fitted_f82::METHOD,
    &fitted_f82_metal::METHOD,
    &fitted_film::METHOD,
    &fitted_film_eight::METHOD,
    &fitted_five::METHOD,
    &fitted_rational::METHOD,
    &hoffman_f82::METHOD,
    &iridescence_khr::METHOD,
    &schlick::METHOD,
    &schlick_corrected::METHOD,
    &schlick_f82_f90::METHOD,
    &schlick_f90::METHOD,
    &schlick_generalised::METHOD,
    &schlick_ior::METHOD,
    &schlick_rescaled::METHOD,
    &schlick_spherical_gaussian::METHOD,
    &table::METHOD,
];

/// Each by its name.
#[rustfmt::skip]
#[allow(missing_docs)]
impl Method {
    pub const AIRY_MATERIALX: &'static Method = &airy_materialx::METHOD;
    pub const BELCOUR_DECOMPOSITION: &'static Method = &belcour_decomposition::METHOD;
    pub const CONDUCTOR_ARTISTIC: &'static Method = &conductor_artistic::METHOD;
    pub const CONDUCTOR_EXACT: &'static Method = &conductor_exact::METHOD;
    pub const CONDUCTOR_EXACT_METAL: &'static Method = &conductor_exact_metal::METHOD;
    pub const CONDUCTOR_EXACT_P: &'static Method = &conductor_exact_p::METHOD;
    pub const CONDUCTOR_EXACT_S: &'static Method = &conductor_exact_s::METHOD;
    pub const CONDUCTOR_FROM_F0_F82: &'static Method = &conductor_from_f0_f82::METHOD;
    pub const CONDUCTOR_TEXTBOOK: &'static Method = &conductor_textbook::METHOD;
    pub const CONSTANT_F0: &'static Method = &constant_f0::METHOD;
    pub const DIELECTRIC_EXACT: &'static Method = &dielectric_exact::METHOD;
    pub const DIELECTRIC_EXACT_P: &'static Method = &dielectric_exact_p::METHOD;
    pub const DIELECTRIC_EXACT_S: &'static Method = &dielectric_exact_s::METHOD;
    pub const DIELECTRIC_TEXTBOOK: &'static Method = &dielectric_textbook::METHOD;
    pub const DIELECTRIC_TINTED: &'static Method = &dielectric_tinted::METHOD;
    pub const EMPIRICAL: &'static Method = &empirical::METHOD;
    pub const F82_TINT: &'static Method = &f82_tint::METHOD;
    pub const FILM_SPECTRAL_SIX: &'static Method = &film_spectral_six::METHOD;
    pub const FILM_SPECTRAL_THREE: &'static Method = &film_spectral_three::METHOD;
    pub const FITTED: &'static Method = &fitted::METHOD;
    pub const FITTED_DIELECTRIC: &'static Method = &fitted_dielectric::METHOD;
    pub const FITTED_DIELECTRIC_RATIONAL: &'static Method = &fitted_dielectric_rational::METHOD;
    pub const FITTED_DIELECTRIC_TINTED: &'static Method = &fitted_dielectric_tinted::METHOD;
    pub const FITTED_F82: &'static Method = &fitted_f82::METHOD;
    pub const FITTED_F82_METAL: &'static Method = &fitted_f82_metal::METHOD;
    pub const FITTED_FILM: &'static Method = &fitted_film::METHOD;
    pub const FITTED_FILM_EIGHT: &'static Method = &fitted_film_eight::METHOD;
    pub const FITTED_FIVE: &'static Method = &fitted_five::METHOD;
    pub const FITTED_RATIONAL: &'static Method = &fitted_rational::METHOD;
    pub const HOFFMAN_F82: &'static Method = &hoffman_f82::METHOD;
    pub const IRIDESCENCE_KHR: &'static Method = &iridescence_khr::METHOD;
    pub const SCHLICK: &'static Method = &schlick::METHOD;
    pub const SCHLICK_CORRECTED: &'static Method = &schlick_corrected::METHOD;
    pub const SCHLICK_F82_F90: &'static Method = &schlick_f82_f90::METHOD;
    pub const SCHLICK_F90: &'static Method = &schlick_f90::METHOD;
    pub const SCHLICK_GENERALISED: &'static Method = &schlick_generalised::METHOD;
    pub const SCHLICK_IOR: &'static Method = &schlick_ior::METHOD;
    pub const SCHLICK_RESCALED: &'static Method = &schlick_rescaled::METHOD;
    pub const SCHLICK_SPHERICAL_GAUSSIAN: &'static Method = &schlick_spherical_gaussian::METHOD;
    pub const TABLE: &'static Method = &table::METHOD;
}
// END list

pub(in crate::language) use conductor_exact::{Polarised, polarised};
pub use f82_tint::schlick_82;
pub use schlick_corrected::lambda;
pub use table::{ONLY_ROW, TEXELS, WARP, fetch, unwarped, warped, warped_step};
