//! Visible effects of Fresnel's equations, as functions that engines import. One file for each effect, with its formula, its
//! source and where it must be wrong.
//!
//! To add one, write its file: a `//!` header with formula and source, and a `pub static EFFECT: Effect`. Then run `tests/lists`, which
//! writes the list below. Each file begins with `use super::*`, which brings the words that an effect is written with.
//! An effect is a graph like a method's, so it is printed, run and measured in the same way. There are no loops: the application
//! repeats a step.

use std::str::FromStr;

use crate::language::ir::{Expr, Letters, Ty, USED_TWICE};
use crate::physics::cite::Citation;
use crate::physics::names::{UnknownName, named};

mod effect;

pub use image_light::WHITE_MEAN_LOST;

pub use effect::{Argument, BuiltEffect, Domain, Effect, EffectFunction, Reflectance};
use effect::{
    Arguments, ETA, INCIDENT, NORMAL, UV_SCALE_BIAS, VIEW_PROJECTION, cross, length, mirrored,
    refraction, unit_or_zero,
};

// BEGIN list (written by tests/lists)
mod caustics;
mod coat;
mod complex_f0;
mod dispersion;
mod ggx_specular;
mod image_light;
mod interface;
mod interior;
mod normal_mapping;
mod parallax;
mod polarisation;
mod water;

/// Every effect, by name.
#[rustfmt::skip]
pub static ALL: &[&Effect] = &[
    &caustics::EFFECT,
    &coat::EFFECT,
    &complex_f0::EFFECT,
    &dispersion::EFFECT,
    &ggx_specular::EFFECT,
    &image_light::EFFECT,
    &interface::EFFECT,
    &interior::EFFECT,
    &normal_mapping::EFFECT,
    &parallax::EFFECT,
    &polarisation::EFFECT,
    &water::EFFECT,
];

/// Each by its name.
#[rustfmt::skip]
#[allow(missing_docs)]
impl Effect {
    pub const CAUSTICS: &'static Effect = &caustics::EFFECT;
    pub const COAT: &'static Effect = &coat::EFFECT;
    pub const COMPLEX_F0: &'static Effect = &complex_f0::EFFECT;
    pub const DISPERSION: &'static Effect = &dispersion::EFFECT;
    pub const GGX_SPECULAR: &'static Effect = &ggx_specular::EFFECT;
    pub const IMAGE_LIGHT: &'static Effect = &image_light::EFFECT;
    pub const INTERFACE: &'static Effect = &interface::EFFECT;
    pub const INTERIOR: &'static Effect = &interior::EFFECT;
    pub const NORMAL_MAPPING: &'static Effect = &normal_mapping::EFFECT;
    pub const PARALLAX: &'static Effect = &parallax::EFFECT;
    pub const POLARISATION: &'static Effect = &polarisation::EFFECT;
    pub const WATER: &'static Effect = &water::EFFECT;
}
// END list

/// The effect of this name.
pub fn find(name: &str) -> Option<&'static Effect> {
    ALL.iter().find(|effect| effect.name == name).copied()
}

/// Former names of effects, under which earlier versions of this program wrote files. A run without flags removes these files.
pub const FORMER: &[&str] = &[];

/// The default method for R: it covers both sides of a surface, total reflection included.
pub const USUAL_METHOD: &str = "dielectric_exact";

impl FromStr for &'static Effect {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<&'static Effect, UnknownName> {
        named("effect", name, find(name), ALL.iter().map(|one| one.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods;

    #[test]
    fn every_function_is_well_formed_with_every_method() {
        for function in ALL.iter().flat_map(|effect| effect.functions) {
            for by in methods::ALL.iter().filter(|by| !by.keeps_inputs()) {
                let fault = function.built(by).err();
                assert_eq!(fault, None, "{} by {}", function.name, by.name);
            }
        }
    }
}
