//! The supervisor of a verification, which hands files to worker processes and ends those that time out, and the worker, which
//! answers a file's number with its rows.

use core::time::Duration;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::file::file_rows;
use super::judge::unfinished;
use super::machine::MachineStatement;
use super::requested::VerifyPlan;
use super::row::VerifyRow;
use super::run::Devices;
use super::shard::{Shard, ShardOutcome};
use crate::lab::process::{Error, Inbox, Launch, NoAnswer, Pool, Surroundings, Task};

/// The rows of a shard's files, in the plan's order. Compilers in the folder `tools` come before all others. `progress` is told how
/// many files are done, of how many, and which.
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
    let all = 0..plan.files.len();
    let dealt: Vec<usize> = all.filter(|place| shard.takes(*place)).collect();
    let task = Task {
        jobs: &dealt,
        launch: &|_| launch.clone(),
        work: &|worker, place, tick| {
            let answer = worker.ask(place, pool.limit)?;
            tick();
            Ok(answer.unwrap_or_else(|why| FileAnswer {
                rows: unfinished(&plan.files[*place], &reason(&why, pool.limit)),
                ..FileAnswer::default()
            }))
        },
    };
    let (mut count, whole) = (0, dealt.len() as u64);
    let answers = pool.run(&task, &mut |place: &usize| {
        count += 1;
        progress(count, whole, &plan.files[*place].run_page().path);
    })?;
    let mut outcome = ShardOutcome {
        plan: plan.planned_rows(),
        ..ShardOutcome::default()
    };
    for (place, answer) in dealt.into_iter().zip(answers) {
        outcome.add(place, &plan.files[place], answer.rows);
        outcome.machine.add(answer.machine);
    }
    Ok(outcome)
}

/// Why there are no rows.
fn reason(why: &NoAnswer, limit: Duration) -> String {
    match why {
        NoAnswer::TooLong => format!(
            "it did not end within {} s: a device or a compiler that hangs, or more --points than --limit allows",
            limit.as_secs()
        ),
        NoAnswer::Ended(status) => {
            format!("the process that ran it ended ({status}): its driver failed on this shader")
        }
    }
}

/// A worker's answer to the place of a file in the plan.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct FileAnswer {
    /// The rows of the file.
    pub rows: Vec<VerifyRow>,
    /// For a shard: what the machine has for the file's target.
    #[serde(default)]
    pub machine: MachineStatement,
}

/// Serves until the supervisor is gone. Only files of the plan have rows, and only a shard states what the machine has. `points` is
/// the number of cosines for each function and material.
///
/// # Errors
/// The pipe is gone.
pub fn serve(
    inbox: Inbox,
    plan: &VerifyPlan,
    devices: &Devices,
    points: usize,
    is_shard: bool,
) -> io::Result<()> {
    let mut stated: BTreeMap<&str, MachineStatement> = BTreeMap::new();
    inbox.serve(|place: usize| -> FileAnswer {
        let Some(file) = plan.files.get(place) else {
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
            rows: file_rows(plan, file, devices, points),
            machine,
        }
    })
}
