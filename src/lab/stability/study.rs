//! A study: the rows of several methods, in their library form or specialised to materials.

use crate::generator::emit::{self, Bounds, Naming, specialised_function};
use crate::generator::reference::MaterialInMedium;
use crate::language::methods::Method;
use crate::physics::num::Precision;

use super::row::StabilityRow;
use super::scan::{Finding, ScannedFunction, scan, scan_specialised};

/// Hears how much is done, of how much, of what.
pub type StudyProgress<'a> = &'a mut dyn FnMut(u64, u64, &str);

/// What is scanned.
#[derive(Clone, Debug)]
pub struct Study {
    /// The methods.
    pub methods: Vec<&'static Method>,
    /// What they compute in.
    pub precision: Precision,
}

impl Study {
    /// The rows of library functions, over the media that each describes and over its arguments.
    pub fn library_rows(&self, progress: StudyProgress) -> Vec<StabilityRow> {
        const PARTS: u64 = 1000;
        let all = PARTS * self.methods.len() as u64;
        let mut rows = Vec::new();
        for (i, method) in self.methods.iter().enumerate() {
            let before = PARTS * i as u64;
            let mut scanned = |done: usize, total: usize| {
                let done = PARTS * done as u64 / total.max(1) as u64;
                progress(before + done, all, method.name);
            };
            let found = scan(method, self.precision, &mut scanned);
            rows.extend(self.rows_of(method, None, found));
        }
        rows
    }

    /// The rows of functions specialised to materials, a channel each.
    ///
    /// # Errors
    /// A method cannot be specialised to a material.
    pub fn specialised_rows(
        &self,
        subjects: &[MaterialInMedium],
        progress: StudyProgress,
    ) -> Result<Vec<StabilityRow>, emit::Error> {
        let mut rows = Vec::new();
        for (i, subject) in subjects.iter().enumerate() {
            progress(i as u64, subjects.len() as u64, &subject.name);
            let fits = |method: &&&Method| subject.is_described_by(method);
            for method in self.methods.iter().filter(fits) {
                rows.extend(self.channel_rows(method, subject)?);
            }
        }
        Ok(rows)
    }

    fn channel_rows(
        &self,
        method: &'static Method,
        subject: &MaterialInMedium,
    ) -> Result<Vec<StabilityRow>, emit::Error> {
        let function = |precision: Precision| {
            let naming = Naming {
                precision,
                ..Naming::default()
            };
            specialised_function(method, subject, &naming, &Bounds::recorded())
        };
        let code = ScannedFunction {
            function: function(self.precision)?.function,
            meaning: function(Precision::F32)?.function,
            precision: self.precision,
        };
        let reference = subject.truth_for(method);
        let channel = |(channel, name): (usize, &'static str)| {
            let found = scan_specialised(&code, channel, &|c| reference.at(c)[channel]);
            self.rows_of(method, Some((subject.argument.clone(), name)), found)
        };
        let names = ["red", "green", "blue"].into_iter().enumerate();
        Ok(names.flat_map(channel).collect())
    }

    /// A row for each finding, or one that says that there is none.
    fn rows_of(
        &self,
        method: &'static Method,
        material: Option<(String, &'static str)>,
        findings: Vec<Finding>,
    ) -> Vec<StabilityRow> {
        let row = |finding: Option<Finding>| StabilityRow {
            method: method.name,
            material: material.clone(),
            precision: self.precision.name(),
            finding,
        };
        if findings.is_empty() {
            return vec![row(None)];
        }
        let all = findings.into_iter().map(Some);
        all.map(row).collect()
    }
}
