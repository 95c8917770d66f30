//! `manifest.json`: the files in the output folder, what each was made from, and its errors.
//!
//! Runs of different scopes share one manifest. Its bytes are a function of the entries alone, not of the order of the runs.
//!
//! The scope of a run says which entries it may replace or remove. A run owns only what it was asked for, so that `--material silver`
//! after `--target gles` gives the same tree as the other way round.

use std::collections::BTreeSet;
use std::path::Path;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::{Map, Value};

use crate::generator::emit::Artifact;
use crate::generator::envelope::TOOL;
use crate::generator::error::Error;
use crate::generator::output::contents::listed_hash;
use crate::generator::output::folder::{self, check_path};
use crate::physics::num::Precision;
use crate::physics::user_text::without_mark;

/// The manifest's name in the output folder.
pub const FILE: &str = "manifest.json";

/// The version of the manifest's format. It rises when an older program would misread a newer manifest.
pub const SCHEMA: u32 = 1;

/// All that `manifest.json` says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Always [`TOOL`].
    #[serde(deserialize_with = "our_tool")]
    pub tool: String,
    /// The version of the format: [`SCHEMA`]. The first manifests lacked it.
    #[serde(default, deserialize_with = "known_schema")]
    pub schema: u32,
    /// The version of the program that wrote it last.
    pub version: String,
    /// The version of naga that generated the SPIR-V.
    pub naga: String,
    /// The data of the materials, sorted by name.
    pub inputs: Vec<Input>,
    /// The artifacts, sorted by file.
    pub files: Vec<Entry>,
    /// Fields that somebody else wrote: they are kept.
    #[serde(flatten)]
    pub others: Map<String, Value>,
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
    /// The effect, in a file of effects.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effect: Option<String>,
    /// In a library file, its method. In an effect's file, the method that computes R, unless it is the default.
    pub method: Option<String>,
    /// The material of a specialised file.
    pub material: Option<String>,
    /// The SHA-256 of the file. For text, line ends are hashed as LF.
    pub sha256: String,
    /// The SHA-256 of the file that this one replaces. It is set only while a run writes, so that a killed run leaves no file
    /// unlisted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub was: Option<String>,
    /// Functions, parameters and errors as in [`Detail`](crate::generator::emit::Detail), or as another version wrote them; those
    /// are kept.
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
    /// The data of the materials that the run used. Those that no entry names are left out.
    pub inputs: Vec<Input>,
}

impl Manifest {
    /// The manifest of a folder, and its bytes; none if the folder has none.
    ///
    /// # Errors
    /// It cannot be read, or as [`Manifest::parse`].
    pub fn in_folder(out_dir: &Path) -> Result<Option<(Manifest, Vec<u8>)>, Error> {
        let path = out_dir.join(FILE);
        let Some(bytes) = folder::read(&path)? else {
            return Ok(None);
        };
        Ok(Some((Manifest::parse(&path, &bytes)?, bytes)))
    }

    /// Reads a manifest. `path` is used only in the message.
    ///
    /// # Errors
    /// The text is not JSON, not a manifest of this program, or holds the marks of a merge conflict.
    pub fn parse(path: &Path, text: &[u8]) -> Result<Manifest, Error> {
        // UTF-16 text is not JSON, and the parser reports it.
        let text = without_mark(text).unwrap_or(text);
        serde_json::from_slice(text).map_err(|fault| match conflict(text) {
            Some(line) => Error::Manifest {
                path: path.to_path_buf(),
                line,
                column: 1,
                reason: CONFLICT.to_owned(),
            },
            None => Error::Manifest {
                path: path.to_path_buf(),
                line: fault.line(),
                column: fault.column(),
                reason: reason(&fault),
            },
        })
    }
}

/// The value of `--gpu` in a command.
pub fn gpu_in(command: &str) -> Option<&str> {
    command
        .split(' ')
        .skip_while(|word| *word != "--gpu")
        .nth(1)
}

impl Entry {
    /// The precision of its functions. Only half precision is recorded.
    pub fn precision(&self) -> &str {
        let said = self.detail.get("precision").and_then(Value::as_str);
        said.unwrap_or(Precision::F32.name())
    }

    /// Its functions. Another version may have written them in another form: what does not fit counts as absent.
    pub fn functions(&self) -> &[Value] {
        let functions = self.detail.get("functions").and_then(Value::as_array);
        functions.map_or(&[], Vec::as_slice)
    }

    /// The names of its functions.
    pub fn function_names(&self) -> impl Iterator<Item = &str> {
        let functions = self.functions().iter();
        functions.filter_map(|function| function["name"].as_str())
    }

    /// The methods of its functions.
    pub fn function_methods(&self) -> impl Iterator<Item = &str> {
        let functions = self.functions().iter();
        functions.filter_map(|function| function["method"].as_str())
    }

    /// The materials of an atlas, in the order of its rows.
    pub fn row_materials(&self) -> Vec<&str> {
        let rows = self.detail.get("row_materials").and_then(Value::as_array);
        let rows = rows.map_or(&[][..], Vec::as_slice).iter();
        rows.filter_map(Value::as_str).collect()
    }

