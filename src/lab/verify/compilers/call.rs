//! Calls of compilers: finds one, runs it in a temporary folder of its own, and stops it when it takes too long. No other file of
//! this room touches the machine.

use std::env::{consts::EXE_SUFFIX, join_paths, split_paths, var_os};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::lab::process::{TEMPORARY, beside};

/// More than any compiler needs for our files, even on a slow and busy machine.
const LIMIT: Duration = Duration::from_secs(60);

/// Bytes that must still fit on the disk beside a compiler's output, to tell a full disk from a refusal. Most outputs are smaller.
const PROBE: usize = 1 << 18;

/// Exit codes of the system's own programs that cannot run another: not executable, not found.
const NOT_RUN: [i32; 2] = [126, 127];

/// A file for a compiler to read.
pub struct CompilerInput {
    /// Its name, without a folder.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// The result of a call.
pub struct Called {
    /// Whether the compiler reports success.
    pub ok: bool,
    /// What it printed.
    pub said: String,
    /// The file that it wrote to `OUT` in the options. Empty if it wrote none.
    pub made: Vec<u8>,
}

/// Why a command gave no answer.
#[derive(Debug, thiserror::Error)]
pub enum Silent {
    /// It cannot be started.
    #[error("it cannot be started: {0}")]
    Start(io::Error),
    /// A shell, a loader or `env` could not run it: an interpreter or a library is missing.
    #[error("it could not be run (exit status {0}): {1}")]
    NotRun(i32, String),
    /// Its files cannot be written.
    #[error(
        "its temporary files cannot be written: {0}; make room in the temporary folder, or set {TEMPORARY} to another"
    )]
    Files(#[from] io::Error),
}

/// Where a command lies: on the path, or beside this program.
pub fn find(command: &str) -> Option<PathBuf> {
    let file = format!("{command}{EXE_SUFFIX}");
    let mut places = path().into_iter().chain(beside());
    places.find_map(|place| {
        let path = place.join(&file);
        path.is_file().then_some(path)
    })
}

/// The folders of the path, without relative ones: files below the current folder may be anybody's.
fn path() -> Vec<PathBuf> {
    let path = var_os("PATH").unwrap_or_default();
    split_paths(&path)
        .filter(|place| place.is_absolute())
        .collect()
}

/// Calls a command with options, in which `FILE` stands for all the files and `OUT` for what it writes.
pub fn call(command: &Path, options: &str, files: &[CompilerInput]) -> Result<Called, Silent> {
    call_within(LIMIT, command, options, files)
}

fn call_within(
    limit: Duration,
    command: &Path,
    options: &str,
    files: &[CompilerInput],
) -> Result<Called, Silent> {
    let folder = TempDir::new()?;
    for file in files {
        fs::write(folder.path().join(&file.name), &file.bytes)?;
    }
    let (made, said) = ("made.out", folder.path().join("said.out"));
    // A file, not a pipe: a pipe that nobody reads would stop a compiler with much to say.
    let words = fs::File::create(&said)?;
    let mut child = Command::new(command)
        .args(arguments(options, files, made))
        // Some are scripts, whose interpreter is looked up in the path too.
        .env("PATH", join_paths(path()).unwrap_or_default())
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stdout(words.try_clone()?)
        .stderr(words)
        .spawn()
        .map_err(Silent::Start)?;
    let status = wait(&mut child, limit)?;
    let mut said = String::from_utf8_lossy(&fs::read(said)?).into_owned();
    let ok = status.is_some_and(|status| status.success());
    if let Some(code) = status
        .and_then(|status| status.code())
        .filter(|code| NOT_RUN.contains(code))
    {
        return Err(Silent::NotRun(code, said.trim().to_owned()));
    }
    if !ok {
        // A compiler that cannot write its output fails in words of its own, and is not to blame.
        fs::write(folder.path().join("probe"), [0; PROBE])?;
    }
    match status {
        None => said.insert_str(0, &format!("stopped after {} s\n", limit.as_secs_f64())),
        Some(status) if !ok && said.trim().is_empty() => said = format!("no word, {status}"),
        Some(_) => {}
    }
    let made = fs::read(folder.path().join(made)).unwrap_or_default();
    Ok(Called { ok, said, made })
}

fn arguments<'a>(options: &'a str, files: &'a [CompilerInput], made: &'a str) -> Vec<&'a str> {
    let expanded = |word: &'a str| match word {
        "FILE" => files.iter().map(|file| file.name.as_str()).collect(),
        "OUT" => vec![made],
        word => vec![word],
    };
    options.split_whitespace().flat_map(expanded).collect()
}

/// Waits for the program to end. None if it did not end in time and was stopped.
fn wait(child: &mut Child, limit: Duration) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() > limit {
            // It may just have ended by itself.
            let _ = child.kill();
            child.wait()?;
            return Ok(None);
        }
        sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(20));
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str, limit: Duration) -> Called {
        let file = CompilerInput {
            name: "script".to_owned(),
            bytes: script.as_bytes().to_vec(),
        };
        call_within(limit, &find("sh").unwrap(), "FILE OUT", &[file]).unwrap()
    }

    #[test]
    fn what_is_said_and_made_comes_back() {
        let called = shell("echo a; echo b >&2; echo made > $1", LIMIT);
        assert!(called.ok);
        assert_eq!(called.said, "a\nb\n");
        assert_eq!(called.made, b"made\n");
    }

    #[test]
    fn a_failure_without_a_word_names_the_status() {
        let called = shell("exit 3", LIMIT);
        assert!(!called.ok && called.made.is_empty());
        assert_eq!(called.said, "no word, exit status: 3");
    }

    #[test]
    fn much_is_said_without_end() {
        let called = shell("yes | head -n 1000000; exit 1", LIMIT);
        assert_eq!(called.said.len(), 2_000_000);
    }

    #[test]
    fn a_compiler_that_hangs_is_stopped() {
        let called = shell("echo thinking; exec sleep 60", Duration::from_millis(200));
        assert!(!called.ok);
        assert_eq!(called.said, "stopped after 0.2 s\nthinking\n");
    }

    #[test]
    fn what_does_not_exist_is_not_found() {
        assert_eq!(find("no-such-compiler"), None);
    }
}
