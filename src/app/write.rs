//! The only writer. Every file is first staged beside its destination; only when all are staged
//! are they renamed into place, orphans removed, and the manifest renamed last. Until the first rename a failure
//! changes nothing. A run killed at any moment leaves each file either old or new, and running it again ends its work.
//!
//! Two runs at once in one folder are not provided for: the later manifest would lack the earlier entries.
//! Nothing is forced to the disk's platter: after a power cut, run again.

use std::fs;
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use super::error::Error;
use super::folder::{self, TEMPORARY_PREFIX, TEMPORARY_SUFFIX};
use super::manifest;
use super::tree::{Plan, State};

/// What a write did, in files, the manifest included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// Files that are new or differ from before.
    pub written: usize,
    /// Orphans removed.
    pub removed: usize,
    /// Files left as they were.
    pub unchanged: usize,
}

/// Brings the folder to the state of the plan. Files that are right already are not touched.
pub fn write(plan: &Plan) -> Result<Written, Error> {
    let pending = plan.all().filter(|file| file.state() != State::Unchanged);
    let pending: Vec<(PathBuf, &[u8])> = pending
        .map(|file| (plan.out_dir.join(&file.path), file.new.as_slice()))
        .collect();
    let mut staged = stage_all(&pending)?;
    let manifest = plan.out_dir.join(manifest::FILE);
    let manifest = staged.pop_if(|file| file.destination == manifest);
    replace_all(staged, 0, pending.len())?;
    // Before the manifest: of a run that is killed here, the old one still names the orphans, and the next run ends it.
    let mut orphans = plan.orphans.iter();
    let removed = orphans.try_for_each(|orphan| remove(&plan.out_dir, orphan));
    replace_all(manifest, pending.len().saturating_sub(1), pending.len())?;
    removed?;
    Ok(Written {
        written: pending.len(),
        removed: plan.orphans.len(),
        unchanged: plan.all().count() - pending.len(),
    })
}

/// Writes a single file whole or not at all, with the folders above it. False: it was right already.
/// A link is followed; a device or pipe (`/dev/null`) is written to, because renaming would destroy it.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<bool, Error> {
    if fs::metadata(path).is_ok_and(|found| !found.is_dir() && !found.is_file()) {
        let fault = |source| stage_fault(path, source);
        return fs::write(path, bytes).map(|()| true).map_err(fault);
    }
    Ok(write_files(&[(path.to_path_buf(), bytes)])? == 1)
}

/// Writes files, each whole or not at all, with the folders above them; a fault before all are staged changes nothing.
/// How many were written: the others were right already. Links are followed.
pub fn write_files(files: &[(PathBuf, &[u8])]) -> Result<usize, Error> {
    let mut pending = Vec::new();
    for (path, bytes) in files {
        pending.extend(destination(path, bytes)?.map(|path| (path, *bytes)));
    }
    replace_all(stage_all(&pending)?, 0, pending.len())?;
    Ok(pending.len())
}

/// Whether a file can be written there, found out by doing it and taking it back: before work that takes long.
///
/// # Errors
/// It cannot be.
pub fn try_file(path: &Path) -> Result<(), Error> {
    if fs::metadata(path).is_ok_and(|found| !found.is_dir() && !found.is_file()) {
        return Ok(());
    }
    // No file of ours holds this alone.
    let Some(place) = destination(path, &[0])? else {
        return Ok(());
    };
    let mut created = Vec::new();
    let tried = stage(&place, &[], &mut created).map(drop);
    for folder in created.iter().rev() {
        let _ = fs::remove_dir(folder);
    }
    tried.map_err(|source| stage_fault(path, source))
}

/// Whether two paths lead to one file, which the later of two outputs would replace. A device takes both.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    let is_device = fs::metadata(one).is_ok_and(|found| !found.is_dir() && !found.is_file());
    !is_device && resolved(one) == resolved(other)
}

/// A path without links, as far as it is there.
fn resolved(path: &Path) -> PathBuf {
    let (Some(parent), Some(name)) = (path.parent(), path.file_name()) else {
        return path.to_path_buf();
    };
    let above = match parent {
        parent if parent.as_os_str().is_empty() => fs::canonicalize("."),
        parent => fs::canonicalize(parent),
    };
    fs::canonicalize(path).unwrap_or_else(|_| match above {
        Ok(above) => above.join(name),
        Err(_) => resolved(parent).join(name),
    })
}

/// Where these bytes go; nowhere where they are already.
fn destination(path: &Path, bytes: &[u8]) -> Result<Option<PathBuf>, Error> {
    let fault = |source| stage_fault(path, source);
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => Err(Error::NotAFile {
            path: path.to_path_buf(),
        }),
        Ok(_) if folder::read(path)?.as_deref() == Some(bytes) => Ok(None),
        Ok(_) => fs::canonicalize(path).map(Some).map_err(fault),
        Err(missing) if missing.kind() == ErrorKind::NotFound => Ok(Some(path.to_path_buf())),
        Err(other) => Err(fault(other)),
    }
}

/// A file ready to be renamed into place; deleted when dropped before.
struct Staged {
    temporary: TempPath,
    destination: PathBuf,
}

fn stage_all(pending: &[(PathBuf, &[u8])]) -> Result<Vec<Staged>, Error> {
    let mut created = Vec::new();
    let staged: Result<Vec<Staged>, Error> = pending
        .iter()
        .map(|(path, bytes)| {
            stage(path, bytes, &mut created).map_err(|source| stage_fault(path, source))
        })
        .collect();
    if staged.is_err() {
        // The temporary files are gone by now, so that the folders made for them are empty.
        for folder in created.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
    staged
}

fn stage(path: &Path, bytes: &[u8], created: &mut Vec<PathBuf>) -> io::Result<Staged> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    create_folder(folder, created)?;
    let mut file = builder().tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.flush()?;
    Ok(Staged {
        // Without its handle: a tree has more files than some systems let a process open.
        temporary: file.into_temp_path(),
        destination: path.to_path_buf(),
    })
}

/// Temporary files are private by default; ours become the user's files and get what the umask leaves.
#[cfg(unix)]
fn builder() -> tempfile::Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = named_builder();
    builder.permissions(fs::Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn builder() -> tempfile::Builder<'static, 'static> {
    named_builder()
}

fn named_builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY_PREFIX).suffix(TEMPORARY_SUFFIX);
    builder
}

/// Creates a folder and those above it, and notes each that was not there.
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

/// Renames these into place; the numbers are for the message: how many were replaced before, how many there are in all.
fn replace_all(
    staged: impl IntoIterator<Item = Staged>,
    before: usize,
    pending: usize,
) -> Result<(), Error> {
    for (index, file) in staged.into_iter().enumerate() {
        let replaced = before + index;
        let path = file.destination;
        if let Err(fault) = file.temporary.persist(&path) {
            return Err(Error::Replace {
                path,
                source: fault.error,
                replaced,
                pending,
            });
        }
    }
    Ok(())
}

/// Removes a file, or a link but not what it points to, and the folders that it leaves empty.
fn remove(out_dir: &Path, orphan: &str) -> Result<(), Error> {
    let path = out_dir.join(orphan);
    match fs::remove_file(&path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            return Err(Error::Remove { path, source });
        }
        _ => {}
    }
    let above = path.ancestors().skip(1);
    for folder in above.take_while(|folder| *folder != out_dir) {
        if fs::remove_dir(folder).is_err() {
            break;
        }
    }
    Ok(())
}

fn stage_fault(path: &Path, source: io::Error) -> Error {
    Error::Stage {
        path: path.to_path_buf(),
        source,
    }
}
