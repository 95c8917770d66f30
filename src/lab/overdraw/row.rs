//! The cost of a function by overdraw as a row of reports.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::drawing_device::DeviceFacts;
use super::figure::OverdrawFigure;
use super::measure::{Clock, MeasuredDrawings};
use super::plan::{DrawingPlan, TimedFunction};
use crate::lab::cost::FunctionId;

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
