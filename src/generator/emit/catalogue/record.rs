//! The record of the catalogue's rows for the default viewing conditions, `data/records/catalogue.json`. Deriving them takes a
//! hundred times as long as the rest of a run. The record holds for material files and fitted shapes with the recorded hashes,
//! and a test derives it again.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{CatalogueRow, CloserFit};
use crate::generator::emit::{Average, fingerprint};
use crate::generator::fit::ModelError;
use crate::language::methods::{self, Method};
use crate::physics::digest::sha256;
use crate::physics::materials::{self, MaterialKind, ViewingConditions};

static RECORD: &str = include_str!("../../../../data/records/catalogue.json");

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Record {
    /// The fingerprint of each fitted method.
    methods: BTreeMap<String, String>,
    /// The first half of the SHA-256 digits of each material's file.
    files: BTreeMap<String, String>,
    /// The materials for which there is a fitted method, in the order of the catalogue.
    rows: Vec<Recorded>,
}

/// A row of the catalogue, with methods by name.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Recorded {
    name: String,
    class: String,
    method: String,
    coefficients: Vec<[f64; 3]>,
    error: ModelError,
    average: Average,
    better: Option<RecordedBetter>,
    held: Option<String>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct RecordedBetter {
    method: String,
    coefficients: Vec<[f64; 3]>,
    max_abs: f64,
}

/// The recorded rows in air. None for other viewing conditions, or where a material's file or a fitted method has changed since.
pub fn recorded_catalogue(viewing: &ViewingConditions) -> Option<Vec<CatalogueRow>> {
    if *viewing != ViewingConditions::default() {
        return None;
    }
    let record: Record = serde_json::from_str(RECORD).ok()?;
    if record.files != files() || record.methods != fitted_methods() {
        return None;
    }
    record.rows.into_iter().map(Recorded::row).collect()
}

/// The text of the record of these rows.
pub fn catalogue_record(rows: &[CatalogueRow]) -> String {
    let record = Record {
        methods: fitted_methods(),
        files: files(),
        rows: rows.iter().map(Recorded::from_row).collect(),
    };
    let mut text = "{\n\"methods\": ".to_owned();
    text += &line(&record.methods);
    text += ",\n\"files\": ";
    text += &line(&record.files).replace(',', ",\n");
    text += ",\n\"rows\": [\n";
    let rows: Vec<String> = record.rows.iter().map(line).collect();
    text + &rows.join(",\n") + "\n]\n}\n"
}

fn line(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("a record has only text keys")
}

fn fitted_methods() -> BTreeMap<String, String> {
    let fitted = methods::ALL.iter().filter(|method| method.is_fitted());
    let mark = |method: &&Method| {
        let function = method.function(false).expect("a test builds all");
        (method.name.to_owned(), fingerprint(&function))
    };
    fitted.map(mark).collect()
}

fn files() -> BTreeMap<String, String> {
    let hash = |name: &str| {
        let text = materials::source(name).unwrap_or_default();
        (name.to_owned(), sha256(text.as_bytes())[..32].to_owned())
    };
    materials::names().into_iter().map(hash).collect()
}

impl Recorded {
    fn from_row(row: &CatalogueRow) -> Recorded {
        let better = row.better.as_ref().map(|better| RecordedBetter {
            method: better.method.name.to_owned(),
            coefficients: better.coefficients.clone(),
            max_abs: better.max_abs,
        });
        Recorded {
            name: row.name.clone(),
            class: row.class.to_owned(),
            method: row.method.name.to_owned(),
            coefficients: row.coefficients.clone(),
            error: row.error,
            average: row.average,
            better,
            held: row.held.clone(),
        }
    }

    fn row(self) -> Option<CatalogueRow> {
        let class = MaterialKind::ALL
            .iter()
            .find(|kind| kind.name() == self.class)?;
        let better = match self.better {
            Some(better) => Some(CloserFit {
                method: methods::find(&better.method)?,
                coefficients: better.coefficients,
                max_abs: better.max_abs,
            }),
            None => None,
        };
        Some(CatalogueRow {
            argument: self.name.clone(),
            name: self.name,
            class: class.name(),
            method: methods::find(&self.method)?,
            coefficients: self.coefficients,
            error: self.error,
            average: self.average,
            better,
            held: self.held,
        })
    }
}
