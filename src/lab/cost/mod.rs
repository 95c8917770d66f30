//! The cost of a function by the compilers of GPUs, asked here or recorded, and the trade-off of a method's cost against its error.

mod chain;
mod compilers;
mod family;
mod figures;
pub mod foreign;
mod function;
mod pareto;
mod probe;
mod record;
mod row;
mod session;
mod shapes;
pub use chain::MeasuredFunction;
pub use compilers::{FamilyAnswers, ask_compilers};
pub use family::{Dialect, FAMILIES, Family, GpuCompiler, find};
pub use figures::{CostFigures, Counts};
pub use function::{
    CostedFunction, FunctionId, REFERENCE, functions, functions_of_effect, input_numbers,
};
pub use pareto::{CostAndError, Multiples, TIE, pareto_frontier};
pub use probe::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX};
pub use record::{
    CostBasis, CostRecord, KnownCost, function_cost, known_cost, known_library_cost, library_cost,
    records,
};
pub use row::{CostRow, CostSource, cost_rows};
pub use session::{CompilerSession, FragmentShader, answered, launch, serve};
pub use shapes::{ChoiceRow, SEARCHED, SearchResult, SearchRow, SearchedClass, ShapeRow};
