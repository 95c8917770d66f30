//! Compares the artifacts of a run with the output folder: what would be written, and what removed. Nothing is changed here.
//!
//! An *orphan* is in the run's scope, is no longer generated, and is proved to be as this program wrote it. It is removed.
//! Everything else in the folder is kept. A file that is not ours in the place of an artifact is an *obstacle*: the run ends
//! before it writes anything. [`ownership`](crate::generator::output::ownership) decides what is ours.
//!
//! [`report`] is what `--check` prints: what a run would write or remove. A file that a run leaves alone is no difference.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Map;
use similar::TextDiff;

use super::contents::{Planned, State};
use super::manifest::Scope;
use crate::generator::emit::Artifact;
use crate::generator::envelope::{TOOL, json_text};
use crate::generator::error::Error;
use crate::generator::output::contents::listed_hash;
use crate::generator::output::manifest::{self, Entry, Input, Manifest, Provenance};
use crate::generator::output::ownership::{
    KeptFile, bears_mark, could_be_written, is_as_written, is_listed, unknown_entries,
    unlisted_files,
};
use crate::generator::output::{earlier_runs, folder};
use crate::physics::digest::sha256;
use crate::physics::foreign::{Foreign, line_of_file};

/// The difference between the artifacts and the folder.
#[derive(Clone, Debug, PartialEq)]
pub struct TreePlan {
    /// The output folder.
    pub out_dir: PathBuf,
    /// The artifacts, sorted by path.
    pub files: Vec<Planned>,
    /// The manifest after the run.
    pub manifest: Planned,
    /// The manifest during the run. It lists both the present files and those to come.
    pub interim: Vec<u8>,
    /// The entries of files that a write removes, sorted by file.
    pub orphans: Vec<Entry>,
    /// Files that stay although they are not what this program writes there, sorted. The run names them.
    pub kept: Vec<KeptFile>,
    /// Files of others in the places of artifacts.
    pub obstacles: Vec<Obstacle>,
    /// Files of ours that were changed since they were written, and that a write replaces. The run names them.
    pub edited: Vec<String>,
    /// Remarks on what the run changes of the work of earlier runs.
    pub remarks: Vec<String>,
    /// The first folder of the tree that is a link, and where it leads.
    pub linked: Option<(PathBuf, PathBuf)>,
}

/// A file in the place of an artifact that this program must not replace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Obstacle {
    /// The path, relative to the output folder.
    pub path: String,
    /// Where it leads, if it is a link.
    pub leads_to: Option<PathBuf>,
}

/// Compares the artifacts with the folder, which need not exist yet.
///
/// # Errors
/// An artifact's path cannot be used, the manifest is not one of ours, or a file of the folder cannot be read.
pub fn plan(
    out_dir: &Path,
    artifacts: &[Artifact],
    scope: &Scope,
    provenance: &Provenance,
) -> Result<TreePlan, Error> {
    check_paths(artifacts)?;
    let (mut old, old_text) = Manifest::in_folder(out_dir)?.unzip();
    if let Some(old) = old.as_mut().filter(|_| scope.whole) {
        forget_deleted(old, out_dir);
    }
    let merged = merged(old.as_ref(), scope, artifacts, provenance);
    earlier_runs::refuse_meeting_names(artifacts, &merged)?;
    let old_entries = old.as_ref().map_or(&[][..], |old| &old.files);
    let listed: BTreeMap<&str, &Entry> = old_entries
        .iter()
        .map(|entry| (entry.file.as_str(), entry))
        .collect();
    let files = planned(out_dir, artifacts)?;
    if let Some(old) = old.as_ref().filter(|_| !scope.alone) {
        earlier_runs::refuse_namesakes(artifacts, &files, old, provenance)?;
    }
    let manifest = Planned {
        path: manifest::FILE.to_string(),
        old: old_text,
        new: json_text(&merged).into_bytes(),
    };
    let expected: BTreeSet<&str> = (merged.files.iter().map(|entry| entry.file.as_str()))
        .chain([manifest::FILE])
        .collect();
    let (orphans, mut kept) = dropped(out_dir, old_entries, &expected)?;
    kept.extend(unknown_entries(out_dir, old_entries, artifacts, scope));
    if scope.whole {
        kept.extend(unlisted_files(out_dir, &expected, &listed, scope)?);
    }
    kept.sort();
    let (obstacles, edited) = standing(out_dir, &files, &manifest, &listed);
    let mut written = files.iter().map(|file| file.path.as_str());
    let mut linked = written.find_map(|path| folder::linked_folder(out_dir, path));
    if linked.is_none() {
        let mut removed = orphans.iter().map(|entry| entry.file.as_str());
        linked = removed.find_map(|path| folder::linked_folder(out_dir, path));
    }
    Ok(TreePlan {
        out_dir: out_dir.to_path_buf(),
        interim: interim(&merged, &files, &orphans, &listed),
        files,
        manifest,
        orphans,
        kept,
        obstacles,
        edited,
        remarks: earlier_runs::remarks(artifacts, &listed),
        linked,
    })
}

