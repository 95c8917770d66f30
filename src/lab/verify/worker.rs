//! A worker: answers the numbers of files with their rows.

use std::collections::BTreeMap;
use std::io;

use serde::{Deserialize, Serialize};

use crate::lab::process::Inbox;

use super::file::{VerifyEffort, file_rows};
use super::plan::VerifyPlan;
use super::row::VerifyRow;
use super::run::Devices;
use super::statement::MachineStatement;

/// What a worker is asked: the rows of the file with this place in the plan.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct FileRequest {
    /// The place.
    pub file: usize,
}

/// What a worker answers.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct FileAnswer {
    /// The rows of the file.
    pub rows: Vec<VerifyRow>,
    /// Of a shard: what is here for the file's target.
    #[serde(default)]
    pub machine: MachineStatement,
}

/// Serves until the supervisor is gone. Only files of the plan have rows, and only a shard says what is here.
///
/// # Errors
/// The pipe is gone.
pub fn serve(
    inbox: Inbox,
    plan: &VerifyPlan,
    devices: &Devices,
    effort: VerifyEffort,
    is_shard: bool,
) -> io::Result<()> {
    let mut stated: BTreeMap<&str, MachineStatement> = BTreeMap::new();
    inbox.serve(|request: FileRequest| -> FileAnswer {
        let Some(file) = plan.files.get(request.file) else {
            return FileAnswer::default();
        };
        let mut machine = MachineStatement::default();
        if is_shard {
            let of_target = || MachineStatement::of_target(file.target, file.precision(), devices);
            machine = stated
                .entry(file.target.name)
                .or_insert_with(of_target)
                .clone();
        }
        FileAnswer {
            rows: file_rows(plan, file, devices, effort),
            machine,
        }
    })
}
