//! What the processes of a run share: a folder for their temporary files, and the user's folder of tools. Also why its processes
//! cannot be started.
//!
//! The run holds a lock in its folder, and removes the folder at its end, also when a signal ends it. A run that is killed leaves
//! its folder behind. The next run removes every such folder whose lock is free.

use std::collections::BTreeSet;
use std::env::{current_exe, join_paths, split_paths, temp_dir, var_os};
use std::ffi::OsString;
use std::fs::{self, File, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tempfile::TempDir;
use thiserror::Error;

/// The prefix of a run's folder. Only folders with this prefix and our lock are ever removed.
const PREFIX: &str = ".fresnel-gen-run-";
/// The file that a run holds locked.
const LOCK: &str = "lock";
/// Its name until it is locked, so that no other run takes the folder for one left behind.
const UNLOCKED: &str = "lock.new";
/// Its text, for people. On a full disk these bytes cannot be written, and the run reports that before it begins.
const ABOUT: &str = "A run of fresnel-gen locks this file and removes this folder when it ends. After a run that was killed \
the next run removes it.\n";

/// What the processes of a run share.
pub struct Surroundings {
    /// The folder that is searched for tools before all others.
    pub tools: Option<PathBuf>,
    /// The lock, which is closed before the folder is removed.
    _lock: Option<File>,
    folder: TempDir,
}

impl Surroundings {
    /// Makes the folder, and removes those of runs that were killed.
    ///
    /// # Errors
    /// Temporary files cannot be written, or the folder of tools cannot be used.
    pub fn new(tools: Option<&Path>) -> Result<Surroundings, Error> {
        let tools = tools.map(named).transpose()?;
        let place = temp_dir();
        sweep(&place);
        signals::listen();
        let lacking = |why: io::Error| no_place(&place, &why);
        let folder = tempfile::Builder::new().prefix(PREFIX).tempdir();
        let folder = folder.map_err(lacking)?;
        folders().insert(folder.path().to_path_buf());
        let lock = locked(folder.path()).map_err(lacking)?;
        Ok(Surroundings {
            tools,
            _lock: lock,
            folder,
        })
    }

    /// Variables of each process in addition to our environment: temporary files go into the folder, and the user's tools come
    /// first.
    pub fn environment(&self) -> Vec<(String, OsString)> {
        let folder = || self.folder.path().as_os_str().to_owned();
        let mut all: Vec<(String, OsString)> = ["TMPDIR", "TMP", "TEMP"]
            .map(|name| (name.to_owned(), folder()))
            .into();
        if var_os("XDG_RUNTIME_DIR").is_none() {
            // Mesa complains if it is not set.
            all.push(("XDG_RUNTIME_DIR".to_owned(), folder()));
        }
        if let Some(tools) = &self.tools {
            let path = var_os("PATH").unwrap_or_default();
            let all_places = [tools.clone()].into_iter().chain(split_paths(&path));
            // A folder that cannot be joined was refused when it was named.
            let joined = join_paths(all_places).unwrap_or(path.clone());
            all.push(("PATH".to_owned(), joined));
        }
        all
    }
}

impl Drop for Surroundings {
    fn drop(&mut self) {
        folders().remove(self.folder.path());
    }
}

/// The folder of tools as the user names it: the only place that may be relative to the current folder.
fn named(tools: &Path) -> Result<PathBuf, Error> {
    let refused = |why: &str| Error::Tools {
        folder: tools.to_path_buf(),
        why: why.to_owned(),
    };
    if !tools.is_dir() {
        return Err(refused("this is no folder"));
    }
    let whole = std::path::absolute(tools).map_err(|why| refused(&why.to_string()))?;
    match join_paths([&whole]) {
        Ok(_) => Ok(whole),
        Err(why) => Err(refused(&why.to_string())),
    }
}

fn no_place(place: &Path, why: &io::Error) -> Error {
    // The error's own words repeat the path.
    let inner = why.get_ref().and_then(|inner| inner.source());
    let why = inner.map_or_else(|| why.to_string(), ToString::to_string);
    Error::Temporary {
        place: place.to_path_buf(),
        why,
    }
}

/// The lock of a new folder. None where the file system has no locks, and then no other run removes the folder.
fn locked(folder: &Path) -> io::Result<Option<File>> {
    let file = folder.join(UNLOCKED);
    let mut lock = File::create(&file)?;
    lock.write_all(ABOUT.as_bytes())?;
    if lock.try_lock().is_err() {
        return Ok(None);
    }
    fs::rename(file, folder.join(LOCK))?;
    Ok(Some(lock))
}

/// Removes the folders that killed runs have left in a folder.
fn sweep(place: &Path) {
    for entry in fs::read_dir(place).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let is_named = name.to_str().is_some_and(|name| name.starts_with(PREFIX));
        // A folder that cannot be removed is left to its owner.
        if is_named && is_left(&entry.path()) {
            let _ = fs::remove_dir_all(entry.path());
        } else if is_named && entry.metadata().is_ok_and(|found| is_old(&found)) {
            // The run was killed before it took its lock. This removes only an empty folder.
            let _ = fs::remove_dir(entry.path());
        }
    }
}

