//! Audit: a user's own function compared with the reference reflectance of a material, and with our methods.
//!
//! This room decides the conditions of the text (`preprocess`), cuts out the function and what it needs (`slice`), and names what that
//! reads from outside (`hidden`). Compilers read what is left. A program of ours goes around the user's function (`program`). It runs in a
//! worker (`runner`, `serve`), so that a function that hangs or crashes a driver is a line of the report. Compilers run in workers too
//! (`compile`).

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

/// What is audited.
#[derive(Clone, Debug)]
pub struct Audit {
    /// The file's name, for messages.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Its language.
    pub language: Language,
    /// The function; where none is named the file holds one.
    pub function: Option<String>,
    /// Names that are defined for the preprocessor.
    pub defines: Vec<Define>,
    /// Values of its arguments.
    pub given: Vec<Given>,
    /// The space of colours, for errors as they are seen.
    pub space: Space,
    /// The largest error that is no finding.
    pub max_error: Option<f64>,
    /// How many numbers of a material methods of ours may take that it is compared with.
    pub max_inputs: Option<usize>,
    /// The GPUs whose compilers are asked.
    pub families: Vec<&'static Family>,
    /// The folder of compilers that the user names.
    pub tools: Option<PathBuf>,
    /// Seconds that one step may take.
    pub seconds: u64,
    /// Processes at once.
    pub workers: usize,
}

/// The rows of an audit.
#[derive(Debug, Default)]
pub struct AuditRows {
    /// A row for each material that has values for all arguments.
    pub rows: Vec<AuditRow>,
    /// Why others have none.
    pub skipped: Vec<String>,
}

impl Audit {
    /// A row for each material. Of several materials those that have no value for an argument are skipped.
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
        // Many files of the desktop leave their version to what includes them.
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

    /// The same with the constants that Godot's shaders have, where it is one of them.
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

    /// The same as GLSL of the desktop, of the version that its text states.
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
