//! An artifact: one output file in memory, and the rules that its path obeys.

use std::collections::BTreeSet;

use crate::generator::emit::Detail;

use crate::generator::error::Error;
use crate::generator::output::manifest;
use crate::generator::output::scope::EffectKey;

pub use crate::physics::digest::sha256;

/// One output file, and what the manifest says about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Artifact {
    /// Where it goes: relative to the output folder, parts separated by `/`.
    pub path: String,
    /// The file's content.
    pub bytes: Vec<u8>,
    /// The target that it is written for.
    pub target: String,
    /// The effect of a file of effects.
    pub effect: Option<String>,
    /// The method of a library file; of an effect's file the method that computes R, where it is not the usual one.
    pub method: Option<String>,
    /// The material of a specialised file.
    pub material: Option<String>,
    /// Functions, parameters, errors.
    pub detail: Detail,
}

impl Artifact {
    /// What tells a file of an effect from others in its target's folder.
    pub(in crate::generator) fn effect_key(&self) -> Option<EffectKey> {
        let effect = self.effect.clone()?;
        Some((effect, self.material.clone(), self.method.clone()))
    }
}

/// Refuses paths that leave the output folder, meet each other, or take the manifest's place.
///
/// # Errors
/// A path breaks a rule of [`check_path`], is the manifest's, is another artifact's, or is a folder that another one needs.
pub fn check_paths(artifacts: &[Artifact]) -> Result<(), Error> {
    let mut seen = BTreeSet::new();
    for artifact in artifacts {
        let path = artifact.path.as_str();
        check_path(path).map_err(|reason| fault(path, reason))?;
        if path == manifest::FILE {
            return Err(fault(path, "it is the manifest's own name"));
        }
        if !seen.insert(path) {
            return Err(fault(path, "two artifacts have it"));
        }
    }
    match seen.iter().find(|path| is_folder_of_another(path, &seen)) {
        Some(path) => Err(fault(path, "another artifact needs it as a folder")),
        None => Ok(()),
    }
}

/// Is this a path that stays inside its folder, on every system?
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

fn is_folder_of_another(path: &str, all: &BTreeSet<&str>) -> bool {
    let inside = format!("{path}/");
    let next = all.range(inside.as_str()..).next();
    next.is_some_and(|next| next.starts_with(&inside))
}

fn fault(path: &str, reason: &str) -> Error {
    Error::Path {
        path: path.to_string(),
        reason: reason.to_string(),
    }
}
