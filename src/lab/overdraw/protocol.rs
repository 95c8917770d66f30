//! What the process that draws is asked, and what it answers.

use serde::{Deserialize, Serialize};

use crate::lab::gpu::DeviceFault;

use super::drawing_device::DeviceFacts;
use super::measure::Reading;

/// What it is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum DrawRequest {
    /// What it draws on.
    Device,
    /// A reading.
    Draw {
        /// The place of a drawing in the plan.
        drawing: usize,
        /// How often it is drawn.
        draws: u32,
    },
}

/// What it answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum DrawResponse {
    /// What it draws on.
    Device(DeviceFacts),
    /// A reading.
    Reading(Reading),
    /// Something is missing on this machine.
    Absent(String),
    /// The shader or the device failed.
    Failed(String),
}

impl From<DeviceFault> for DrawResponse {
    fn from(fault: DeviceFault) -> DrawResponse {
        match fault {
            DeviceFault::Absent { .. } | DeviceFault::Unable { .. } => {
                DrawResponse::Absent(fault.to_string())
            }
            _ => DrawResponse::Failed(fault.to_string()),
        }
    }
}
