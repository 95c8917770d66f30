//! Bounds of code error. Those of specialised functions are recorded in `data/code-bounds.csv`, and for half precision in
//! `data/code-bounds-f16.csv`. They are keyed by what the function computes, and a test measures them again. A function without a
//! record says so.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::generator::fit::Measured;
use crate::language::ir::{Checked, Function, print};
use crate::physics::digest::sha256;
use crate::physics::num::Precision;
use crate::physics::records;

/// The code error of functions that read a texture: a sampler may round its weights to multiples of 1/256, or truncate them.
pub const FILTERED: &str = "at most 1/256 of the difference of two neighbouring texels, as samplers weigh them in so many steps";

static RECORD: &str = include_str!("../../../data/code-bounds.csv");
static HALF_RECORD: &str = include_str!("../../../data/code-bounds-f16.csv");

/// What a function promises of its code error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CodeBound {
    /// In single precision: units in the last place, or 2⁻²² absolute.
    Ulp(f64),
    /// In half precision, and for coefficients: the absolute difference.
    Absolute(f64),
}

impl CodeBound {
    /// The number, in the bound's own unit.
    pub fn value(self) -> f64 {
        match self {
            CodeBound::Ulp(value) | CodeBound::Absolute(value) => value,
        }
    }
}

/// The largest error in ulp with which a plain form is written in place of the stable one.
pub const PLAIN_ULP: f64 = 10.0;

/// The recorded bounds, by fingerprint.
#[derive(Clone, Debug, Default)]
pub struct Bounds {
    ulp: BTreeMap<String, f64>,
    absolute: BTreeMap<String, f64>,
}

impl Bounds {
    /// The bounds recorded in the program.
    pub fn recorded() -> Bounds {
        let ulp = records::rows::<UlpBound>(RECORD).into_iter();
        let absolute = records::rows::<AbsoluteBound>(HALF_RECORD).into_iter();
        Bounds {
            ulp: ulp.map(|row| (row.fingerprint, row.max_ulp)).collect(),
            absolute: absolute.map(|row| (row.fingerprint, row.max_abs)).collect(),
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

/// The bound of a function in single precision.
#[derive(Deserialize)]
struct UlpBound {
    fingerprint: String,
    max_ulp: f64,
}

/// The bound of a function in half precision.
#[derive(Deserialize)]
struct AbsoluteBound {
    fingerprint: String,
    max_abs: f64,
}

/// The fingerprint of what a function computes, in 16 hexadecimal digits: names of steps and reasons do not count.
pub fn fingerprint(function: &Checked) -> String {
    let mut bare: Function = (**function).clone();
    bare.name = "f".to_owned();
    bare.nodes.iter_mut().for_each(|node| node.label = None);
    sha256(print(&bare).as_bytes())[..16].to_owned()
}
