//! The record of times: what `fresnel-gen time` measured, and on what. `tests/times` writes it.

use serde::Deserialize;

use crate::generator::emit::FunctionForm;
use crate::physics::num::Precision;
use crate::physics::records;

static RECORD: &str = include_str!("../../../data/records/times.csv");

/// A line of the record.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Time {
    /// The method.
    pub method: String,
    /// The material that it is specialised to; empty for the library.
    pub material: String,
    /// What it takes and gives.
    pub form: FunctionForm,
    /// 1 or 3.
    pub channels: u8,
    /// What it computes in.
    pub precision: Precision,
    /// Nanoseconds a pixel of a draw that evaluates it once.
    pub ns_per_pixel: f64,
    /// Its net cost over that of `dielectric_exact`.
    pub share: f64,
    /// The range of the middle half of single rounds' shares, over their median.
    pub spread: f64,
    /// The device.
    pub device: String,
    /// Its driver.
    pub driver: String,
}

/// All lines, in the record's order.
pub fn times() -> Vec<Time> {
    records::rows(RECORD)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods;

    #[test]
    fn every_line_of_the_record_is_read() {
        for time in times() {
            assert!(methods::find(&time.method).is_some(), "{time:?}");
            assert_eq!(
                time.channels == 1,
                time.form == FunctionForm::Scalar,
                "{time:?}"
            );
            assert!(time.share > 0.0 && time.spread >= 0.0, "{time:?}");
        }
    }
}
