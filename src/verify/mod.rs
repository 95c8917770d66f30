//! Verification: generated code against what it means.
//!
//! A [`Trial`] is a function with the values of its arguments; what it means at its inputs, in f64, is what is
//! [`Expected`]. With the feature `compilers` compilers that are not ours give their word; with the feature `gpu` the
//! text itself runs, on a real graphics stack.

mod code_error;
#[cfg(feature = "compilers")]
pub mod compilers;
pub mod drift;
mod half;
#[cfg(feature = "gpu")]
pub mod harness;
pub mod module;
pub mod outline;
mod points;
#[cfg(feature = "gpu")]
pub mod run;
#[cfg(feature = "compilers")]
pub mod second;
#[cfg(feature = "gpu")]
mod sweep;
mod trial;
mod worst;

pub use code_error::{
    ABSOLUTE_FLOOR, CodeError, code_error, digits_lost, library_code_error, library_code_error_at,
};
pub use half::{
    HalfError, HalfTrial, halves, halves_beyond, library_half_error, library_half_error_at,
    nearest_half,
};
pub use points::{WITHIN, beyond, cosines, cosines_around, limits, share};
#[cfg(feature = "gpu")]
pub use sweep::{count, sweep};
pub use trial::{Expected, Miss, Outcome, Trial, result_range};
pub use worst::{worst_cases, worst_cosines, worst_media};
