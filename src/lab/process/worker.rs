//! Worker processes of this program, which answer requests line by line, and both ends of their pipe. A driver that crashes or hangs
//! harms only its worker. A pool distributes jobs among workers, one for each thread.
//!
//! Each line begins with the milliseconds that its answer may take. A worker ends, with all processes that it has started, when the
//! supervisor is gone, which closes the pipe. It also ends when an answer takes too long, in case the supervisor is stuck.

use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;
use std::{panic, thread};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::surroundings::{Error, Surroundings};

/// The command line and the environment of a worker process.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Launch {
    words: Vec<OsString>,
    /// Variables in addition to the environment of this process.
    environment: Vec<(String, OsString)>,
}

/// A process that answers requests. The first request starts it, and so does the request after one without an answer. It ends, with all that
/// it has started, when this is dropped and when this process ends.
pub struct Worker {
    launch: Launch,
    process: Option<Process>,
}

/// Why a worker gave no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoAnswer {
    /// It timed out.
    TooLong,
    /// Its process is gone or gave an invalid answer, for this reason.
    Ended(String),
}

impl Launch {
    /// This program with these arguments, in the surroundings of a run.
    pub fn new(words: &[&str], surroundings: &Surroundings) -> Launch {
        Launch {
            words: words.iter().map(OsString::from).collect(),
            environment: surroundings.environment(),
        }
    }

    /// This program with its own arguments and `--worker`, so that the worker makes the same plan.
    pub fn with_own_words(surroundings: &Surroundings) -> Launch {
        let own = std::env::args_os().skip(1);
        Launch {
            words: own.chain(["--worker".into()]).collect(),
            environment: surroundings.environment(),
        }
    }

    /// This launch with these variables in addition.
    pub fn with_environment(mut self, variables: Vec<(String, OsString)>) -> Launch {
        self.environment.extend(variables);
        self
    }
}

impl Worker {
    /// A worker whose process is not yet started.
    pub fn new(launch: Launch) -> Worker {
        Worker {
            launch,
            process: None,
        }
    }

    /// Sends a request and waits for the response. If the inner result is [`NoAnswer`], none came, and the process is ended.
    ///
    /// # Errors
    /// No process can be started.
    pub fn ask<Request: Serialize, Response: DeserializeOwned>(
        &mut self,
        request: &Request,
        limit: Duration,
    ) -> Result<Result<Response, NoAnswer>, Error> {
        let mut process = match self.process.take() {
            Some(process) => process,
            None => start(&self.launch).map_err(Error::Start)?,
        };
        let line = serde_json::to_string(request).expect("a request has only text keys");
        let response = process.ask(&line, limit);
        self.process = response.is_ok().then_some(process);
        Ok(response)
    }

    /// Ends the process. The next request starts another.
    pub fn end(&mut self) {
        self.process = None;
    }

    /// Whether its process is started by this launch.
    pub fn is_of(&self, launch: &Launch) -> bool {
        self.launch == *launch
    }
}

/// A running process.
struct Process {
    child: Child,
    input: ChildStdin,
    responses: Receiver<String>,
}

impl Process {
    fn ask<Response: DeserializeOwned>(
        &mut self,
        line: &str,
        limit: Duration,
    ) -> Result<Response, NoAnswer> {
        let sent =
            writeln!(self.input, "{}", framed(line, limit)).and_then(|()| self.input.flush());
        if sent.is_err() {
            return Err(self.ended());
        }
        match self.responses.recv_timeout(limit) {
            Ok(line) => serde_json::from_str(&line).map_err(|why| NoAnswer::Ended(why.to_string())),
            Err(RecvTimeoutError::Timeout) => Err(NoAnswer::TooLong),
            Err(RecvTimeoutError::Disconnected) => Err(self.ended()),
        }
    }

