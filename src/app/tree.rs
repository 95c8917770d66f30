//! The artifacts of a run against the output folder: what would be written, what removed. Nothing is changed here.
//!
//! An *orphan* is ours and no longer generated: in the scope of the run by the old manifest, a leftover
//! temporary file, or, in a run without flags, a file in a target's folder that no manifest entry names
//! and that bears our marks. A *foreign* file lies there too, bears none, and is reported but never removed.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::artifact::{self, Artifact};
use super::error::Error;
use super::folder;
use super::manifest::{self, Manifest, Provenance};
use super::scope::Scope;
use crate::num::Precision;

/// The difference between the artifacts and the folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The output folder.
    pub out_dir: PathBuf,
    /// The artifacts, sorted by path.
    pub files: Vec<Planned>,
    /// The manifest after the run.
    pub manifest: Planned,
    /// Files of ours that a write removes, sorted.
    pub orphans: Vec<String>,
    /// Files of others in the targets' folders, sorted: to be warned of. Empty unless the run is whole.
    pub foreign: Vec<String>,
}

/// One file, as it is and as it will be.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// The path, relative to the output folder, parts separated by `/`.
    pub path: String,
    /// The bytes on disk, if the file is there.
    pub old: Option<Vec<u8>>,
    /// The bytes that it should have.
    pub new: Vec<u8>,
}

/// How a file on disk stands to what it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It is not there.
    Missing,
    /// It is there and differs.
    Changed,
    /// It is there and the same.
    Unchanged,
}

/// Compares the artifacts with the folder, which need not exist yet.
pub fn plan(
    out_dir: &Path,
    artifacts: &[Artifact],
    scope: &Scope,
    provenance: &Provenance,
) -> Result<Plan, Error> {
    artifact::check_paths(artifacts)?;
    let old_text = folder::read(&out_dir.join(manifest::FILE))?;
    let old = old_manifest(out_dir, old_text.as_deref(), scope)?;
    let merged = Manifest::merge(old.as_ref(), scope, artifacts, provenance);
    let known = Known::new(&merged, old.as_ref(), scope);
    let (orphans, foreign) = strays(out_dir, &known)?;
    Ok(Plan {
        out_dir: out_dir.to_path_buf(),
        files: planned(out_dir, artifacts)?,
        manifest: Planned {
            path: manifest::FILE.to_string(),
            old: old_text,
            new: merged.to_json().into_bytes(),
        },
        orphans,
        foreign,
    })
}

impl Plan {
    /// All files that a write puts in place, the manifest last.
    pub fn all(&self) -> impl Iterator<Item = &Planned> {
        self.files.iter().chain([&self.manifest])
    }

    /// The paths of the files in this state, sorted, the manifest last.
    pub fn paths(&self, state: State) -> Vec<&str> {
        let matching = self.all().filter(|file| file.state() == state);
        matching.map(|file| file.path.as_str()).collect()
    }
}

impl Planned {
    /// How the file on disk stands to what it should be.
    pub fn state(&self) -> State {
        match &self.old {
            None => State::Missing,
            Some(old) if *old == self.new => State::Unchanged,
            Some(_) => State::Changed,
        }
    }
}

/// What tells our files from others'.
struct Known {
    /// Every path that will be in the folder after the run.
    expected: BTreeSet<String>,
    /// Every path that the old manifest lists.
    listed: BTreeSet<String>,
    /// The folders in which all files should be ours: targets, and the first part of every path.
    folders: BTreeSet<String>,
    /// The run removes orphans that no manifest lists.
    whole: bool,
    /// The folder holds a manifest of ours.
    has_manifest: bool,
    /// What the names of the run's own files end in.
    suffix: &'static str,
}

impl Known {
    fn new(merged: &Manifest, old: Option<&Manifest>, scope: &Scope) -> Known {
        let mut expected = paths(merged);
        let listed = old.map(paths).unwrap_or_default();
        let parts = || expected.union(&listed).filter_map(|path| first_part(path));
        let folders = parts().map(|(first, _)| first.to_string());
        let folders = folders.chain(scope.targets.iter().cloned()).collect();
        expected.insert(manifest::FILE.to_string());
        Known {
            expected,
            listed,
            folders,
            whole: scope.whole,
            has_manifest: old.is_some(),
            suffix: scope.precision.suffix(),
        }
    }

