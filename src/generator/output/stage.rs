//! Staged files: written whole beside their places, and not yet renamed. In a tree, the folder's lock lists their temporary names
//! before they are made. Elsewhere each one is locked itself. A staged file that is dropped before it is renamed leaves nothing
//! behind.
//!
//! This file also holds what a run expects in a file's place when it renames its own into it. Between the look at a folder and
//! the renaming, somebody else may make or change a file there. That file stays.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use crate::generator::error::Error;
use crate::generator::output::folder::{self, folder_of};
use crate::generator::output::lock::{Lock, create_held, remove_leftovers_of};
use crate::generator::output::ownership::bears_mark;
use crate::physics::digest::sha256;

/// A file to be staged.
pub struct Pending<'a> {
    /// Its place.
    pub path: PathBuf,
    /// What it will hold.
    pub bytes: &'a [u8],
    /// What may lie there when the file is renamed.
    pub expected: ExpectedContent,
}

/// A file ready to be renamed. It is deleted when dropped before.
struct Staged {
    temporary: TempPath,
    destination: PathBuf,
    expected: ExpectedContent,
    /// The lock on the temporary file, held until that is renamed or removed.
    _held: Option<File>,
}

/// Files ready to be renamed, and the folders that were made for them.
#[derive(Default)]
pub struct StagedFiles {
    files: Vec<Staged>,
    created: Vec<PathBuf>,
}

impl StagedFiles {
    /// Stages files of a tree, under names that the folder's lock lists.
    ///
    /// # Errors
    /// The disk refuses one: then none is staged.
    pub fn in_tree(
        pending: &[Pending],
        out_dir: &Path,
        lock: &mut Lock,
    ) -> Result<StagedFiles, Error> {
        let beside = |one: &Pending| one.path.with_file_name(folder::temporary_name());
        let temporaries: Vec<PathBuf> = pending.iter().map(beside).collect();
        if let Some(Pending { path: first, .. }) = pending.first() {
            let listed: Vec<String> = temporaries
                .iter()
                .map(|path| inner(out_dir, path))
                .collect();
            lock.write_down(&listed)
                .map_err(|source| stage_fault(first, source))?;
        }
        let mut temporaries = temporaries.into_iter();
        Self::new(pending, |_| {
            let temporary = temporaries.next().expect("there is one for each file");
            let new = OpenOptions::new()
                .write(true)
                .create_new(true)
                .open(&temporary)?;
            // A tree has more files than some systems let a process open: they are closed, and the folder's lock protects them.
            Ok((temporary, new, false))
        })
    }

    /// Stages files that the user names. Each temporary file is locked itself.
    ///
    /// # Errors
    /// The disk refuses one: then none is staged.
    pub fn beside_outputs(pending: &[Pending]) -> Result<StagedFiles, Error> {
        Self::new(pending, |path| {
            remove_leftovers_of(path);
            let (temporary, new) = create_beside(path)?;
            Ok((temporary, new, true))
        })
    }

    /// Stages files in temporary ones that `create` makes. `create` also says whether they stay open.
    fn new(
        pending: &[Pending],
        mut create: impl FnMut(&Path) -> io::Result<(PathBuf, File, bool)>,
    ) -> Result<StagedFiles, Error> {
        let mut all = StagedFiles::default();
        for one in pending {
            let path = &one.path;
            let mut stage = || {
                create_folder(folder_of(path), &mut all.created)?;
                let (temporary, file, is_held) = create(path)?;
                filled(temporary, file, is_held, one)
            };
            let staged = stage().map_err(|source| stage_fault(path, source))?;
            all.files.push(staged);
        }
        Ok(all)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.files.len()
    }

    /// Splits off the last file, if that is wanted.
    pub fn split_last(&mut self, is_wanted: bool) -> StagedFiles {
        let last = if is_wanted { self.files.pop() } else { None };
        StagedFiles {
            files: last.into_iter().collect(),
            created: Vec::new(),
        }
    }

    /// Refuses places that are folders by now. One output of a run can lie above another (`-o a.wgsl --depfile a.wgsl/b.d`), and
    /// its folder is made when it is staged. Call this when all are staged and none is renamed.
    ///
    /// # Errors
    /// A place is a folder.
    pub fn refuse_folders(&self) -> Result<(), Error> {
        match self.files.iter().find(|file| file.destination.is_dir()) {
            Some(file) => Err(Error::NotAFile {
                path: file.destination.clone(),
            }),
            None => Ok(()),
        }
    }

