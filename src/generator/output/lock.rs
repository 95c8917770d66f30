//! The lock on an output folder: runs that write to one folder do so one after the other.
//!
//! The lock is held on the file [`FILE`] in the folder. The system releases it when a run ends or is killed. During a run, the
//! file lists the run's temporary files. Their names are written down before they are made, so that the next run can find and
//! remove what a killed run left behind. A run that ends removes the file itself. Nobody renames it.
//!
//! A file that the user names has no such folder. Its temporary file, which has a new name in every run, is locked instead. No
//! run waits for that lock. It only tells the next run of that output that the first one is alive: temporary files that are not
//! locked are removed.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use crate::generator::output::folder::{
    check_path, is_plain_file, is_temporary, planted, temporaries_beside,
};

/// The lock's file in the output folder.
pub const FILE: &str = ".fresnel-gen.lock";

/// A run waits this many turns of this many milliseconds before it says that it waits.
const SILENT_TURNS: u64 = 20;
const TURN_MS: u64 = 50;
/// The longest wait, in seconds.
const MOST_WAIT_S: u64 = 120;

/// How often a waiting run may find that the lock's file was replaced, and begin again. Without a limit, a file system whose
/// inode numbers change would hold it for ever.
const TAKING_TURNS: u32 = 1000;

/// Receives messages for the user during a run.
pub type Announce<'a> = &'a dyn Fn(&str);

/// A held lock, or none where the folder cannot have one.
#[derive(Debug)]
pub struct Lock {
    file: Option<File>,
    path: PathBuf,
    /// Temporary files that a killed run left behind, relative to the folder.
    leftovers: Vec<String>,
    /// Folders that were made for the lock, outermost first.
    created: Vec<PathBuf>,
    /// Whether somebody else held it during the longest wait.
    pub is_busy: bool,
}

impl Lock {
    /// Waits until no other run holds the folder's lock, and takes it. A missing folder is made.
    ///
    /// Where the lock's file cannot be made, as in a read-only folder, no lock is held: a run that has nothing to write needs
    /// none, and one that has something to write fails then. Where the file system has no locks, the run goes on without one and
    /// `announce` is told.
    pub fn take(out_dir: &Path, announce: Announce) -> Lock {
        let mut lock = Lock {
            file: None,
            path: out_dir.join(FILE),
            leftovers: Vec::new(),
            created: Vec::new(),
            is_busy: false,
        };
        // The write that follows will be refused.
        if planted(out_dir).is_some() {
            return lock;
        }
        for _ in 0..TAKING_TURNS {
            lock.create_folders(out_dir);
            if is_foreign(&lock.path) {
                announce(&without(&lock.path, "is not a lock of fresnel-gen"));
                return lock;
            }
            let mut file = match open(&lock.path) {
                Ok(file) => file,
                // Another run made it, or somebody put a link there: try again.
                Err(why) if why.kind() == ErrorKind::AlreadyExists => continue,
                Err(why) => {
                    // If nothing lies there, the folder is read-only.
                    if is_plain_file(&lock.path) {
                        announce(&without(&lock.path, &format!("cannot be opened ({why})")));
                    }
                    return lock;
                }
            };
            match wait(&file, &lock.path, announce) {
                Err(why) => {
                    drop(file);
                    announce(&format!(
                        "{}: the file system has no locks ({why}); let no other run write there meanwhile",
                        crate::physics::foreign::path(&out_dir)
                    ));
                    let _ = fs::remove_file(&lock.path);
                    return lock;
                }
                Ok(false) => {
                    let why = format!("is held for more than {MOST_WAIT_S} s");
                    announce(&without(&lock.path, &why));
                    lock.is_busy = true;
                    return lock;
                }
                // The previous run removed the file while this one waited for it, or somebody replaced it.
                Ok(true) if !is_at(&file, &lock.path) => continue,
                Ok(true) => {
                    lock.leftovers = listed(&mut file);
                    lock.file = Some(file);
                    return lock;
                }
            }
        }
        announce(&without(&lock.path, "is another file at every look"));
        lock
    }

    /// Writes down which temporary files are about to be made. Does nothing if no lock is held.
    ///
    /// # Errors
    /// Writing fails, for example because the disk is full.
    pub fn write_down(&mut self, temporaries: &[String]) -> io::Result<()> {
        let Some(file) = &mut self.file else {
            return Ok(());
        };
        let lines: String = (self.leftovers.iter().chain(temporaries))
            .map(|name| format!("{name}\n"))
            .collect();
        // Truncated after the write, not before, so that a run killed between the two leaves no empty list.
        file.seek(SeekFrom::Start(0))?;
        file.write_all(lines.as_bytes())?;
        file.set_len(lines.len() as u64)
    }

    /// Temporary files that a killed run left behind, relative to the folder.
    pub fn leftovers(&self) -> &[String] {
        &self.leftovers
    }

    /// Forgets the leftovers, once they are removed.
    pub fn forget_leftovers(&mut self) {
        self.leftovers.clear();
    }

