//! Processes of this program that answer line by line: what a driver does to them, it does to nobody else.

use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::pool::Error;
use super::inbox::framed;
use super::surroundings::Surroundings;

/// How a process of this program is started.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Launch {
    words: Vec<OsString>,
    /// Beside the environment of this process.
    environment: Vec<(String, OsString)>,
}

/// A process that answers requests: started by the first, and anew by the one after a silence. It ends when this is dropped,
/// with all that it has started, and when this process ends.
pub struct Worker {
    launch: Launch,
    process: Option<Process>,
}

/// Why a worker gave no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Silence {
    /// It was given time enough.
    TooLong,
    /// Its process is gone, or answered what is no answer: the reason.
    Ended(String),
}

impl Launch {
    /// This program with these words, in the surroundings of a run.
    pub fn new(words: &[&str], surroundings: &Surroundings) -> Launch {
        Launch {
            words: words.iter().map(OsString::from).collect(),
            environment: surroundings.environment(),
        }
    }

    /// This program with the words that it was given itself, and `--worker`: so the worker comes to the same plan.
    pub fn with_own_words(surroundings: &Surroundings) -> Launch {
        let own = std::env::args_os().skip(1);
        Launch {
            words: own.chain(["--worker".into()]).collect(),
            environment: surroundings.environment(),
        }
    }

    /// The same with these variables too.
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

    /// Sends a request and waits for the response: none came where the inner result says so, and then the process is ended.
    ///
    /// # Errors
    /// No process can be started.
    pub fn ask<Request: Serialize, Response: DeserializeOwned>(
        &mut self,
        request: &Request,
        limit: Duration,
    ) -> Result<Result<Response, Silence>, Error> {
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

    /// Whether this is how it is started.
    pub fn is_of(&self, launch: &Launch) -> bool {
        self.launch == *launch
    }
}

/// A process at work.
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
    ) -> Result<Response, Silence> {
        let sent =
            writeln!(self.input, "{}", framed(line, limit)).and_then(|()| self.input.flush());
        if sent.is_err() {
            return Err(self.ended());
        }
        match self.responses.recv_timeout(limit) {
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

impl Drop for Process {
    fn drop(&mut self) {
        #[cfg(unix)]
        end_group(&self.child);
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Ends a worker with the compilers that it has started: they are all in its group.
#[cfg(unix)]
fn end_group(child: &Child) {
    use rustix::process::{Pid, Signal, kill_process_group};
    let group = i32::try_from(child.id()).ok().and_then(Pid::from_raw);
    // Nothing may be left of it.
    let _ = group.map(|group| kill_process_group(group, Signal::KILL));
}

/// Starts a process. What drivers print is not for users.
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
        // Ends with the process's output, or when nobody listens.
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
