//! Writes the files of a run. Nothing else changes the disk, except for the lock's file.
//!
//! Every file is first staged beside its destination (`stage.rs`). When all are staged, a manifest that lists old and new files
//! is put in place, then the files. Then orphans are removed, and the final manifest is put in place. A failure before the first
//! of these steps changes nothing. A run killed at any moment leaves each file either old or new and listed, and another run
//! completes its work.
//!
//! What is not proved to be this program's own is never replaced or removed: see [`ownership`](crate::generator::output::ownership).
//! Nothing is forced to the disk: after a power cut, run again.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::contents::{Planned, State};
use crate::generator::error::Error;
use crate::generator::output::folder;
use crate::generator::output::lock::Lock;
use crate::generator::output::ownership::{bears_mark, remove, remove_leftover};
use crate::generator::output::stage::{ExpectedContent, Pending, StagedFiles, stage_fault};
use crate::generator::output::tree::{Obstacle, TreePlan};

/// What a write did, in numbers of files, the manifest included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// Files that are new or differ from before.
    pub written: usize,
    /// Orphans removed.
    pub removed: usize,
    /// Files left as they were.
    pub unchanged: usize,
}

/// Brings the folder to the state of the plan, and writes files beside the tree: all of them, or none where the disk refuses.
/// Files that are already right are not touched. With `overwrite`, files of others in the places of the plan's are replaced.
///
/// # Errors
/// A file of others lies in a file's place, a folder of the tree is a link, or the disk refuses.
pub fn write(
    plan: &TreePlan,
    beside: &[OutputFile],
    overwrite: bool,
    lock: &mut Lock,
) -> Result<Written, Error> {
    refuse_others(plan, overwrite)?;
    let pending: Vec<&Planned> = (plan.files.iter())
        .filter(|file| file.state() != State::Unchanged)
        .collect();
    let has_interim = !pending.is_empty() || !plan.orphans.is_empty();
    let is_new = plan.manifest.state() != State::Unchanged || has_interim;
    let mut files: Vec<Pending> = pending
        .iter()
        .map(|file| staged_file(plan, file, &file.new, overwrite))
        .collect();
    if has_interim {
        files.push(staged_file(plan, &plan.manifest, &plan.interim, overwrite));
    }
    if is_new {
        let new = &plan.manifest.new;
        files.push(staged_file(plan, &plan.manifest, new, overwrite));
    }
    let beside = StagedOutputs::new(beside)?;
    let mut staged = StagedFiles::in_tree(&files, &plan.out_dir, lock)?;
    let last = staged.split_last(is_new);
    let interim = staged.split_last(has_interim);
    let own = pending.len() + usize::from(is_new);
    let all = own + beside.files.count();
    for files in [&interim, &staged, &last, &beside.files] {
        files.refuse_folders()?;
        files.refuse_taken()?;
    }
    beside.write_devices()?;
    interim.replace(0, all)?;
    staged.replace(0, all)?;
    // Done before the final manifest: if the run is killed here, or cannot remove an orphan, the manifest on disk still lists it.
    let removed: Result<usize, Error> = (plan.orphans.iter())
        .map(|orphan| remove(&plan.out_dir, orphan).map(usize::from))
        .sum();
    for name in lock.leftovers() {
        remove_leftover(&plan.out_dir, name);
    }
    lock.forget_leftovers();
    if removed.is_ok() {
        last.replace(pending.len(), all)?;
    }
    beside.files.replace(own, all)?;
    let written = pending.len() + usize::from(plan.manifest.state() != State::Unchanged);
    Ok(Written {
        written,
        removed: removed?,
        unchanged: plan.all().count() - written,
    })
}

/// A file of a tree with these bytes. Its place must be as the plan found it, unless everything is to be overwritten.
fn staged_file<'a>(
    plan: &TreePlan,
    file: &Planned,
    bytes: &'a [u8],
    overwrite: bool,
) -> Pending<'a> {
    Pending {
        path: plan.out_dir.join(&file.path),
        bytes,
        expected: ExpectedContent::seen(file.old.as_deref(), overwrite),
    }
}

