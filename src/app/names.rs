//! Names on the command line that are not there, as errors of this program.

use crate::cost::{FAMILIES, Family, find};
use crate::names::UnknownName;

use super::error::Error;

/// The error for a name that does not exist.
pub fn unknown(kind: &'static str, name: &str, all: &[&str]) -> Error {
    UnknownName::new(kind, name, all).into()
}

/// The family of GPUs of this name.
///
/// # Errors
/// There is no family of this name.
pub fn family(name: &str) -> Result<&'static Family, Error> {
    let all: Vec<&str> = FAMILIES.iter().map(|family| family.name).collect();
    find(name).ok_or_else(|| unknown("GPU family", name, &all))
}
