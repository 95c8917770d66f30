//! The file formats of tables.

use super::picture::Picture;
use super::texel::{Depth, Error};
use super::{exr, ktx2, png, text};

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

    /// The depths of these formats, the smallest first, each once.
    pub fn depths(formats: &[Format]) -> Vec<Depth> {
        let wanted = |depth: &Depth| formats.iter().any(|format| format.depth() == *depth);
        Depth::ALL.into_iter().filter(wanted).collect()
    }

    /// The name on the command line, the ending of file names, and the number type of texels.
    fn row(self) -> (&'static str, &'static str, Depth) {
        match self {
            Format::ExrHalf => ("exr-half", ".exr", Depth::Half),
            Format::ExrFloat => ("exr-float", ".float.exr", Depth::Float),
            Format::Png8 => ("png8", ".8bit.png", Depth::Unorm8),
            Format::Png16 => ("png16", ".png", Depth::Unorm16),
            Format::Ktx2 => ("ktx2", ".ktx2", Depth::Half),
            Format::C => ("c", ".h", Depth::Half),
            Format::Rust => ("rust", ".rs", Depth::Half),
            Format::Js => ("js", ".js", Depth::Half),
        }
    }

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// The ending of its file names: no two formats write the same file.
    pub fn ending(self) -> &'static str {
        self.row().1
    }

    /// The number type of its texels.
    pub fn depth(self) -> Depth {
        self.row().2
    }

    /// Whether its files are text for version control.
    pub fn is_text(self) -> bool {
        matches!(self, Format::C | Format::Rust | Format::Js)
    }

    /// Whether its four channels reach a GPU unchanged. Readers of EXR and PNG may multiply or divide by alpha.
    pub fn keeps_alpha(self) -> bool {
        self.is_text() || self == Format::Ktx2
    }

    /// The file of a picture with this format's depth.
    ///
    /// # Errors
    /// The encoder refuses.
    pub fn encode(self, picture: &Picture) -> Result<Vec<u8>, Error> {
        let bytes = match self {
            Format::ExrHalf | Format::ExrFloat => exr::exr(picture),
            Format::Png8 | Format::Png16 => png::png(picture),
            Format::Ktx2 => Ok(ktx2::ktx2(picture)),
            Format::C => Ok(text::c(picture).into_bytes()),
            Format::Rust => Ok(text::rust(picture).into_bytes()),
            Format::Js => Ok(text::js(picture).into_bytes()),
        };
        bytes.map_err(|why| Error::Encode {
            format: self.name(),
            why,
        })
    }
}
