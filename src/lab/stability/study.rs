//! A study: the rows of scans of several methods, in their library form or specialised to materials. Each row is a failure of a
//! method, or states that it has none.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::scan::{Finding, ScannedFunction, scan, scan_specialised};
use crate::generator::emit::{self, Bounds, of_cosine};
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
        materials: &[MaterialInMedium],
        progress: StudyProgress,
    ) -> Result<Vec<StabilityRow>, emit::Error> {
        let mut rows = Vec::new();
        for (i, material) in materials.iter().enumerate() {
            progress(i as u64, materials.len() as u64, &material.name);
            let fits = |method: &&&Method| material.is_described_by(method);
            for method in self.methods.iter().filter(fits) {
                rows.extend(self.channel_rows(method, material)?);
            }
        }
        Ok(rows)
    }

    fn channel_rows(
        &self,
        method: &'static Method,
        material: &MaterialInMedium,
    ) -> Result<Vec<StabilityRow>, emit::Error> {
        let bounds = Bounds::recorded();
        let function = |precision| of_cosine(method, material, precision, &bounds);
        let code = ScannedFunction {
            function: function(self.precision)?,
            meaning: function(Precision::F32)?,
            precision: self.precision,
        };
        let reference = material.truth_for(method);
        let channel = |(channel, name): (usize, &'static str)| {
            let found = scan_specialised(&code, channel, &|c| reference.at(c)[channel]);
            self.rows_of(method, Some((material.label().to_owned(), name)), found)
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
            method,
            material: material.clone(),
            precision: self.precision,
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
#[derive(Clone, Debug)]
pub struct StabilityRow {
    /// The method.
    pub method: &'static Method,
    /// The material that it is specialised to, and the channel.
    pub material: Option<(String, &'static str)>,
    /// The precision that the function computes in.
    pub precision: Precision,
    /// The failure. None where there is none.
    pub finding: Option<Finding>,
}

impl Serialize for StabilityRow {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let material = self.material.as_ref().map(|(material, _)| material);
        let channel = self.material.as_ref().map(|(_, channel)| channel);
        let finding = self.finding.as_ref();
        let mut row = to.serialize_map(None)?;
        row.serialize_entry("method", self.method.name)?;
        row.serialize_entry("material", &material)?;
        row.serialize_entry("channel", &channel)?;
        row.serialize_entry("precision", &self.precision)?;
        row.serialize_entry("failure", &finding.map(|finding| finding.failure.words()))?;
        row.serialize_entry("fault_of", &finding.map(fault_of))?;
        row.serialize_entry("points", &finding.map(kind_of_points))?;
        row.serialize_entry("region", &finding.map(|finding| &finding.region))?;
        row.serialize_entry("share", &finding.map(|finding| finding.share))?;
        row.serialize_entry("worst", &finding.map(worst))?;
        if finding.is_none() {
            row.serialize_entry("reason", "nothing was found")?;
        }
        row.end()
    }
}

/// The worst point, and the values there.
#[derive(Serialize)]
struct Worst<'a> {
    #[serde(serialize_with = "as_object")]
    at: &'a [(&'static str, f64)],
    amount: f64,
    got: Option<f64>,
    expected: Option<f64>,
    law: Option<f64>,
}

fn worst(finding: &Finding) -> Worst<'_> {
    Worst {
        at: &finding.worst,
        amount: finding.amount,
        got: finding.point.map(|point| point.got),
        expected: finding.point.map(|point| point.want),
        law: finding.point.and_then(|point| point.law),
    }
}

/// The cause of a failure, in a word: the formula or its rounding.
fn fault_of(finding: &Finding) -> &'static str {
    if finding.is_of_formula() {
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