    fn create_folders(&mut self, out_dir: &Path) {
        let missing = out_dir.ancestors().take_while(|folder| {
            !folder.as_os_str().is_empty() && fs::symlink_metadata(folder).is_err()
        });
        let missing: Vec<PathBuf> = missing.map(Path::to_path_buf).collect();
        for folder in missing.into_iter().rev() {
            if fs::create_dir(&folder).is_ok() {
                self.created.push(folder);
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // A run that failed removed its own temporary files, but not those of the previous run.
        let is_clean = self.leftovers.is_empty() || self.write_down(&[]).is_err();
        if let (Some(file), true) = (&mut self.file, is_clean) {
            // Other systems cannot remove a file that another run has open: it stays, and lists nothing.
            if cfg!(unix) {
                let _ = fs::remove_file(&self.path);
            } else {
                let _ = file.set_len(0);
            }
        }
        // A run that wrote nothing leaves no folder. Folders that are not empty stay.
        for folder in self.created.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Opens the lock's file, or makes it. A dangling link makes no file elsewhere.
fn open(path: &Path) -> io::Result<File> {
    let mut way = OpenOptions::new();
    way.read(true).write(true);
    match way.open(path) {
        Err(missing) if missing.kind() == ErrorKind::NotFound => way.create_new(true).open(path),
        opened => opened,
    }
}

/// The message of a run that goes on without a lock.
fn without(path: &Path, why: &str) -> String {
    format!(
        "{} {why}; fresnel-gen goes on without a lock: let no other run write there meanwhile",
        crate::physics::foreign::path(path)
    )
}

/// Makes a temporary file, and locks it where the file system has locks.
///
/// # Errors
/// Something lies there (`AlreadyExists`), another run is checking it at this moment (`WouldBlock`), or the disk refuses.
pub fn create_held(temporary: &Path) -> io::Result<File> {
    let file = OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(temporary)?;
    match file.try_lock() {
        // Another run took it for a leftover before it was locked, and is removing it.
        Err(TryLockError::WouldBlock) => Err(ErrorKind::WouldBlock.into()),
        Ok(()) if !is_at(&file, temporary) => Err(ErrorKind::WouldBlock.into()),
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// Removes the temporary files of an output that killed runs left behind. Files that another run has locked, that another user
/// owns, or that are not ordinary files stay. Where the file system has no locks, all stay.
pub fn remove_leftovers_of(output: &Path) {
    for left in temporaries_beside(output) {
        let open = || OpenOptions::new().read(true).write(true).open(&left);
        if !is_plain_file(&left) {
            continue;
        }
        let Ok(file) = open() else { continue };
        if file.try_lock().is_ok() && is_at(&file, &left) {
            let _ = fs::remove_file(&left);
        }
    }
}

/// Waits for the lock, and says so when that takes longer than a second. False: it was held longer than any run of ours can take.
/// A run holds it while it writes, but anybody who may open the file can hold it for ever.
fn wait(file: &File, path: &Path, announce: Announce) -> io::Result<bool> {
    for turn in 0..MOST_WAIT_S * 1000 / TURN_MS {
        match file.try_lock() {
            Ok(()) => return Ok(true),
            Err(TryLockError::WouldBlock) => thread::sleep(Duration::from_millis(TURN_MS)),
            Err(TryLockError::Error(why)) => return Err(why),
        }
        if turn == SILENT_TURNS {
            let folder = crate::physics::foreign::path(&path.parent().unwrap_or(path));
            announce(&format!(
                "{folder}: another run writes there; waiting for it to end"
            ));
        }
    }
    Ok(false)
}

/// Whether the open file is still the one at this path.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |found: fs::Metadata| (found.dev(), found.ino());
    let (held, there) = (file.metadata(), fs::symlink_metadata(path));
    match (held, there) {
        (Ok(held), Ok(there)) => identity(held) == identity(there),
        _ => false,
    }
}

/// Other systems never remove the file.
#[cfg(not(unix))]
fn is_at(_file: &File, _path: &Path) -> bool {
    true
}

fn listed(file: &mut File) -> Vec<String> {
    let mut text = String::new();
    let read = file.read_to_string(&mut text);
    match read {
        Ok(_) => text.lines().map(str::to_owned).collect(),
        Err(_) => Vec::new(),
    }
}

/// Whether something else lies in the lock's place: a link, a folder, a pipe, or a file that lists names which are not those of
/// temporary files.
fn is_foreign(path: &Path) -> bool {
    /// A list of twenty thousand names is shorter, and a tree has far fewer files.
    const MOST_BYTES: u64 = 2 << 20;
    let Ok(found) = fs::symlink_metadata(path) else {
        return false;
    };
    let is_ours = |line: &str| is_temporary(line) && check_path(line).is_ok();
    let is_list =
        |bytes: Vec<u8>| std::str::from_utf8(&bytes).is_ok_and(|text| text.lines().all(is_ours));
    !found.is_file()
        || has_other_names(&found)
        || found.len() > MOST_BYTES
        || fs::read(path).is_ok_and(|bytes| !is_list(bytes))
}

/// Whether a file has other hard links, through which a write would change it elsewhere.
#[cfg(unix)]
fn has_other_names(found: &fs::Metadata) -> bool {
    std::os::unix::fs::MetadataExt::nlink(found) > 1
}

/// Other systems do not tell.
#[cfg(not(unix))]
fn has_other_names(_found: &fs::Metadata) -> bool {
    false
}
