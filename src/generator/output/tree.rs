//! Compares the artifacts of a run with the output folder: what would be written, and what removed. Nothing is changed here.
//!
//! An *orphan* is in the run's scope, is no longer generated, and is proved to be as this program wrote it. It is removed.
//! Everything else in the folder *stays*. A file that is not ours in the place of an artifact is an *obstacle*: the run ends
//! before it writes anything. [`ours`](crate::generator::output::ours) decides what is ours.
//!
//! [`report`] is what `--check` prints: what a run would write or remove. A file that a run leaves alone is no difference.
//!
//! [`changed_rows`] compares the materials in the rows of an atlas before and after a run. A function that reads a row by its
//! number shows another material where the rows change.
//!
//! [`refuse_namesakes`] refuses two files whose materials get the same name, such as `Gläser.csv` and `Glaser.csv`: the second
//! run would silently replace the functions of the first.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use similar::TextDiff;

use crate::generator::emit::Artifact;
use crate::generator::emit::{Detail, FunctionDetail};
use crate::generator::error::{Error, RequestFault};
use crate::generator::output::artifact::{self, Scope, sha256};
use crate::generator::output::folder;
use crate::generator::output::manifest::{self, Entry, Manifest, Provenance};
use crate::generator::output::ours::{
    bears_mark, could_be_written, is_as_written, is_listed, is_same, listed_hash, strangers,
    unknown,
};
use crate::physics::foreign::{Foreign, line_of_file, one_line};

pub use crate::generator::output::ours::Stay;

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
    pub stays: Vec<Stay>,
    /// Files of others in the places of artifacts.
    pub obstacles: Vec<Obstacle>,
    /// Files of ours that were changed since they were written, and that a write replaces. The run names them.
    pub edited: Vec<String>,
    /// Functions that earlier runs put into a file and this one does not, by file. The run names them.
    pub dropped: Vec<(String, Vec<String>)>,
    /// Files whose functions get other viewing conditions than before: the file, and both conditions in words. The run names
    /// them.
    pub reseen: Vec<(String, [String; 2])>,
    /// Atlases whose rows get other materials than before. The run names them.
    pub rows: Vec<ChangedRows>,
    /// The first folder of the tree that is a link, and where it leads.
    pub linked: Option<(PathBuf, PathBuf)>,
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

/// A file in the place of an artifact that this program must not replace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Obstacle {
    /// The path, relative to the output folder.
    pub path: String,
    /// Where it leads, if it is a link.
    pub leads_to: Option<PathBuf>,
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
    artifact::check_paths(artifacts)?;
    let old_text = folder::read(&out_dir.join(manifest::FILE))?;
    let old = old_manifest(out_dir, old_text.as_deref(), scope)?;
    let merged = Manifest::merge(old.as_ref(), scope, artifacts, provenance);
    refuse_meeting_names(artifacts, &merged)?;
    let old_entries = old.as_ref().map_or(&[][..], |old| &old.files);
    let listed: BTreeMap<&str, &Entry> = old_entries
        .iter()
        .map(|entry| (entry.file.as_str(), entry))
        .collect();
    let files = planned(out_dir, artifacts)?;
    if let Some(old) = &old {
        refuse_namesakes(artifacts, &files, old, provenance)?;
    }
    let manifest = Planned {
        path: manifest::FILE.to_string(),
        old: old_text,
        new: merged.to_json().into_bytes(),
    };
    let expected: BTreeSet<&str> = (merged.files.iter().map(|entry| entry.file.as_str()))
        .chain([manifest::FILE])
        .collect();
    let (orphans, mut stays) = dropped(out_dir, old_entries, &expected)?;
    stays.extend(unknown(out_dir, old_entries, &files, scope));
    if scope.whole {
        stays.extend(strangers(out_dir, &expected, &listed, scope)?);
    }
    stays.sort();
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
        stays,
        obstacles,
        edited,
        dropped: dropped_functions(artifacts, &listed),
        reseen: reseen(artifacts, &listed),
        rows: changed_rows(artifacts, &listed),
        linked,
    })
}

