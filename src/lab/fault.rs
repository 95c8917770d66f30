//! Why there is no result of a shader: the machine lacks something, or the shader or the device failed.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::generator::emit;

/// Why there is no result.
#[derive(Clone, Debug, PartialEq, Eq, Error, Serialize, Deserialize)]
pub enum Fault {
    /// Something is missing on this machine, so the shader is not checked. The reason says how to get it.
    #[error("{0}")]
    Absent(String),
    /// A compiler refuses the shader, or the device fails.
    #[error("{0}")]
    Failed(String),
}

/// A function that cannot be written is a fault of this program, which the result shows as a failure.
impl From<emit::Error> for Fault {
    fn from(why: emit::Error) -> Fault {
        Fault::Failed(why.to_string())
    }
}

impl Fault {
    /// The device cannot do this.
    pub(super) fn unable(device: &str, what: impl ToString) -> Fault {
        Fault::Absent(format!("{device} cannot do this: {}", what.to_string()))
    }

    /// A program is not accepted, or its inputs do not fit it: the message of the compiler or the check.
    pub(super) fn refused(log: impl ToString) -> Fault {
        let log = log.to_string();
        Fault::Failed(format!("the shader was refused: {}", log.trim_end()))
    }

    /// The device stopped working, for the driver's reason.
    pub(super) fn lost(why: impl ToString) -> Fault {
        Fault::Failed(format!("the device was lost: {}", why.to_string()))
    }
}