impl TreePlan {
    /// All files that a write puts in place, the manifest last.
    pub fn all(&self) -> impl Iterator<Item = &Planned> {
        self.files.iter().chain([&self.manifest])
    }
}

/// Drops the entries of files that somebody deleted. Only a run without flags does: no other run would write them again once that
/// material is no longer asked for.
fn forget_deleted(old: &mut Manifest, out_dir: &Path) {
    let is_there = |entry: &Entry| out_dir.join(&entry.file).try_exists().unwrap_or(true);
    old.files
        .retain(|entry| !could_be_written(entry) || is_there(entry));
}

/// The manifest after a run: its artifacts, and those old entries that it does not own.
fn merged(
    old: Option<&Manifest>,
    scope: &Scope,
    artifacts: &[Artifact],
    provenance: &Provenance,
) -> Manifest {
    let old_files = old.map_or(&[][..], |old| &old.files);
    let kept = old_files
        .iter()
        .filter(|entry| !scope.owns(entry) || !could_be_written(entry));
    let made = artifacts.iter().map(Entry::of);
    // Later pairs replace earlier ones, so that this run's entries win.
    let files: BTreeMap<_, _> = (kept.cloned().chain(made))
        .map(|entry| (entry.file.clone(), entry))
        .collect();
    let files: Vec<Entry> = files.into_values().collect();
    Manifest {
        tool: TOOL.to_string(),
        schema: manifest::SCHEMA,
        version: provenance.version.clone(),
        naga: provenance.naga.clone(),
        inputs: merge_inputs(old, &provenance.inputs, &files),
        files,
        others: old.map_or_else(Map::new, |old| old.others.clone()),
    }
}
fn merge_inputs(old: Option<&Manifest>, new: &[Input], files: &[Entry]) -> Vec<Input> {
    let named: BTreeSet<_> = files.iter().filter_map(|e| e.material.as_ref()).collect();
    let old_inputs = old.map_or(&[][..], |old| &old.inputs);
    let inputs: BTreeMap<_, _> = (old_inputs.iter().chain(new))
        .filter(|input| named.contains(&input.name))
        .map(|input| (&input.name, input))
        .collect();
    inputs.into_values().cloned().collect()
}

