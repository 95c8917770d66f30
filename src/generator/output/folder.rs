//! Reads the output folder and the files in it, and resolves paths.
//!
//! Listing never follows links: what lies behind one is not ours to remove. Reading never blocks for ever: some files of Linux'
//! `/proc` and `/sys` claim to be ordinary and empty, but never end, or give nothing until something happens.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read as _};
use std::path::{Component, Path, PathBuf};

use crate::generator::error::Error;
use crate::physics::digest::sha256;

const TEMPORARY_PREFIX: &str = ".fresnel-gen-";
const TEMPORARY_SUFFIX: &str = ".tmp";
const TEMPORARY_DIGITS: usize = 16;

/// The files directly in `root`, and those at any depth in the given folders of it, as paths relative to `root` with `/`. A link
/// is listed as one file.
///
/// # Errors
/// A folder cannot be read. A folder that does not exist has no files, and is no error.
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
///
/// # Errors
/// What lies there is not a file, or cannot be read.
pub fn read(path: &Path) -> Result<Option<Vec<u8>>, Error> {
    match fs::metadata(path) {
        // Opening a pipe would block for ever.
        Ok(found) if !found.is_file() => Err(Error::NotAFile {
            path: path.to_path_buf(),
        }),
        Ok(_) => match bytes(path, u64::MAX) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(fault) => Err(read_fault(path, fault)),
        },
        Err(fault) if fault.kind() == ErrorKind::NotFound => Ok(None),
        Err(fault) => Err(read_fault(path, fault)),
    }
}

/// A new name for a temporary file.
pub fn temporary_name() -> String {
    format!(
        "{TEMPORARY_PREFIX}{:0digits$x}{TEMPORARY_SUFFIX}",
        fastrand::u64(..),
        digits = TEMPORARY_DIGITS
    )
}

/// A new name for the temporary file of an output that the user names. Its first half is the same in every run, so that the next
/// run finds what a killed run left behind. Its second half is new in every run, so that nobody can occupy the name in advance.
pub fn temporary_of(output: &Path) -> String {
    format!(
        "{}{:08x}{TEMPORARY_SUFFIX}",
        temporaries_of(output),
        fastrand::u32(..)
    )
}

/// How the names of an output's temporary files begin.
fn temporaries_of(output: &Path) -> String {
    let name = output.file_name().unwrap_or_default();
    let hash = sha256(name.as_encoded_bytes());
    format!("{TEMPORARY_PREFIX}{}", &hash[..TEMPORARY_DIGITS / 2])
}

/// The temporary files of other runs that lie beside an output. A folder that cannot be listed has none.
pub fn temporaries_beside(output: &Path) -> Vec<PathBuf> {
    let start = temporaries_of(output);
    let entries = fs::read_dir(folder_of(output)).into_iter().flatten();
    let of_output = |name: &str| name.starts_with(&start) && is_temporary(name);
    let of_output = entries
        .flatten()
        .filter(|entry| entry.file_name().to_str().is_some_and(of_output));
    of_output.map(|entry| entry.path()).collect()
}

/// The folder that a file lies in.
pub fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Is this the name of a temporary file?
pub fn is_temporary(path: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or(path);
    let inner = name.strip_prefix(TEMPORARY_PREFIX);
    let digits = inner.and_then(|inner| inner.strip_suffix(TEMPORARY_SUFFIX));
    digits.is_some_and(|digits| {
        digits.len() == TEMPORARY_DIGITS && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
    })
}

/// Whether this is an ordinary file, and neither a link nor a folder.
pub fn is_plain_file(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_file())
}

/// Whether two paths lead to one file, so that the later of two outputs would replace the earlier. A device accepts both.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    !is_device(one) && resolved(one) == resolved(other)
}

/// Whether a path ends in a slash, so that no file can have that name.
pub fn is_named_as_folder(path: &Path) -> bool {
    let last = path.to_string_lossy().chars().next_back();
    last.is_some_and(std::path::is_separator)
}

