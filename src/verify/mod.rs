//! Verification: generated code against what it means. So far the part that needs no graphics stack: the graph in
//! unfused f32 against the graph in f64. Running the text of each target has its place here.
//! With the feature `compilers`, the word of compilers that are not ours.

mod code_error;
#[cfg(feature = "compilers")]
pub mod compilers;
mod points;
#[cfg(feature = "compilers")]
pub mod second;

pub use code_error::{
    ABSOLUTE_FLOOR, CodeError, code_error, library_code_error, library_code_error_at,
};
pub use points::cosines;
