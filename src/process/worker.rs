//! Processes of this program that answer line by line: what a driver does to them, it does to nobody else.

use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use serde::de::DeserializeOwned;

use super::error::Error;
use super::inbox::framed;
use super::surroundings::Surroundings;

/// A process that answers. It ends when this is dropped, with all that it has started, and when this process ends.
pub struct Worker {
    child: Child,
    input: ChildStdin,
    answers: Receiver<String>,
}

/// Why a worker gave no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Silence {
    /// It was given time enough.
    TooLong,
    /// Its process is gone, or answered what is no answer: the reason.
    Ended(String),
}

impl Worker {
    /// Starts this program with these words and this environment beside its own. What drivers print is not for users.
    ///
    /// # Errors
    /// It cannot be started.
    pub fn start(
        words: &[OsString],
        environment: &[(String, OsString)],
        surroundings: &Surroundings,
    ) -> Result<Worker, Error> {
        spawn(words, environment, surroundings).map_err(Error::Start)
    }

    /// Asks a line, and waits for a line of JSON.
    ///
    /// # Errors
    /// None came.
    pub fn ask<T: DeserializeOwned>(&mut self, line: &str, limit: Duration) -> Result<T, Silence> {
        let asked =
            writeln!(self.input, "{}", framed(line, limit)).and_then(|()| self.input.flush());
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

fn spawn(
    words: &[OsString],
    environment: &[(String, OsString)],
    surroundings: &Surroundings,
) -> io::Result<Worker> {
    let mut command = Command::new(std::env::current_exe()?);
    command.args(words);
    command.envs(surroundings.environment());
    command.envs(environment.iter().map(|(name, value)| (name, value)));
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

/// The words that this program was given.
pub fn own_words() -> Vec<OsString> {
    std::env::args_os().skip(1).collect()
}
