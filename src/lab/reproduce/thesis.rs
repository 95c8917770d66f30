//! The figures that the thesis prints, as `data/thesis-tables.json` records them.
//!
//! Source: Štetić-Kozić, "Poređenje metoda za računanje koeficijenata Frenelove refleksije u programima za senčenje",
//! diploma thesis, School of Electrical Engineering, University of Belgrade, 2014.

use std::sync::LazyLock;

use serde_json::Value;

static RECORD: LazyLock<Value> = LazyLock::new(|| {
    serde_json::from_str(include_str!("../../../data/thesis-tables.json"))
        .expect("the record is part of the program, and a test reads it")
});

/// How many angles the function errors are taken at (section 5.2).
pub const ANGLES: usize = 1_000_000;

/// cos θ at which the text says that λ is matched: 84.26 degrees (section 3.2.4).
pub const TEXT_MATCHING_COS: f64 = 0.10;

/// One figure, by the keys that lead to it.
pub fn number(keys: &[&str]) -> f64 {
    let found = at(keys).as_f64();
    found.expect("the keys are constants, and a test reads them all")
}

/// A row of figures.
pub fn numbers(keys: &[&str]) -> Vec<f64> {
    let row = at(keys).as_array().into_iter().flatten();
    row.map(|value| value.as_f64().expect("a row of figures holds figures"))
        .collect()
}

/// A row of names.
pub fn names(keys: &[&str]) -> Vec<&'static str> {
    let row = at(keys).as_array().into_iter().flatten();
    row.filter_map(Value::as_str).collect()
}

/// The devices of a table of times, in the order of the thesis.
pub fn devices(table: &str) -> Vec<&'static str> {
    let entries = at(&[table]).as_object().into_iter().flatten();
    let rows = entries.filter(|(_, row)| row.get(0).is_some_and(Value::is_number));
    rows.map(|(name, _)| name.as_str()).collect()
}

fn at(keys: &[&str]) -> &'static Value {
    keys.iter().fold(&RECORD, |value, key| &value[*key])
}
