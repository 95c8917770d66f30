//! The errors of methods whose numbers were chosen on a class of materials, where each substance is judged by numbers that were chosen
//! without it. `tests/fit-f82 --left-out` finds these figures.

use serde::Serialize;

use super::sets::{MaterialSet, STATISTICS, set_name};
use crate::generator::reference::MaterialClass;
use crate::language::methods::Method;
use crate::physics::records::rows;

static RECORD: &str = include_str!("../../../data/records/left-out.csv");

/// Statistics of the largest errors over angles and channels, for materials judged by numbers that were chosen without their
/// substance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeftOutErrors {
    /// The median over measurements.
    pub median: f64,
    /// The 90th percentile over measurements.
    pub p90: f64,
    /// The median over substances.
    pub median_by_substance: f64,
    /// The 90th percentile over substances.
    pub p90_by_substance: f64,
}

/// The number of the sample's measurements that are of metals.
const METALS_OF_THE_SAMPLE: usize = 66;

/// The left-out errors of a method over the sample of metals and semiconductors on which its numbers were chosen. None for sets
/// of other materials or of fewer metals than the sample has, and for methods whose numbers were not chosen on it.
pub fn left_out(method: &Method, set: &MaterialSet) -> Option<LeftOutErrors> {
    let is_set = |statistic| set.name == set_name(MaterialClass::Metals, statistic);
    if set.count < METALS_OF_THE_SAMPLE || !STATISTICS.into_iter().any(is_set) {
        return None;
    }
    let recorded: Vec<(String, f64, f64, f64, f64)> = rows(RECORD);
    let own = recorded.into_iter().find(|row| row.0 == method.name)?;
    let (_, median, p90, median_by_substance, p90_by_substance) = own;
    Some(LeftOutErrors {
        median,
        p90,
        median_by_substance,
        p90_by_substance,
    })
}
