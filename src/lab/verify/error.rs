//! Why nothing can be verified as it was asked for.

use thiserror::Error;

/// Why nothing can be verified as it was asked for.
#[derive(Debug, Error)]
pub enum Error {
    /// No function can be run at all numbers.
    #[error(
        "--exhaustive runs functions specialised to a material in WGSL: name both, and leave --target out or name wgsl"
    )]
    NothingExhaustive,
}
