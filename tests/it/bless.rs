//! Committed text against what the program says today: compared by default, rewritten with `BLESS=1`.

use std::fs;
use std::path::Path;

/// Whether differences are to be rewritten.
pub fn is_on() -> bool {
    std::env::var_os("BLESS").is_some_and(|value| value == "1")
}

/// Compares a committed file with what it should hold.
#[track_caller]
pub fn check(path: &Path, expected: &[u8]) {
    let found = fs::read(path).unwrap_or_default();
    if found == expected {
        return;
    }
    if is_on() {
        fs::write(path, expected).expect("the repository can be written");
        return;
    }
    let line = found
        .iter()
        .zip(expected)
        .take_while(|(a, b)| a == b)
        .filter(|(a, _)| **a == b'\n')
        .count()
        + 1;
    panic!(
        "{} differs from line {line} on; BLESS=1 cargo test rewrites it",
        path.display()
    );
}
