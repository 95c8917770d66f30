//! `reproduce`: the thesis beside ours.

use crate::app::args::Reproduce;
use crate::app::error::Error;

use super::{Output, Progress};

/// Reproduces.
pub fn run(_flags: &Reproduce, _progress: Progress) -> Result<Output, Error> {
    Ok(Output::default())
}
