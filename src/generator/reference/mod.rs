//! The reference: a material in its medium under viewing conditions, its reference reflectance, and the effective index of each
//! channel. Methods are fitted to it and compared with it.

mod effective;
mod material_in_medium;
mod reference_curve;

pub use effective::{Effective, IndexSource, effective};
pub use material_in_medium::{
    Derivation, FITTED_IN_ENGINES, LEAST_FITTED_N, MaterialClass, MaterialInMedium,
    THESIS_MATCHING_COS, Typed,
};
pub use reference_curve::{
    ANGLES, COSINES, FITTED_COSINES, ReferenceCurve, cosine_of_part, cosines, reference_reflectance,
};
