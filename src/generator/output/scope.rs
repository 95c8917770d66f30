//! The scope of a run: which manifest entries it may replace or remove.
//!
//! A run owns only what it was asked for, so that `--material silver` after `--target gles` gives the same tree as the other way
//! round.

use std::collections::BTreeSet;

use crate::generator::emit::Artifact;
use crate::generator::output::manifest::Entry;
use crate::physics::num::Precision;

impl Artifact {
    /// The key that distinguishes a file of an effect from others in its target's folder.
    pub(in crate::generator) fn effect_key(&self) -> Option<EffectKey> {
        let effect = self.effect.clone()?;
        Some((effect, self.material.clone(), self.method.clone()))
    }
}

/// What a run generates, by name. Only names whose files the run generates may stand here: a run removes the files that it owns
/// but does not generate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scope {
    /// The targets selected, by `--target` or by default.
    pub targets: BTreeSet<String>,
    /// The methods selected by `--method`. None: all, also those that this version no longer knows, so that the files of a
    /// deleted method are removed. An empty set: the run makes no library files.
    pub methods: Option<BTreeSet<String>>,
    /// The materials selected, by `--material` or by default. There is no "all" here:
    /// an earlier run may have added a material from the user's own file.
    pub materials: BTreeSet<String>,
    /// Whether the run makes the files that name neither method nor material, such as the catalogue.
    pub shared: bool,
    /// The files of effects that the run makes.
    pub effects: BTreeSet<EffectKey>,
    /// The flavours that the run writes.
    pub flavours: BTreeSet<String>,
    /// The precision of the run's functions. The run does not own files of the other precision.
    pub precision: Precision,
    /// Whether no selecting flag was given. Such a run also removes orphans.
    pub whole: bool,
    /// Whether the folder belongs to this run alone. Then the run owns all that the manifest lists.
    pub alone: bool,
}

/// The key of a file of effects in its target's folder: the effect, the material, and the method unless it is the default.
pub type EffectKey = (String, Option<String>, Option<String>);

impl Scope {
    /// May this run replace or remove the entry?
    pub fn owns(&self, entry: &Entry) -> bool {
        if self.alone {
            return true;
        }
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
