//! Audit: a user's own function compared with the reference reflectance of a material, and with our methods.
//!
//! This room decides the conditions of the text (`preprocess`), cuts out the function and what it needs (`slice`), and names its
//! inputs from outside (`hidden`). Compilers see only that part. A program of ours around the user's function (`program`) runs in a
//! worker (`runner` asks, `worker` answers), so that a function that hangs or crashes a driver is only a line of the report.
//! Compilers run in workers too (`compile`). Files import one way.

mod admission;
mod auditor;
mod bind;
mod choose;
mod comparison;
mod compile;
mod compilers;
mod condition;
mod cosine;
mod cost;
mod directives;
mod edges;
mod error;
mod hidden;
mod inputs;
mod language;
mod loops;
mod ours;
mod parts;
mod preprocess;
mod program;
mod quantity;
mod reach;
mod request;
mod row;
mod runner;
mod slice;
mod type_names;
mod variables;
mod worker;

use crate::generator::reference::MaterialInMedium;
use auditor::Auditor;
use language::desktop_version;

pub use comparison::ExactFit;
pub use cost::AuditCost;
pub use error::Error;
pub use language::Language;
pub use preprocess::{Condition, Define};
pub use request::{Audit, Given};
pub use row::{AuditRow, CheckResults};
pub use worker::serve;

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
}
