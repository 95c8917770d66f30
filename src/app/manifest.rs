//! `manifest.json`: what lies in the output folder, what each file was made from, and how wrong it is.
//!
//! Runs of different scopes share one manifest. Its bytes are a function of the entries alone, not of the order of the runs.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::{Map, Value};

use crate::num::Precision;

use super::artifact::{Artifact, check_path, sha256};
use super::error::Error;
use super::scope::Scope;

/// The manifest's name in the output folder.
pub const FILE: &str = "manifest.json";

/// The name by which a manifest is known as ours.
pub const TOOL: &str = "fresnel-gen";

/// All that `manifest.json` says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Always [`TOOL`].
    #[serde(deserialize_with = "our_tool")]
    pub tool: String,
    /// The version that wrote it last.
    pub version: String,
    /// The version of naga that lowered to SPIR-V.
    pub naga: String,
    /// The data of the materials, sorted by name.
    pub inputs: Vec<Input>,
    /// The artifacts, sorted by file.
    pub files: Vec<Entry>,
}

/// The data of one material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Input {
    /// The material's name, as in [`Entry::material`].
    pub name: String,
    /// The SHA-256 of its data.
    pub sha256: String,
}

/// One artifact as the manifest knows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The path, relative to the output folder, parts separated by `/`.
    #[serde(deserialize_with = "inner_path")]
    pub file: String,
    /// The target that it is written for.
    pub target: String,
    /// The method of a library file.
    pub method: Option<String>,
    /// The material of a specialised file.
    pub material: Option<String>,
    /// The SHA-256 of the file.
    pub sha256: String,
    /// Functions, parameters, errors.
    #[serde(flatten)]
    pub detail: Map<String, Value>,
}

/// What a run adds to the manifest besides its artifacts.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// The version of this program.
    pub version: String,
    /// The version of naga.
    pub naga: String,
    /// The data of the materials that the run used; those that no entry names are left out.
    pub inputs: Vec<Input>,
}

impl Manifest {
    /// Reads a manifest; `path` is for the message only.
    pub fn parse(path: &Path, text: &[u8]) -> Result<Manifest, Error> {
        serde_json::from_slice(text).map_err(|fault| Error::Manifest {
            path: path.to_path_buf(),
            line: fault.line(),
            column: fault.column(),
            reason: reason(&fault),
        })
    }

    /// The file's text.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self);
        text.expect("all keys are strings, and no part of a manifest can fail to serialise") + "\n"
    }

    /// The manifest after a run: its artifacts, and those old entries that it does not own.
    pub fn merge(
        old: Option<&Manifest>,
        scope: &Scope,
        artifacts: &[Artifact],
        provenance: &Provenance,
    ) -> Manifest {
        let old_files = old.map_or(&[][..], |old| &old.files);
        let kept = old_files.iter().filter(|entry| !scope.owns(entry));
        let made = artifacts.iter().map(Entry::of);
        // Later pairs replace earlier ones: what this run made stands above what it found.
        let files: BTreeMap<_, _> = (kept.cloned().chain(made))
            .map(|entry| (entry.file.clone(), entry))
            .collect();
        let files: Vec<Entry> = files.into_values().collect();
        Manifest {
            tool: TOOL.to_string(),
            version: provenance.version.clone(),
            naga: provenance.naga.clone(),
            inputs: merge_inputs(old, &provenance.inputs, &files),
            files,
        }
    }
}

impl Entry {
    /// What its functions compute in; only half precision is said.
    pub fn precision(&self) -> &str {
        let said = self.detail.get("precision").and_then(Value::as_str);
        said.unwrap_or(Precision::F32.name())
    }

    /// The entry of an artifact. A detail that is no object stands under `detail`;
    /// one that has a name of the entry's own fields is left out, because a name can stand only once.
    pub fn of(artifact: &Artifact) -> Entry {
        let mut detail = match artifact.detail.clone() {
            Value::Object(detail) => detail,
            Value::Null => Map::new(),
            other => Map::from_iter([("detail".to_string(), other)]),
        };
        detail.retain(|name, _| !OWN_FIELDS.contains(&name.as_str()));
        Entry {
            file: artifact.path.clone(),
            target: artifact.target.clone(),
            method: artifact.method.clone(),
            material: artifact.material.clone(),
            sha256: sha256(&artifact.bytes),
            detail,
        }
    }
}

const OWN_FIELDS: [&str; 5] = ["file", "target", "method", "material", "sha256"];

fn merge_inputs(old: Option<&Manifest>, new: &[Input], files: &[Entry]) -> Vec<Input> {
    let named: BTreeSet<_> = files.iter().filter_map(|e| e.material.as_ref()).collect();
    let old_inputs = old.map_or(&[][..], |old| &old.inputs);
    let inputs: BTreeMap<_, _> = (old_inputs.iter().chain(new))
        .filter(|input| named.contains(&input.name))
        .map(|input| (&input.name, input))
        .collect();
    inputs.into_values().cloned().collect()
}

fn reason(fault: &serde_json::Error) -> String {
    let text = fault.to_string();
    // serde_json ends with the position, which the message gives in front.
    let reason = text.rsplit_once(" at line ").map_or(text.as_str(), |p| p.0);
    format!("not a manifest of {TOOL}: {reason}")
}

fn our_tool<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    let tool = String::deserialize(from)?;
    if tool == TOOL {
        return Ok(tool);
    }
    Err(D::Error::custom(format!("`tool` is `{tool}`")))
}

/// A manifest comes from a repository, and what it lists may be removed: it must not reach outside.
fn inner_path<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    let path = String::deserialize(from)?;
    match check_path(&path) {
        Ok(()) => Ok(path),
        Err(rule) => Err(D::Error::custom(format!("`file` is `{path}`: {rule}"))),
    }
}
