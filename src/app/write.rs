//! The only writer. Every file is first staged beside its destination, under a name that the folder's lock lists. When
//! all are staged, a manifest that lists old and new files is put in place, then the files, then orphans are removed, then
//! the manifest that stays is put in place. Until the first of these steps a failure changes nothing. A run killed at any
//! moment leaves each file either old or new and listed, and running it again ends its work.
//!
//! What is not proved to be this program's own is never replaced or removed: [`ours`](super::ours).
//! Nothing is forced to the disk's platter: after a power cut, run again.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use super::error::Error;
use super::folder;
use super::lock::{Lock, create_held};
use super::manifest::{self, Entry};
use super::ours::{bears_mark, is_listed};
use super::tree::{Obstacle, Planned, State, TreePlan};

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

/// Brings the folder to the state of the plan. Files that are right already are not touched. With `overwrite` files of
/// others are replaced where they lie in the place of one of the plan's.
///
/// # Errors
/// A file of others lies where one is to be written, a folder of the tree is a link, or the disk refuses.
pub fn write(plan: &TreePlan, overwrite: bool, lock: &mut Lock) -> Result<Written, Error> {
    if let Some((link, leads_to)) = &plan.linked {
        return Err(Error::Linked {
            link: link.clone(),
            leads_to: leads_to.clone(),
        });
    }
    if let (Some(obstacle), false) = (plan.obstacles.first(), overwrite) {
        return Err(not_ours(&plan.out_dir, obstacle, plan.obstacles.len() - 1));
    }
    let pending: Vec<&Planned> = (plan.files.iter())
        .filter(|file| file.state() != State::Unchanged)
        .collect();
    let has_interim = !pending.is_empty() || !plan.orphans.is_empty();
    let is_new = plan.manifest.state() != State::Unchanged || has_interim;
    let mut files: Vec<(PathBuf, &[u8])> = pending
        .iter()
        .map(|file| (plan.out_dir.join(&file.path), file.new.as_slice()))
        .collect();
    let manifest = plan.out_dir.join(manifest::FILE);
    if has_interim {
        files.push((manifest.clone(), &plan.interim));
    }
    if is_new {
        files.push((manifest, &plan.manifest.new));
    }
    let mut staged = stage_all(&files, Some((&plan.out_dir, lock)))?;
    let last = if is_new { staged.pop() } else { None };
    let interim = if has_interim { staged.pop() } else { None };
    let all = pending.len() + usize::from(is_new);
    replace_all(interim, 0, all)?;
    replace_all(staged, 0, all)?;
    // Before the last manifest: of a run that is killed here, the one on disk still lists the orphans.
    let mut removed = 0;
    for orphan in &plan.orphans {
        removed += usize::from(remove(&plan.out_dir, orphan)?);
    }
    for name in lock.leftovers() {
        remove_leftover(&plan.out_dir, name);
    }
    lock.forget_leftovers();
    replace_all(last, pending.len(), all)?;
    let written = pending.len() + usize::from(plan.manifest.state() != State::Unchanged);
    Ok(Written {
        written,
        removed,
        unchanged: plan.all().count() - written,
    })
}

/// Refuses these places of a report where files lie that do not bear our mark.
///
/// # Errors
/// One does.
pub fn try_places_of_ours(files: &[PathBuf], overwrite: bool) -> Result<(), Error> {
    for path in files.iter().filter(|_| !overwrite) {
        let link = fs::read_link(path).ok();
        if link.is_some() || folder::read(path)?.is_some_and(|bytes| !bears_mark(&bytes)) {
            return Err(Error::NotOurs {
                path: path.clone(),
                what: of_others(link.as_deref()),
            });
        }
    }
    Ok(())
}

/// Writes the files of a report into a folder, each whole or not at all. They replace only what bears our mark. Which were
/// replaced: no manifest tells whether somebody changed them since.
///
/// # Errors
/// A file of others lies in the place of one, or the disk refuses.
pub fn write_report(files: &[(PathBuf, &[u8])], overwrite: bool) -> Result<Vec<PathBuf>, Error> {
    let (mut replaced, mut pending) = (Vec::new(), Vec::new());
    for (path, bytes) in files {
        let old = folder::read(path)?;
        if old.as_deref() == Some(*bytes) {
            continue;
        }
        if old.is_some() || fs::read_link(path).is_ok() {
            try_places_of_ours(std::slice::from_ref(path), overwrite)?;
            replaced.push(path.clone());
        }
        pending.push((path.clone(), *bytes));
    }
    // Not through links: what lies behind one is not the report's.
    let count = pending.len();
    replace_all(stage_all(&pending, None)?, 0, count)?;
    Ok(replaced)
}

