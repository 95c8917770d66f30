//! Why nothing can be verified as it was asked for.

use thiserror::Error;

use super::merge::MergeFault;
use crate::physics::materials::FileFault;

/// Why nothing can be verified as it was asked for.
#[derive(Debug, Error)]
pub enum Error {
    /// No function can be run at all numbers.
    #[error(
        "--exhaustive runs functions specialised to a material in WGSL: name both, and leave --target out or name wgsl"
    )]
    NothingExhaustive,
    /// Reports of shards that are not those of one run.
    #[error(transparent)]
    Merge(#[from] Box<MergeFault>),
    /// A report that is no report.
    #[error(transparent)]
    File(#[from] FileFault),
}