    /// Refuses places that were empty when the run looked and are taken by now. Call this before the first file is renamed.
    ///
    /// # Errors
    /// A place is taken.
    pub fn refuse_taken(&self) -> Result<(), Error> {
        let is_taken = |file: &&Staged| !file.expected.allows(&file.destination);
        match self.files.iter().find(is_taken) {
            Some(file) => Err(Error::NotOurs {
                path: file.destination.clone(),
                what: "what lies there appeared or changed while this run wrote, or cannot be read"
                    .to_owned(),
            }),
            None => Ok(()),
        }
    }

    /// Renames all into place. The numbers are for the message: how many were replaced before, and how many there are in all.
    ///
    /// # Errors
    /// The system refuses one, or something has appeared in its place. The files before it are then in place.
    pub fn replace(mut self, before: usize, pending: usize) -> Result<(), Error> {
        for (index, file) in self.files.drain(..).enumerate() {
            let (path, replaced) = (file.destination, before + index);
            match put(file.temporary, &path, &file.expected) {
                Ok(true) => {}
                Ok(false) => {
                    return Err(Error::Taken {
                        path,
                        replaced,
                        pending,
                    });
                }
                Err(source) => {
                    return Err(Error::Replace {
                        path,
                        source,
                        replaced,
                        pending,
                    });
                }
            }
        }
        Ok(())
    }
}

