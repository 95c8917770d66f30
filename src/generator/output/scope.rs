//! The scope of a run: which manifest entries it may replace or remove.
//!
//! A run owns only what it asked for, so that `--material silver` after `--target gles` gives the same tree as the other way round.

use std::collections::BTreeSet;

use crate::physics::num::Precision;

use crate::generator::output::manifest::Entry;

/// What a run generates, by name. A name must stand here only if the run generates its files:
/// what a run owns and does not generate, it removes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scope {
    /// The targets selected, by `--target` or by default.
    pub targets: BTreeSet<String>,
    /// The methods selected by `--method`. None: all, also those that this version no longer knows,
    /// so that the files of a deleted method go. An empty set: the run makes no library files.
    pub methods: Option<BTreeSet<String>>,
    /// The materials selected, by `--material` or by default. There is no "all" here:
    /// an earlier run may have added a material from the user's own file.
    pub materials: BTreeSet<String>,
    /// Does the run make the files that name neither method nor material, such as the catalogue?
    pub shared: bool,
    /// The files of effects that the run makes: the effect, the material, the method where it is not the usual one.
    pub effects: BTreeSet<EffectKey>,
    /// The flavours that the run writes.
    pub flavours: BTreeSet<String>,
    /// What the run's functions compute in: files of the other precision are not its own.
    pub precision: Precision,
    /// None of the flags that choose was given: the run also removes orphans.
    pub whole: bool,
}

/// What tells files of effects apart in a target's folder.
pub type EffectKey = (String, Option<String>, Option<String>);

impl Scope {
    /// May this run replace or remove the entry?
    pub fn owns(&self, entry: &Entry) -> bool {
        if let Some(effect) = &entry.effect {
            let key = (effect.clone(), entry.material.clone(), entry.method.clone());
            let is_usual = entry.material.is_none() && entry.method.is_none();
            return self.targets.contains(&entry.target)
                && (self.effects.contains(&key) || self.whole && is_usual);
        }
        if self.flavours.contains(&entry.target) {
            return (entry.material.as_ref()).is_none_or(|name| self.materials.contains(name));
        }
        let method = |name: &String| self.methods.as_ref().is_none_or(|all| all.contains(name));
        let named = entry.method.is_some() || entry.material.is_some();
        self.targets.contains(&entry.target)
            && entry.precision() == self.precision.name()
            && (named || self.shared)
            && entry.method.as_ref().is_none_or(method)
            && (entry.material.as_ref()).is_none_or(|name| self.materials.contains(name))
    }
}
