//! A worker: reads the numbers of files, a line each, and answers each with its rows, a line of JSON.

use std::io::{self, Write};

use crate::process::Inbox;
use crate::verify::run::Devices;

use super::file::{Effort, file_rows};
use super::plan::Plan;

/// Serves until there is nothing more to read. Only numbers of the plan are answered.
///
/// # Errors
/// The pipe is gone.
pub fn serve(inbox: Inbox, plan: &Plan, devices: &Devices, effort: Effort) -> io::Result<()> {
    let mut output = io::stdout().lock();
    for line in inbox {
        let Some(file) = line
            .trim()
            .parse()
            .ok()
            .and_then(|index: usize| plan.files.get(index))
        else {
            continue;
        };
        let rows = file_rows(plan, file, devices, effort);
        writeln!(output, "{}", serde_json::to_string(&rows)?)?;
        output.flush()?;
    }
    Ok(())
}
