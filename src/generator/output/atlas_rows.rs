//! Which material stands in which row of an atlas, before a run and after it. A function that reads a row by its number shows
//! another material where the rows change.

use std::collections::BTreeMap;

use crate::physics::foreign::{Foreign, one_line};

use crate::generator::output::artifact::Artifact;
use crate::generator::output::manifest::Entry;

/// Files of an atlas whose rows change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedRows {
    /// The files, relative to the output folder.
    files: Vec<String>,
    /// The materials of the rows before.
    old: Vec<String>,
    /// Those after.
    new: Vec<String>,
}

impl ChangedRows {
    /// For people.
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

/// The atlases of a run whose rows are others than the manifest lists.
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