impl Drop for StagedFiles {
    fn drop(&mut self) {
        self.files.clear();
        // Where nothing was put in place they are empty. The system refuses to remove others.
        for folder in self.created.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// A path of a tree as the lock lists it.
fn inner(out_dir: &Path, path: &Path) -> String {
    let inside = path.strip_prefix(out_dir).unwrap_or(path);
    let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

/// Makes a temporary file beside an output, and locks it where the file system has locks.
fn create_beside(path: &Path) -> io::Result<(PathBuf, File)> {
    /// Names are random. One that is taken, or that another run is checking at this moment, is given up.
    const TRIES: usize = 16;
    let create = || {
        let temporary = folder_of(path).join(folder::temporary_of(path));
        Ok((temporary.clone(), create_held(&temporary)?))
    };
    let is_taken = |made: &io::Result<_>| {
        let kind = made.as_ref().err().map(io::Error::kind);
        matches!(kind, Some(ErrorKind::AlreadyExists | ErrorKind::WouldBlock))
    };
    let mut made = create();
    for _ in 1..TRIES {
        if is_taken(&made) {
            made = create();
        }
    }
    made
}

/// A temporary file that holds the given bytes.
fn filled(
    temporary: PathBuf,
    mut file: File,
    is_held: bool,
    pending: &Pending,
) -> io::Result<Staged> {
    let path = &pending.path;
    // From here on the file is deleted when dropped.
    let temporary = TempPath::try_from_path(temporary)?;
    // The owner chose who may read a file: a new version keeps the permissions, where the file system can.
    if let Some(old) = fs::symlink_metadata(path)
        .ok()
        .filter(fs::Metadata::is_file)
    {
        let _ = file.set_permissions(old.permissions());
    }
    file.write_all(pending.bytes)?;
    file.flush()?;
    Ok(Staged {
        temporary,
        destination: path.clone(),
        expected: pending.expected.clone(),
        _held: is_held.then_some(file),
    })
}

/// Creates a folder and those above it, and notes each one that it made.
fn create_folder(folder: &Path, created: &mut Vec<PathBuf>) -> io::Result<()> {
    if folder.as_os_str().is_empty() || folder.is_dir() {
        return Ok(());
    }
    if let Some(parent) = folder.parent() {
        create_folder(parent, created)?;
    }
    match fs::create_dir(folder) {
        Ok(()) => created.push(folder.to_path_buf()),
        // Made by somebody else in the meantime.
        Err(_) if folder.is_dir() => {}
        Err(fault) => return Err(fault),
    }
    Ok(())
}

/// The error of a file that cannot be prepared.
pub fn stage_fault(path: &Path, source: io::Error) -> Error {
    Error::Stage {
        path: path.to_path_buf(),
        source,
    }
}

/// What may lie in a place when a file is renamed into it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExpectedContent {
    /// Anything: the user named the file, or wants everything replaced.
    Anything,
    /// Nothing, or a file that bears this program's mark.
    Free,
    /// A file with this SHA-256, one that bears the mark, or nothing.
    Was(String),
}

impl ExpectedContent {
    /// What to expect where these bytes were seen, or nothing. With `overwrite`, anything may lie there.
    pub fn seen(old: Option<&[u8]>, overwrite: bool) -> ExpectedContent {
        match old {
            _ if overwrite => ExpectedContent::Anything,
            None => ExpectedContent::Free,
            Some(bytes) => ExpectedContent::Was(sha256(bytes)),
        }
    }

    /// Whether what lies there now may be replaced. A link or an unreadable file may not.
    pub fn allows(&self, place: &Path) -> bool {
        if *self == ExpectedContent::Anything || fs::symlink_metadata(place).is_err() {
            return true;
        }
        let Some(bytes) = folder::is_plain_file(place)
            .then(|| folder::read(place).ok().flatten())
            .flatten()
        else {
            return false;
        };
        bears_mark(&bytes) || matches!(self, ExpectedContent::Was(hash) if *hash == sha256(&bytes))
    }
}

/// Renames a file into its place. False: what lies there is not what was seen, and stays. Where nothing was seen, the system itself
/// refuses to replace what has appeared.
fn put(temporary: TempPath, place: &Path, expected: &ExpectedContent) -> io::Result<bool> {
    if !expected.allows(place) {
        return Ok(false);
    }
    let replaced = |temporary: TempPath| {
        let renamed = temporary.persist(place);
        renamed.map(|()| true).map_err(|fault| fault.error)
    };
    let is_free = *expected != ExpectedContent::Anything && fs::symlink_metadata(place).is_err();
    if !is_free {
        return replaced(temporary);
    }
    match temporary.persist_noclobber(place) {
        Ok(()) => Ok(true),
        Err(fault) if fault.error.kind() == ErrorKind::AlreadyExists => {
            if expected.allows(place) {
                replaced(fault.path)
            } else {
                Ok(false)
            }
        }
        // The file system can neither rename without replacing nor link: the check just before must do.
        Err(fault) if fs::symlink_metadata(place).is_err() => replaced(fault.path),
        Err(fault) => Err(fault.error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    const OURS: &str = "// @generated by fresnel-gen\n";

    /// Puts `new` in a place where `old` was seen, and `now` lies.
    #[track_caller]
    fn check(old: Option<&str>, now: Option<&str>, is_put: bool) {
        let dir = TempDir::new().expect("a folder");
        let [place, temporary] = ["place", "temporary"].map(|name| dir.path().join(name));
        fs::write(&temporary, "new").expect("a file");
        if let Some(now) = now {
            fs::write(&place, now).expect("a file");
        }
        let temporary = TempPath::try_from_path(temporary).expect("a path");
        let expected = ExpectedContent::seen(old.map(str::as_bytes), false);
        let placing = put(temporary, &place, &expected);
        assert_eq!(placing.expect("the disk takes it"), is_put);
        let left = fs::read_to_string(&place).expect("a file");
        assert_eq!(
            left,
            if is_put {
                "new"
            } else {
                now.unwrap_or_default()
            }
        );
        let count = fs::read_dir(dir.path()).expect("a folder").count();
        assert_eq!(count, 1, "nothing else is left");
    }

    #[test]
    fn what_appears_or_changes_stays() {
        check(None, None, true);
        check(None, Some("mine"), false);
        check(None, Some(OURS), true);
        check(Some("old"), Some("old"), true);
        check(Some("old"), None, true);
        check(Some("old"), Some("mine"), false);
        check(Some("old"), Some(OURS), true);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_appears_stays() {
        let dir = TempDir::new().expect("a folder");
        let place = dir.path().join("place");
        fs::write(dir.path().join("other"), OURS).expect("a file");
        std::os::unix::fs::symlink("other", &place).expect("a link");
        assert!(!ExpectedContent::Free.allows(&place));
        assert!(!ExpectedContent::seen(Some(OURS.as_bytes()), false).allows(&place));
        assert!(ExpectedContent::Anything.allows(&place));
    }
}