/// Functions that the manifest lists for a file and the artifact lacks.
fn dropped_functions(
    artifacts: &[Artifact],
    listed: &BTreeMap<&str, &Entry>,
) -> Vec<(String, Vec<String>)> {
    let dropped = |artifact: &Artifact| {
        let entry = listed.get(artifact.path.as_str())?;
        let kept = artifact.detail.functions();
        let is_lost = |name: &&str| !kept.iter().any(|function| function.name == *name);
        let lost = entry.function_names().filter(is_lost);
        let lost: Vec<String> = lost.map(str::to_owned).collect();
        (!lost.is_empty()).then(|| (artifact.path.clone(), lost))
    };
    artifacts.iter().filter_map(dropped).collect()
}

/// Files of materials whose functions were written for other viewing conditions. A file is written for one set of conditions, so
/// functions that it keeps from earlier runs change with it.
fn reseen(artifacts: &[Artifact], listed: &BTreeMap<&str, &Entry>) -> Vec<(String, [String; 2])> {
    let changed = |artifact: &Artifact| {
        let old = listed.get(artifact.path.as_str())?.reference()?;
        let new = &artifact.detail.seen()?.truth;
        (old != new).then(|| (artifact.path.clone(), [old.to_owned(), new.clone()]))
    };
    artifacts.iter().filter_map(changed).collect()
}

/// Refuses a function that another file of the same language already holds from another run: including both would define it
/// twice.
fn refuse_meeting_names(artifacts: &[Artifact], merged: &Manifest) -> Result<(), Error> {
    let made: BTreeSet<&str> = artifacts
        .iter()
        .map(|artifact| artifact.path.as_str())
        .collect();
    // What this program could not have written is not its own, whatever a manifest says about it.
    let is_other = |entry: &&Entry| !made.contains(entry.file.as_str()) && could_be_written(entry);
    let others = merged.files.iter().filter(is_other);
    let mut owners: BTreeMap<(&str, &str), &str> = BTreeMap::new();
    for entry in others {
        for name in entry.function_names() {
            owners.insert((&entry.target, name), &entry.file);
        }
    }
    for artifact in artifacts {
        for FunctionDetail { name, .. } in artifact.detail.functions() {
            if let Some(other) = owners.get(&(artifact.target.as_str(), name.as_str())) {
                return Err(RequestFault::refused(format!(
                    "`{name}` would stand in {} and stands in {other}; rename a material, or choose another --prefix",
                    artifact.path
                ))
                .into());
            }
        }
    }
    Ok(())
}

impl TreePlan {
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
    /// How the file on disk compares with what it should be.
    pub fn state(&self) -> State {
        match &self.old {
            None => State::Missing,
            Some(old) if is_same(&self.path, old, &self.new) => State::Unchanged,
            Some(_) => State::Changed,
        }
    }
}

/// The old manifest. A run without flags forgets entries whose file somebody deleted. No other run would, once that material is
/// no longer asked for.
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
        let is_there = |entry: &Entry| out_dir.join(&entry.file).try_exists().unwrap_or(true);
        old.files
            .retain(|entry| !could_be_written(entry) || is_there(entry));
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

/// Entries of the old manifest that the new one lacks. Files that are as listed are orphans; others stay.
fn dropped(
    out_dir: &Path,
    old: &[Entry],
    expected: &BTreeSet<&str>,
) -> Result<(Vec<Entry>, Vec<Stay>), Error> {
    let (mut orphans, mut stays) = (Vec::new(), Vec::new());
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
            stays.push(Stay {
                path: entry.file.clone(),
                why: "it is no longer generated, and is not as fresnel-gen wrote it: the manifest lists it no more",
            });
        }
    }
    Ok((orphans, stays))
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
    interim.to_json().into_bytes()
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

/// The files of an atlas whose rows change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedRows {
    files: Vec<String>,
    /// The materials of the rows before.
    old: Vec<String>,
    /// Those after.
    new: Vec<String>,
}

impl ChangedRows {
    /// The change in words, for the user.
    pub fn words(&self) -> String {
        let lost = self.old.iter().filter(|name| !self.new.contains(name));
        let lost: Vec<String> = lost.map(|name| Foreign(name).to_string()).collect();
        let lost = if lost.is_empty() {
            "its rows have other numbers than before".to_owned()
        } else {
            format!(
                "rows that an earlier run put there leave it: {}",
                lost.join(", ")
            )
        };
        let files: Vec<String> = self
            .files
            .iter()
            .map(|file| Foreign(file).to_string())
            .collect();
        let rows = self.new.iter().enumerate();
        let rows: Vec<String> = rows
            .map(|(row, name)| format!("{row} {}", Foreign(name)))
            .collect();
        one_line(&format!(
            "{}: {lost}; its rows are {}. --out-dir writes another atlas elsewhere",
            files.join(", "),
            rows.join(", ")
        ))
    }
}

