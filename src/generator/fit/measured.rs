//! A figure, or the reason why there is none.

use serde::Serialize;

/// "Not measured" is a value with a reason, never an empty cell and never a zero.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum Measured<T> {
    /// The figure.
    Yes(T),
    /// Why there is none.
    No(String),
}

impl<T> Measured<T> {
    /// The figure, where there is one.
    pub fn value(&self) -> Option<&T> {
        match self {
            Measured::Yes(value) => Some(value),
            Measured::No(_) => None,
        }
    }
}