/// Whether a folder of this user's is too old for a run that is about to put its lock there.
fn is_old(found: &Metadata) -> bool {
    const HOUR: Duration = Duration::from_secs(3600);
    let age = found.modified().ok().and_then(|made| made.elapsed().ok());
    found.is_dir() && is_own(found) && age.is_some_and(|age| age > HOUR)
}

/// Whether a folder was made by a run of this user's that has ended.
fn is_left(folder: &Path) -> bool {
    let lock = folder.join(LOCK);
    let own = |path: &Path, is: fn(&Metadata) -> bool| {
        fs::symlink_metadata(path).is_ok_and(|found| is(&found) && is_own(&found))
    };
    let open = || File::options().read(true).write(true).open(&lock);
    own(folder, Metadata::is_dir)
        && own(&lock, Metadata::is_file)
        && fs::read(&lock).is_ok_and(|text| text == ABOUT.as_bytes())
        && open().is_ok_and(|lock| lock.try_lock().is_ok())
}

#[cfg(unix)]
fn is_own(found: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    found.uid() == rustix::process::geteuid().as_raw()
}

#[cfg(not(unix))]
fn is_own(_: &Metadata) -> bool {
    // The temporary folder of other systems is the user's own.
    true
}

/// The folders of this process that a signal must remove.
fn folders() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    static FOLDERS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    FOLDERS.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(unix)]
mod signals {
    use std::fs;
    use std::sync::Once;
    use std::thread::{sleep, spawn};
    use std::time::Duration;

    use signal_hook::consts::{
        SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGXCPU,
    };
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    /// Removes folders when a signal ends this process. Workers end by themselves when this process is gone.
    pub fn listen() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let Ok(mut signals) = Signals::new(ending()) else {
                return;
            };
            spawn(move || {
                for signal in signals.forever() {
                    remove();
                    // The sender of the signal sees that this process ended by it.
                    let _ = emulate_default_handler(signal);
                }
            });
        });
    }

    /// The signals that end this process. Signals that it was told to ignore, for example by `nohup`, stay ignored. Where those
    /// are not known, only signals that people send are handled.
    fn ending() -> Vec<i32> {
        const ALL: [i32; 10] = [
            SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGVTALRM,
            SIGXCPU,
        ];
        match ignored() {
            Some(mask) => ALL
                .into_iter()
                .filter(|signal| mask >> (signal - 1) & 1 == 0)
                .collect(),
            None => vec![SIGINT, SIGTERM],
        }
    }

    /// The signals that this process ignores, as Linux reports them: bit n - 1 stands for signal n.
    fn ignored() -> Option<u64> {
        let status = fs::read_to_string("/proc/self/status").ok()?;
        let mask = status
            .lines()
            .find_map(|line| line.strip_prefix("SigIgn:"))?;
        u64::from_str_radix(mask.trim(), 16).ok()
    }

    /// A worker may write while its folder is removed, so this tries a few times.
    fn remove() {
        for folder in super::folders().iter() {
            for _ in 0..20 {
                let _ = fs::remove_dir_all(folder);
                if !folder.exists() {
                    break;
                }
                sleep(Duration::from_millis(5));
            }
        }
    }
}

