//! The supervisor: hands files to workers, and ends those that come to no end.

use core::time::Duration;
use std::path::Path;

use crate::process::{Error, Launch, Pool, Silence, Surroundings, Task};

use super::judge::unfinished;
use super::plan::VerifyPlan;
use super::row::VerifyRow;
use super::worker::FileRequest;

/// The rows of all files, in the plan's order, by the compilers in the folder of tools before all others. `progress` hears how many are done.
///
/// # Errors
/// No process can be started.
pub fn supervise(
    plan: &VerifyPlan,
    pool: Pool,
    tools: Option<&Path>,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<VerifyRow>, Error> {
    let surroundings = Surroundings::new(tools)?;
    let launch = Launch::with_own_words(&surroundings);
    let requests = (0..plan.files.len()).map(|file| FileRequest { file });
    let task = Task {
        jobs: &requests.collect::<Vec<FileRequest>>(),
        launch: &|_| launch.clone(),
        work: &|worker, request, tick| {
            let rows = worker.ask(request, pool.limit)?;
            tick();
            let file = &plan.files[request.file];
            Ok(rows.unwrap_or_else(|silence| unfinished(file, &reason(&silence, pool.limit))))
        },
    };
    let (mut count, whole) = (0, plan.files.len() as u64);
    let rows = pool.run(&task, &mut |request: &FileRequest| {
        count += 1;
        progress(count, whole, &plan.files[request.file].run_page().path);
    })?;
    Ok(rows.into_iter().flatten().collect())
}

/// Why there are no rows.
fn reason(silence: &Silence, limit: Duration) -> String {
    match silence {
        Silence::TooLong => format!(
            "it did not end within {} s: a device or a compiler that hangs, or more --points than --limit allows",
            limit.as_secs()
        ),
        Silence::Ended(status) => {
            format!("the process that ran it ended ({status}): its driver failed on this shader")
        }
    }
}
