//! What is wrong with a user's file, and where.

use crate::physics::foreign::{Foreign, one_line};

/// A fault in a file, as `file:line:column: what`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}:{line}:{column}: {}", Foreign(file), one_line(what))]
pub struct FileFault {
    /// The file, as the user named it.
    pub file: String,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
    /// What was found, and what is allowed.
    pub what: String,
}

impl FileFault {
    /// A fault at an offset of a text, in bytes: line and column are counted there.
    pub fn at(file: &str, text: &str, offset: usize, what: String) -> FileFault {
        let before = text.get(..offset).unwrap_or("");
        FileFault {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before.rsplit('\n').next().unwrap_or("").chars().count() + 1,
            what,
        }
    }
}
