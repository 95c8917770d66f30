//! The request for an audit, and the same request for another dialect of the language.

use core::time::Duration;
use std::path::PathBuf;

use super::given::Given;
use super::language::Language;
use super::preprocess::Define;
use crate::lab::cost::Family;
use crate::physics::spectra::Space;

/// A request for an audit.
#[derive(Clone, Debug)]
pub struct Audit {
    /// The file's name, for messages.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Its language.
    pub language: Language,
    /// The name of the function. If none is given, the file must hold one only.
    pub function: Option<String>,
    /// Names that are defined for the preprocessor.
    pub defines: Vec<Define>,
    /// Values of its arguments.
    pub given: Vec<Given>,
    /// The colour space, for errors under viewing conditions.
    pub space: Space,
    /// The largest error that is not a finding.
    pub max_error: Option<f64>,
    /// The most numbers of a material that a compared method of ours may take.
    pub max_inputs: Option<usize>,
    /// The GPUs whose compilers are asked.
    pub families: Vec<&'static Family>,
    /// The user's folder of compilers.
    pub tools: Option<PathBuf>,
    /// Seconds that one step may take.
    pub seconds: u64,
    /// Processes that run at once.
    pub workers: usize,
}

impl Audit {
    /// This audit with the constants of Godot's shaders, if the text is one of them.
    pub fn in_godot(&self) -> Option<Audit> {
        let constants = [("PI", "3.1415926535897932"), ("TAU", "6.2831853071795864")];
        let is_of_godot = self.file.ends_with(".gdshader") || self.file.ends_with(".gdshaderinc");
        (is_of_godot && self.language == Language::Gles).then(|| {
            let mut audit = self.clone();
            let own = constants.iter().filter(|(name, _)| {
                let defines = |one: &Define| one.name == *name;
                !self.text.contains(&format!("define {name}")) && !self.defines.iter().any(defines)
            });
            audit.defines.extend(own.map(|(name, value)| Define {
                name: (*name).to_owned(),
                value: (*value).to_owned(),
            }));
            audit
        })
    }

    /// This audit with the text as desktop GLSL of this version.
    pub fn on_the_desktop(&self, version: u32) -> Audit {
        let mut audit = self.clone();
        audit.language = Language::Glsl;
        audit.defines.insert(0, Define::of("__VERSION__", version));
        audit
    }

    /// How long one step may take.
    pub fn limit(&self) -> Duration {
        Duration::from_secs(self.seconds)
    }
}
