//! Why nothing can be drawn.

use thiserror::Error;

use crate::lab::process;

/// Why nothing can be drawn.
#[derive(Debug, Error)]
pub enum Error {
    /// The process that draws cannot be started.
    #[error(transparent)]
    Process(#[from] process::Error),
    /// There is no graphics device, or its driver fails: what it said.
    #[error("{0}")]
    Device(String),
    /// The process that should open the device answers another question.
    #[error("a process that does not greet")]
    Protocol,
    /// The driver hangs.
    #[error("no graphics device opened within {0} s: its driver hangs")]
    Hangs(u64),
    /// The driver takes its process down.
    #[error("the process that opens the graphics device ended ({0}): its driver failed")]
    Ended(String),
}

impl Error {
    /// Whether the machine lacks something; otherwise the user's words are at fault.
    pub fn is_lacking(&self) -> bool {
        match self {
            Error::Process(error) => error.is_lacking(),
            _ => true,
        }
    }
}
