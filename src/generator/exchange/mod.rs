//! A material's numbers in the formats that engines and tools read, one file a format.
//!
//! Each format computes reflectance by a model of its own: Schlick's approximation, F82-tint, or the law itself. Numbers are
//! limited as the format wants it. The error that is left is measured with the numbers as they are written.
//!
//! To add a format, write its file with a `pub static FORMAT: Format`, and run `tests/lists`.

mod format;
mod model;
mod sheet;
mod subject;

pub use format::{ExchangeFault, Exported, Format};
pub use model::{Model, NodeError};
pub use sheet::{Field, FieldValue, Node, Sheet};
pub use subject::{Body, EngineMaterial};

// BEGIN list (written by tests/lists)
mod blender;
mod filament;
mod gltf;
mod materialx;
mod openpbr;
mod unreal;
mod usd;

/// Every format, by name.
#[rustfmt::skip]
pub static ALL: &[&Format] = &[
    &blender::FORMAT,
    &filament::FORMAT,
    &gltf::FORMAT,
    &materialx::FORMAT,
    &openpbr::FORMAT,
    &unreal::FORMAT,
    &usd::FORMAT,
];
// END list
