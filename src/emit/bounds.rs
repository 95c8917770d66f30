//! The code bounds of specialised functions: recorded in `data/code-bounds.csv`, keyed by what the function computes,
//! and measured again by a test. A function that is not in the record says so.

use std::collections::BTreeMap;

use sha2::{Digest, Sha256};

use crate::fit::Measured;
use crate::ir::{Checked, Function, print};

static RECORD: &str = include_str!("../../data/code-bounds.csv");

/// The record, by fingerprint.
#[derive(Clone, Debug, Default)]
pub struct Bounds {
    ulp: BTreeMap<String, f64>,
}

impl Bounds {
    /// The record that is part of the program.
    pub fn recorded() -> Bounds {
        let row = |line: &str| {
            let mut cells = line.split(',');
            Some((cells.next()?.to_owned(), cells.nth(2)?.parse().ok()?))
        };
        Bounds {
            ulp: RECORD.lines().skip(1).filter_map(row).collect(),
        }
    }

    /// The bound of a function, in ulp.
    pub fn of(&self, function: &Checked) -> Measured<f64> {
        match self.ulp.get(&fingerprint(function)) {
            Some(ulp) => Measured::Yes(*ulp),
            None => Measured::No("not measured for this material".to_owned()),
        }
    }
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
