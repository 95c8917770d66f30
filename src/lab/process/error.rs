//! Why the processes of a run cannot be started.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// The variable that says where temporary files go.
pub const TEMPORARY: &str = if cfg!(windows) { "TMP" } else { "TMPDIR" };

/// Why the processes of a run cannot be started.
#[derive(Debug, Error)]
pub enum Error {
    /// The system cannot start a process.
    #[error("not checked: this program cannot start a process of its own to run shaders in: {0}")]
    Start(io::Error),
    /// Temporary files cannot be written.
    #[error(
        "not checked: temporary files cannot be written in {}: {why}; create this folder, make room in it, or set {TEMPORARY} to another",
        crate::physics::foreign::path(place)
    )]
    Temporary {
        /// The folder for temporary files.
        place: PathBuf,
        /// The system's reason.
        why: String,
    },
    /// The user's folder of tools cannot be used.
    #[error(
        "--tools {}: {why}; name a folder that holds compilers",
        crate::physics::foreign::path(folder)
    )]
    Tools {
        /// The folder as it was named.
        folder: PathBuf,
        /// What is wrong with it.
        why: String,
    },
}

impl Error {
    /// Whether the machine lacks something. Otherwise the user's flags are at fault.
    pub fn is_lacking(&self) -> bool {
        !matches!(self, Error::Tools { .. })
    }
}
