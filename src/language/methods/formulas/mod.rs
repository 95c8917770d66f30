//! The formulas, one file each. To add one, write its file and run `tests/lists`, which writes the list below.

use super::Method;

// BEGIN list (written by tests/lists)
mod belcour_decomposition;
mod conductor_artistic;
mod conductor_exact;
mod conductor_exact_metal;
mod conductor_from_f0_f82;
mod conductor_textbook;
mod constant_f0;
mod dielectric_exact;
mod dielectric_exact_p;
mod dielectric_exact_s;
mod dielectric_textbook;
mod empirical;
mod f82_tint;
mod fitted;
mod fitted_dielectric;
mod fitted_dielectric_rational;
mod fitted_f82;
mod fitted_f82_metal;
mod fitted_five;
mod fitted_rational;
mod hoffman_f82;
mod schlick;
mod schlick_corrected;
mod schlick_f90;
mod schlick_generalised;
mod schlick_ior;
mod schlick_rescaled;
mod schlick_spherical_gaussian;
mod table;

/// Every method, by name.
#[rustfmt::skip]
pub static ALL: &[&Method] = &[
    &belcour_decomposition::METHOD,
    &conductor_artistic::METHOD,
    &conductor_exact::METHOD,
    &conductor_exact_metal::METHOD,
    &conductor_from_f0_f82::METHOD,
    &conductor_textbook::METHOD,
    &constant_f0::METHOD,
    &dielectric_exact::METHOD,
    &dielectric_exact_p::METHOD,
    &dielectric_exact_s::METHOD,
    &dielectric_textbook::METHOD,
    &empirical::METHOD,
    &f82_tint::METHOD,
    &fitted::METHOD,
    &fitted_dielectric::METHOD,
    &fitted_dielectric_rational::METHOD,
    &fitted_f82::METHOD,
    &fitted_f82_metal::METHOD,
    &fitted_five::METHOD,
    &fitted_rational::METHOD,
    &hoffman_f82::METHOD,
    &schlick::METHOD,
    &schlick_corrected::METHOD,
    &schlick_f90::METHOD,
    &schlick_generalised::METHOD,
    &schlick_ior::METHOD,
    &schlick_rescaled::METHOD,
    &schlick_spherical_gaussian::METHOD,
    &table::METHOD,
];
// END list

pub use belcour_decomposition::BELCOUR_COSINES;
pub use f82_tint::schlick_82;
pub use schlick_corrected::lambda;
pub use table::{ONLY_ROW, TEXELS, WARP, fetch, unwarped, warped, warped_step};
