//! Cost: what a function costs by the compilers of GPUs, asked here or recorded, and what a method costs beside its error.

mod chain;
mod compilers;
mod family;
mod figures;
pub mod foreign;
mod function;
mod inputs;
mod known;
mod pareto;
mod probe;
mod protocol;
mod record;
mod row;
mod serve;
mod session;
mod shapes;
mod table;
mod text_shape;
pub use compilers::{FamilyAnswers, ask_compilers};
pub use family::{Dialect, FAMILIES, Family, GpuCompiler, find};
pub use figures::{CostFigures, Counts, StatisticNames, Statistics, figures, remarked};
pub use function::{CostedFunction, functions, functions_of_effect};
pub use inputs::input_numbers;
pub use known::{
    CostBasis, KnownCost, function_cost, known_cost, known_library_cost, library_cost,
};
pub use pareto::{CostAndError, Multiples, TIE, pareto_frontier};
pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX, gles_vertex};
pub use protocol::FragmentShader;
pub use record::{CostRecord, FunctionKey, records};
pub use row::{CostRow, CostSource};
pub use serve::serve;
pub use session::{CompilerSession, launch, told};
pub use shapes::{
    ChoiceRow, ChosenShape, SEARCHED, SearchResult, SearchRow, SearchedClass, ShapeRow,
};
pub use table::cost_rows;

/// The method that others' costs and times are shares of, in its library form of three channels.
pub const REFERENCE: &str = "dielectric_exact";
