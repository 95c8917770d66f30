//! Removing from an output folder: orphans that are as this program wrote them, what a killed run left, and folders left empty.

use std::fs;
use std::path::Path;

use crate::generator::error::Error;
use crate::generator::output::folder;
use crate::generator::output::manifest::Entry;
use crate::generator::output::ours::is_as_written;

/// Removes an orphan and the folders that it leaves empty. False: it is gone, or no longer what the manifest lists.
///
/// # Errors
/// The system refuses.
pub fn remove(out_dir: &Path, orphan: &Entry) -> Result<bool, Error> {
    let path = out_dir.join(&orphan.file);
    let is_ours = |bytes: Vec<u8>| is_as_written(orphan, &bytes);
    if !folder::is_plain_file(&path) || !folder::read(&path)?.is_some_and(is_ours) {
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
pub fn remove_leftover(out_dir: &Path, name: &str) {
    let path = out_dir.join(name);
    // A lock can be forged: folders are removed only above a file that was there, and never beyond a link.
    let is_inside = folder::is_plain_file(&path) && folder::linked_folder(out_dir, name).is_none();
    if is_inside && fs::remove_file(&path).is_ok() {
        remove_empty_folders(out_dir, &path);
    }
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