    fn ended(&mut self) -> NoAnswer {
        let status = self.child.wait();
        NoAnswer::Ended(status.map_or_else(|why| why.to_string(), |status| status.to_string()))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        #[cfg(unix)]
        end_group(&self.child);
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Ends a worker with the compilers that it has started, which are all in its group.
#[cfg(unix)]
fn end_group(child: &Child) {
    use rustix::process::{Pid, Signal, kill_process_group};
    let group = i32::try_from(child.id()).ok().and_then(Pid::from_raw);
    // Nothing may be left of it.
    let _ = group.map(|group| kill_process_group(group, Signal::KILL));
}

/// Starts a process. Output of drivers is not shown to users.
fn start(launch: &Launch) -> io::Result<Process> {
    let mut command = Command::new(std::env::current_exe()?);
    command.args(&launch.words);
    let variables = launch.environment.iter();
    command.envs(variables.map(|(name, value)| (name, value)));
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    let mut child = command.spawn()?;
    let gone = || io::Error::other("a process without pipes");
    let input = child.stdin.take().ok_or_else(gone)?;
    let output = BufReader::new(child.stdout.take().ok_or_else(gone)?);
    let (send, responses) = channel();
    thread::spawn(move || {
        // Ends with the process's output, or when the receiver is gone.
        for line in output.lines().map_while(Result::ok) {
            if send.send(line).is_err() {
                break;
            }
        }
    });
    Ok(Process {
        child,
        input,
        responses,
    })
}

/// How long a worker may exceed the limit of an answer before it ends itself. A working supervisor ends it earlier.
const MARGIN: Duration = Duration::from_secs(5);

/// The requests to a worker.
pub struct Inbox {
    lines: Receiver<String>,
    work: Sender<LineEvent>,
}

/// An event of a request line.
enum LineEvent {
    /// It has arrived, and its answer may take this long.
    Arrived(Duration),
    /// It is answered.
    Answered,
}

/// A line with the time that its answer may take.
fn framed(line: &str, limit: Duration) -> String {
    format!("{} {line}", limit.as_millis())
}

/// The time limit and the request of a line. None for a line that no supervisor wrote.
fn read(line: &str) -> Option<(Duration, String)> {
    let (limit, line) = line.split_once(' ')?;
    let limit = Duration::from_millis(limit.parse().ok()?);
    Some((limit, line.to_owned()))
}

impl Inbox {
    /// Listens to the supervisor.
    pub fn open() -> Inbox {
        let ((send, lines), (work, heard)) = (channel(), channel());
        let arrived = work.clone();
        thread::spawn(move || {
            for line in io::stdin().lines().map_while(Result::ok) {
                if let Some((limit, line)) = read(&line) {
                    let _ = arrived.send(LineEvent::Arrived(limit.saturating_add(MARGIN)));
                    let _ = send.send(line);
                }
            }
            end();
        });
        thread::spawn(move || watch(&heard));
        Inbox { lines, work }
    }

    /// Answers each request until the supervisor is gone.
    ///
    /// # Errors
    /// The pipe is gone, or a line is not a request.
    pub fn serve<Request: DeserializeOwned, Response: Serialize>(
        self,
        mut answer: impl FnMut(Request) -> Response,
    ) -> io::Result<()> {
        let mut output = io::stdout().lock();
        for line in self.lines {
            let response = answer(serde_json::from_str(&line)?);
            writeln!(output, "{}", serde_json::to_string(&response)?)?;
            output.flush()?;
            let _ = self.work.send(LineEvent::Answered);
        }
        Ok(())
    }
}

/// Ends this process when an answer is overdue.
fn watch(work: &Receiver<LineEvent>) {
    // The next line may arrive before the answer to the last one is noted here.
    let (mut waiting, mut limit) = (0usize, Duration::MAX);
    loop {
        let wait = if waiting > 0 { limit } else { Duration::MAX };
        match work.recv_timeout(wait) {
            Ok(LineEvent::Arrived(allowed)) => (waiting, limit) = (waiting + 1, allowed),
            Ok(LineEvent::Answered) => waiting = waiting.saturating_sub(1),
            Err(RecvTimeoutError::Timeout) => end(),
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// Ends this process, and the compilers that it has started.
#[cfg(unix)]
fn end() -> ! {
    use rustix::process::{Signal, getpgrp, getpid, kill_process, kill_process_group};
    // A worker that was not started by a supervisor may share its group with others.
    let _ = if getpgrp() == getpid() {
        kill_process_group(getpid(), Signal::KILL)
    } else {
        kill_process(getpid(), Signal::KILL)
    };
    std::process::abort()
}

/// Ends this process. Processes that it has started end by their own time limits.
#[cfg(not(unix))]
fn end() -> ! {
    std::process::exit(1)
}

/// The limits of a run.
#[derive(Clone, Copy, Debug)]
pub struct Pool {
    /// The time limit of one response.
    pub limit: Duration,
    /// The number of processes at once.
    pub workers: usize,
}

/// Does a job in a process, and calls its last argument whenever there is progress.
pub type Work<'a, Job, Done> =
    dyn Fn(&mut Worker, &Job, &dyn Fn()) -> Result<Done, Error> + Sync + 'a;

/// The jobs of a run, and how they are done.
pub struct Task<'a, Job, Done> {
    /// All jobs.
    pub jobs: &'a [Job],
    /// The launch of a job's process. A thread keeps its process as long as the launch is the same.
    pub launch: &'a (dyn Fn(&Job) -> Launch + Sync),
    /// Does a job. It calls the last argument whenever there is progress.
    pub work: &'a Work<'a, Job, Done>,
}

impl Pool {
    /// The results of all jobs, in order. `progress` is called with a job whenever there is progress in it.
    ///
    /// # Errors
    /// A process cannot be started.
    pub fn run<Job: Sync, Done: Send>(
        self,
        task: &Task<Job, Done>,
        progress: &mut dyn FnMut(&Job),
    ) -> Result<Vec<Done>, Error> {
        let next = AtomicUsize::new(0);
        let (send, ticks) = channel();
        let shares = thread::scope(|scope| {
            let start = |_| {
                let (send, next) = (send.clone(), &next);
                scope.spawn(move || task.share(next, &send))
            };
            let workers = self.workers.clamp(1, task.jobs.len().max(1));
            let threads: Vec<_> = (0..workers).map(start).collect();
            drop(send);
            for place in ticks {
                progress(&task.jobs[place]);
            }
            let shares = threads.into_iter().map(|thread| {
                let share = thread.join();
                share.unwrap_or_else(|fault| panic::resume_unwind(fault))
            });
            shares.collect::<Result<Vec<_>, Error>>()
        })?;
        let mut done: Vec<(usize, Done)> = shares.into_iter().flatten().collect();
        done.sort_by_key(|(place, _)| *place);
        Ok(done.into_iter().map(|(_, done)| done).collect())
    }
}

impl<Job, Done> Task<'_, Job, Done> {
    /// The results of one thread's share of the jobs, each with its index.
    fn share(
        &self,
        next: &AtomicUsize,
        ticks: &Sender<usize>,
    ) -> Result<Vec<(usize, Done)>, Error> {
        let mut kept: Option<Worker> = None;
        let mut share = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = self.jobs.get(place) else {
                return Ok(share);
            };
            let launch = (self.launch)(job);
            let mut worker = match kept.take() {
                Some(worker) if worker.is_of(&launch) => worker,
                _ => Worker::new(launch),
            };
            // The receiver is gone if the run has failed.
            let tick = || ticks.send(place).unwrap_or_default();
            share.push((place, (self.work)(&mut worker, job, &tick)?));
            kept = Some(worker);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_its_time() {
        let limit = Duration::from_millis(1500);
        for line in ["", "7", "\"fn f() { }\""] {
            assert_eq!(read(&framed(line, limit)), Some((limit, line.to_owned())));
        }
        assert_eq!(read("\"fn f() { }\""), None);
        assert_eq!(read(""), None);
    }
}