/// Refuses a tree where files or links of others lie in the places of its files.
fn refuse_others(plan: &TreePlan, overwrite: bool) -> Result<(), Error> {
    refuse_planted(&plan.out_dir)?;
    if let Some((link, leads_to)) = &plan.linked {
        return Err(Error::Linked {
            link: link.clone(),
            leads_to: leads_to.clone(),
        });
    }
    match plan.obstacles.first() {
        Some(obstacle) if !overwrite => {
            Err(not_ours(&plan.out_dir, obstacle, plan.obstacles.len() - 1))
        }
        _ => Ok(()),
    }
}

/// Refuses a path that follows a link or ends in a pipe which another user may have put there.
fn refuse_planted(path: &Path) -> Result<(), Error> {
    match folder::planted(path) {
        Some(link) => Err(Error::Planted { link }),
        None => Ok(()),
    }
}

/// Refuses places of a report that hold files without our mark.
///
/// # Errors
/// A place holds such a file.
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

/// Describes what lies in the place of an output.
fn of_others(leads_to: Option<&Path>) -> String {
    match leads_to {
        Some(leads_to) => format!(
            "a link to {} lies there",
            crate::physics::foreign::path(&leads_to)
        ),
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

/// A file that a run writes outside a generated tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    path: PathBuf,
    bytes: Vec<u8>,
    place: OutputPlace,
}

/// The rule by which an output takes its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OutputPlace {
    /// The user named the file: it replaces whatever lies there. Links are followed. Devices are written to, because renaming
    /// would destroy them.
    Named,
    /// The user named the file, which is theirs once it exists: it is made, and replaces nothing.
    New,
    /// The user named the folder of a report: a file there replaces only what bears our mark, unless everything is to be
    /// overwritten. Links are not followed: what lies behind one is not the report's.
    OfReport { overwrite: bool },
}

impl OutputFile {
    fn at(path: impl Into<PathBuf>, bytes: impl Into<Vec<u8>>, place: OutputPlace) -> OutputFile {
        OutputFile {
            path: path.into(),
            bytes: bytes.into(),
            place,
        }
    }

    /// A file that the user names.
    pub fn named(path: impl Into<PathBuf>, bytes: impl Into<Vec<u8>>) -> OutputFile {
        OutputFile::at(path, bytes, OutputPlace::Named)
    }

    /// A file that the user names and that replaces nothing.
    pub fn new(path: impl Into<PathBuf>, bytes: impl Into<Vec<u8>>) -> OutputFile {
        OutputFile::at(path, bytes, OutputPlace::New)
    }

    /// A file of a report in a folder that the user names.
    pub fn of_report(
        path: impl Into<PathBuf>,
        bytes: impl Into<Vec<u8>>,
        overwrite: bool,
    ) -> OutputFile {
        OutputFile::at(path, bytes, OutputPlace::OfReport { overwrite })
    }

    /// Where it goes.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// Outputs that are ready to be put in place.
struct StagedOutputs<'a> {
    devices: Vec<&'a OutputFile>,
    files: StagedFiles,
    replaced: Vec<PathBuf>,
}

