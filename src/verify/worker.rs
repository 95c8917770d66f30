//! A worker: answers the numbers of files with their rows.

use std::io;

use serde::{Deserialize, Serialize};

use crate::process::Inbox;

use super::file::{VerifyEffort, file_rows};
use super::plan::VerifyPlan;
use super::row::VerifyRow;
use super::run::Devices;

/// What a worker is asked: the rows of the file with this place in the plan.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct FileRequest {
    /// The place.
    pub file: usize,
}

/// Serves until the supervisor is gone. Only files of the plan have rows.
///
/// # Errors
/// The pipe is gone.
pub fn serve(
    inbox: Inbox,
    plan: &VerifyPlan,
    devices: &Devices,
    effort: VerifyEffort,
) -> io::Result<()> {
    inbox.serve(|request: FileRequest| -> Vec<VerifyRow> {
        let file = plan.files.get(request.file);
        file.map(|file| file_rows(plan, file, devices, effort))
            .unwrap_or_default()
    })
}
