//! The file formats of tables ([`Format`]), the number types of texels ([`Depth`]), a table rounded to one of them ([`Stored`]),
//! and the errors of baking.

use super::axis::TableAxis;
use super::picture::Picture;
use super::split_sum::MOST_SIDE;
use super::table::Table;
use crate::physics::num::{Half, Num};

/// The folder of lookup tables in an output folder. It holds the tables of a run without flags, and any that `bake` put beside
/// them, which no manifest lists.
pub const TABLES: &str = "lut";

/// A file format.
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
    /// KTX 2.0, RGBA of binary16, in the layout that GPUs take.
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

    /// The ending of its file names: no two formats write the same file.
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

    /// Whether its files are text for version control.
    pub fn is_text(self) -> bool {
        matches!(self, Format::C | Format::Rust | Format::Js)
    }

    /// Whether its four channels reach a GPU unchanged. Readers of EXR and PNG may multiply or divide by alpha.
    pub fn keeps_alpha(self) -> bool {
        match self {
            Format::Ktx2 | Format::C | Format::Rust | Format::Js => true,
            Format::ExrHalf | Format::ExrFloat | Format::Png8 | Format::Png16 => false,
        }
    }

    /// The number type of its texels.
    pub fn depth(self) -> Depth {
        match self {
            Format::ExrFloat => Depth::Float,
            Format::Png8 => Depth::Unorm8,
            Format::Png16 => Depth::Unorm16,
            Format::ExrHalf | Format::Ktx2 | Format::C | Format::Rust | Format::Js => Depth::Half,
        }
    }

    /// The file of a picture with this format's depth.
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

/// The number type of a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// 8 bits, i/255 for 0 to 1.
    Unorm8,
    /// binary16: 11 significant bits.
    Half,
    /// 16 bits, i/65535 for 0 to 1. GLES and WebGPU sample it only with an extension.
    Unorm16,
    /// binary32. GLES and WebGPU filter it only with an extension.
    Float,
}

impl Depth {
    /// All depths, the smallest first; of equal sizes, the one that more devices can filter.
    pub const ALL: [Depth; 4] = [Depth::Unorm8, Depth::Half, Depth::Unorm16, Depth::Float];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Depth::Unorm8 => "unorm8",
            Depth::Half => "half",
            Depth::Unorm16 => "unorm16",
            Depth::Float => "float",
        }
    }

    /// Bytes of a texel in GPU memory, where it has four channels.
    pub fn bytes(self) -> usize {
        match self {
            Depth::Unorm8 => 4,
            Depth::Half | Depth::Unorm16 => 8,
            Depth::Float => 16,
        }
    }

    /// The largest integer, for integer depths.
    pub fn largest(self) -> Option<f32> {
        match self {
            Depth::Unorm8 => Some(255.0),
            Depth::Unorm16 => Some(65_535.0),
            Depth::Half | Depth::Float => None,
        }
    }

    /// The nearest value, as a sampler returns it. An integer depth holds only 0 to 1.
    pub fn nearest(self, value: f64) -> f32 {
        match self {
            Depth::Half => Half::from_f64(value).to_f32(),
            Depth::Float => value as f32,
            Depth::Unorm8 | Depth::Unorm16 => {
                let largest = self.largest().unwrap_or(1.0);
                let steps = value.clamp(0.0, 1.0) * f64::from(largest);
                steps.round() as f32 / largest
            }
        }
    }

    /// The factor to store with tables in this depth: 1, or for integers the largest channel of all where that is above 1,
    /// rounded up to binary32.
    pub fn scale(self, tables: &[&Table]) -> f32 {
        if self.largest().is_none() {
            return 1.0;
        }
        let texels = tables.iter().flat_map(|table| &table.texels);
        let most = texels.flatten().copied().fold(1.0, f64::max);
        let near = most as f32;
        if f64::from(near) < most {
            near.next_up()
        } else {
            near
        }
    }
}

/// A table as stored in a GPU texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Stored {
    /// The axis of cosines.
    pub axis: TableAxis,
    /// The number type.
    pub depth: Depth,
    /// value = texel × scale.
    pub scale: f32,
    /// The value of each texel that a sampler returns.
    pub texels: Vec<[f32; 3]>,
}

impl Stored {
    /// A table divided by its own scale and rounded.
    pub fn new(table: &Table, depth: Depth) -> Stored {
        Stored::scaled(table, depth, depth.scale(&[table]))
    }

    /// A table divided by a scale that it may share with others, and rounded.
    pub fn scaled(table: &Table, depth: Depth, scale: f32) -> Stored {
        let rounded = |value: f64| depth.nearest(value / f64::from(scale));
        Stored {
            axis: table.axis,
            depth,
            scale,
            texels: table
                .texels
                .iter()
                .map(|texel| texel.map(rounded))
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(texels: &[[f64; 3]]) -> Table {
        Table {
            name: "invented".to_owned(),
            axis: TableAxis::Cos,
            texels: texels.to_vec(),
        }
    }

    #[test]
    fn each_depth_rounds_to_its_nearest() {
        for (depth, value, want) in [
            (Depth::Unorm8, 0.5, 128.0 / 255.0),
            (Depth::Unorm8, 1.2, 1.0),
            (Depth::Unorm8, -0.1, 0.0),
            (Depth::Unorm8, f64::NAN, f32::NAN),
            (Depth::Unorm16, 0.25, 16384.0 / 65535.0),
            (Depth::Half, 1.0 + 0.000_6, 1.000_976_6),
            (Depth::Half, 0.1, 0.099_975_586),
            (Depth::Float, 0.1, 0.1),
            (Depth::Float, 1.06, 1.06),
        ] {
            let got = depth.nearest(value);
            assert!(
                got == want || got.is_nan() && want.is_nan(),
                "{depth:?} {value}: {got}"
            );
        }
    }

    #[test]
    fn integers_are_scaled_where_a_channel_is_above_one() {
        let gold = table(&[[1.0, 1.0, 1.0], [1.058_7, 0.77, 0.31]]);
        for depth in Depth::ALL {
            let stored = Stored::new(&gold, depth);
            let is_integer = depth.largest().is_some();
            assert_eq!(stored.scale > 1.0, is_integer, "{depth:?}");
            let most = f64::from(stored.texels[1][0]) * f64::from(stored.scale);
            assert!((most - 1.058_7).abs() < 4e-4, "{depth:?} {most}");
            assert!(!is_integer || stored.texels[1][0] == 1.0);
        }
        let glass = table(&[[1.0; 3], [0.04; 3]]);
        assert_eq!(Stored::new(&glass, Depth::Unorm8).scale, 1.0);
    }
}