/// Refuses paths that leave the output folder, collide with each other, or are the manifest's.
///
/// # Errors
/// A path breaks a rule of [`folder::check_path`], is the manifest's, is another artifact's, or is a folder that another artifact needs.
fn check_paths(artifacts: &[Artifact]) -> Result<(), Error> {
    let mut seen = BTreeSet::new();
    for artifact in artifacts {
        let path = artifact.path.as_str();
        folder::check_path(path).map_err(|reason| fault(path, reason))?;
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

/// Entries of the old manifest that the new one lacks. Files that are as listed are orphans; others are kept.
fn dropped(
    out_dir: &Path,
    old: &[Entry],
    expected: &BTreeSet<&str>,
) -> Result<(Vec<Entry>, Vec<KeptFile>), Error> {
    let (mut orphans, mut kept) = (Vec::new(), Vec::new());
    let mut seen = expected.clone();
    for entry in old {
        let path = out_dir.join(&entry.file);
        if !seen.insert(&entry.file) || fs::symlink_metadata(&path).is_err() {
            continue;
        }
        let is_plain = folder::is_plain_file(&path);
        if is_plain && folder::read(&path)?.is_some_and(|bytes| is_as_written(entry, &bytes)) {
            orphans.push(entry.clone());
        } else {
            kept.push(KeptFile {
                path: entry.file.clone(),
                why: "it is no longer generated, and is not as fresnel-gen wrote it: the manifest lists it no more",
            });
        }
    }
    Ok((orphans, kept))
}

/// Among the files that differ from what they should be: those of others, and those of ours that were changed.
fn standing(
    out_dir: &Path,
    files: &[Planned],
    manifest: &Planned,
    listed: &BTreeMap<&str, &Entry>,
) -> (Vec<Obstacle>, Vec<String>) {
    let (mut obstacles, mut edited) = (Vec::new(), Vec::new());
    for file in files.iter().chain([manifest]) {
        if file.state() == State::Unchanged {
            continue;
        }
        let leads_to = fs::read_link(out_dir.join(&file.path)).ok();
        let Some(old) = &file.old else {
            // Either a dangling link lies there, or nothing.
            obstacles.extend(leads_to.map(|leads_to| Obstacle {
                path: file.path.clone(),
                leads_to: Some(leads_to),
            }));
            continue;
        };
        let entry = listed.get(file.path.as_str());
        let is_manifest = file.path == manifest::FILE;
        let path = file.path.clone();
        if leads_to.is_some() {
            obstacles.push(Obstacle { path, leads_to });
        } else if is_manifest || entry.is_some_and(|entry| is_as_written(entry, old)) {
            // Unchanged since we wrote it.
        } else if bears_mark(old) {
            edited.push(path);
        } else {
            obstacles.push(Obstacle { path, leads_to });
        }
    }
    (obstacles, edited)
}

/// The manifest on disk while the run writes. It lists every file with its hashes before and after, and the orphans, so that a
/// killed run leaves nothing unlisted.
fn interim(
    merged: &Manifest,
    files: &[Planned],
    orphans: &[Entry],
    listed: &BTreeMap<&str, &Entry>,
) -> Vec<u8> {
    let mut interim = merged.clone();
    let changed = files.iter().filter(|file| file.state() == State::Changed);
    let before: BTreeMap<&str, &Vec<u8>> = changed
        .filter_map(|file| Some((file.path.as_str(), file.old.as_ref()?)))
        .collect();
    for entry in &mut interim.files {
        let path = entry.file.as_str();
        let (Some(old), Some(known)) = (before.get(path), listed.get(path)) else {
            continue;
        };
        if is_listed(known, old) {
            entry.was = Some(listed_hash(path, old));
        }
    }
    interim.files.extend(orphans.iter().cloned());
    interim.files.sort_by(|a, b| a.file.cmp(&b.file));
    json_text(&interim).into_bytes()
}

const CONTEXT_LINES: usize = 3;

/// The report, sorted by path, and whether it reports any difference.
pub fn report(plan: &TreePlan) -> (String, bool) {
    let mut parts = BTreeMap::new();
    for file in plan.all() {
        parts.insert(&file.path, report_file(file));
    }
    for orphan in &plan.orphans {
        parts.insert(&orphan.file, format!("orphan: {}\n", Foreign(&orphan.file)));
    }
    let text: String = parts.into_values().collect();
    let drift = !text.is_empty();
    (text, drift)
}

fn report_file(file: &Planned) -> String {
    match &file.old {
        None => format!("missing: {}\n", file.path),
        Some(_) if file.state() == State::Unchanged => String::new(),
        Some(old) => difference(&file.path, old, &file.new),
    }
}

fn difference(path: &str, old: &[u8], new: &[u8]) -> String {
    match (std::str::from_utf8(old), std::str::from_utf8(new)) {
        (Ok(old), Ok(new)) if !path.ends_with(".spv") => text_difference(path, old, new),
        _ => format!(
            "binary file {path} differs (sha256 {} → {})\n",
            sha256(old),
            sha256(new)
        ),
    }
}

fn text_difference(path: &str, old: &str, new: &str) -> String {
    let text = TextDiff::from_lines(old, new)
        .unified_diff()
        .context_radius(CONTEXT_LINES)
        .header(&format!("a/{path}"), &format!("b/{path}"))
        .to_string();
    text.split_terminator('\n').map(difference_line).collect()
}

/// A line of a diff: its mark, and the file's text.
fn difference_line(line: &str) -> String {
    let (mark, held) = line.split_at(line.len().min(1));
    format!("{mark}{}\n", line_of_file(held))
}