    /// The viewing conditions of its material, in words.
    pub fn reference(&self) -> Option<&str> {
        self.detail.get("seen")?["truth"].as_str()
    }

    /// What `--gpu` was given to the command that wrote it. None where no command is listed, and `Some(None)` where it named no GPU.
    pub fn gpu(&self) -> Option<Option<&str>> {
        Some(gpu_in(self.detail.get("command")?.as_str()?))
    }

    /// The entry of an artifact.
    pub fn of(artifact: &Artifact) -> Entry {
        let Ok(Value::Object(detail)) = serde_json::to_value(&artifact.detail) else {
            unreachable!("a detail is a structure of text keys")
        };
        Entry {
            file: artifact.path.clone(),
            target: artifact.target.clone(),
            effect: artifact.effect.clone(),
            method: artifact.method.clone(),
            material: artifact.material.clone(),
            sha256: listed_hash(&artifact.path, &artifact.bytes),
            was: None,
            detail,
        }
    }
}

/// What to do with a manifest that version control could not merge.
const CONFLICT: &str = "it holds a merge conflict. Take either side whole (git checkout --ours or --theirs), then run the \
    same commands again: each run lists what it writes";

/// The line of a merge conflict, counted from 1.
fn conflict(text: &[u8]) -> Option<usize> {
    let mut lines = text.split(|byte| *byte == b'\n');
    let marks: [&[u8]; 2] = [b"<<<<<<< ", b">>>>>>> "];
    let is_mark = |line: &[u8]| marks.iter().any(|mark| line.starts_with(mark));
    lines.position(is_mark).map(|at| at + 1)
}

fn reason(fault: &serde_json::Error) -> String {
    let text = fault.to_string();
    // serde_json ends with the position, which our message puts first.
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

/// A newer format may mean something else, so it is left alone.
fn known_schema<'de, D: Deserializer<'de>>(from: D) -> Result<u32, D::Error> {
    let schema = u32::deserialize(from)?;
    if schema <= SCHEMA {
        return Ok(schema);
    }
    Err(D::Error::custom(format!(
        "its `schema` is {schema}, and this version knows {SCHEMA} at most: a newer fresnel-gen wrote it. Update this one"
    )))
}

/// A manifest comes from a repository, and the files that it lists may be removed. Its paths must stay inside the folder.
fn inner_path<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    let path = String::deserialize(from)?;
    match check_path(&path) {
        Ok(()) => Ok(path),
        Err(rule) => Err(D::Error::custom(format!("`file` is `{path}`: {rule}"))),
    }
}

impl Artifact {
    /// The key that distinguishes a file of an effect from others in its target's folder.
    pub(in crate::generator) fn effect_key(&self) -> Option<EffectKey> {
        let effect = self.effect.clone()?;
        Some((effect, self.material.clone(), self.method.clone()))
    }
}

/// What a run generates, by name. Only names whose files the run generates may stand here: a run removes the files that it owns
/// but does not generate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scope {
    /// The targets selected, by `--target` or by default.
    pub targets: BTreeSet<String>,
    /// The methods selected by `--method`. None: all, also those that this version no longer knows, so that the files of a
    /// deleted method are removed. An empty set: the run makes no library files.
    pub methods: Option<BTreeSet<String>>,
    /// The materials selected, by `--material` or by default. There is no "all" here:
    /// an earlier run may have added a material from the user's own file.
    pub materials: BTreeSet<String>,
    /// Whether the run makes the files that name neither method nor material, such as the catalogue.
    pub shared: bool,
    /// The files of effects that the run makes.
    pub effects: BTreeSet<EffectKey>,
    /// The flavours that the run writes.
    pub flavours: BTreeSet<String>,
    /// The precision of the run's functions. The run does not own files of the other precision.
    pub precision: Precision,
    /// Whether no selecting flag was given. Such a run also removes orphans.
    pub whole: bool,
    /// Whether the folder belongs to this run alone. Then the run owns all that the manifest lists.
    pub alone: bool,
}

/// The key of a file of effects in its target's folder: the effect, the material, and the method unless it is the default.
pub type EffectKey = (String, Option<String>, Option<String>);

impl Scope {
    /// May this run replace or remove the entry?
    pub fn owns(&self, entry: &Entry) -> bool {
        if self.alone {
            return true;
        }
        if let Some(effect) = &entry.effect {
            let key = (effect.clone(), entry.material.clone(), entry.method.clone());
            let is_usual = entry.material.is_none() && entry.method.is_none();
            return self.targets.contains(&entry.target)
                && (self.effects.contains(&key) || self.whole && is_usual);
        }
        if self.flavours.contains(&entry.target) {
            return (entry.material.as_ref()).is_none_or(|name| self.materials.contains(name));
        }
        let method = |name: &String| self.methods.as_ref().is_none_or(|all| all.contains(name));
        let named = entry.method.is_some() || entry.material.is_some();
        self.targets.contains(&entry.target)
            && entry.precision() == self.precision.name()
            && (named || self.shared)
            && entry.method.as_ref().is_none_or(method)
            && (entry.material.as_ref()).is_none_or(|name| self.materials.contains(name))
    }
}
