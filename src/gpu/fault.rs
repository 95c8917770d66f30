//! What can go wrong between a shader and its results.

/// Why a shader gave no results.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// There is nothing to run on.
    #[error("{what}; {get}")]
    Absent {
        /// What is not there.
        what: String,
        /// How to come by it, or what there is in its place.
        get: String,
    },
    /// What there is cannot do this.
    #[error("{device} cannot do this: {what}")]
    Unable {
        /// The device's name.
        device: String,
        /// What it was asked for.
        what: String,
    },
    /// The program was not accepted, or what it was to be run with does not fit it.
    #[error("the shader was refused: {log}")]
    Refused {
        /// The words of the compiler, or of what checked it.
        log: String,
    },
    /// The device stopped working.
    #[error("the device was lost: {why}")]
    Lost {
        /// What the driver said.
        why: String,
    },
}

impl Fault {
    /// A refusal in these words.
    pub(super) fn refused(log: impl ToString) -> Fault {
        let log = log.to_string().trim_end().to_owned();
        Fault::Refused { log }
    }

    /// A loss for this reason.
    pub(super) fn lost(why: impl ToString) -> Fault {
        let why = why.to_string();
        Fault::Lost { why }
    }

    /// Something that this device lacks.
    pub(super) fn unable(device: &str, what: impl ToString) -> Fault {
        let (device, what) = (device.to_owned(), what.to_string());
        Fault::Unable { device, what }
    }
}
