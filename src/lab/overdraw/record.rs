//! The record of times with their devices. `fresnel-gen time` measures what is recorded, and `tests/times` writes the record.

use serde::Deserialize;

use crate::generator::emit::FunctionForm;
use crate::language::methods::{Method, find};
use crate::physics::num::Precision;
use crate::physics::records;

static RECORD: &str = include_str!("../../../data/records/times.csv");

/// A line of the record.
#[derive(Debug, Deserialize)]
struct RecordedTime {
    method: String,
    form: FunctionForm,
    precision: Precision,
    share: f64,
    device: String,
}

/// The recorded time of a library function of three channels in single precision.
#[derive(Clone, Debug)]
pub struct LibraryTime {
    /// The method.
    pub method: &'static Method,
    /// Its net cost divided by that of `dielectric_exact`.
    pub share: f64,
    /// The device.
    pub device: String,
}

/// The recorded times of library functions, in the record's order.
pub fn library_times() -> Vec<LibraryTime> {
    let rows: Vec<RecordedTime> = records::rows(RECORD);
    let plain = rows
        .into_iter()
        .filter(|row| row.form == FunctionForm::Library && row.precision == Precision::F32);
    let time = |row: RecordedTime| {
        Some(LibraryTime {
            method: find(&row.method)?,
            share: row.share,
            device: row.device,
        })
    };
    plain.filter_map(time).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_record_is_read() {
        /// Nanoseconds, share, spread.
        type Figures = (f64, f64, f64);
        /// Method, material, form, channels, precision, figures, device, driver.
        type Line = (
            String,
            String,
            FunctionForm,
            u8,
            Precision,
            Figures,
            String,
            String,
        );
        for line in records::rows::<Line>(RECORD) {
            let (method, _, form, channels, _, (_, share, spread), ..) = line;
            assert!(find(&method).is_some(), "{method}");
            assert_eq!(channels == 1, form == FunctionForm::Scalar, "{method}");
            assert!(share > 0.0 && spread >= 0.0, "{method}");
        }
    }
}
