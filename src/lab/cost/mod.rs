//! Cost: what a function costs by the compilers of GPUs, asked here or recorded, and what a method costs beside its error.

mod chain;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod compilers;
mod family;
mod figures;
pub mod foreign;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod function;
mod inputs;
mod known;
mod pareto;
mod probe;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod protocol;
mod record;
mod row;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod serve;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod session;
mod shapes;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod table;
mod text_shape;

#[cfg(all(feature = "cli", feature = "gpu"))]
pub use compilers::{FamilyAnswers, ask_compilers};
pub use family::{Dialect, FAMILIES, Family, GpuCompiler, find};
pub use figures::{CostFigures, Counts, StatisticNames, Statistics, figures, remarked};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use function::{CostedFunction, functions, functions_of_effect};
pub use inputs::input_numbers;
pub use known::{
    CostBasis, KnownCost, function_cost, known_cost, known_library_cost, library_cost,
};
pub use pareto::{CostAndError, Multiples, TIE, pareto_frontier};
pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX, gles_vertex};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use protocol::FragmentShader;
pub use record::{CostRecord, FunctionKey, records};
pub use row::{CostRow, CostSource};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use serve::serve;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use session::{CompilerSession, launch, told};
pub use shapes::{
    ChoiceRow, ChosenShape, SEARCHED, SearchResult, SearchRow, SearchedClass, ShapeRow,
};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use table::cost_rows;

/// The method that others' costs and times are shares of, in its library form of three channels.
pub const REFERENCE: &str = "dielectric_exact";
