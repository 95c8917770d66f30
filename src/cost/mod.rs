//! Cost: a function measured, always with the device or compiler named. By its own compiler, as counts; by overdraw, as
//! time.

#[cfg(all(feature = "cli", feature = "gpu"))]
mod asked;
mod family;
mod figures;
pub mod foreign;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod function;
mod pareto;
mod probe;
mod record;
mod row;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod serve;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod session;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod table;

#[cfg(all(feature = "cli", feature = "gpu"))]
pub use asked::{Limits, Told, ask};
pub use family::{Compiler, Dialect, FAMILIES, Family, find};
pub use figures::{Columns, Counts, Figures, Statistics, figures, remarked};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use function::{Function, functions};
pub use pareto::{CostAndError, Multiples, TIE, pareto_frontier};
pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX, gles_vertex};
pub use record::{Record, function_cost, library_cost, records};
pub use row::{CostRow, CostSource};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use serve::serve;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use session::{Said, environment, reason};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use table::cost_rows;

/// The method that others' costs and times are shares of, in its library form of three channels.
pub const REFERENCE: &str = "dielectric_exact";
