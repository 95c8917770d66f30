//! The real program in temporary folders: flags, exit codes, streams, files.

mod again;
mod bad_input;
mod bake;
mod brought;
mod budget;
mod catalogue;
mod chart;
mod clean;
mod compare;
mod compare_engine;
mod cost;
mod determinism;
#[cfg(unix)]
mod disk;
mod effects;
mod elsewhere;
mod exchange;
mod files;
mod fit;
mod forged;
mod generation;
mod half;
mod help;
mod hooks;
mod hostile;
mod injected;
#[cfg(unix)]
mod killed;
mod marks;
mod materials;
mod medium;
pub mod pipelines;
mod plan;
mod reflectance;
mod scene_error;
mod seen;
#[cfg(unix)]
mod shared_folders;
mod single;
mod stability;
mod streams;
mod time;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

use crate::tree::{Snapshot, snapshot};
use fresnel_gen::physics::digest::sha256;

/// The program.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_fresnel-gen");

/// The output folder where none is named.
pub const OUT: &str = "shaders-generated";

/// A good material file.
pub const MY_METAL: &str = r#"name = "my_metal"
summary = "An invented metal"
class = "metal"
licence = "CC0-1.0"
reference = "Nobody, Nothing, 2020"
link = "https://example.org"
data = [
  [380, 1.39, 1.72],
  [780, 0.23, 3.94],
]
"#;

/// An empty folder that the program runs in.
pub struct Place(TempDir);

impl Place {
    pub fn new() -> Place {
        Place(TempDir::new().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn put(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::create_dir_all(self.path(name).parent().unwrap()).unwrap();
        fs::write(self.path(name), bytes).unwrap();
    }

    #[track_caller]
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|fault| panic!("{name}: {fault}"))
    }

    #[track_caller]
    pub fn read_bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|fault| panic!("{name}: {fault}"))
    }

    /// Every file with its bytes and its time of change.
    pub fn files(&self) -> Snapshot {
        snapshot(self.0.path())
    }

    /// The manifest of the usual output folder.
    pub fn manifest(&self) -> Value {
        serde_json::from_str(&self.read(&format!("{OUT}/manifest.json"))).unwrap()
    }

    /// Puts a file into the usual output folder, and lists it as if an earlier version had written it: the entry is that
    /// of `like`, of the method `schlick` where `like` has a method.
    pub fn list_as(&self, like: &str, file: &str, text: &str) {
        let mut manifest = self.manifest();
        let entries = manifest["files"].as_array_mut().unwrap();
        let mut entry = entries.iter().find(|e| e["file"] == like).unwrap().clone();
        if entry["material"].is_null() {
            entry["method"] = "schlick".into();
        }
        entry["file"] = file.into();
        entry["sha256"] = sha256(text.as_bytes()).into();
        entries.push(entry);
        self.put(&format!("{OUT}/{file}"), text);
        self.put(&format!("{OUT}/manifest.json"), manifest.to_string());
    }

    /// The files that the manifest lists.
    pub fn listed(&self) -> Vec<String> {
        let manifest = self.manifest();
        let files = manifest["files"].as_array().unwrap().iter();
        files
            .map(|entry| entry["file"].as_str().unwrap().to_string())
            .collect()
    }

    pub fn command<S: AsRef<std::ffi::OsStr>>(&self, arguments: &[S]) -> Command {
        let mut command = Command::new(PROGRAM);
        command
            .args(arguments)
            .current_dir(self.0.path())
            .stdin(Stdio::null());
        command
    }

    /// Runs the program; the line's words are its arguments.
    pub fn run(&self, line: &str) -> Ran {
        self.run_with(&line.split_whitespace().collect::<Vec<_>>())
    }

    pub fn run_with(&self, arguments: &[&str]) -> Ran {
        let output = self.command(arguments).output().unwrap();
        Ran::new(arguments.join(" "), output)
    }

    /// The run ends with 0.
    #[track_caller]
    pub fn done(&self, line: &str) -> Ran {
        self.run(line).ends(0)
    }

    /// The run ends with 2, says each of these, and changes nothing.
    #[track_caller]
    pub fn refused(&self, line: &str, says: &[&str]) {
        self.refused_with(&line.split_whitespace().collect::<Vec<_>>(), says);
    }

    #[track_caller]
    pub fn refused_with(&self, arguments: &[&str], says: &[&str]) {
        let before = self.files();
        let ran = self.run_with(arguments).ends(2);
        assert!(ran.err.starts_with("error: "), "{ran:?}");
        assert!(!ran.err.contains("bug in fresnel-gen"), "{ran:?}");
        assert_eq!(ran.out, "", "{ran:?}");
        for text in says {
            assert!(ran.err.contains(text), "{text} is not in {ran:?}");
        }
        assert!(before == self.files(), "{ran:?} changed files");
    }
}

/// A run that has ended.
#[derive(Debug)]
pub struct Ran {
    pub line: String,
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Ran {
    pub fn new(line: String, output: Output) -> Ran {
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        Ran {
            line,
            code: output.status.code(),
            out: text(output.stdout),
            err: text(output.stderr),
        }
    }

    #[track_caller]
    pub fn ends(self, code: i32) -> Ran {
        assert_eq!(self.code, Some(code), "{}: {self:?}", self.line);
        assert!(!self.err.contains("panicked"), "{self:?}");
        self
    }

    #[track_caller]
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|fault| panic!("{fault}: {self:?}"))
    }
}

/// The bytes of files below a folder, without times.
pub fn contents(folder: &Path) -> std::collections::BTreeMap<String, Vec<u8>> {
    let files = snapshot(folder).into_iter();
    files.map(|(path, (bytes, _))| (path, bytes)).collect()
}
