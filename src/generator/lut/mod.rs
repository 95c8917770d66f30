//! Lookup tables: reflectance by cos θ as a texture, and the error of the filtered lookup.
//!
//! A table takes these steps, one file each. [`TableAxis`] says where a cosine lies. [`Table`] is the reference at the centres of
//! texels, and [`Stored`] is the table in a [`Depth`]. [`Stored::lookup`] is what a sampler returns, and [`table_error`] compares
//! that with the reference. [`smallest`] finds the table with the fewest bytes within an error. A [`Picture`] of one or more rows
//! becomes a file in a [`Format`]. [`lookup()`] is the shader function that reads it.
//!
//! [`CatalogueTexture`] is no table: it holds fitted coefficients, which a shader fetches by number. [`SplitSum`] is a table by
//! angle and roughness of what a rough surface reflects.
//!
//! Rows run along x, cos θ = 0 first. Values are linear: neither sRGB nor any other curve is applied, and every format that can
//! say so does. Nothing here uses the disk or the terminal.

mod axis;
mod catalogue;
mod exr;
mod format;
mod ktx2;
mod lookup;
mod orthogonal;
mod picture;
mod png;
mod search;
mod split_sum;
mod split_sum_design;
mod table;
mod texel;
mod text;

pub use axis::TableAxis;
pub use catalogue::{CatalogueTexture, CatalogueTextureDetail};
pub use format::{Format, TABLES};
pub use ktx2::KTX2_MARK;
pub use lookup::{lookup, lookup_by_thickness};
pub use orthogonal::Orthogonal;
pub use picture::Picture;
pub use search::{BetweenTexels, TableKind, smallest, table_error};
pub use split_sum::{
    BetweenSplitSum, LEAST_ROUGHNESS, SPLIT_SUM_SIZE, SplitSum, StoredSplitSum, term_range,
};
pub use split_sum_design::{SPLIT_SUM_AXES, SplitSumAxis, SplitSumDesign, SplitSumLayout};
pub use table::{Stored, Table};
pub use texel::{Depth, Error, LEAST_TEXELS, check_side, check_size};
