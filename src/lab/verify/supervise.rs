//! The supervisor: hands files to workers, and ends those that come to no end.

use core::time::Duration;
use std::path::Path;

use crate::lab::process::{Error, Launch, Pool, Silence, Surroundings, Task};

use super::judge::unfinished;
use super::plan::VerifyPlan;
use super::shard::{Shard, ShardOutcome};
use super::worker::{FileAnswer, FileRequest};

/// The rows of a shard's files, in the plan's order, by the compilers in the folder of tools before all others. `progress` hears how many are done.
///
/// # Errors
/// No process can be started.
pub fn supervise(
    plan: &VerifyPlan,
    shard: Shard,
    pool: Pool,
    tools: Option<&Path>,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<ShardOutcome, Error> {
    let surroundings = Surroundings::new(tools)?;
    let launch = Launch::with_own_words(&surroundings);
    let dealt = (0..plan.files.len()).filter(|file| shard.takes(*file));
    let requests: Vec<FileRequest> = dealt.map(|file| FileRequest { file }).collect();
    let task = Task {
        jobs: &requests,
        launch: &|_| launch.clone(),
        work: &|worker, request, tick| {
            let answer = worker.ask(request, pool.limit)?;
            tick();
            let file = &plan.files[request.file];
            Ok(answer.unwrap_or_else(|silence| FileAnswer {
                rows: unfinished(file, &reason(&silence, pool.limit)),
                ..FileAnswer::default()
            }))
        },
    };
    let (mut count, whole) = (0, requests.len() as u64);
    let answers = pool.run(&task, &mut |request: &FileRequest| {
        count += 1;
        progress(count, whole, &plan.files[request.file].run_page().path);
    })?;
    let mut outcome = ShardOutcome {
        plan: plan.planned_rows(),
        ..ShardOutcome::default()
    };
    for (request, answer) in requests.iter().zip(answers) {
        outcome.add(request.file, &plan.files[request.file], answer.rows);
        outcome.machine.add(answer.machine);
    }
    Ok(outcome)
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
