//! The process that draws: opens the device, and answers what it is and how long its drawings take.

use std::io;

use crate::lab::gpu::{AdapterKind, Backend, Device, DeviceFault, Wanted};
use crate::lab::process::Inbox;

use super::drawing_device::DrawingDevice;
use super::plan::DrawingPlan;
use super::protocol::{DrawRequest, DrawResponse};

/// Serves until the supervisor is gone. Only drawings of the plan are drawn; what is planned depends on whether the device is software.
///
/// # Errors
/// The pipe is gone.
pub fn serve(
    inbox: Inbox,
    plan: &dyn Fn(bool) -> DrawingPlan,
    wanted: &Wanted,
    size: Option<u32>,
) -> io::Result<()> {
    let opened = open(wanted);
    let plan = &plan(
        opened
            .as_ref()
            .is_ok_and(|device| device.adapter.kind == AdapterKind::Software),
    );
    let mut device = opened.and_then(|device| DrawingDevice::new(plan, &device, size));
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

/// The device that is wanted. OpenGL draws as well as the others, so it is taken where nothing else is there.
fn open(wanted: &Wanted) -> Result<Device, DeviceFault> {
    let opengl = Wanted {
        backend: Some(Backend::OpenGl),
        ..wanted.clone()
    };
    match Device::open(wanted) {
        Err(fault @ DeviceFault::Absent { .. }) if wanted.backend.is_none() => {
            Device::open(&opengl).map_err(|_| fault)
        }
        opened => opened,
    }
}
