//! The record of `tests/exhaustive`: every f32 from 0 to 1, through WGSL as it runs.

use std::sync::LazyLock;

use serde::Deserialize;

use fresnel_gen::physics::records;

static RECORD: LazyLock<Vec<Line>> =
    LazyLock::new(|| records::rows(include_str!("../../data/records/exhaustive.csv")));

/// A line of the record. The test that runs functions needs the graphics stack; it reads the fields that others do not.
#[derive(Deserialize)]
pub struct Line {
    pub method: String,
    pub material: String,
    pub fingerprint: String,
    pub points: u64,
    pub max_ulp: f64,
    pub max_abs: f64,
    pub device: String,
}

/// All lines.
pub fn lines() -> impl Iterator<Item = &'static Line> {
    RECORD.iter()
}

/// The largest error in ulp of the function with this fingerprint, 0 where it is not in the record.
pub fn max_ulp(fingerprint: &str) -> f64 {
    let same = lines().find(|line| line.fingerprint == fingerprint);
    same.map_or(0.0, |line| line.max_ulp)
}