#[cfg(not(unix))]
mod signals {
    /// Other systems end a process without notice. The next run removes its folder.
    pub fn listen() {}
}

/// The folders of tools that belong to this program: `tools` beside it and, where Cargo has built it, `tools` in the target
/// folder, where `tests/run` puts what it fetches.
pub fn beside() -> Vec<PathBuf> {
    let program = current_exe().unwrap_or_default();
    let Some(folder) = program.parent().filter(|folder| folder.is_absolute()) else {
        return Vec::new();
    };
    // Cargo keeps its own notes beside a program, and one folder above a test.
    let mut above = folder.ancestors().take(2);
    let built = above.find(|folder| folder.join(".fingerprint").is_dir());
    let target = built.and_then(Path::parent);
    let places = [Some(folder), target].into_iter().flatten();
    places.map(|place| place.join("tools")).collect()
}

/// The variable that says where temporary files go.
pub const TEMPORARY: &str = if cfg!(windows) { "TMP" } else { "TMPDIR" };

/// Why the processes of a run cannot be started.
#[derive(Debug, Error)]
pub enum Error {
    /// The system cannot start a process.
    #[error("not checked: this program cannot start a process of its own to run shaders in: {0}")]
    Start(io::Error),
    /// Temporary files cannot be written.
    #[error(
        "not checked: temporary files cannot be written in {}: {why}; create this folder, make room in it, or set {TEMPORARY} to another",
        crate::physics::foreign::path(place)
    )]
    Temporary {
        /// The folder for temporary files.
        place: PathBuf,
        /// The system's reason.
        why: String,
    },
    /// The user's folder of tools cannot be used.
    #[error(
        "--tools {}: {why}; name a folder that holds compilers",
        crate::physics::foreign::path(folder)
    )]
    Tools {
        /// The folder as it was named.
        folder: PathBuf,
        /// What is wrong with it.
        why: String,
    },
}

impl Error {
    /// Whether the machine lacks something. Otherwise the user's flags are at fault.
    pub fn is_lacking(&self) -> bool {
        !matches!(self, Error::Tools { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::SystemTime;

    #[test]
    fn only_folders_that_a_run_left_are_removed() {
        let place = TempDir::new().unwrap();
        let folder = |name: &str| {
            let path = place.path().join(name);
            fs::create_dir(&path).unwrap();
            path
        };
        let left = folder(&format!("{PREFIX}left"));
        drop(locked(&left).unwrap());
        fs::create_dir(left.join("inner")).unwrap();
        let busy = folder(&format!("{PREFIX}busy"));
        let lock = locked(&busy).unwrap();
        let new = folder(&format!("{PREFIX}new"));
        fs::write(new.join(UNLOCKED), "").unwrap();
        let strange = folder("strange");
        fs::write(strange.join(LOCK), ABOUT).unwrap();
        let foreign = folder(&format!("{PREFIX}foreign"));
        fs::write(foreign.join(LOCK), "").unwrap();
        sweep(place.path());
        assert!(!left.exists());
        assert!(busy.exists() && new.exists() && strange.exists() && foreign.exists());
        drop(lock);
        let bare = folder(&format!("{PREFIX}bare"));
        sweep(place.path());
        assert!(!busy.exists() && bare.exists());
        let old = SystemTime::now() - Duration::from_secs(7200);
        for folder in [&bare, &new] {
            File::open(folder).unwrap().set_modified(old).unwrap();
        }
        sweep(place.path());
        assert!(!bare.exists() && new.exists());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_left_alone() {
        let (place, elsewhere) = (TempDir::new().unwrap(), TempDir::new().unwrap());
        drop(locked(elsewhere.path()).unwrap());
        let link = place.path().join(format!("{PREFIX}link"));
        std::os::unix::fs::symlink(elsewhere.path(), &link).unwrap();
        sweep(place.path());
        assert!(link.exists() && elsewhere.path().join(LOCK).exists());
    }

    #[test]
    fn tools_of_a_build_lie_beside_its_profiles() {
        let target = current_exe().unwrap();
        let target = target.ancestors().nth(3).unwrap();
        assert!(beside().contains(&target.join("tools")));
    }
}
