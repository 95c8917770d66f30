//! Verification of generated code: its results compared with what it means.
//!
//! A [`Trial`] is a function with the values of its arguments. What it means at its inputs, in f64, is [`Expected`]. Independent
//! compilers check the text, and the text itself runs on a real graphics stack.
//!
//! Shaders run in processes of their own, so that one that hangs or crashes its driver costs no more than a row of the report. All
//! processes make the same [`VerifyPlan`](requested::VerifyPlan) from the same flags, and a number names one of its files.

mod cases;
pub mod compilers;
pub mod effect_trial;
mod error;
pub mod file;
pub mod function_head;
mod half;
pub mod harness;
mod judge;
mod listed;
pub mod machine;
pub mod merge;
pub mod naga_translation;
pub mod outline;
mod points;
pub mod requested;
mod row;
pub mod run;
pub mod shader_words;
pub mod shard;
mod shipped;
mod supervise;
mod sweep;
mod tampering;
mod trial;

pub use cases::material_trial;
pub use error::Error;
pub use half::{HalfError, HalfTrial, halves, halves_beyond, nearest_half};
pub use machine::MachineStatement;
pub use points::{Random, WITHIN, beyond, cosines, cosines_around, limits, share, worst_media};
pub use row::{AllowedError, Answer, Status, VerifyRow, as_object};
pub use supervise::{serve, supervise};
pub use sweep::exhaustive_rows;
pub use trial::{ABSOLUTE_FLOOR, CodeError, Expected, Miss, Outcome, Trial, result_range};
