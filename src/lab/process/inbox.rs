//! The worker's end of the pipe: it answers requests, line by line.
//!
//! Each line begins with the milliseconds that its answer may take. A worker ends with all processes that it has started when
//! the supervisor is gone, which closes the pipe, and when an answer takes longer, in case the supervisor is stuck.

use std::io::{self, Write};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use serde::{Serialize, de::DeserializeOwned};

/// How much longer than it is allowed a worker may work on an answer: a supervisor that is well ends it before.
const MARGIN: Duration = Duration::from_secs(5);

/// The requests to a worker.
pub struct Inbox {
    lines: Receiver<String>,
    work: Sender<LineEvent>,
}

/// What happens to a line.
enum LineEvent {
    /// It is here, and its answer may take so long.
    Arrived(Duration),
    /// It is answered.
    Answered,
}

/// A line with the time that its answer may take.
pub fn framed(line: &str, limit: Duration) -> String {
    format!("{} {line}", limit.as_millis())
}

/// What is asked, and the time for it; nothing of a line that no supervisor wrote.
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
    /// The pipe is gone, or a line is no request.
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
    // The next line may arrive before the answer to the last one is entered here.
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

/// Ends this process. What it has started ends by its own time limit.
#[cfg(not(unix))]
fn end() -> ! {
    std::process::exit(1)
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
