//! What functions compute in, as the command line says it: single or half precision.

use clap::Args;

use crate::num::Precision;

use super::error::Error;
use super::names::unknown;

/// The flags of every command that writes or runs functions.
#[derive(Args, Clone, Debug, Default)]
pub struct PrecisionFlags {
    /// What functions compute in: f32, or f16, whose names end in _f16 [default: f32]
    #[arg(long, value_name = "NAME")]
    pub precision: Option<String>,
    /// Also write methods that f16 cannot compute accurately, without an error bound
    #[arg(long, requires = "precision")]
    pub force: bool,
}

impl PrecisionFlags {
    /// What they say.
    ///
    /// # Errors
    /// There is no precision of this name.
    pub fn read(&self) -> Result<Precision, Error> {
        named(self.precision.as_deref())
    }
}

/// The precision of a name, single where none is said.
///
/// # Errors
/// There is no precision of this name.
pub fn named(name: Option<&str>) -> Result<Precision, Error> {
    let names = Precision::ALL.map(Precision::name);
    match name {
        None => Ok(Precision::default()),
        Some(name) => Precision::find(name).ok_or_else(|| unknown("precision", name, &names)),
    }
}

/// The precisions of these names, each once and in order; both where none is said.
///
/// # Errors
/// There is no precision of one of these names.
pub fn several(names: &[String]) -> Result<Vec<Precision>, Error> {
    if names.is_empty() {
        return Ok(Precision::ALL.to_vec());
    }
    let found = names.iter().map(|name| named(Some(name)));
    let mut found = found.collect::<Result<Vec<Precision>, Error>>()?;
    found.sort_unstable();
    found.dedup();
    Ok(found)
}
