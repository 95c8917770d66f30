//! Why no function can be chosen.

use crate::{emit, materials};

/// How many materials without a function an error names.
const NAMED: usize = 3;

/// Why no function can be chosen.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A budget that is no error of reflectance.
    #[error("--budget is {most}; it is an error of reflectance, above 0, such as 0.001")]
    OutOfRange {
        /// The budget.
        most: f64,
    },
    /// GPUs of which no costs are recorded.
    #[error("no costs are recorded of {gpu}: {reason}; name another --gpu")]
    NoCosts {
        /// The family.
        gpu: &'static str,
        /// Why not.
        reason: &'static str,
    },
    /// No method among which a budget chooses.
    #[error(
        "--budget chooses among methods for unpolarised light that keep the contract; none of --method is one"
    )]
    NoMethod,
    /// Materials that have no function within the budget.
    #[error("nothing is within --budget {most}; {}", named(faults))]
    NothingWithin {
        /// The budget.
        most: f64,
        /// Why, a material each.
        faults: Vec<String>,
    },
    /// A function cannot be made.
    #[error(transparent)]
    Function(#[from] emit::Error),
    /// A material of the catalogue has a fault.
    #[error(transparent)]
    Material(materials::FileFault),
}

/// The first faults, and how many more there are.
fn named(faults: &[String]) -> String {
    let named: Vec<&str> = faults.iter().take(NAMED).map(String::as_str).collect();
    let more = match faults.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    named.join("; ") + &more
}
