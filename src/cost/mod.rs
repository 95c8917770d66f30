//! Cost: a function measured, always with the device or compiler named.

mod probe;

pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX, gles_vertex};