/// What lies in the place of an output.
fn of_others(leads_to: Option<&Path>) -> String {
    match leads_to {
        Some(leads_to) => format!("a link to {} lies there", crate::foreign::path(&leads_to)),
        None => "a file that fresnel-gen did not write lies there".to_owned(),
    }
}

fn not_ours(out_dir: &Path, obstacle: &Obstacle, others: usize) -> Error {
    let mut what = of_others(obstacle.leads_to.as_deref());
    if others > 0 {
        what += &format!(", and {others} more in other places");
    }
    Error::NotOurs {
        path: out_dir.join(&obstacle.path),
        what,
    }
}

/// Writes a single file whole or not at all, with the folders above it. False: it was right already.
/// A link is followed; a device or pipe (`/dev/null`) is written to, because renaming would destroy it.
///
/// # Errors
/// A folder stands in the file's place, or the disk refuses. The old file is then as it was.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<bool, Error> {
    Ok(write_files(&[(path.to_path_buf(), bytes)])? == 1)
}

/// Writes files, each whole or not at all, with the folders above them; a fault before all are staged changes nothing.
/// How many were written: the others were right already. Links are followed, and devices are written to.
///
/// # Errors
/// A folder stands in a file's place, or the disk refuses.
pub fn write_files(files: &[(PathBuf, &[u8])]) -> Result<usize, Error> {
    let (mut pending, mut devices) = (Vec::new(), Vec::new());
    for (path, bytes) in files {
        if folder::is_device(path) {
            devices.push((path, *bytes));
        } else {
            pending.extend(destination(path, bytes)?.map(|path| (path, *bytes)));
        }
    }
    replace_all(stage_all(&pending, None)?, 0, pending.len())?;
    for (path, bytes) in &devices {
        fs::write(path, bytes).map_err(|source| stage_fault(path, source))?;
    }
    Ok(pending.len() + devices.len())
}

/// Whether a file can be written there, found out by doing it and taking it back: before work that takes long.
///
/// # Errors
/// It cannot be.
pub fn try_file(path: &Path) -> Result<(), Error> {
    if folder::is_device(path) {
        return Ok(());
    }
    // No file of ours holds this alone.
    let Some(place) = destination(path, &[0])? else {
        return Ok(());
    };
    let mut created = Vec::new();
    let temporary = folder::temporary_of(&place);
    let tried = stage(&place, &[], &temporary, false, &mut created).map(drop);
    for folder in created.iter().rev() {
        let _ = fs::remove_dir(folder);
    }
    tried.map_err(|source| stage_fault(path, source))
}

/// Where these bytes go; nowhere where they are already.
fn destination(path: &Path, bytes: &[u8]) -> Result<Option<PathBuf>, Error> {
    let fault = |source| stage_fault(path, source);
    let not_a_file = || Error::NotAFile {
        path: path.to_path_buf(),
    };
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => Err(not_a_file()),
        Ok(_) if folder::read(path)?.as_deref() == Some(bytes) => Ok(None),
        Ok(_) => fs::canonicalize(path).map(Some).map_err(fault),
        Err(missing) if missing.kind() == ErrorKind::NotFound => {
            match folder::dangling_link(path) {
                // The link stays, and what it leads to is made.
                Some(leads_to) if leads_to.parent().is_some_and(Path::is_dir) => Ok(Some(leads_to)),
                Some(_) => Err(fault(missing)),
                None if folder::is_named_as_folder(path) => Err(not_a_file()),
                None => Ok(Some(path.to_path_buf())),
            }
        }
        Err(other) => Err(fault(other)),
    }
}

/// A file ready to be renamed into place; deleted when dropped before.
struct Staged {
    temporary: TempPath,
    destination: PathBuf,
    /// The lock on the temporary file, held until it is renamed or removed.
    _held: Option<File>,
}

