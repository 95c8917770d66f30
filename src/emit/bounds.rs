//! The code bounds of specialised functions: recorded in `data/code-bounds.csv`, for half precision in
//! `data/code-bounds-f16.csv`, keyed by what the function computes, and measured again by a test. A function that is not
//! in the record says so.

use std::collections::BTreeMap;

use sha2::{Digest, Sha256};

use crate::fit::Measured;
use crate::ir::{Checked, Function, print};
use crate::num::Precision;

static RECORD: &str = include_str!("../../data/code-bounds.csv");
static HALF_RECORD: &str = include_str!("../../data/code-bounds-f16.csv");

/// What a function promises of its code error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CodeBound {
    /// In single precision: units in the last place, beside 2⁻²².
    Ulp(f64),
    /// In half precision: the absolute difference.
    Absolute(f64),
}

/// The most that a plain form may be off to be written in place of the stable one.
pub const PLAIN_ULP: f64 = 10.0;

/// The record, by fingerprint.
#[derive(Clone, Debug, Default)]
pub struct Bounds {
    ulp: BTreeMap<String, f64>,
    absolute: BTreeMap<String, f64>,
}

impl Bounds {
    /// The record that is part of the program.
    pub fn recorded() -> Bounds {
        Bounds {
            ulp: column(RECORD),
            absolute: column(HALF_RECORD),
        }
    }

    /// The bound of a function in this precision.
    pub fn of(&self, precision: Precision, function: &Checked) -> Measured<CodeBound> {
        let mark = fingerprint(function);
        let bound = match precision {
            Precision::F32 => self.ulp.get(&mark).copied().map(CodeBound::Ulp),
            Precision::F16 => self.absolute.get(&mark).copied().map(CodeBound::Absolute),
        };
        let none = || Measured::No("not measured for this material".to_owned());
        bound.map_or_else(none, Measured::Yes)
    }
}

/// The record of half precision: material, method and bound of each row.
pub fn half_record() -> impl Iterator<Item = (&'static str, &'static str, f64)> {
    HALF_RECORD.lines().skip(1).filter_map(|line| {
        let mut cells = line.split(',').skip(1);
        Some((cells.next()?, cells.next()?, cells.next()?.parse().ok()?))
    })
}

/// The bounds of a record: the column after fingerprint, material and method.
fn column(record: &str) -> BTreeMap<String, f64> {
    let row = |line: &str| {
        let mut cells = line.split(',');
        Some((cells.next()?.to_owned(), cells.nth(2)?.parse().ok()?))
    };
    record.lines().skip(1).filter_map(row).collect()
}

/// What a function computes, in 16 hexadecimal digits: names of steps and reasons do not count.
pub fn fingerprint(function: &Checked) -> String {
    let mut bare: Function = (**function).clone();
    bare.name = "f".to_owned();
    bare.nodes.iter_mut().for_each(|node| node.label = None);
    sha256(print(&bare).as_bytes())[..16].to_owned()
}

/// The SHA-256 of these bytes in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