    /// Is the file ours beyond doubt, in any run?
    fn is_recorded(&self, path: &str) -> bool {
        folder::is_temporary(path) || self.listed.contains(path)
    }

    /// Should a run without flags say something about a file that nothing records? Not of a table: `bake` records none.
    fn is_of_interest(&self, path: &str) -> bool {
        let ours = |first: &str| first != artifact::TABLES && self.folders.contains(first);
        let in_target = first_part(path).is_some_and(|(first, _)| ours(first));
        self.whole && in_target && !is_hidden(path) && self.is_of_precision(path)
    }

    /// Has a file the name of this run's precision? Those of the other are not its own.
    fn is_of_precision(&self, path: &str) -> bool {
        let name = path.rsplit('/').next().unwrap_or(path);
        let stem = name.split('.').next().unwrap_or(name);
        let half = Precision::F16.suffix();
        stem.ends_with(half) == (self.suffix == half)
    }

    /// Has a module a name that only we give? SPIR-V has no comments, so it cannot bear the mark.
    fn is_our_module(&self, out_dir: &Path, path: &str) -> bool {
        let rest = first_part(path).map_or("", |(_, rest)| rest);
        let named = rest.starts_with("fresnel_") || rest.starts_with("materials/");
        self.has_manifest
            && named
            && extension(rest) == Some("spv")
            && folder::is_spirv(&out_dir.join(path))
    }
}

/// The old manifest. A run without flags forgets entries whose file somebody deleted:
/// no other run would, once nobody asks for that material again.
fn old_manifest(
    out_dir: &Path,
    text: Option<&[u8]>,
    scope: &Scope,
) -> Result<Option<Manifest>, Error> {
    let Some(text) = text else {
        return Ok(None);
    };
    let mut old = Manifest::parse(&out_dir.join(manifest::FILE), text)?;
    if scope.whole {
        old.files
            .retain(|entry| out_dir.join(&entry.file).try_exists().unwrap_or(true));
    }
    Ok(Some(old))
}

fn planned(out_dir: &Path, artifacts: &[Artifact]) -> Result<Vec<Planned>, Error> {
    let compare = |artifact: &Artifact| {
        Ok(Planned {
            path: artifact.path.clone(),
            old: folder::read(&out_dir.join(&artifact.path))?,
            new: artifact.bytes.clone(),
        })
    };
    let mut files = (artifacts.iter().map(compare)).collect::<Result<Vec<_>, Error>>()?;
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// The orphans and the foreign files.
fn strays(out_dir: &Path, known: &Known) -> Result<(Vec<String>, Vec<String>), Error> {
    let mut present = folder::list(out_dir, &known.folders)?;
    present.retain(|path| !known.expected.contains(path));
    let (mut orphans, mut foreign) = (Vec::new(), Vec::new());
    for path in present {
        if known.is_recorded(&path) {
            orphans.push(path);
        } else if known.is_of_interest(&path) {
            let ours =
                known.is_our_module(out_dir, &path) || folder::is_marked(&out_dir.join(&path));
            (if ours { &mut orphans } else { &mut foreign }).push(path);
        }
    }
    Ok((orphans, foreign))
}

fn paths(manifest: &Manifest) -> BTreeSet<String> {
    manifest.files.iter().map(|e| e.file.clone()).collect()
}

fn first_part(path: &str) -> Option<(&str, &str)> {
    path.split_once('/')
}

fn extension(path: &str) -> Option<&str> {
    let name = path.rsplit('/').next()?;
    name.rsplit_once('.').map(|(_, extension)| extension)
}

/// Desktops and version control leave such files anywhere.
fn is_hidden(path: &str) -> bool {
    path.split('/').any(|part| part.starts_with('.'))
}
