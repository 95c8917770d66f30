//! The record of the catalogue's rows for the default viewing conditions, `data/records/catalogue.json`. Deriving them takes a
//! hundred times as long as the rest of a run. The record holds for material files and fitted shapes with the recorded hashes,
//! and a test derives it again.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::row::CatalogueRow;
use crate::generator::emit::code_bound::fingerprint;
use crate::language::methods::{self, Method};
use crate::physics::digest::sha256;
use crate::physics::materials::{self, ViewingConditions};

static RECORD: &str = include_str!("../../../../data/records/catalogue.json");

#[derive(Deserialize)]
struct Record {
    /// The fingerprint of each fitted method.
    methods: BTreeMap<String, String>,
    /// The first half of the SHA-256 digits of each material's file.
    files: BTreeMap<String, String>,
    /// The materials for which there is a fitted method, in the order of the catalogue.
    rows: Vec<CatalogueRow>,
}

/// The recorded rows in air. None for other viewing conditions, or where a material's file or a fitted method has changed since.
pub fn recorded_catalogue(viewing: &ViewingConditions) -> Option<Vec<CatalogueRow>> {
    if *viewing != ViewingConditions::default() {
        return None;
    }
    let mut record: Record = serde_json::from_str(RECORD).ok()?;
    if record.files != files() || record.methods != fitted_methods() {
        return None;
    }
    for row in &mut record.rows {
        row.argument = row.name.clone();
    }
    Some(record.rows)
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
