//! Names on the command line that are not there, as errors of this program.

use crate::physics::names::UnknownName;

use super::error::Error;

/// The error for a name that does not exist.
pub fn unknown(kind: &'static str, name: &str, all: &[&str]) -> Error {
    UnknownName::new(kind, name, all).into()
}
