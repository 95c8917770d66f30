//! Why no function can be chosen.

use core::fmt;

use crate::generator::emit;
use crate::generator::fit::rounded_up;
use crate::physics::materials;

use super::choice::BudgetCandidate;

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
        /// The materials.
        faults: Vec<NoFunction>,
    },
    /// A function cannot be made.
    #[error(transparent)]
    Function(#[from] emit::Error),
    /// A material of the catalogue has a fault.
    #[error(transparent)]
    Material(materials::FileFault),
}

/// A material of which no function is within the budget.
#[derive(Clone, Debug)]
pub struct NoFunction {
    /// The material's name.
    pub material: String,
    /// The GPUs whose costs decide.
    pub gpu: &'static str,
    /// The function with the smallest error; none where no cost is known.
    pub best: Option<BudgetCandidate>,
}

impl fmt::Display for NoFunction {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let NoFunction {
            material,
            gpu,
            best,
        } = self;
        match best {
            None => write!(
                to,
                "{material}: no method that describes it has a known cost on {gpu}"
            ),
            Some(best) => write!(
                to,
                "{material}: {} has the smallest error, {}, and costs {} on {gpu}",
                best.method,
                rounded_error(best.point.error),
                best.point.cost
            ),
        }
    }
}

/// An error rounded up, or with two digits where it is below 1e-4.
pub fn rounded_error(error: f64) -> String {
    if error < 1e-4 {
        format!("{error:.1e}")
    } else {
        rounded_up(error)
    }
}

/// The first faults, and how many more there are.
fn named(faults: &[NoFunction]) -> String {
    let named = faults.iter().take(NAMED);
    let named: Vec<String> = named.map(NoFunction::to_string).collect();
    let more = match faults.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    named.join("; ") + &more
}

#[cfg(test)]
mod tests {
    use super::rounded_error;

    #[test]
    fn an_error_is_not_rounded_down() {
        assert_eq!(rounded_error(0.001_931), "0.00194");
        assert_eq!(rounded_error(6.0e-8), "6.0e-8");
    }
}
