//! What cannot be baked.

use crate::{emit, lut};

/// A fault of what is to be baked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A table cannot be made.
    #[error(transparent)]
    Table(#[from] lut::Error),
    /// A language refuses the function that reads a table.
    #[error(transparent)]
    Function(#[from] emit::Error),
    /// A split-sum table of a method without coefficients.
    #[error(
        "--dfg takes a method that is linear in its coefficients (fitted, fitted_dielectric), and `{method}` is none"
    )]
    NotFitted {
        /// The method.
        method: &'static str,
    },
}
