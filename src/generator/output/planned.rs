//! A file of a run as it is in the folder and as it will be.

use crate::generator::output::contents::is_same;

/// One file, as it is and as it will be.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// The path, relative to the output folder, parts separated by `/`.
    pub path: String,
    /// The bytes on disk; none if the file is missing.
    pub old: Option<Vec<u8>>,
    /// The bytes that it should have.
    pub new: Vec<u8>,
}

impl Planned {
    /// How the file on disk compares with what it should be.
    pub fn state(&self) -> State {
        match &self.old {
            None => State::Missing,
            Some(old) if is_same(&self.path, old, &self.new) => State::Unchanged,
            Some(_) => State::Changed,
        }
    }
}

/// How a file on disk compares with what it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It is not there.
    Missing,
    /// It is there and differs.
    Changed,
    /// It is there and says the same.
    Unchanged,
}
