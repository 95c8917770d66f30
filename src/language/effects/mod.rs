//! What Fresnel's equations make visible, as functions that engines import: one file an effect, with formula, source and where it
//! must be wrong.
//!
//! To add one, write its file: a `//!` header with formula and source, and a `pub static EFFECT: Effect`. Then run `tests/lists`, which
//! writes the list below.
//! An effect is a graph like a method's, so that it is printed, run and measured in the same way. There are no loops: an application
//! repeats a step.

mod effect;

pub use effect::{Argument, BuiltEffect, Domain, Effect, EffectFunction, Reflectance};

// BEGIN list (written by tests/lists)
mod caustics;
mod coat;
mod complex_f0;
mod dispersion;
mod ggx_specular;
mod interface;
mod interior;
mod normal_mapping;
mod parallax;
mod water;

/// Every effect, by name.
#[rustfmt::skip]
pub static ALL: &[&Effect] = &[
    &caustics::EFFECT,
    &coat::EFFECT,
    &complex_f0::EFFECT,
    &dispersion::EFFECT,
    &ggx_specular::EFFECT,
    &interface::EFFECT,
    &interior::EFFECT,
    &normal_mapping::EFFECT,
    &parallax::EFFECT,
    &water::EFFECT,
];
// END list

/// The effect of this name.
pub fn find(name: &str) -> Option<&'static Effect> {
    ALL.iter().find(|effect| effect.name == name).copied()
}

/// Every name that a version of this program wrote files of effects under and that is no effect's today: a run without flags removes
/// these files.
pub const FORMER: &[&str] = &[];

/// What R is computed by unless asked otherwise: both sides of a surface, total reflection included.
pub const USUAL_METHOD: &str = "dielectric_exact";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods;

    #[test]
    fn every_function_is_well_formed_with_every_method() {
        let functions = ALL.iter().flat_map(|effect| effect.functions);
        let all = functions.flat_map(|function| methods::ALL.iter().map(move |by| (function, by)));
        let faults = all.filter_map(|(function, by)| {
            let fault = function.built(by).err()?;
            Some(format!("{} by {}: {fault}\n", function.name, by.name))
        });
        let faults: String = faults.collect();
        assert!(faults.is_empty(), "{faults}");
    }
}
