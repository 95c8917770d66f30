//! Verification: generated code against what it means.
//!
//! A [`Trial`] is a function with the values of its arguments; what it means at its inputs, in f64, is what is
//! [`Expected`]. With the feature `compilers` compilers that are not ours give their word; with the feature `gpu` the
//! text itself runs, on a real graphics stack.
//!
//! Shaders run in processes of their own, so that one that never ends, or that takes its driver down, is a row of the
//! report and no more. All processes make the same [`VerifyPlan`](plan::VerifyPlan) from the same flags; a number names a file of it.

mod code_error;
#[cfg(feature = "compilers")]
pub mod compilers;
pub mod drift;
pub mod effect_points;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod effect_run;
pub mod effect_trial;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod error;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod exhaustive;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod file;
mod half;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod half_run;
#[cfg(feature = "gpu")]
pub mod harness;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod judge;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod machine;
pub mod module;
#[cfg(feature = "compilers")]
pub mod naga_translation;
mod object;
pub mod outline;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod plan;
mod points;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod row;
#[cfg(feature = "gpu")]
pub mod run;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod shard;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod statement;
mod status;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod supervise;
#[cfg(feature = "gpu")]
mod sweep;
mod trial;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod trial_case;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod worker;
mod worst;

pub use code_error::{
    ABSOLUTE_FLOOR, CodeError, code_error, coefficient_code_error, digits_lost, library_code_error,
    library_code_error_at, random_medium,
};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use error::Error;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use exhaustive::exhaustive_rows;
pub use half::{
    HalfError, HalfTrial, halves, halves_beyond, library_half_error, library_half_error_at,
    nearest_half,
};
pub use object::as_object;
pub use points::{Random, WITHIN, beyond, cosines, cosines_around, limits, share};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use row::{
    AllowedError, Answer, CodeErrorFigures, Emulation, ModelErrorFigures, SecondOpinion, VerifyRow,
    WORST,
};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use statement::MachineStatement;
pub use status::Status;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use supervise::supervise;
#[cfg(feature = "gpu")]
pub use sweep::{count, sweep};
pub use trial::{Expected, Miss, Outcome, Trial, result_range};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use trial_case::material_trial;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use worker::serve;
pub use worst::{worst_cases, worst_cosines, worst_media};
