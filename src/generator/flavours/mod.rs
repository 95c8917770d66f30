//! Flavours: targets dressed for one host. A flavour's files are an adapter: they replace each use of Fresnel's equations in that host,
//! with fitted coefficients of materials.
//!
//! Lamps, image light and the compensation of multiple scattering take the same coefficients, which keep to [0, 1] by themselves, as those
//! of the catalogue do.
//!
//! To add one, write its file with a `pub static FLAVOUR: Flavour` and its templates, and run `tests/lists`.

mod flavour;
mod view;

pub use flavour::{Commands, Error, Fitted, Flavour, FlavourFile, FlavourPage, files};

// BEGIN list (written by tests/lists)
mod babylon;
mod bevy;
mod godot;
mod materialx;
mod playcanvas;
mod three;
mod unity;
mod unreal;

/// Every flavour, by name.
#[rustfmt::skip]
pub static ALL: &[&Flavour] = &[
    &babylon::FLAVOUR,
    &bevy::FLAVOUR,
    &godot::FLAVOUR,
    &materialx::FLAVOUR,
    &playcanvas::FLAVOUR,
    &three::FLAVOUR,
    &unity::FLAVOUR,
    &unreal::FLAVOUR,
];
// END list

/// The flavour of this name.
pub fn find(name: &str) -> Option<&'static Flavour> {
    ALL.iter().find(|flavour| flavour.name == name).copied()
}
