//! The errors of baking.

use crate::generator::emit;
use crate::generator::lut::{self, MOST_TERM, TERMS, term_range};
use crate::language::methods::{self, Method};

/// An error of baking.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A table cannot be made.
    #[error(transparent)]
    Table(#[from] lut::Error),
    /// A language refuses the function that reads a table.
    #[error(transparent)]
    Function(#[from] emit::Error),
    /// A split-sum table of a method that is not affine in numbers of the material.
    #[error(
        "--dfg takes a method that is affine in numbers of a material ({}), and `{method}` is none",
        split_sum_methods().join(", ")
    )]
    NotAffine {
        /// The method.
        method: &'static str,
    },
    /// An engine's table with a method that the engine does not use.
    #[error(
        "--layout {layout} holds the terms of schlick, and not of `{method}`: leave --method out"
    )]
    EnginesMethod {
        /// The layout.
        layout: &'static str,
        /// The method.
        method: &'static str,
    },
    /// Terms below 0 or above 1 in an integer format.
    #[error(
        "the terms of `{method}` lie beyond 0 to 1, which {format} does not hold: take exr-half, exr-float, ktx2, c, rust or js"
    )]
    Integers {
        /// The method.
        method: &'static str,
        /// The format.
        format: &'static str,
    },
}

/// The methods that have a split-sum table.
pub fn split_sum_methods() -> Vec<&'static str> {
    let has_table = |method: &&Method| {
        let basis = method.basis();
        basis.is_some_and(|basis| basis.terms() <= TERMS && term_range(&basis)[1] <= MOST_TERM)
    };
    let all = methods::ALL.iter().copied().filter(has_table);
    all.map(|method| method.name).collect()
}
