//! Cost: a function measured, always with the device or compiler named.

mod family;
mod figures;
mod probe;
mod record;

pub use family::{Compiler, Dialect, FAMILIES, Family, find};
pub use figures::Columns;
pub use figures::{Counts, Figures, Statistics, figures, remarked};
pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX, gles_vertex};
pub use record::{Record, records};
