//! Cost: a function measured, always with the device or compiler named. By its own compiler, as counts; by overdraw, as
//! time.

#[cfg(feature = "gpu")]
mod clock;
mod family;
mod figures;
pub mod foreign;
pub mod overdraw;
mod probe;
mod record;
pub mod statistics;
mod times;

pub use family::{Compiler, Dialect, FAMILIES, Family, find};
pub use figures::{Columns, Counts, Figures, Statistics, figures, remarked};
pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX, gles_vertex};
pub use record::{Record, function_cost, library_cost, records};
pub use times::{Time, times};

/// The method that others' costs and times are shares of, in its library form of three channels.
pub const REFERENCE: &str = "dielectric_exact";
