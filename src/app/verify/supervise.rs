//! The supervisor: hands files to workers, and ends those that come to no end.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use serde_json::Value;

use crate::app::error::Error;

use super::machine;
use super::plan::Plan;
use super::row::unfinished;

/// How much a run may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For one file.
    pub seconds: u64,
    /// Processes at once.
    pub workers: usize,
}

/// A process that answers.
struct Worker {
    child: Child,
    input: ChildStdin,
    answers: Receiver<String>,
}

/// Why a worker gave no answer.
enum Silence {
    TooLong,
    Ended(String),
}

/// The rows of all files, in the plan's order. `progress` hears how many are done.
///
/// # Errors
/// No process can be started.
pub fn supervise(
    plan: &Plan,
    limits: Limits,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Value>, Error> {
    let time = Duration::from_secs(limits.seconds);
    let scratch = tempfile::tempdir().map_err(|why| cannot_start(&why))?;
    let start = || start(scratch.path()).map_err(|why| cannot_start(&why));
    let next = AtomicUsize::new(0);
    let answers: Vec<Mutex<Vec<Value>>> = plan.files.iter().map(|_| Mutex::default()).collect();
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
    answers: &[Mutex<Vec<Value>>],
    done: &std::sync::mpsc::Sender<usize>,
) -> Result<(), Error> {
    let mut worker = start()?;
    loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        let Some(file) = plan.files.get(index) else {
            return Ok(());
        };
        let rows = match worker.ask(index, limit) {
            Ok(rows) => rows,
            Err(silence) => {
                worker = start()?;
                unfinished(file, &silence.text(limit))
            }
        };
        if let Ok(mut place) = answers[index].lock() {
            *place = rows;
        }
        // Nobody listens any more when another worker could not be started.
        let _ = done.send(index);
    }
}

impl Silence {
    fn text(&self, limit: Duration) -> String {
        match self {
            Silence::TooLong => format!(
                "it did not end within {} s: a device that hangs, or more --points than --limit allows",
                limit.as_secs()
            ),
            Silence::Ended(status) => {
                format!(
                    "the process that ran it ended ({status}): its driver failed on this shader"
                )
            }
        }
    }
}

fn start(scratch: &std::path::Path) -> std::io::Result<Worker> {
    let (program, words) = machine::own_program()?;
    let mut child = machine::worker(&program, &words, scratch)?;
    let gone = || std::io::Error::other("a process without pipes");
    let input = child.stdin.take().ok_or_else(gone)?;
    let output = BufReader::new(child.stdout.take().ok_or_else(gone)?);
    let (send, answers) = channel();
    thread::spawn(move || {
        // Ends with the process's output, or when nobody listens.
        for line in output.lines().map_while(Result::ok) {
            if send.send(line).is_err() {
                break;
            }
        }
    });
    Ok(Worker {
        child,
        input,
        answers,
    })
}

impl Worker {
    fn ask(&mut self, index: usize, limit: Duration) -> Result<Vec<Value>, Silence> {
        let asked = writeln!(self.input, "{index}").and_then(|()| self.input.flush());
        if asked.is_err() {
            return Err(self.ended());
        }
        match self.answers.recv_timeout(limit) {
            Ok(line) => serde_json::from_str(&line).map_err(|why| Silence::Ended(why.to_string())),
            Err(RecvTimeoutError::Timeout) => Err(Silence::TooLong),
            Err(RecvTimeoutError::Disconnected) => Err(self.ended()),
        }
    }

    fn ended(&mut self) -> Silence {
        let status = self.child.wait();
        Silence::Ended(status.map_or_else(|why| why.to_string(), |status| status.to_string()))
    }
}

impl Drop for Worker {
    /// Ends the process, whatever it does.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn cannot_start(why: &std::io::Error) -> Error {
    Error::Usage {
        what: format!("this program cannot start a process of its own to run shaders in: {why}"),
    }
}
