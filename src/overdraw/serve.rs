//! The process that draws: opens the device, and answers what it is and how long its drawings take.

use std::io;

use crate::gpu::Wanted;
use crate::process::Inbox;

use super::drawing_device::DrawingDevice;
use super::plan::DrawingPlan;
use super::protocol::{DrawRequest, DrawResponse};

/// Serves until the supervisor is gone. Only drawings of the plan are drawn.
///
/// # Errors
/// The pipe is gone.
pub fn serve(
    inbox: Inbox,
    plan: &DrawingPlan,
    wanted: &Wanted,
    size: Option<u32>,
) -> io::Result<()> {
    let mut device = DrawingDevice::open(plan, wanted, size);
    inbox.serve(|request| match (&mut device, request) {
        (Err(fault), _) => fault.clone().into(),
        (Ok(device), DrawRequest::Device) => DrawResponse::Device(device.facts()),
        (Ok(_), DrawRequest::Draw { drawing, .. }) if drawing >= plan.drawings.len() => {
            DrawResponse::Failed("the plan has no such drawing".to_owned())
        }
        (Ok(device), DrawRequest::Draw { drawing, draws }) => device
            .draw(drawing, draws)
            .map_or_else(DrawResponse::from, DrawResponse::Reading),
    })
}
