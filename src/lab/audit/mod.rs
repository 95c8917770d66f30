//! Audit: a user's own function compared with the reference reflectance of a material, and with our methods.
//!
//! This room decides the conditions of the text (`preprocess`), cuts out the function and what it needs (`slice`), and names its
//! inputs from outside (`hidden`). Compilers see only that part. A program of ours around the user's function (`program`) runs in
//! a worker (`runner`), so that a function that hangs or crashes a driver is only a line of the report. Compilers run in workers
//! too (`compile`).

mod admission;
mod auditor;
mod bind;
mod choose;
mod comparison;
mod compile;
mod condition;
mod cosine;
mod cost;
mod directives;
mod edges;
mod error;
mod hidden;
mod inputs;
mod loops;
mod ours;
mod parts;
mod preprocess;
mod program;
mod quantity;
mod reach;
mod row;
mod runner;
mod scan;
mod slice;
mod type_names;
mod variables;

use core::time::Duration;
use std::path::PathBuf;

use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::Family;
use crate::physics::spectra::Space;
use auditor::Auditor;
use condition::desktop_version;

pub use comparison::ExactFit;
pub use condition::Language;
pub use cost::AuditCost;
pub use edges::EdgeRow;
pub use error::{Error, FunctionPlace, MissingArgument, ValueFault};
pub use inputs::Given;
pub use preprocess::Define;
pub use row::{ArgumentValue, AuditRow, Checked, ConditionRow, Dominating, PerceivedFigures};
pub use runner::serve;

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

/// The rows of an audit.
#[derive(Debug, Default)]
pub struct AuditRows {
    /// A row for each material that has values for all arguments.
    pub rows: Vec<AuditRow>,
    /// Why other materials have no row.
    pub skipped: Vec<String>,
}

impl Audit {
    /// A row for each material. If there are several, those without a value for an argument are skipped.
    ///
    /// # Errors
    /// The file does not hold the function, or its arguments are not bound for any material.
    pub fn rows(
        &self,
        subjects: &[MaterialInMedium],
        progress: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<AuditRows, Error> {
        if let Some(godot) = self.in_godot() {
            return godot.rows_in(subjects, progress);
        }
        if self.language != Language::Gles {
            return self.rows_in(subjects, progress);
        }
        if let Some(version) = desktop_version(&self.text) {
            return self.on_the_desktop(version).rows_in(subjects, progress);
        }
        let found = self.rows_in(subjects, progress)?;
        let is_refused = |row: &AuditRow| row.checked.accepted == Some(false);
        if self.text.contains("#version") || !found.rows.iter().all(is_refused) {
            return Ok(found);
        }
        // Many desktop files leave their version to the file that includes them.
        let mut desktop = self.on_the_desktop(450).rows_in(subjects, progress)?;
        for row in &mut desktop.rows {
            row.language_remark = Some(
                "GLSL 4.50: the file states no `#version`, and GLSL ES 3.00 refuses it".to_owned(),
            );
        }
        let is_accepted = |row: &AuditRow| row.checked.accepted == Some(true);
        Ok(if desktop.rows.iter().all(is_accepted) {
            desktop
        } else {
            found
        })
    }

    /// This audit with the constants of Godot's shaders, if the text is one of them.
    fn in_godot(&self) -> Option<Audit> {
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
    fn on_the_desktop(&self, version: u32) -> Audit {
        let mut audit = self.clone();
        audit.language = Language::Glsl;
        audit.defines.insert(0, Define::of("__VERSION__", version));
        audit
    }

    fn rows_in(
        &self,
        subjects: &[MaterialInMedium],
        progress: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<AuditRows, Error> {
        let auditor = Auditor::new(self)?;
        let mut found = AuditRows::default();
        let mut first = None;
        for subject in subjects {
            match auditor.row(subject, subjects, progress) {
                Ok(row) => found.rows.push(row),
                Err(error @ Error::Unbound { .. }) => {
                    found.skipped.push(error.to_string());
                    first.get_or_insert(error);
                }
                Err(error) => return Err(error),
            }
        }
        match first {
            Some(error) if found.rows.is_empty() => Err(error),
            _ => Ok(found),
        }
    }

    fn limit(&self) -> Duration {
        Duration::from_secs(self.seconds)
    }
}
