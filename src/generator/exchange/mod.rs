//! A material's numbers in the formats that engines and tools read, one file per format.
//!
//! Each format computes reflectance by its own model: Schlick's approximation, F82-tint, or the exact law. Numbers are clamped to
//! the format's limits. The remaining error is measured with the numbers as written.
//!
//! To add a format, write its file with a `pub static FORMAT: Format`, and run `tests/lists`.

mod coat;
mod cycles_film;
mod engine_material;
mod format;
mod model;
mod sheet;

pub use coat::CoatLaw;
pub use cycles_film::{CyclesBase, CyclesFilm};
pub use engine_material::{Body, EngineMaterial, ExchangeFault};
pub use format::Format;
pub use model::Model;

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

/// The format of this name.
pub fn find(name: &str) -> Option<&'static Format> {
    ALL.iter().find(|format| format.name == name).copied()
}