/// Whether a path leads to a device or a pipe.
pub fn is_device(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| !found.is_dir() && !found.is_file())
}

/// Whether a path leads into a folder.
pub fn is_below(folder: &Path, path: &Path) -> bool {
    resolved(path).starts_with(resolved(folder))
}

/// How many links are followed in a row: as many as Linux follows.
const LINKS: u32 = 40;

/// A path without links and without `..`, whether or not it exists. A run makes missing folders, so `new/..` is the folder that
/// will hold `new`, and a dangling link leads to the file that will be made.
pub fn resolved(path: &Path) -> PathBuf {
    let whole = resolved_within(path, LINKS, &mut |_, _| {});
    fs::canonicalize(&whole).unwrap_or(whole)
}

/// The first link on the way to a path that another user may have put there, or a pipe in its place.
pub fn planted(path: &Path) -> Option<PathBuf> {
    let mut first = None;
    // Opening a pipe for writing waits for its reader, who receives what is written.
    if is_device(path) && is_planted(folder_of(path), path) {
        return Some(path.to_path_buf());
    }
    resolved_within(path, LINKS, &mut |folder, link| {
        if first.is_none() && is_planted(folder, link) {
            first = Some(link.to_path_buf());
        }
    });
    first
}

/// Whether this lies in a folder that several users can write to, such as `/tmp`, and its owner is neither the current user, nor
/// root, nor the folder's owner. This is Linux' rule `fs.protected_symlinks`, which other systems lack and an administrator can
/// turn off.
#[cfg(unix)]
fn is_planted(folder: &Path, link: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    const STICKY: u32 = 0o1000;
    const WRITABLE_TO_OTHERS: u32 = 0o022;
    let (Ok(folder), Ok(link)) = (fs::metadata(folder), fs::symlink_metadata(link)) else {
        return false;
    };
    let is_shared = folder.mode() & STICKY != 0 && folder.mode() & WRITABLE_TO_OTHERS != 0;
    let user = rustix::process::geteuid().as_raw();
    is_shared && ![user, 0, folder.uid()].contains(&link.uid())
}

/// Other systems have no sticky bit. In a build script nobody else writes.
#[cfg(not(unix))]
fn is_planted(_folder: &Path, _link: &Path) -> bool {
    false
}

/// Calls `on_link` for each link that it follows, with the link's folder (without links) and the link.
fn resolved_within(path: &Path, links: u32, on_link: &mut dyn FnMut(&Path, &Path)) -> PathBuf {
    let mut whole = if path.is_absolute() {
        PathBuf::new()
    } else {
        fs::canonicalize(".").unwrap_or_default()
    };
    for part in path.components() {
        match part {
            Component::Prefix(_) | Component::RootDir => whole.push(part),
            Component::CurDir => {}
            Component::ParentDir => {
                whole.pop();
            }
            Component::Normal(name) => {
                let next = whole.join(name);
                whole = match fs::read_link(&next) {
                    Ok(leads_to) if links > 0 => {
                        on_link(&whole, &next);
                        resolved_within(&whole.join(leads_to), links - 1, on_link)
                    }
                    _ => next,
                };
            }
        }
    }
    whole
}

/// Where a dangling link leads; none if this is no dangling link.
pub fn dangling_link(path: &Path) -> Option<PathBuf> {
    let leads_to = fs::read_link(path).ok()?;
    let is_missing = fs::metadata(path).is_err_and(|fault| fault.kind() == ErrorKind::NotFound);
    is_missing.then(|| path.parent().unwrap_or(Path::new("")).join(leads_to))
}

/// The first folder on the way from `root` to this path that is a link, and where it leads.
pub fn linked_folder(root: &Path, path: &str) -> Option<(PathBuf, PathBuf)> {
    let mut folder = root.to_path_buf();
    let parts: Vec<&str> = path.split('/').collect();
    for part in &parts[..parts.len().saturating_sub(1)] {
        folder.push(part);
        if let Ok(leads_to) = fs::read_link(&folder) {
            return Some((folder, leads_to));
        }
    }
    None
}

