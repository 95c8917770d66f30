//! The reference: a material in its medium as it is seen, its reference reflectance, and the index per channel that stands for
//! its spectrum. Methods are fitted to it and held against it.

mod class;
mod derivation;
mod effective;
mod subject;
mod truth;

pub use class::MaterialClass;
pub use derivation::{Derivation, THESIS_MATCHING_COS};
pub use effective::{By, Effective, effective};
pub use subject::{LEAST_FITTED_N, Subject, Typed};
pub use truth::{ANGLES, Truth, cosine, cosines, seen};
