//! Flavours: targets adapted to one host. A flavour's files are an adapter: they replace each use of Fresnel's equations in that
//! host by fitted coefficients of materials.
//!
//! Lights, image-based light and the compensation of multiple scattering use the same coefficients. Their form keeps to [0, 1] by
//! itself, as that of the catalogue does.
//!
//! To add one, write its file with a `pub static FLAVOUR: Flavour` and its templates, and run `tests/lists`.

use std::str::FromStr;

use crate::physics::names::{UnknownName, named};

mod compared;
mod files;
mod flavour;
mod texels;
mod view;

pub use compared::{ANGLES, Compared, ComparedFault, angles};
pub use files::{Fitted, files};
pub use flavour::{Error, Flavour, FlavourPage};

// BEGIN list (written by tests/lists)
mod babylon;
mod bevy;
mod godot;
mod materialx;
mod npm;
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
    &npm::FLAVOUR,
    &playcanvas::FLAVOUR,
    &three::FLAVOUR,
    &unity::FLAVOUR,
    &unreal::FLAVOUR,
];

/// Each by its name.
#[rustfmt::skip]
#[allow(missing_docs)]
impl Flavour {
    pub const BABYLON: &'static Flavour = &babylon::FLAVOUR;
    pub const BEVY: &'static Flavour = &bevy::FLAVOUR;
    pub const GODOT: &'static Flavour = &godot::FLAVOUR;
    pub const MATERIALX: &'static Flavour = &materialx::FLAVOUR;
    pub const NPM: &'static Flavour = &npm::FLAVOUR;
    pub const PLAYCANVAS: &'static Flavour = &playcanvas::FLAVOUR;
    pub const THREE: &'static Flavour = &three::FLAVOUR;
    pub const UNITY: &'static Flavour = &unity::FLAVOUR;
    pub const UNREAL: &'static Flavour = &unreal::FLAVOUR;
}
// END list

/// The flavour of this name.
pub fn find(name: &str) -> Option<&'static Flavour> {
    ALL.iter().find(|flavour| flavour.name == name).copied()
}

impl FromStr for &'static Flavour {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<&'static Flavour, UnknownName> {
        named("flavour", name, find(name), ALL.iter().map(|one| one.name))
    }
}