/// Stages files. In a folder with a lock their temporary names are written down before they are made.
fn stage_all(
    pending: &[(PathBuf, &[u8])],
    locked: Option<(&Path, &mut Lock)>,
) -> Result<Vec<Staged>, Error> {
    let is_tree = locked.is_some();
    let name = |(path, _): &(PathBuf, &[u8])| match is_tree {
        true => folder::temporary_name(),
        false => folder::temporary_of(path),
    };
    let names: Vec<String> = pending.iter().map(name).collect();
    if let (Some((out_dir, lock)), Some((first, _))) = (locked, pending.first()) {
        let beside = |(path, name): (&PathBuf, &String)| {
            let inside = path.with_file_name(name);
            let inside = inside.strip_prefix(out_dir).unwrap_or(&inside);
            let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
            parts.join("/")
        };
        let paths = pending.iter().map(|(path, _)| path);
        let beside: Vec<String> = paths.zip(&names).map(beside).collect();
        lock.write_down(&beside)
            .map_err(|source| stage_fault(first, source))?;
    }
    let mut created = Vec::new();
    let staged: Result<Vec<Staged>, Error> = pending
        .iter()
        .zip(&names)
        .map(|((path, bytes), name)| {
            stage(path, bytes, name, is_tree, &mut created)
                .map_err(|source| stage_fault(path, source))
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

/// Writes one temporary file. In a tree the folder's lock holds; elsewhere the file's own, where there can be one.
fn stage(
    path: &Path,
    bytes: &[u8],
    name: &str,
    is_tree: bool,
    created: &mut Vec<PathBuf>,
) -> io::Result<Staged> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    create_folder(folder, created)?;
    let mut temporary = folder.join(name);
    let held = if is_tree {
        None
    } else {
        create_held(&temporary).ok()
    };
    if held.is_none() && !is_tree {
        temporary = folder.join(folder::temporary_name());
    }
    let mut file = match held {
        Some(file) => file,
        None => OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&temporary)?,
    };
    // From here on it is deleted when dropped.
    let temporary = TempPath::try_from_path(temporary)?;
    // Who may read a file is its owner's choice: a new version keeps it, where the file system can.
    if let Some(old) = fs::symlink_metadata(path)
        .ok()
        .filter(fs::Metadata::is_file)
    {
        let _ = file.set_permissions(old.permissions());
    }
    file.write_all(bytes)?;
    file.flush()?;
    Ok(Staged {
        temporary,
        destination: path.to_path_buf(),
        // A tree has more files than some systems let a process open.
        _held: (!is_tree).then_some(file),
    })
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

/// Removes an orphan and the folders that it leaves empty. False: it is gone, or no longer what the manifest lists.
fn remove(out_dir: &Path, orphan: &Entry) -> Result<bool, Error> {
    let path = out_dir.join(&orphan.file);
    let is_listed = |bytes: Vec<u8>| is_listed(orphan, &bytes);
    if !folder::is_plain_file(&path) || !folder::read(&path)?.is_some_and(is_listed) {
        return Ok(false);
    }
    fs::remove_file(&path).map_err(|source| Error::Remove {
        path: path.clone(),
        source,
    })?;
    remove_empty_folders(out_dir, &path);
    Ok(true)
}

/// Removes a temporary file that a killed run left behind, with the folders that it leaves empty. If it cannot be, nothing is lost.
fn remove_leftover(out_dir: &Path, name: &str) {
    let path = out_dir.join(name);
    if folder::is_plain_file(&path) && folder::linked_folder(out_dir, name).is_none() {
        let _ = fs::remove_file(&path);
    }
    remove_empty_folders(out_dir, &path);
}

/// Removes the folders above a path, up to the output folder, as far as they are empty.
fn remove_empty_folders(out_dir: &Path, path: &Path) {
    let above = path.ancestors().skip(1);
    for folder in above.take_while(|folder| *folder != out_dir) {
        if fs::remove_dir(folder).is_err() {
            break;
        }
    }
}

fn stage_fault(path: &Path, source: io::Error) -> Error {
    Error::Stage {
        path: path.to_path_buf(),
        source,
    }
}
