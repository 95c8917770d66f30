//! What a run does to the work of earlier runs in the same folder, by the manifest.
//!
//! [`remarks`] names functions that leave a file, viewing conditions and GPUs that change, and rows of an atlas that get other
//! materials: a function that reads a row by its number shows another material then.
//!
//! [`refuse_meeting_names`] refuses a function that another file defines. [`refuse_namesakes`] refuses two files whose materials get
//! the same name, such as `Gläser.csv` and `Glaser.csv`: the second run would silently replace the functions of the first.

use std::collections::{BTreeMap, BTreeSet};

use super::contents::{Planned, State};
use crate::generator::emit::{Artifact, Detail, FunctionDetail};
use crate::generator::error::{Error, RequestFault};
use crate::generator::output::manifest::{Entry, Manifest, Provenance, gpu_in};
use crate::generator::output::ownership::could_be_written;
use crate::language::targets;
use crate::physics::foreign::{Foreign, one_line};

/// A line for each change of what the manifest lists, for the user.
pub fn remarks(artifacts: &[Artifact], listed: &BTreeMap<&str, &Entry>) -> Vec<String> {
    let known = |artifact: &'_ Artifact| listed.get(artifact.path.as_str()).copied();
    let pairs = artifacts
        .iter()
        .filter_map(|artifact| Some((artifact, known(artifact)?)));
    let pairs: Vec<(&Artifact, &Entry)> = pairs.collect();
    let dropped = pairs
        .iter()
        .filter_map(|(artifact, entry)| dropped(artifact, entry));
    let seen = pairs
        .iter()
        .filter_map(|(artifact, entry)| seen_otherwise(artifact, entry));
    let others = dropped.chain(seen).chain(changed_rows(&pairs));
    others.chain(other_gpus(&pairs)).collect()
}

/// The files that were written for another GPU, counted by both.
fn other_gpus(pairs: &[(&Artifact, &Entry)]) -> Vec<String> {
    let mut changed: BTreeMap<[&str; 2], (usize, &str)> = BTreeMap::new();
    for (artifact, entry) in pairs {
        let Detail::Functions(detail) = &artifact.detail else {
            continue;
        };
        let (Some(old), Some(target)) = (entry.gpu(), targets::find(&artifact.target)) else {
            continue;
        };
        let usual = target.gpu.name();
        let both = [old, gpu_in(&detail.command)].map(|gpu| gpu.unwrap_or(usual));
        if both[0] != both[1] {
            let (count, _) = changed.entry(both).or_insert((0, &artifact.path));
            *count += 1;
        }
    }
    let words = |([old, new], (count, first)): ([&str; 2], (usize, &str))| {
        let files = match count {
            1 => Foreign(first).to_string(),
            _ => format!("{count} files, {} among them", Foreign(first)),
        };
        format!(
            "{files}: written for {new}, and by an earlier run for {}; --gpu says for which GPU",
            Foreign(old)
        )
    };
    changed.into_iter().map(words).collect()
}

/// Functions that the manifest lists for a file and the artifact lacks.
fn dropped(artifact: &Artifact, entry: &Entry) -> Option<String> {
    let kept = artifact.detail.functions();
    let is_lost = |name: &&str| !kept.iter().any(|function| function.name == *name);
    let lost: Vec<&str> = entry.function_names().filter(is_lost).collect();
    (!lost.is_empty()).then(|| {
        format!(
            "no longer in {}: {}, which an earlier run put there; name its method to have it",
            Foreign(&artifact.path),
            one_line(&lost.join(", "))
        )
    })
}

/// A file of a material whose functions were written for other viewing conditions. A file is written for one set of conditions, so
/// functions that it keeps from earlier runs change with it.
fn seen_otherwise(artifact: &Artifact, entry: &Entry) -> Option<String> {
    let (old, new) = (entry.reference()?, artifact.detail.seen()?.truth.as_str());
    let [path, from, to] = [artifact.path.as_str(), old, new].map(Foreign);
    (old != new).then(|| {
        format!("{path}: other viewing conditions, so that all of its functions change: from {from} to {to}")
    })
}

/// The atlases and catalogues whose rows differ from those that the manifest lists, each with all of its files.
fn changed_rows(pairs: &[(&Artifact, &Entry)]) -> Vec<String> {
    let mut changed: Vec<([Vec<&str>; 2], Vec<&str>)> = Vec::new();
    for (artifact, entry) in pairs {
        let new = artifact.detail.row_materials().iter().map(String::as_str);
        let rows = [entry.row_materials(), new.collect()];
        if rows.iter().any(Vec::is_empty) || rows[0] == rows[1] {
            continue;
        }
        match changed.iter_mut().find(|(other, _)| *other == rows) {
            Some((_, files)) => files.push(&artifact.path),
            None => changed.push((rows, vec![&artifact.path])),
        }
    }
    let words = |([old, new], files): &([Vec<&str>; 2], Vec<&str>)| rows_in_words(files, old, new);
    changed.iter().map(words).collect()
}

fn rows_in_words(files: &[&str], old: &[&str], new: &[&str]) -> String {
    let listed = |names: &[&str]| -> String {
        let names = names.iter().map(|name| Foreign(name).to_string());
        names.collect::<Vec<_>>().join(", ")
    };
    let lost: Vec<&str> = old
        .iter()
        .copied()
        .filter(|name| !new.contains(name))
        .collect();
    let lost = if lost.is_empty() {
        "its rows have other numbers than before".to_owned()
    } else {
        format!(
            "rows that an earlier run put there leave it: {}",
            listed(&lost)
        )
    };
    let rows = new.iter().enumerate();
    let rows: Vec<String> = rows
        .map(|(row, name)| format!("{row} {}", Foreign(name)))
        .collect();
    one_line(&format!(
        "{}: {lost}; its rows are {}. --out-dir writes other ones elsewhere",
        listed(files),
        rows.join(", ")
    ))
}

/// Refuses a function that another file of the same language already holds from another run: including both would define it
/// twice.
pub fn refuse_meeting_names(artifacts: &[Artifact], merged: &Manifest) -> Result<(), Error> {
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