/// The atlases of a run whose rows differ from those that the manifest lists.
pub fn changed_rows(artifacts: &[Artifact], listed: &BTreeMap<&str, &Entry>) -> Vec<ChangedRows> {
    let mut changed: Vec<ChangedRows> = Vec::new();
    for artifact in artifacts {
        let Some(entry) = listed.get(artifact.path.as_str()) else {
            continue;
        };
        let (old, new) = (entry.row_materials(), artifact.detail.row_materials());
        if old.is_empty() || new.is_empty() || old == *new {
            continue;
        }
        let same = |one: &&mut ChangedRows| one.old == old && one.new == *new;
        match changed.iter_mut().find(same) {
            Some(one) => one.files.push(artifact.path.clone()),
            None => changed.push(ChangedRows {
                files: vec![artifact.path.clone()],
                old: old.into_iter().map(str::to_owned).collect(),
                new: new.to_vec(),
            }),
        }
    }
    changed
}

/// Refuses to write what is made of a table or page beside what is made of another one, or of a catalogue material, with the same
/// name. Tables and pages are named after their files, and the data differ. A material file states its own name, and is taken for
/// a newer version of that material.
///
/// # Errors
/// The manifest lists something made from other data.
pub fn refuse_namesakes(
    artifacts: &[Artifact],
    files: &[Planned],
    old: &Manifest,
    provenance: &Provenance,
) -> Result<(), Error> {
    for (artifact, file) in artifacts.iter().zip(files) {
        let (Some(name), Some(new)) = (&artifact.material, wanted(artifact)) else {
            continue;
        };
        let [known_data, new_data] = [&old.inputs, &provenance.inputs]
            .map(|inputs| inputs.iter().find(|input| input.name == *name));
        // Everything made of that material counts, in every language and format: a manifest has one hash for all of it.
        let of_name = |entry: &&Entry| entry.material.as_ref() == Some(name);
        for entry in old.files.iter().filter(of_name) {
            let Some(known) = listed(entry).filter(|known| *known != new) else {
                continue;
            };
            // A manifest does not say what tables were made of.
            let is_same = match (known_data, new_data) {
                (Some(known), Some(new)) => known.sha256 == new.sha256,
                _ => entry.file == artifact.path && file.state() == State::Unchanged,
            };
            if !is_same && [known, new].into_iter().all(names_no_material_file) {
                return Err(RequestFault::Namesake {
                    file: entry.file.clone(),
                    words: [known, new].map(str::to_owned),
                }
                .into());
            }
        }
    }
    Ok(())
}

/// The material in the command of an entry.
fn listed(entry: &Entry) -> Option<&str> {
    material_word(entry.detail.get("command")?.as_str()?)
}

/// The material in the command of an artifact.
fn wanted(artifact: &Artifact) -> Option<&str> {
    match &artifact.detail {
        Detail::Functions(detail) => material_word(&detail.command),
        Detail::Table(detail) => material_word(&detail.command),
        Detail::Adapter(detail) => material_word(&detail.command),
        Detail::Catalogue(_) => None,
    }
}

/// The word after the flag, as a shell reads it: up to the first unquoted blank.
fn material_word(command: &str) -> Option<&str> {
    let (_, rest) = command.split_once(" --material ")?;
    let (mut quote, mut is_escaped) = (None, false);
    let end = rest.find(|c| {
        match (quote, c) {
            _ if is_escaped => is_escaped = false,
            (None | Some('"'), '\\') => is_escaped = true,
            (None, '\'' | '"') => quote = Some(c),
            (None, ' ') => return true,
            (Some(open), _) if open == c => quote = None,
            _ => {}
        }
        false
    });
    Some(&rest[..end.unwrap_or(rest.len())])
}

/// Whether a word, as a shell reads it, is not a material file but a table, a page, or a name of the catalogue.
fn names_no_material_file(word: &str) -> bool {
    let word = word.trim_end_matches(['\'', '"', ')']).to_lowercase();
    !word.ends_with(".toml")
}
