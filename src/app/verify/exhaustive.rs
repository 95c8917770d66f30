//! Every f32 from 0 to 1: not a sample.

use serde_json::Value;

use crate::app::error::Error;
use crate::verify::run::Devices;

use super::plan::Plan;

/// The rows of all numbers.
///
/// # Errors
/// There is no device.
pub fn rows(
    _plan: &Plan,
    _devices: &Devices,
    _progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Value>, Error> {
    Err(Error::Lacking {
        what: "not built yet".to_owned(),
    })
}
