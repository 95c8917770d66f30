//! Materials: named media with measured n(λ) and k(λ), their sources and licences.
//!
//! The catalogue lies in `data/materials/`, one file each, and is part of the binary. A user's own file has the same
//! format ([`Material::parse`]). To add a material to the catalogue, add its file.

mod catalogue;
mod channels;
mod constant;
mod credit;
mod csv;
mod decimal;
mod dispersion;
mod file;
mod file_text;
mod formula;
mod material;
mod page;
mod print;
mod read;
mod rows;
mod surface;
mod trim;

pub use crate::physics::foreign::{escaped, is_hidden};
pub use catalogue::{find, list, names, source};
pub use channels::{Channels, THESIS_NM};
pub use constant::{ConstantIndex, IndexFault};
pub use dispersion::{DispersionCurve, Extrapolate};
pub use file::name_fault;
pub use file_text::FileText;
pub use formula::Formula;
pub use material::{Index, Material, MaterialKind};
pub use page::Page;
pub use read::page;
pub use surface::{Surface, Unseen, ViewingConditions, surfaces_of};

pub use crate::physics::spectra::FileFault;
