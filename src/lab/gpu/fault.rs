//! What can go wrong between a shader and its results.

/// Why a shader gave no results.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DeviceFault {
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

impl DeviceFault {
    /// A refusal in these words.
    pub(super) fn refused(log: impl ToString) -> DeviceFault {
        let log = log.to_string().trim_end().to_owned();
        DeviceFault::Refused { log }
    }

    /// A loss for this reason.
    pub(super) fn lost(why: impl ToString) -> DeviceFault {
        let why = why.to_string();
        DeviceFault::Lost { why }
    }

    /// Something that this device lacks.
    pub(super) fn unable(device: &str, what: impl ToString) -> DeviceFault {
        let (device, what) = (device.to_owned(), what.to_string());
        DeviceFault::Unable { device, what }
    }
}
