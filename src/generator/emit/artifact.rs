//! An artifact: one output file in memory.

use super::detail::Detail;

/// One output file, and what the manifest says about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Artifact {
    /// Where it goes: relative to the output folder, parts separated by `/`.
    pub path: String,
    /// The file's content.
    pub bytes: Vec<u8>,
    /// The target that it is written for.
    pub target: String,
    /// The effect, in a file of effects.
    pub effect: Option<String>,
    /// In a library file, its method. In an effect's file, the method that computes R, unless it is the default.
    pub method: Option<String>,
    /// The material of a specialised file.
    pub material: Option<String>,
    /// Functions, parameters, errors.
    pub detail: Detail,
}

impl Artifact {
    /// A file that belongs to no effect, method or material.
    pub(in crate::generator) fn new(
        target: &str,
        path: String,
        bytes: Vec<u8>,
        detail: Detail,
    ) -> Artifact {
        Artifact {
            path,
            bytes,
            target: target.to_owned(),
            effect: None,
            method: None,
            material: None,
            detail,
        }
    }
}
