//! The process that draws: opens the device, and answers each line with a line of JSON: [`HELLO`] with what the device is, a
//! drawing's number and how often it is drawn with a reading.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use crate::gpu::{Fault, Wanted};
use crate::process::Inbox;

use super::drawing_device::{DeviceFacts, DrawingDevice};
use super::measure::Reading;
use super::plan::Plan;

/// What it is asked first.
pub const HELLO: &str = "hello";

/// What it says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// What it draws on.
    DeviceFacts(DeviceFacts),
    /// A reading.
    Reading(Reading),
    /// Something is missing on this machine.
    Absent(String),
    /// The shader or the device failed.
    Failed(String),
}

impl From<Fault> for Answer {
    fn from(fault: Fault) -> Answer {
        match fault {
            Fault::Absent { .. } | Fault::Unable { .. } => Answer::Absent(fault.to_string()),
            _ => Answer::Failed(fault.to_string()),
        }
    }
}

/// Serves until there is nothing more to read. Only drawings of the plan are drawn.
///
/// # Errors
/// The pipe is gone.
pub fn serve(inbox: Inbox, plan: &Plan, wanted: &Wanted, size: Option<u32>) -> io::Result<()> {
    let mut device = DrawingDevice::open(plan, wanted, size);
    for line in inbox {
        let answer = match (&mut device, job(&line, plan)) {
            (Err(fault), _) => fault.clone().into(),
            (Ok(device), Some((drawing, draws))) => device
                .draw(drawing, draws)
                .map_or_else(Answer::from, Answer::Reading),
            (Ok(device), None) => Answer::DeviceFacts(device.facts()),
        };
        let mut output = io::stdout().lock();
        writeln!(output, "{}", serde_json::to_string(&answer)?)?;
        output.flush()?;
    }
    Ok(())
}

fn job(line: &str, plan: &Plan) -> Option<(usize, u32)> {
    let (drawing, draws) = line.trim().split_once(' ')?;
    let drawing: usize = drawing.parse().ok()?;
    let draws = draws.parse().ok()?;
    (drawing < plan.drawings.len()).then_some((drawing, draws))
}
