//! The record of `tests/exhaustive`: every f32 from 0 to 1, through WGSL as it runs.

static RECORD: &str = include_str!("../../data/records/exhaustive.csv");

/// A line of the record. The test that runs functions needs the graphics stack; it reads the fields that others do not.
#[cfg_attr(not(all(feature = "cli", feature = "gpu")), allow(dead_code))]
pub struct Line {
    pub method: &'static str,
    pub material: &'static str,
    pub fingerprint: &'static str,
    pub points: u64,
    pub max_ulp: f64,
    pub max_abs: f64,
    pub device: &'static str,
}

/// All lines.
pub fn lines() -> impl Iterator<Item = Line> {
    let rows = RECORD.lines().filter(|line| !line.starts_with('#'));
    rows.skip(1).map(|text| {
        let cells: Vec<&str> = text.splitn(8, ',').collect();
        Line {
            method: cells[0],
            material: cells[1],
            fingerprint: cells[2],
            points: cells[3].parse().unwrap(),
            max_ulp: cells[4].parse().unwrap(),
            max_abs: cells[5].parse().unwrap(),
            device: cells[7].trim_matches('"'),
        }
    })
}

/// The largest error in ulp of the function with this fingerprint, 0 where it is not in the record.
pub fn max_ulp(fingerprint: &str) -> f64 {
    let same = lines().find(|line| line.fingerprint == fingerprint);
    same.map_or(0.0, |line| line.max_ulp)
}
