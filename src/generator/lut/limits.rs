//! Sizes that tables may have, and the errors of baking.

/// The fewest texels: one at each end.
pub const LEAST_TEXELS: usize = 2;
/// The most texels: the longest side of a texture that all today's GPUs take (Direct3D 11's limit; WebGL 2 asks for 2048).
pub const MOST_TEXELS: usize = 16_384;

/// The most texels per side: errors fall with the square of the size, and from 256 on half precision dominates.
pub const MOST_SIDE: usize = 1024;

/// Refuses a number of texels that a texture cannot have.
///
/// # Errors
/// Fewer than [`LEAST_TEXELS`], or more than [`MOST_TEXELS`].
pub fn check_size(texels: usize) -> Result<(), Error> {
    if (LEAST_TEXELS..=MOST_TEXELS).contains(&texels) {
        Ok(())
    } else {
        Err(Error::Size { texels })
    }
}

/// Refuses a side that a table cannot have.
///
/// # Errors
/// Fewer than [`LEAST_TEXELS`], or more than a texture may have.
pub fn check_side(size: usize) -> Result<(), Error> {
    if (LEAST_TEXELS..=MOST_SIDE).contains(&size) {
        Ok(())
    } else {
        Err(Error::Side { size })
    }
}

/// An invalid request for a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A size that no texture can have.
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
        /// The largest error allowed.
        budget: f64,
        /// The least error reached.
        best: f64,
        /// The axes and depths that were tried.
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
        /// The number of coefficients.
        terms: usize,
    },
    /// A split-sum table whose terms exceed 4.
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
