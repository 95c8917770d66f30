//! Verification: generated code against what it means. The graph in unfused f32 against the
//! graph in f64 needs no graphics stack; `gpu`, behind the feature of that name, runs the text itself on one.

mod code_error;
#[cfg(feature = "gpu")]
pub mod gpu;
mod points;

pub use code_error::{
    ABSOLUTE_FLOOR, CodeError, code_error, library_code_error, library_code_error_at,
};
pub use points::cosines;
