//! Why nothing can be verified as requested, and why reports are not the shards of one run.

use std::path::PathBuf;

use thiserror::Error;

use crate::physics::foreign::{self, Foreign, one_line};
use crate::physics::user_text::FileFault;

/// Why nothing can be verified as requested.
#[derive(Debug, Error)]
pub enum Error {
    /// No function can be run at all numbers.
    #[error(
        "--exhaustive runs functions specialised to a material in WGSL: name both, and leave --target out or name wgsl"
    )]
    NothingExhaustive,
    /// Reports of shards that are not of one run.
    #[error(transparent)]
    Merge(#[from] Box<MergeFault>),
    /// A report that cannot be read.
    #[error(transparent)]
    File(#[from] FileFault),
}

/// Why reports are not the shards of one run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MergeFault {
    /// A file that is not a shard's report, or a report that contradicts itself.
    #[error("{}: {}", foreign::path(file), one_line(what))]
    NotAShard {
        /// The file.
        file: PathBuf,
        /// What it is instead.
        what: String,
    },
    /// Two reports of one shard.
    #[error(
        "{}: this is shard {shard}, and so is {}; leave one of them out",
        foreign::path(file),
        foreign::path(other)
    )]
    Twice {
        /// The file.
        file: PathBuf,
        /// The file before it.
        other: PathBuf,
        /// The shard.
        shard: usize,
    },
    /// Reports of two runs.
    #[error(
        "{}: {} {}, and in {} {}; run one of them again as the other was run",
        foreign::path(file),
        one_line(what),
        Foreign(here),
        foreign::path(other),
        Foreign(there)
    )]
    Differs {
        /// The file.
        file: PathBuf,
        /// The file that it differs from.
        other: PathBuf,
        /// What differs.
        what: String,
        /// Its value in the file.
        here: String,
        /// Its value in the other.
        there: String,
    },
    /// Shards without a report.
    #[error("{count} of {shards} shards missing: {names}; run what is missing, and merge again")]
    Missing {
        /// How many are missing.
        count: usize,
        /// How many shards the run has.
        shards: usize,
        /// Their numbers.
        names: String,
    },
}

impl From<MergeFault> for Error {
    fn from(fault: MergeFault) -> Error {
        Error::Merge(Box::new(fault))
    }
}
