//! The code bounds of specialised functions: recorded in `data/code-bounds.csv`, for half precision in
//! `data/code-bounds-f16.csv`, keyed by what the function computes, and measured again by a test. A function that is not
//! in the record says so.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::generator::fit::Measured;
use crate::language::ir::{Checked, Function, print};
use crate::physics::digest::sha256;
use crate::physics::num::Precision;
use crate::physics::records;

static RECORD: &str = include_str!("../../../data/code-bounds.csv");
static HALF_RECORD: &str = include_str!("../../../data/code-bounds-f16.csv");

/// What a function promises of its code error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CodeBound {
    /// In single precision: units in the last place, beside 2⁻²².
    Ulp(f64),
    /// In half precision, and of coefficients: the absolute difference.
    Absolute(f64),
}

impl CodeBound {
    /// The number.
    pub fn value(self) -> f64 {
        match self {
            CodeBound::Ulp(value) | CodeBound::Absolute(value) => value,
        }
    }
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
        let single: Vec<SingleBound> = records::rows(RECORD);
        let half = half_bounds().into_iter();
        Bounds {
            ulp: single
                .into_iter()
                .map(|row| (row.fingerprint, row.max_ulp))
                .collect(),
            absolute: half.map(|row| (row.fingerprint, row.max_abs)).collect(),
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

/// The bound of a specialised function in half precision.
#[derive(Clone, Debug, Deserialize)]
pub struct HalfBound {
    /// What the function computes.
    pub fingerprint: String,
    /// Its material.
    pub material: String,
    /// Its method.
    pub method: String,
    /// The largest difference from its meaning.
    pub max_abs: f64,
}

/// The bound of a specialised function in single precision.
#[derive(Deserialize)]
struct SingleBound {
    fingerprint: String,
    max_ulp: f64,
}

/// The record of half precision.
pub fn half_bounds() -> Vec<HalfBound> {
    records::rows(HALF_RECORD)
}

/// What a function computes, in 16 hexadecimal digits: names of steps and reasons do not count.
pub fn fingerprint(function: &Checked) -> String {
    let mut bare: Function = (**function).clone();
    bare.name = "f".to_owned();
    bare.nodes.iter_mut().for_each(|node| node.label = None);
    sha256(print(&bare).as_bytes())[..16].to_owned()
}
