//! Cost: a function measured, always with the device or compiler named.

#[cfg(feature = "gpu")]
mod clock;
pub mod overdraw;
mod probe;
pub mod statistics;
mod times;

pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX, gles_vertex};
pub use times::{Time, times};
