//! Why a material has no place in a format.

use crate::physics::foreign::Foreign;
use thiserror::Error;

/// Why a material has no place in a format.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ExchangeFault {
    /// A dielectric that is rarer than its medium.
    #[error(
        "`{}` has an index of {index} relative to its medium; these formats take an index of 1 or more: choose a medium that \
         is optically rarer",
        Foreign(name)
    )]
    Rarer {
        /// The material.
        name: String,
        /// Its relative index.
        index: String,
    },
    /// A space that the format does not know.
    #[error("--as {format} takes colours in {allowed}, and not in {space}; change --space")]
    Space {
        /// The format.
        format: &'static str,
        /// What was asked for.
        space: &'static str,
        /// What the format takes.
        allowed: String,
    },
}
