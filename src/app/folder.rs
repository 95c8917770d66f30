//! Reading the output folder. Links are never followed here: what lies behind one is not ours to remove.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use super::error::Error;

pub use crate::emit::MARK;

/// The beginning of a temporary file's name.
pub const TEMPORARY_PREFIX: &str = ".fresnel-gen-";

/// The end of a temporary file's name.
pub const TEMPORARY_SUFFIX: &str = ".tmp";

/// The mark must stand within this many bytes.
const MARK_WITHIN: u64 = 1024;

/// The files right in `root` and at any depth of these folders in it, as paths relative to `root` with `/`.
/// A link is listed as one file.
pub fn list(root: &Path, folders: &BTreeSet<String>) -> Result<BTreeSet<String>, Error> {
    let mut files = BTreeSet::new();
    let top = list_one(root, "", &mut files)?;
    let mut waiting: Vec<String> = top.into_iter().filter(|f| folders.contains(f)).collect();
    while let Some(folder) = waiting.pop() {
        waiting.extend(list_one(root, &folder, &mut files)?);
    }
    Ok(files)
}

/// The content of a file, None if nothing is there.
pub fn read(path: &Path) -> Result<Option<Vec<u8>>, Error> {
    match fs::metadata(path) {
        // Opening a pipe would wait for ever.
        Ok(found) if !found.is_file() => Err(Error::NotAFile {
            path: path.to_path_buf(),
        }),
        Ok(_) => fs::read(path).map(Some).map_err(|e| read_fault(path, e)),
        Err(fault) if fault.kind() == ErrorKind::NotFound => Ok(None),
        Err(fault) => Err(read_fault(path, fault)),
    }
}

/// Is this a plain file whose first lines hold the [`MARK`]?
pub fn is_marked(path: &Path) -> bool {
    let plain = fs::symlink_metadata(path).is_ok_and(|found| found.is_file());
    plain && first_bytes(path).is_ok_and(|head| holds_mark(&head))
}

/// Is this a plain file that begins as a SPIR-V module does?
pub fn is_spirv(path: &Path) -> bool {
    let plain = fs::symlink_metadata(path).is_ok_and(|found| found.is_file());
    plain && first_bytes(path).is_ok_and(|head| head.starts_with(&[0x03, 0x02, 0x23, 0x07]))
}

/// Is this the name of a temporary file that a run left behind when it was killed?
pub fn is_temporary(path: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.starts_with(TEMPORARY_PREFIX) && name.ends_with(TEMPORARY_SUFFIX)
}

/// Adds the files of one folder and returns the folders in it. A folder that is not there is empty.
fn list_one(root: &Path, folder: &str, files: &mut BTreeSet<String>) -> Result<Vec<String>, Error> {
    let path = root.join(folder);
    let entries = match fs::read_dir(&path) {
        Err(fault) if fault.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        other => other.map_err(|e| read_fault(&path, e))?,
    };
    let mut inner = Vec::new();
    for entry in entries {
        let (name, is_folder) = entry
            .and_then(|entry| Ok((entry.file_name(), entry.file_type()?.is_dir())))
            .map_err(|e| read_fault(&path, e))?;
        let name = join(folder, &name.to_string_lossy());
        if is_folder {
            inner.push(name);
        } else {
            files.insert(name);
        }
    }
    Ok(inner)
}

fn join(folder: &str, name: &str) -> String {
    match folder {
        "" => name.to_string(),
        _ => format!("{folder}/{name}"),
    }
}

fn first_bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut head = Vec::new();
    File::open(path)?.take(MARK_WITHIN).read_to_end(&mut head)?;
    Ok(head)
}

fn holds_mark(head: &[u8]) -> bool {
    head.windows(MARK.len())
        .any(|bytes| bytes == MARK.as_bytes())
}

fn read_fault(path: &Path, source: io::Error) -> Error {
    Error::Read {
        path: path.to_path_buf(),
        source,
    }
}
