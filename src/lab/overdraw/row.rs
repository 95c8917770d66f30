//! The cost of a function by overdraw as a row of reports, the errors of a measurement, and the record of times with their devices.
//! `fresnel-gen time` measures what is recorded, and `tests/times` writes the record.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::drawing_device::DeviceFacts;
use super::figure::OverdrawFigure;
use super::functions::TimedFunctions;
use super::measure::{Clock, MeasuredDrawings};
use super::plan::TimedFunction;
use crate::generator::emit::FunctionForm;
use crate::lab::process;
use crate::language::ir::Ty;
use crate::physics::num::Precision;
use crate::physics::records;

/// A function and its cost.
#[derive(Clone, Debug, Serialize)]
#[serde(into = "TimeRowJson")]
pub struct TimeRow {
    /// The method.
    pub method: &'static str,
    /// The material that it is specialised to, as a user types it.
    pub material: Option<String>,
    /// Its form.
    pub form: FunctionForm,
    /// The number of channels, 1 or 3.
    pub channels: u8,
    /// The precision that it computes in.
    pub precision: Precision,
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
    timed: &TimedFunctions,
    device: &DeviceFacts,
    measured: &MeasuredDrawings,
) -> Vec<TimeRow> {
    let figures = measured.figures(&timed.plan, device.pixels);
    let functions = timed.functions.iter().zip(figures);
    let time_row = |(function, figure): (&TimedFunction, _)| {
        let emitted = &function.emitted;
        let is_lacking = emitted.precision.is_half() && !device.has_half;
        let is_scalar = emitted.function.ty() == Ty::Scalar;
        TimeRow {
            method: emitted.method.name,
            material: function.material.clone(),
            form: emitted.form,
            channels: if is_scalar { 1 } else { 3 },
            precision: emitted.precision,
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

/// The row in a report's JSON.
#[derive(Serialize)]
struct TimeRowJson {
    method: &'static str,
    material: Option<String>,
    form: FunctionForm,
    channels: u8,
    precision: Precision,
    ns_per_pixel: Option<f64>,
    share: Option<f64>,
    spread: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    net_ns_per_pixel: Option<f64>,
    empty_ns_per_pixel: Option<f64>,
    gpu_ns_per_pixel: Option<f64>,
    wall_ns_per_pixel: Option<f64>,
    clock: Clock,
    draws: Option<u32>,
    evaluations: Option<usize>,
    rounds: usize,
    reason: Option<String>,
}

impl From<TimeRow> for TimeRowJson {
    fn from(row: TimeRow) -> TimeRowJson {
        let figure = row.figure.as_ref().ok();
        let number =
            |one: fn(&OverdrawFigure) -> f64| figure.map(one).filter(|value| value.is_finite());
        let interval = figure.and_then(|figure| figure.interval);
        TimeRowJson {
            ns_per_pixel: number(|f| f.ns_per_pixel),
            share: number(|f| f.share),
            spread: number(|f| f.spread),
            low: interval.map(|(low, _)| low),
            high: interval.map(|(_, high)| high),
            net_ns_per_pixel: number(|f| f.net_ns_per_pixel),
            empty_ns_per_pixel: number(|f| f.empty_ns_per_pixel),
            gpu_ns_per_pixel: number(|f| f.gpu_ns_per_pixel),
            wall_ns_per_pixel: number(|f| f.wall_ns_per_pixel),
            clock: row.clock,
            draws: figure.map(|f| f.draws),
            evaluations: figure.map(|f| f.evaluations),
            rounds: row.rounds,
            reason: row.reason(),
            method: row.method,
            material: row.material,
            form: row.form,
            channels: row.channels,
            precision: row.precision,
        }
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
    #[error("{0}")]
    Device(String),
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
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Time {
    /// The method.
    pub method: String,
    /// The material that it is specialised to. Empty for the library.
    pub material: String,
    /// Its form.
    pub form: FunctionForm,
    /// The number of channels, 1 or 3.
    pub channels: u8,
    /// The precision that it computes in.
    pub precision: Precision,
    /// Nanoseconds per pixel of a draw that evaluates it once.
    pub ns_per_pixel: f64,
    /// Its net cost divided by that of `dielectric_exact`.
    pub share: f64,
    /// The interquartile range of single rounds' shares, divided by their median.
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
