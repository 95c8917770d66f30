//! What methods promise ([`Claims`]): model error, code error, and for fitted methods how well they follow classes of materials
//! ([`ByClass`]): metals, semiconductors, and dielectrics of n 1.2 or more, in air.
//!
//! The figure of a class is the largest error over all angles and channels of each material, as median and 90th percentile: over
//! the pages of the catalogue, and over the pages of `data/outside.csv`, which had no part in any choice of a shape. The figures
//! stand in the methods' own files. The test `fits::classes_are_followed_as_promised` checks that each is neither exceeded nor
//! slack.
//!
//! In half precision ([`InHalf`]) a method promises what it errs there, or says why it is not written. A number has 11 bits there,
//! the largest is 65504, the smallest normal one 6.1e-5. So fourth powers overflow (that of an extinction coefficient of 16 is
//! 65536), guards of 1e-37 become 0, and a difference of two numbers near 1 is off by 5e-4. A method whose formula does not survive
//! that builds another one, in its own file, where [`Inputs::is_half`](super::Inputs::is_half). Most often it is 1 minus a small
//! quotient instead of a quotient near 1.

use super::input::{Input, Range};
use super::media::MediaSet;

/// What a method promises. Tests check each figure in both directions: not exceeded, and not slack.
#[derive(Clone, Copy, Debug)]
pub struct Claims {
    /// Model error: maximum absolute difference to the exact law, over stated sets of media and all angles.
    pub model: &'static [Claim],
    /// Code error: the largest difference in ulp between unfused f32 and f64 at the same inputs, over these media and all
    /// angles. Differences within 2⁻²² do not count. 0: no larger difference was found, or
    /// the method reads a texture, where the sampler decides.
    pub code_ulp: f64,
    /// Code error of a method that promises none in ulp: the largest absolute difference. 0 for all others.
    pub code_abs: f64,
    /// The media that the code error is stated over.
    pub code_over: MediaSet,
    /// The code error over all colours that artists may enter, where a method takes colours.
    pub colours: Option<ColourClaim>,
    /// How well a fitted method follows classes of materials.
    pub by_class: &'static [ByClass],
}

impl Claims {
    /// No promise.
    pub(super) const NONE: Claims = Claims {
        model: &[],
        code_ulp: 0.0,
        code_abs: 0.0,
        code_over: MediaSet::Wide,
        colours: None,
        by_class: &[],
    };

    /// The promise for a class of materials, if there is one.
    pub fn for_class(&self, class: &str) -> Option<&'static ByClass> {
        self.by_class.iter().find(|row| row.class == class)
    }
}

/// A promised code error of a method whose inputs artists enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourClaim {
    /// The largest difference between f32, unfused or fused, and f64 at the same inputs, over every argument from 0 to 1 and
    /// every angle.
    pub max_abs: f64,
    /// Arguments for which it holds over another range than 0 to 1.
    pub ends: &'static [(&'static str, Range)],
    /// The weaker promise beyond these; may be empty.
    pub beyond: &'static str,
}

impl ColourClaim {
    /// An error of at most this, over arguments from 0 to 1.
    pub const fn within(max_abs: f64) -> Option<ColourClaim> {
        Some(ColourClaim {
            max_abs,
            ends: &[],
            beyond: "",
        })
    }

    /// Where the promise holds.
    pub fn range(&self, input: &Input) -> Range {
        let own = self.ends.iter().find(|(name, _)| *name == input.name);
        own.map_or(Range::new(0.0, 1.0), |(_, range)| *range)
    }
}

/// A promised model error.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// The media that it is stated over.
    pub over: MediaSet,
    /// The promise; 0 where the method is the exact law.
    pub max_abs: f64,
    /// The angle, in degrees, at which it is worst.
    pub at_degrees: f64,
}

impl Claim {
    const fn new(over: MediaSet, max_abs: f64, at_degrees: f64) -> Claim {
        Claim {
            over,
            max_abs,
            at_degrees,
        }
    }

    /// The method is the exact law there.
    pub(super) const fn exact(over: MediaSet) -> Claim {
        Claim::new(over, 0.0, 0.0)
    }

    /// At most this error over [`MediaSet::Dielectrics`], worst at this angle.
    pub(super) const fn dielectrics(max_abs: f64, at_degrees: f64) -> Claim {
        Claim::new(MediaSet::Dielectrics, max_abs, at_degrees)
    }

    /// At most this error over [`MediaSet::Metals`], worst at this angle.
    pub(super) const fn metals(max_abs: f64, at_degrees: f64) -> Claim {
        Claim::new(MediaSet::Metals, max_abs, at_degrees)
    }
}

/// Median and 90th percentile of the largest errors of some materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Half of the materials err no more.
    pub median: f64,
    /// The 90th percentile: nine of ten err no more.
    pub percentile_90: f64,
}

impl Spread {
    const fn new([median, percentile_90]: [f64; 2]) -> Spread {
        Spread {
            median,
            percentile_90,
        }
    }
}

/// What a fitted method promises for a class of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByClass {
    /// `metal`, `semiconductor` or `dielectric`.
    pub class: &'static str,
    /// Over the catalogue.
    pub catalogue: Spread,
    /// Over pages that are not in the catalogue.
    pub outside: Spread,
    /// The 90th percentile over both together. A fit that errs more misses its class.
    pub limit: f64,
}

impl ByClass {
    /// A promise for a class: median and 90th percentile over the catalogue and outside it, and the 90th percentile over both.
    pub(super) const fn of_class(
        class: &'static str,
        catalogue: [f64; 2],
        outside: [f64; 2],
        limit: f64,
    ) -> ByClass {
        ByClass {
            class,
            catalogue: Spread::new(catalogue),
            outside: Spread::new(outside),
            limit,
        }
    }
}

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
