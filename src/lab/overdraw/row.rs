//! The cost of a function by overdraw as a row of reports, the errors of a measurement, and the record of times with their devices.
//! `fresnel-gen time` measures what is recorded, and `tests/times` writes the record.

use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};
use thiserror::Error;

use super::drawing_device::DeviceFacts;
use super::figure::OverdrawFigure;
use super::measure::{Clock, MeasuredDrawings};
use super::plan::{DrawingPlan, TimedFunction};
use crate::generator::emit::FunctionForm;
use crate::lab::cost::FunctionId;
use crate::lab::fault::Fault;
use crate::lab::process;
use crate::language::methods::{Method, find};
use crate::physics::num::Precision;
use crate::physics::records;

/// A function and its cost.
#[derive(Clone, Debug)]
pub struct TimeRow {
    /// The function.
    pub id: FunctionId,
    /// Its cost, or why that is not known.
    pub figure: Result<OverdrawFigure, String>,
    /// Whether the machine lacks what it needs.
    pub is_lacking: bool,
    /// The clock that the time was taken by.
    pub clock: Clock,
    /// The number of rounds in which it was drawn.
    pub rounds: usize,
}

/// The rows of functions that were measured on a device, in the order of the plan.
pub fn time_rows(
    functions: &[TimedFunction],
    plan: &DrawingPlan,
    device: &DeviceFacts,
    measured: &MeasuredDrawings,
) -> Vec<TimeRow> {
    let figures = measured.figures(plan, device.pixels);
    let functions = functions.iter().zip(figures);
    let time_row = |(function, figure): (&TimedFunction, _)| {
        let is_lacking = function.id.precision.is_half() && !device.has_half;
        TimeRow {
            id: function.id.clone(),
            figure: if is_lacking {
                Err(device.no_half())
            } else {
                figure
            },
            is_lacking,
            clock: measured.clock,
            rounds: measured.rounds.len(),
        }
    };
    functions.map(time_row).collect()
}

impl Serialize for TimeRow {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let figure = self.figure.as_ref().ok();
        let number =
            |one: fn(&OverdrawFigure) -> f64| figure.map(one).filter(|value| value.is_finite());
        let (low, high) = figure.and_then(|figure| figure.interval).unzip();
        let mut row = to.serialize_map(None)?;
        self.id.serialize_columns(&mut row)?;
        row.serialize_entry("ns_per_pixel", &number(|f| f.ns_per_pixel))?;
        row.serialize_entry("share", &number(|f| f.share))?;
        row.serialize_entry("spread", &number(|f| f.spread))?;
        row.serialize_entry("low", &low)?;
        row.serialize_entry("high", &high)?;
        row.serialize_entry("net_ns_per_pixel", &number(|f| f.net_ns_per_pixel))?;
        row.serialize_entry("empty_ns_per_pixel", &number(|f| f.empty_ns_per_pixel))?;
        row.serialize_entry("gpu_ns_per_pixel", &number(|f| f.gpu_ns_per_pixel))?;
        row.serialize_entry("wall_ns_per_pixel", &number(|f| f.wall_ns_per_pixel))?;
        row.serialize_entry("clock", &self.clock)?;
        row.serialize_entry("draws", &figure.map(|f| f.draws))?;
        row.serialize_entry("evaluations", &figure.map(|f| f.evaluations))?;
        row.serialize_entry("rounds", &self.rounds)?;
        row.serialize_entry("reason", &self.reason())?;
        row.end()
    }
}

impl TimeRow {
    /// Why there is no figure, or no interval.
    fn reason(&self) -> Option<String> {
        match &self.figure {
            Err(why) => Some(why.clone()),
            Ok(figure) if figure.interval.is_none() => {
                Some("an interval takes 29 rounds".to_owned())
            }
            Ok(_) => None,
        }
    }
}

/// Why nothing can be drawn.
#[derive(Debug, Error)]
pub enum Error {
    /// The process that draws cannot be started.
    #[error(transparent)]
    Process(#[from] process::Error),
    /// There is no graphics device, or its driver fails, with this message.
    #[error(transparent)]
    Device(Fault),
    /// The process that should open the device gives an unexpected answer.
    #[error("a process that does not greet")]
    Protocol,
    /// The driver hangs.
    #[error("no graphics device opened within {0} s: its driver hangs")]
    Hangs(u64),
    /// The driver crashes its process.
    #[error("the process that opens the graphics device ended ({0}): its driver failed")]
    Ended(String),
}

impl Error {
    /// Whether the machine lacks something. Otherwise the user's flags are at fault.
    pub fn is_lacking(&self) -> bool {
        match self {
            Error::Process(error) => error.is_lacking(),
            _ => true,
        }
    }
}

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
        /// Method, material, form, channels, precision, nanoseconds, share, spread.
        type Line = (String, String, FunctionForm, u8, Precision, f64, f64, f64);
        for (method, _, form, channels, _, _, share, spread) in records::rows::<Line>(RECORD) {
            assert!(find(&method).is_some(), "{method}");
            assert_eq!(channels == 1, form == FunctionForm::Scalar, "{method}");
            assert!(share > 0.0 && spread >= 0.0, "{method}");
        }
    }
}
