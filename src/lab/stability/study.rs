//! A study: the rows of scans of several methods, in their library form or specialised to materials. Each row is a failure of a
//! method, or states that it has none.

use serde::Serialize;

use super::failure::Failure;
use super::scan::{Finding, ScannedFunction, scan, scan_specialised};
use crate::generator::emit::{self, Bounds, Naming, specialised_function};
use crate::generator::reference::MaterialInMedium;
use crate::lab::verify::as_object;
use crate::language::methods::Method;
use crate::physics::num::Precision;

/// Called with how much is done, of how much, and for what.
pub type StudyProgress<'a> = &'a mut dyn FnMut(u64, u64, &str);

/// The methods and the precision of a study.
#[derive(Clone, Debug)]
pub struct Study {
    /// The methods.
    pub methods: Vec<&'static Method>,
    /// The precision that they compute in.
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

    /// The rows of functions specialised to materials, for each channel.
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

/// A failure of a method, with its function's material and precision.
#[derive(Clone, Debug, Serialize)]
#[serde(into = "FlatRow")]
pub struct StabilityRow {
    /// The method.
    pub method: &'static str,
    /// The material that it is specialised to, and the channel.
    pub material: Option<(String, &'static str)>,
    /// The precision that the function computes in.
    pub precision: &'static str,
    /// The failure. None where there is none.
    pub finding: Option<Finding>,
}

/// A row in the form of JSON reports.
#[derive(Serialize)]
struct FlatRow {
    method: &'static str,
    material: Option<String>,
    channel: Option<&'static str>,
    precision: &'static str,
    failure: Option<String>,
    fault_of: Option<&'static str>,
    points: Option<&'static str>,
    region: Option<String>,
    share: Option<f64>,
    worst: Option<Worst>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// The worst point, and the values there.
#[derive(Serialize)]
struct Worst {
    #[serde(serialize_with = "as_object")]
    at: Vec<(&'static str, f64)>,
    amount: f64,
    got: Option<f64>,
    expected: Option<f64>,
    law: Option<f64>,
}

impl From<StabilityRow> for FlatRow {
    fn from(row: StabilityRow) -> FlatRow {
        let (material, channel) = row.material.unzip();
        let finding = row.finding.as_ref();
        FlatRow {
            method: row.method,
            material,
            channel,
            precision: row.precision,
            failure: finding.map(|finding| finding.failure.words()),
            fault_of: finding.map(|finding| fault_of(finding.failure)),
            points: finding.map(kind_of_points),
            region: finding.map(|finding| finding.region.clone()),
            share: finding.map(|finding| finding.share),
            worst: finding.map(worst),
            reason: finding.is_none().then_some("nothing was found"),
        }
    }
}

fn worst(finding: &Finding) -> Worst {
    Worst {
        at: finding.worst.clone(),
        amount: finding.amount,
        got: finding.point.map(|point| point.got),
        expected: finding.point.map(|point| point.want),
        law: finding.point.and_then(|point| point.law),
    }
}

/// The cause of a failure, in a word: the formula or its rounding.
fn fault_of(failure: Failure) -> &'static str {
    if failure.is_of_the_model() {
        "formula"
    } else {
        "rounding"
    }
}

fn kind_of_points(finding: &Finding) -> &'static str {
    if finding.is_media {
        "media"
    } else {
        "arguments"
    }
}
