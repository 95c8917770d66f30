//! Contents of files: compared, and those of a file of a run as it is in the folder and as it will be. Line ends do not count in
//! text, since version control changes them.

use crate::generator::emit::{CATALOGUE_BUFFER, HALF_BUFFER};
use crate::generator::lut::Format;
use crate::language::targets::{self, Finish};
use crate::physics::digest::sha256;

/// The hash of a file as a manifest lists it. Line ends do not count in text, since version control changes them.
pub fn listed_hash(path: &str, bytes: &[u8]) -> String {
    if is_binary(path) || !bytes.contains(&b'\r') {
        return sha256(bytes);
    }
    sha256(&without_carriage_returns(bytes))
}

/// Whether two files have the same content. Line ends do not count in text.
pub fn is_same(path: &str, one: &[u8], other: &[u8]) -> bool {
    one == other
        || !is_binary(path) && without_carriage_returns(one) == without_carriage_returns(other)
}

/// Whether the format of this path has no room for a mark. These are SPIR-V modules, from which tools drop what is not code, and
/// the bare numbers of the catalogue's buffers.
pub fn has_no_room_for_mark(path: &str) -> bool {
    [CATALOGUE_BUFFER, HALF_BUFFER].contains(&path) || is_module(path)
}

fn is_binary(path: &str) -> bool {
    let mut tables = Format::ALL.into_iter().filter(|format| !format.is_text());
    has_no_room_for_mark(path) || tables.any(|format| path.ends_with(format.ending()))
}

/// Whether this is the path of a SPIR-V module.
pub fn is_module(path: &str) -> bool {
    let mut modules = (targets::ALL.iter()).filter(|target| target.finish == Finish::Spirv);
    modules.any(|target| {
        let stem = path.strip_suffix(target.extension);
        stem.is_some_and(|stem| stem.ends_with('.'))
    })
}

/// The bytes with line ends as LF.
pub fn without_carriage_returns(bytes: &[u8]) -> Vec<u8> {
    let followed = bytes.iter().skip(1).copied().map(Some).chain([None]);
    let pairs = bytes.iter().copied().zip(followed);
    let kept = pairs.filter(|pair| *pair != (b'\r', Some(b'\n')));
    kept.map(|(byte, _)| byte).collect()
}

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
