//! Reading a file without waiting for ever. Some files of Linux' `/proc` and `/sys` say that they are ordinary and empty, and are
//! neither: they end never, or give nothing until something happens.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read as _};
use std::path::Path;

/// The bytes of an ordinary file that has at most so many.
///
/// # Errors
/// It is none, it is larger, nothing comes from it, or the system refuses.
pub fn bytes(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    // Before it is opened: to open a device or a pipe can do something, or wait.
    let said = fs::metadata(path)?;
    check(&said, largest)?;
    let file = open(path)?;
    // By now something else may lie there.
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

/// Opens a file so that no reading of it waits.
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
        // Whoever may not open it is told so; whoever may does not wait.
        let _ = bytes(Path::new("/proc/kmsg"), 1 << 20);
    }
}
