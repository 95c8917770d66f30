//! The faults of commands, and their exit codes.

use thiserror::Error;

use crate::generator;
use crate::generator::error::RequestFault;
use crate::lab::{audit, budget, overdraw, process, verify};

/// A fault of the request, of the files, or of the machine.
#[derive(Debug, Error)]
pub enum Error {
    /// A fault of the request or of files.
    #[error(transparent)]
    Generator(generator::Error),
    /// A user's function cannot be audited.
    #[error(transparent)]
    Audit(#[from] audit::Error),
    /// The request cannot be verified.
    #[error(transparent)]
    Verify(#[from] verify::Error),
    /// The processes of a run cannot be started.
    #[error(transparent)]
    Process(#[from] process::Error),
    /// Nothing can be drawn for timing.
    #[error(transparent)]
    Overdraw(#[from] overdraw::Error),
    /// No function can be chosen within a budget.
    #[error(transparent)]
    Budget(#[from] budget::Error),
}

impl<T> From<T> for Error
where
    generator::Error: From<T>,
{
    fn from(fault: T) -> Error {
        Error::Generator(fault.into())
    }
}

impl Error {
    /// A request that contradicts itself or cannot be met.
    pub fn usage(what: impl Into<String>) -> Error {
        RequestFault::refused(what).into()
    }

    /// Something that the command needs is missing here.
    pub fn lacking(what: impl Into<String>) -> Error {
        Error::Generator(generator::Error::Lacking { what: what.into() })
    }

    /// The program's exit code: 2 for faults of the input, 3 for what is missing on this machine.
    pub fn exit_code(&self) -> u8 {
        let is_lacking = match self {
            Error::Generator(fault) => matches!(fault, generator::Error::Lacking { .. }),
            Error::Process(fault) => fault.is_lacking(),
            Error::Audit(fault) => fault.is_lacking(),
            Error::Overdraw(fault) => fault.is_lacking(),
            Error::Verify(_) | Error::Budget(_) => false,
        };
        if is_lacking { 3 } else { 2 }
    }
}
