//! What verification needs of the machine: processes of its own program, the environment.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The program that runs, and the words it was given.
///
/// # Errors
/// The system does not tell.
pub fn own_program() -> io::Result<(PathBuf, Vec<std::ffi::OsString>)> {
    Ok((
        std::env::current_exe()?,
        std::env::args_os().skip(1).collect(),
    ))
}

/// A process of this program, told what to do through a pipe and answering through another. What drivers print is not
/// for users.
///
/// # Errors
/// It cannot be started.
pub fn worker(program: &Path, words: &[std::ffi::OsString], scratch: &Path) -> io::Result<Child> {
    let mut command = Command::new(program);
    command.args(words).arg("--worker");
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // Mesa complains where it is not set.
        command.env("XDG_RUNTIME_DIR", scratch);
    }
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    command.spawn()
}

/// Whether GitHub runs this, and reads annotations.
pub fn is_github() -> bool {
    std::env::var_os("GITHUB_ACTIONS").is_some_and(|value| value == "true")
}

/// Runs something, and tells how long it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed())
}

/// How many workers a machine takes.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
