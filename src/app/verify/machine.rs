//! What verification needs of the machine: files, its own program, the environment.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use crate::app::error::Error;

/// The largest file that is read: no shader of ours comes near.
const LARGEST: u64 = 16 << 20;

/// The bytes of a file, nothing where there is none.
///
/// # Errors
/// It is there and cannot be read, or is too large to be a shader.
pub fn read_if_there(path: &Path) -> Result<Option<Vec<u8>>, Error> {
    let fault = |source: io::Error| Error::Input {
        path: path.to_owned(),
        source,
    };
    match std::fs::metadata(path) {
        Ok(found) if found.len() > LARGEST => Err(Error::Usage {
            what: format!(
                "{} has {} bytes: that is no shader",
                path.display(),
                found.len()
            ),
        }),
        Ok(_) => std::fs::read(path).map(Some).map_err(fault),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(fault(error)),
    }
}

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

/// How many workers a machine takes.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
