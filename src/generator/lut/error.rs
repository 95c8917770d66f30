//! What cannot be baked.

use super::split_sum::MOST_SIDE;

/// A fault of what was asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A size that no texture has.
    #[error("a table of {texels} texels cannot be: it has 2 to 16384")]
    Size {
        /// The size.
        texels: usize,
    },
    /// No table is good enough.
    #[error(
        "no table meets an error of {budget:?}: the best of {tried} reaches {best:.2e}, with 8-bit filtering weights and up to 16384 texels. Allow more, or more axes and formats"
    )]
    Budget {
        /// What was asked for.
        budget: f64,
        /// The least error that was reached.
        best: f64,
        /// The axes and depths.
        tried: String,
    },
    /// A size that a split-sum table cannot have.
    #[error("a split-sum table of {size} texels a side cannot be: it has 2 to {MOST_SIDE}")]
    Side {
        /// The size.
        size: usize,
    },
    /// A split-sum table of too many terms.
    #[error(
        "a split-sum table has a channel for each coefficient, and a texture has 4: {terms} do not fit (fitted and fitted_dielectric have 4)"
    )]
    Terms {
        /// The coefficients.
        terms: usize,
    },
    /// A split-sum table whose terms lie beyond 1.
    #[error(
        "the terms of this form reach beyond 4, which integers cannot hold and half precision holds poorly: fitted and fitted_dielectric stay below 1"
    )]
    Range,
    /// An encoder refused.
    #[error("the table cannot be written as {format}: {why}")]
    Encode {
        /// The format's name.
        format: &'static str,
        /// The encoder's reason.
        why: String,
    },
}