/// Checks that a path stays inside its folder, on every system.
///
/// # Errors
/// The path holds `\\`, `:` or a control character, is absolute, or has a part that is empty, `.` or `..`.
pub fn check_path(path: &str) -> Result<(), &'static str> {
    if path.contains(|c: char| c == '\\' || c == ':' || c.is_control()) {
        return Err("`\\`, `:` and control characters are not allowed");
    }
    if path.split('/').any(|part| matches!(part, "" | "." | "..")) {
        return Err("it must be relative, without empty parts, `.` and `..`");
    }
    Ok(())
}

/// Adds the files of one folder and returns the folders in it. A missing folder is empty.
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

fn read_fault(path: &Path, source: io::Error) -> Error {
    Error::Read {
        path: path.to_path_buf(),
        source,
    }
}

/// The bytes of an ordinary file of at most `largest` bytes.
///
/// # Errors
/// It is not an ordinary file, it is larger, it gives no bytes, or the system refuses.
pub fn bytes(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    // Checked before opening, since opening a device or a pipe can have effects, or block.
    let said = fs::metadata(path)?;
    check(&said, largest)?;
    let file = open(path)?;
    // Something else may lie there by now.
    check(&file.metadata()?, largest)?;
    let mut bytes = Vec::new();
    bytes
        .try_reserve(usize::try_from(said.len()).unwrap_or(usize::MAX))
        .map_err(|_| ErrorKind::OutOfMemory)?;
    match file.take(largest.saturating_add(1)).read_to_end(&mut bytes) {
        Ok(count) if count as u64 > largest => {
            Err(too_large(format!("more than {largest}"), largest))
        }
        Ok(_) => Ok(bytes),
        Err(fault) if fault.kind() == ErrorKind::WouldBlock => Err(io::Error::other(
            "it is not an ordinary file: it gives nothing, and does not end",
        )),
        Err(fault) => Err(fault),
    }
}

fn check(said: &fs::Metadata, largest: u64) -> io::Result<()> {
    if !said.is_file() {
        return Err(io::Error::other("it is not an ordinary file"));
    }
    if said.len() > largest {
        Err(too_large(said.len().to_string(), largest))
    } else {
        Ok(())
    }
}

fn too_large(has: String, largest: u64) -> io::Error {
    io::Error::other(format!("it has {has} bytes; at most {largest} are read"))
}

/// Opens a file so that reads never block.
#[cfg(unix)]
fn open(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt as _;
    let flags = rustix::fs::OFlags::NONBLOCK.bits().cast_signed();
    OpenOptions::new().read(true).custom_flags(flags).open(path)
}

#[cfg(not(unix))]
fn open(path: &Path) -> io::Result<File> {
    OpenOptions::new().read(true).open(path)
}

#[cfg(test)]
mod tests {
    use super::bytes;
    use std::path::Path;

    #[track_caller]
    fn check(path: &Path, largest: u64, says: &str) {
        let fault = bytes(path, largest).expect_err("it is refused").to_string();
        assert!(fault.contains(says), "{fault}");
    }

    #[test]
    fn only_ordinary_files_of_a_size_are_read() {
        let dir = tempfile::TempDir::new().expect("a folder");
        let file = dir.path().join("file");
        std::fs::write(&file, "four").expect("a file");
        assert_eq!(bytes(&file, 4).expect("it is read"), b"four");
        check(&file, 3, "it has 4 bytes; at most 3 are read");
        check(dir.path(), 4, "not an ordinary file");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_says_that_it_is_ordinary_is_read_to_its_limit() {
        check(Path::new("/proc/self/status"), 10, "more than 10 bytes");
        check(Path::new("/dev/zero"), 10, "not an ordinary file");
        // A user without the right to open it gets an error. A user with it must not block.
        let _ = bytes(Path::new("/proc/kmsg"), 1 << 20);
    }
}
