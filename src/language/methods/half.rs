//! Methods in half precision: what a method promises there, or why it is not written.
//!
//! A number has 11 bits there, the largest is 65504, the smallest normal one 6.1e-5. So fourth powers overflow
//! (that of an extinction coefficient of 16 is 65536), guards of 1e-37 become 0, and a difference of
//! two numbers near 1 is off by 5e-4. A method whose formula does not survive that builds another one, in its own file, where
//! [`Inputs::is_half`](super::Inputs::is_half). Most often it is 1 minus a small quotient instead of a quotient near 1.

use super::media::MediaSet;

/// A method in half precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InHalf {
    /// It is written, and promises this.
    Kept(HalfClaim),
    /// Only specialised to materials, for this reason: constants are folded in f64.
    Specialised(&'static str),
    /// Not written at all, for this reason.
    Refused(&'static str),
}

/// The error that functions of materials should keep within in half precision.
pub const HALF_AIM: f64 = 0.002;

/// A promised code error in half precision. Tests check that it is neither exceeded nor slack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfClaim {
    /// The largest difference between the library function, rounded to f16 after every operation, and f64 at the same
    /// inputs, over these media and every f16 cosine from 0 to 1.
    pub max_abs: f64,
    /// The media.
    pub over: MediaSet,
    /// The weaker promise for other media; may be empty.
    pub beyond: &'static str,
    /// The largest such difference of functions of materials, except those of `data/records/half.csv`. A power of a rounded 1 - c is
    /// off by as many roundings as its exponent says, and large coefficients cancel.
    pub of_materials: f64,
    /// The largest values of arguments, by name, beyond which half precision overflows and single precision does not.
    pub ends: &'static [(&'static str, f64)],
}

impl InHalf {
    /// It is written, and promises this over [`MediaSet::Half`].
    pub const fn within(max_abs: f64) -> InHalf {
        InHalf::within_but(max_abs, "")
    }

    /// The same, with a remark on other media.
    pub const fn within_but(max_abs: f64, beyond: &'static str) -> InHalf {
        InHalf::within_over(max_abs, MediaSet::Half, beyond)
    }

    /// It is written, and promises this over these media, with a remark on others.
    pub const fn within_over(max_abs: f64, over: MediaSet, beyond: &'static str) -> InHalf {
        InHalf::Kept(HalfClaim {
            max_abs,
            over,
            beyond,
            of_materials: HALF_AIM,
            ends: &[],
        })
    }

    /// The same where functions of materials differ by at most this.
    pub const fn materials_within(self, of_materials: f64) -> InHalf {
        match self {
            InHalf::Kept(claim) => InHalf::Kept(HalfClaim {
                of_materials,
                ..claim
            }),
            other => other,
        }
    }

    /// The same where half precision overflows beyond these values of arguments.
    pub const fn ending(self, ends: &'static [(&'static str, f64)]) -> InHalf {
        match self {
            InHalf::Kept(claim) => InHalf::Kept(HalfClaim { ends, ..claim }),
            other => other,
        }
    }

    /// What the library function promises.
    pub fn claim(&self) -> Option<HalfClaim> {
        match self {
            InHalf::Kept(claim) => Some(*claim),
            _ => None,
        }
    }

    /// Why there is no library function.
    pub fn library_refusal(&self) -> Option<&'static str> {
        match self {
            InHalf::Kept(_) => None,
            InHalf::Specialised(why) | InHalf::Refused(why) => Some(why),
        }
    }

    /// Why there is no function of a material either.
    pub fn refusal(&self) -> Option<&'static str> {
        match self {
            InHalf::Refused(why) => Some(why),
            _ => None,
        }
    }
}
