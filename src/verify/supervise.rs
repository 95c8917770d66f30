//! The supervisor: hands files to workers, and ends those that come to no end.

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

use crate::process::{Error, Surroundings};
use crate::process::{Silence, Worker, own_words};

use super::judge::unfinished;
use super::plan::Plan;
use super::row::VerifyRow;

/// How much a run may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For one file.
    pub seconds: u64,
    /// Processes at once.
    pub workers: usize,
}

/// The rows of all files, in the plan's order, by the compilers in the folder of tools before all others. `progress` hears how many are done.
///
/// # Errors
/// No process can be started.
pub fn supervise(
    plan: &Plan,
    limits: Limits,
    tools: Option<&Path>,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<VerifyRow>, Error> {
    let time = Duration::from_secs(limits.seconds);
    let surroundings = Surroundings::new(tools)?;
    let mut words = own_words();
    words.push("--worker".into());
    let start = || Worker::start(&words, &[], &surroundings);
    let next = AtomicUsize::new(0);
    let answers: Vec<Mutex<Vec<VerifyRow>>> = plan.files.iter().map(|_| Mutex::default()).collect();
    let (done, heard) = channel();
    thread::scope(|scope| {
        let work = || work(plan, time, &start, &next, &answers, &done.clone());
        let workers = limits.workers.clamp(1, plan.files.len().max(1));
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        let mut count = 0;
        while count < plan.files.len() && threads.iter().any(|thread| !thread.is_finished()) {
            if let Ok(index) = heard.recv_timeout(Duration::from_millis(100)) {
                count += 1;
                let file: &super::plan::Planned = &plan.files[index];
                progress(count as u64, plan.files.len() as u64, &file.run_page().path);
            }
        }
        let results = threads
            .into_iter()
            .map(|thread| thread.join().unwrap_or(Ok(())));
        results.collect::<Result<Vec<()>, Error>>()
    })?;
    let rows = answers
        .into_iter()
        .flat_map(|rows| rows.into_inner().unwrap_or_default());
    Ok(rows.collect())
}

/// One worker's share of the files, with a new process whenever the last one is gone.
fn work(
    plan: &Plan,
    limit: Duration,
    start: &(dyn Fn() -> Result<Worker, Error> + Sync),
    next: &AtomicUsize,
    answers: &[Mutex<Vec<VerifyRow>>],
    done: &std::sync::mpsc::Sender<usize>,
) -> Result<(), Error> {
    let mut worker = start()?;
    loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        let Some(file) = plan.files.get(index) else {
            return Ok(());
        };
        let rows = match worker.ask(&index.to_string(), limit) {
            Ok(rows) => rows,
            Err(silence) => {
                worker = start()?;
                unfinished(file, &reason(&silence, limit))
            }
        };
        if let Ok(mut place) = answers[index].lock() {
            *place = rows;
        }
        // Nobody listens any more when another worker could not be started.
        let _ = done.send(index);
    }
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