impl<'a> StagedOutputs<'a> {
    /// Prepares all outputs. Those that are already right are left alone.
    fn new(outputs: &'a [OutputFile]) -> Result<StagedOutputs<'a>, Error> {
        let (mut devices, mut pending, mut replaced) = (Vec::new(), Vec::new(), Vec::new());
        for output in outputs {
            let (path, bytes) = (&output.path, output.bytes.as_slice());
            match output.place {
                OutputPlace::Named | OutputPlace::New => refuse_planted(path)?,
                // A link in the place of the file itself is not followed.
                OutputPlace::OfReport { .. } => refuse_planted(folder::folder_of(path))?,
            }
            match output.place {
                OutputPlace::Named | OutputPlace::New if folder::is_device(path) => {
                    devices.push(output);
                }
                OutputPlace::Named => {
                    pending.extend(named(path, bytes, ExpectedContent::Anything)?)
                }
                OutputPlace::New => pending.extend(named(path, bytes, ExpectedContent::Free)?),
                OutputPlace::OfReport { overwrite } => {
                    let old = folder::read(path)?;
                    if old.as_deref() == Some(bytes) {
                        continue;
                    }
                    if old.is_some() || fs::read_link(path).is_ok() {
                        try_places_of_ours(std::slice::from_ref(path), overwrite)?;
                        replaced.push(path.clone());
                    }
                    pending.push(Pending {
                        path: path.clone(),
                        bytes,
                        expected: ExpectedContent::seen(old.as_deref(), overwrite),
                    });
                }
            }
        }
        Ok(StagedOutputs {
            devices,
            files: StagedFiles::beside_outputs(&pending)?,
            replaced,
        })
    }

    fn count(&self) -> usize {
        self.devices.len() + self.files.count()
    }

    /// Writes to devices. This comes before anything is replaced, since a device can refuse.
    fn write_devices(&self) -> Result<(), Error> {
        for device in &self.devices {
            fs::write(&device.path, &device.bytes).map_err(|why| stage_fault(&device.path, why))?;
        }
        Ok(())
    }
}

/// Writes these files and the folders above them: all of them, or none. Returns the files of reports that were replaced: no
/// manifest tells whether somebody changed them since.
///
/// # Errors
/// A file of others lies in the place of a report's file, a folder lies in a file's place, or the disk refuses.
pub fn write_outputs(outputs: &[OutputFile]) -> Result<Vec<PathBuf>, Error> {
    let staged = StagedOutputs::new(outputs)?;
    staged.files.refuse_folders()?;
    staged.files.refuse_taken()?;
    staged.write_devices()?;
    let count = staged.files.count();
    staged.files.replace(0, count)?;
    Ok(staged.replaced)
}

/// Writes a single file whole or not at all, and the folders above it. False: it was already right. A link is followed. A device
/// or pipe (`/dev/null`) is written to, because renaming would destroy it.
///
/// # Errors
/// A folder lies in the file's place, or the disk refuses. The old file is then unchanged.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<bool, Error> {
    let output = [OutputFile::named(path, bytes)];
    let staged = StagedOutputs::new(&output)?;
    staged.write_devices()?;
    let count = staged.count();
    staged.files.replace(0, 1)?;
    Ok(count == 1)
}

/// Tests whether a file can be written there, by writing it and taking it back. Call this before long work.
///
/// # Errors
/// The file cannot be written.
pub fn try_file(path: &Path) -> Result<(), Error> {
    refuse_planted(path)?;
    if folder::is_device(path) {
        return Ok(());
    }
    // No file of ours consists of this byte alone.
    let pending = named(path, &[0], ExpectedContent::Anything)?;
    StagedFiles::beside_outputs(pending.as_slice()).map(drop)
}

/// A file that the user names; none if it is already right.
fn named<'a>(
    path: &Path,
    bytes: &'a [u8],
    expected: ExpectedContent,
) -> Result<Option<Pending<'a>>, Error> {
    let place = destination(path, bytes)?;
    Ok(place.map(|path| Pending {
        path,
        bytes,
        expected,
    }))
}

/// Where these bytes go; none if they are already there.
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
                // The link stays, and its target is made.
                Some(leads_to) if folder::folder_of(&leads_to).is_dir() => Ok(Some(leads_to)),
                Some(_) => Err(fault(missing)),
                None if folder::is_named_as_folder(path) => Err(not_a_file()),
                None => Ok(Some(path.to_path_buf())),
            }
        }
        Err(other) => Err(fault(other)),
    }
}
