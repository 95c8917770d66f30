//! Formats: the files that a table can be written as.
//!
//! What cannot be baked.

use super::depth::Depth;
use super::picture::Picture;
use super::split_sum::MOST_SIDE;

/// The folder of lookup tables in an output folder: those of a run without flags, and any that `bake` put beside them, which no
/// manifest lists.
pub const TABLES: &str = "lut";

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// OpenEXR, binary16.
    ExrHalf,
    /// OpenEXR, binary32.
    ExrFloat,
    /// PNG, 8 bits.
    Png8,
    /// PNG, 16 bits.
    Png16,
    /// KTX 2.0, RGBA of binary16: as GPUs take it.
    Ktx2,
    /// A C header with the bits of binary16.
    C,
    /// Rust with the bits of binary16.
    Rust,
    /// A JavaScript module with the bits of binary16.
    Js,
}

impl Format {
    /// All of them.
    pub const ALL: [Format; 8] = [
        Format::ExrHalf,
        Format::ExrFloat,
        Format::Png8,
        Format::Png16,
        Format::Ktx2,
        Format::C,
        Format::Rust,
        Format::Js,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Format::ExrHalf => "exr-half",
            Format::ExrFloat => "exr-float",
            Format::Png8 => "png8",
            Format::Png16 => "png16",
            Format::Ktx2 => "ktx2",
            Format::C => "c",
            Format::Rust => "rust",
            Format::Js => "js",
        }
    }

    /// What its files end in: no two formats write the same file.
    pub fn ending(self) -> &'static str {
        match self {
            Format::ExrHalf => ".exr",
            Format::ExrFloat => ".float.exr",
            Format::Png8 => ".8bit.png",
            Format::Png16 => ".png",
            Format::Ktx2 => ".ktx2",
            Format::C => ".h",
            Format::Rust => ".rs",
            Format::Js => ".js",
        }
    }

    /// Whether its files are text, as version control sees it.
    pub fn is_text(self) -> bool {
        matches!(self, Format::C | Format::Rust | Format::Js)
    }

    /// Whether its four channels reach a GPU as they are. What reads EXR and PNG may multiply or divide by alpha.
    pub fn keeps_alpha(self) -> bool {
        match self {
            Format::Ktx2 | Format::C | Format::Rust | Format::Js => true,
            Format::ExrHalf | Format::ExrFloat | Format::Png8 | Format::Png16 => false,
        }
    }

    /// The kind of number in it.
    pub fn depth(self) -> Depth {
        match self {
            Format::ExrFloat => Depth::Float,
            Format::Png8 => Depth::Unorm8,
            Format::Png16 => Depth::Unorm16,
            Format::ExrHalf | Format::Ktx2 | Format::C | Format::Rust | Format::Js => Depth::Half,
        }
    }

    /// The file of a picture, whose depth is this format's.
    ///
    /// # Errors
    /// The encoder refuses.
    pub fn encode(self, picture: &Picture) -> Result<Vec<u8>, Error> {
        match self {
            Format::ExrHalf | Format::ExrFloat => {
                super::exr::exr(picture).map_err(|why| self.refused(why))
            }
            Format::Png8 | Format::Png16 => {
                super::png::png(picture).map_err(|why| self.refused(why))
            }
            Format::Ktx2 => Ok(super::ktx2::ktx2(picture)),
            Format::C => Ok(super::text::c(picture).into_bytes()),
            Format::Rust => Ok(super::text::rust(picture).into_bytes()),
            Format::Js => Ok(super::text::js(picture).into_bytes()),
        }
    }

    fn refused(self, why: String) -> Error {
        Error::Encode {
            format: self.name(),
            why,
        }
    }
}

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
