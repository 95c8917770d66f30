//! The files of effects: in their default form, with another method, or specialised to materials.

use crate::generator::emit::{self, Artifact, EffectRequest, EmittedFunction, HeaderForm};
use crate::generator::error::{Error, RequestFault};
use crate::generator::generate::written::Owners;
use crate::generator::generate::{GeneratedFile, Run};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Request, each_once};
use crate::language::effects::{self, Effect, USUAL_METHOD};
use crate::language::methods::{self, Method};
use crate::language::targets::Target;

/// The effects of a request, and the method for them.
#[derive(Debug, Default)]
pub struct WantedEffects {
    /// The effects.
    pub effects: Vec<&'static Effect>,
    /// The method that computes R, if one is named.
    pub method: Option<&'static Method>,
}

/// The effects that a request asks for.
///
/// # Errors
/// A name is no effect, several methods are named, or the precision is not single.
pub fn wanted(
    request: &Request,
    named: Option<&[&'static Method]>,
) -> Result<WantedEffects, Error> {
    if request.effects.is_empty() {
        return Ok(WantedEffects {
            effects: if request.selects_nothing() {
                effects::ALL.to_vec()
            } else {
                Vec::new()
            },
            method: None,
        });
    }
    if request.precision.is_half() {
        let why = "effects compute in single precision; leave --precision f16 out";
        return Err(RequestFault::refused(why).into());
    }
    let method = match named {
        None => None,
        Some([method]) if method.is_textured() => {
            return Err(RequestFault::textured_reflectance(method).into());
        }
        Some([method]) if method.keeps_inputs() => {
            let why = format!(
                "method `{}` takes a film, and effects know bare media; name another --method",
                method.name
            );
            return Err(RequestFault::refused(why).into());
        }
        Some([method]) => Some(*method),
        Some(_) => {
            let why = "an effect takes R from one method; name one --method";
            return Err(RequestFault::refused(why).into());
        }
    };
    Ok(WantedEffects {
        effects: each_once(request.effects.clone(), |effect| effect.name),
        method,
    })
}

impl Run<'_> {
    /// Whether the run writes only effects.
    pub fn is_of_effects(&self) -> bool {
        !self.request.effects.is_empty()
    }

    /// What effects are specialised to: none (any material), or each named material.
    fn effect_subjects(&self) -> Vec<Option<&MaterialInMedium>> {
        if !self.is_of_effects() || self.subjects.is_empty() {
            return vec![None];
        }
        let subjects = self.subjects.iter();
        subjects.map(|(subject, _)| Some(subject)).collect()
    }

    /// The functions of an effect, with the request that gave them.
    fn effect<'s>(
        &self,
        effect: &'static Effect,
        subject: Option<&'s MaterialInMedium>,
        target: &Target,
    ) -> Result<(EffectRequest<'s>, Vec<EmittedFunction>), Error> {
        let usual = subject.map_or(USUAL_METHOD, MaterialInMedium::main_method);
        let usual = methods::find(usual).expect("the usual methods are registered");
        let request = EffectRequest {
            effect,
            method: self.effects.method.unwrap_or(usual),
            subject,
        };
        let functions = request.functions(&self.naming(target, &request.stem()))?;
        Ok((request, functions))
    }

    /// All files of effects.
    pub fn effect_files(&self, owners: &mut Owners) -> Result<Vec<GeneratedFile>, Error> {
        let mut files = Vec::new();
        for target in &self.targets {
            for (request, functions) in self.effect_functions(target)? {
                let stem = request.stem();
                let naming = self.naming(target, &stem);
                for emitted in &functions {
                    owners.claim(&emitted.name, &stem)?;
                }
                let command = self.effect_command(target, &request);
                files.push(GeneratedFile {
                    artifact: emit::effect_file(target, &request, &functions, &naming, &command)?,
                    functions,
                    subject: None,
                });
            }
        }
        Ok(files)
    }

    /// The functions of each file. An effect that neither the method nor the material changes has none.
    ///
    /// # Errors
    /// No effect has any functions.
    pub fn effect_functions(
        &self,
        target: &Target,
    ) -> Result<Vec<(EffectRequest<'_>, Vec<EmittedFunction>)>, Error> {
        let mut all = Vec::new();
        for effect in &self.effects.effects {
            for subject in self.effect_subjects() {
                all.push(self.effect(effect, subject, target)?);
            }
        }
        all.retain(|(_, functions)| !functions.is_empty());
        if all.is_empty() && self.is_of_effects() {
            let names: Vec<&str> = self.request.effects.iter().map(|one| one.name).collect();
            let why = format!("{}; leave the flag out", self.unchanged(&names.join(", ")));
            return Err(RequestFault::refused(why).into());
        }
        Ok(all)
    }

    /// Why an effect has no file in this run.
    fn unchanged(&self, effect: &str) -> String {
        let what = match (self.effects.method, self.subjects.is_empty()) {
            (Some(method), true) => format!("method `{}`", method.name),
            _ => "the material".to_owned(),
        };
        format!("{what} changes nothing of {effect}, whose usual form serves")
    }

    /// The named effects that have none of these files, and why.
    pub fn unchanged_effects(&self, artifacts: &[Artifact]) -> Vec<String> {
        let has = |effect: &Effect| {
            let mut made = artifacts.iter();
            made.any(|artifact| artifact.effect.as_deref() == Some(effect.name))
        };
        let all = self.effects.effects.iter();
        let without = all.filter(|effect| self.is_of_effects() && !has(effect));
        without.map(|effect| self.unchanged(effect.name)).collect()
    }

    /// The effects with all their functions. Functions that several materials share appear once.
    pub fn whole_effects(
        &self,
        target: &Target,
    ) -> Result<Vec<(EffectRequest<'_>, Vec<EmittedFunction>)>, Error> {
        let mut all = Vec::new();
        for effect in &self.effects.effects {
            for (place, subject) in self.effect_subjects().into_iter().enumerate() {
                let (request, changed) = self.effect(effect, subject, target)?;
                let functions = match place {
                    0 => request.whole(&self.naming(target, &request.stem()))?,
                    _ => changed,
                };
                all.push((request, functions));
            }
        }
        all.retain(|(_, functions)| !functions.is_empty());
        Ok(all)
    }

    /// The command that writes a file of an effect again.
    pub fn effect_command(&self, target: &Target, effect: &EffectRequest) -> String {
        let gpu = self.naming(target, &effect.stem()).gpu;
        let method = effect.unusual_method();
        let (subject, form) = (effect.subject, HeaderForm::default());
        self.command(
            (target, gpu),
            Some(effect.effect),
            method.as_slice(),
            subject,
            form,
        )
    }
}
