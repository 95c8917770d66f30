//! Verification: generated code against what it means. So far the part that needs no graphics stack: the graph in
//! unfused f32 against the graph in f64. Running the text of each target has its place here.

mod code_error;
pub mod harness;
mod points;
mod trial;

pub use code_error::{
    ABSOLUTE_FLOOR, CodeError, code_error, library_code_error, library_code_error_at,
};
pub use points::{BEYOND, cosines, cosines_around, limits};
pub use trial::{Expected, Miss, Outcome, Trial};
