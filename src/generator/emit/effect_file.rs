//! The files of effects: the functions of one effect, for any material, with another method, or for one material.

use super::artifact::{Artifact, Detail, FunctionsDetail};
use super::batch::batch_program;
use super::code_bound::CodeBound;
use super::comment;
use super::error::Error;
use super::function::{EffectPart, EmittedFunction, FunctionForm, Naming, check_names};
use super::header::{COSINE, MARK, licence_line};
use super::page::{self, Documented, PageRequest, comments, guard};
use crate::generator::fit::{Measured, values_for_material};
use crate::generator::reference::MaterialInMedium;
use crate::language::effects::{BuiltEffect, Effect, EffectFunction, Reflectance, USUAL_METHOD};
use crate::language::ir::{Checked, Param};
use crate::language::methods::{self, Contract, Method, Values};
use crate::language::targets::{Finish, Target, WGSL};
use crate::physics::materials::Channels;

/// Which functions of an effect to write: all of them, or those that differ for a method or a material.
#[derive(Clone, Copy, Debug)]
pub struct EffectRequest<'a> {
    /// The effect.
    pub effect: &'static Effect,
    /// The method that computes R.
    pub method: &'static Method,
    /// The material whose values are fixed.
    pub subject: Option<&'a MaterialInMedium>,
}

impl EffectRequest<'_> {
    /// The default method: for a material, its exact law.
    fn usual_method(&self) -> &'static str {
        self.subject
            .map_or(USUAL_METHOD, MaterialInMedium::main_method)
    }

    /// The method's name, unless it is the default.
    pub fn unusual_method(&self) -> Option<&'static str> {
        Some(self.method.name).filter(|name| *name != self.usual_method())
    }

    /// The suffix that distinguishes its file and its functions from the default ones: `_gold`, `_schlick`, `_gold_schlick`, or
    /// nothing.
    fn suffix(&self) -> String {
        let material = self.subject.map(|subject| subject.name.as_str());
        let parts = material.into_iter().chain(self.unusual_method());
        parts.map(|part| format!("_{part}")).collect()
    }

    /// The name of its file, without the extension.
    pub fn stem(&self) -> String {
        format!("{EFFECTS}/{}{}", self.effect.name, self.suffix())
    }

    /// The functions that are written: those that another method or a material changes, or all.
    ///
    /// # Errors
    /// The method does not describe the material, or a graph breaks a rule of [`crate::language::ir::RULES`].
    pub fn functions(&self, naming: &Naming) -> Result<Vec<EmittedFunction>, Error> {
        let mut functions = Vec::new();
        for function in self.effect.functions {
            let part = EffectPart {
                effect: self.effect,
                function,
            };
            match self.subject {
                Some(subject) => functions.extend(self.of_material(part, subject, naming)?),
                None => functions.extend(self.of_any_material(part, naming)?),
            }
        }
        check_names(&functions)?;
        Ok(functions)
    }

    /// All functions of the effect: first those in their default form, then those that another method or a material changes.
    ///
    /// # Errors
    /// As [`EffectRequest::functions`].
    pub fn whole(&self, naming: &Naming) -> Result<Vec<EmittedFunction>, Error> {
        let usual = EffectRequest {
            effect: self.effect,
            method: methods::find(USUAL_METHOD).expect("the usual method is registered"),
            subject: None,
        };
        let changed = self.functions(naming)?;
        let part = |emitted: &EmittedFunction| emitted.effect.map(|part| part.function.name);
        let mut all = usual.functions(naming)?;
        all.retain(|one| !changed.iter().any(|other| part(other) == part(one)));
        all.extend(changed);
        Ok(all)
    }

    fn of_any_material(
        &self,
        part: EffectPart,
        naming: &Naming,
    ) -> Result<Vec<EmittedFunction>, Error> {
        if self.unusual_method().is_some() && !part.function.reflectance.is_used() {
            return Ok(Vec::new());
        }
        let method = naming.written(self.method, FunctionForm::Library);
        let built = part.function.built(method);
        let built = built.map_err(|fault| Error::generated(self.effect.name, fault))?;
        let emitted = |built: BuiltEffect| match built.name.strip_prefix(part.function.name) {
            Some(scalar) if !scalar.is_empty() => {
                self.emitted(part, naming, scalar, FunctionForm::Scalar, built.function)
            }
            _ => self.emitted(part, naming, "", FunctionForm::Library, built.function),
        };
        Ok(built.into_iter().map(emitted).collect())
    }

    fn of_material(
        &self,
        part: EffectPart,
        subject: &MaterialInMedium,
        naming: &Naming,
    ) -> Result<Option<EmittedFunction>, Error> {
        let refused = |what: String| Error::specialise(self.method, subject, what);
        if part.function.reflectance.is_used() && !subject.is_described_by(self.method) {
            let media = self.method.class.media();
            return Err(refused(format!("it describes {media}")));
        }
        if subject.has_films() {
            return Err(refused(
                "effects are of bare media, and films have no index to refract by".to_owned(),
            ));
        }
        let Some(mut values) = self.values_of_r(part.function.reflectance, subject) else {
            return Ok(None);
        };
        let Channels { n, k } = subject.effective.channels;
        values.extend([("n".to_owned(), n), ("k".to_owned(), k)]);
        if !k.iter().any(|k| *k > 0.0) {
            values.insert("etas".to_owned(), n);
        }
        let Some(function) = part.function.specialised(self.method, &values) else {
            return Ok(None);
        };
        let function = function.map_err(|fault| refused(fault.to_string()))?;
        let form = FunctionForm::Specialised;
        Ok(Some(self.emitted(part, naming, "", form, function)))
    }

    /// The values of the method's inputs for a material. None where light leaves a body and the method takes more than its index.
    fn values_of_r(&self, asked: Reflectance, subject: &MaterialInMedium) -> Option<Values> {
        match asked {
            Reflectance::Unused => Some(Values::new()),
            Reflectance::EachChannel => Some(values_for_material(subject, self.method)),
            Reflectance::FromWithin => match self.method.inputs {
                [input] if input.name == "eta" => {
                    let inverse = subject.effective.channels.n.map(|n| 1.0 / n);
                    Some([("eta".to_owned(), inverse)].into())
                }
                _ => None,
            },
        }
    }

    fn emitted(
        &self,
        part: EffectPart,
        naming: &Naming,
        scalar: &str,
        form: FunctionForm,
        function: Checked,
    ) -> EmittedFunction {
        let (prefix, of) = (&naming.prefix, part.function.name);
        let name = format!("{prefix}{of}{}{scalar}", self.suffix());
        let code = code_bound(part.function, self.method);
        EmittedFunction {
            effect: Some(part),
            ..EmittedFunction::new(name, self.method, form, function, code)
        }
    }
}

/// The code error that a function states: its own, and that of R, in which a unit in the last place is at most 2^-24.
fn code_bound(function: &EffectFunction, method: &Method) -> Measured<CodeBound> {
    let of_r = match (function.reflectance, method.contract) {
        (Reflectance::Unused, _) => 0.0,
        (_, Contract::Exempt(why)) => return Measured::No(why.to_owned()),
        (_, Contract::Kept) => method.claims.code_ulp / f64::from(1 << 24),
    };
    let rounded = format!("{:.0e}", function.code_abs + of_r);
    let bound = rounded.parse().unwrap_or(f64::INFINITY);
    Measured::Yes(CodeBound::Absolute(bound))
}

/// The folder of effects in a target's folder.
pub const EFFECTS: &str = "effects";

/// The file of an effect in a language. `command` generates it again.
///
/// # Errors
/// naga refuses the text: a bug.
pub fn effect_file(
    target: &'static Target,
    request: &EffectRequest,
    functions: &[EmittedFunction],
    naming: &Naming,
    command: &str,
) -> Result<Artifact, Error> {
    let stem = request.stem();
    let unique = format!("{}{}_effect", naming.prefix, stem.replace('/', "_"));
    let guard = guard(target, &unique);
    let suffix = match target.finish {
        Finish::Spirv => ".comp",
        _ => "",
    };
    let plain: Vec<Documented> = functions.iter().map(|one| (Vec::new(), one)).collect();
    let detail = FunctionsDetail::new(target, &plain, command);
    let path = format!("{}/{stem}{suffix}.{}", target.name, target.extension);
    let bytes = page(target, request, functions, &guard, command)?;
    Ok(Artifact {
        effect: Some(request.effect.name.to_owned()),
        method: request.unusual_method().map(str::to_owned),
        material: request.subject.map(|subject| subject.name.clone()),
        ..Artifact::new(
            target.name,
            path,
            bytes,
            Detail::Functions(Box::new(detail)),
        )
    })
}

/// The text of an effect's functions for pasting; for a module, its bytes.
///
/// # Errors
/// naga refuses the text: a bug.
pub fn effect_text(
    target: &'static Target,
    request: &EffectRequest,
    functions: &[EmittedFunction],
    command: &str,
) -> Result<Vec<u8>, Error> {
    page(target, request, functions, "", command)
}

/// The text of one function of an effect with the comments above it, as in the files of effects.
///
/// # Errors
/// naga refuses the text: a bug.
pub fn effect_function_text(
    target: &'static Target,
    emitted: &EmittedFunction,
) -> Result<String, Error> {
    let functions = [documented(target, emitted)];
    let bytes = PageRequest::new(target, &functions, &emitted.name).render()?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn page(
    target: &'static Target,
    request: &EffectRequest,
    functions: &[EmittedFunction],
    guard: &str,
    command: &str,
) -> Result<Vec<u8>, Error> {
    let is_module = target.finish == Finish::Spirv;
    let text_of = if is_module { &WGSL } else { target };
    let one = |emitted| documented(text_of, emitted);
    let documented: Vec<Documented> = functions.iter().map(one).collect();
    let page = PageRequest {
        header: &comments(text_of, &comment::lines(header(request, command))),
        guard,
        ..PageRequest::new(text_of, &documented, request.effect.name)
    };
    let bytes = page.render()?;
    if !is_module {
        return Ok(bytes);
    }
    let text = String::from_utf8_lossy(&bytes);
    let all: Vec<&EmittedFunction> = functions.iter().collect();
    let program = batch_program(text_of, &text, &all).expect("WGSL is run in batches");
    page::spirv(&program).map_err(|fault| Error::generated(request.effect.name, fault))
}

/// A function with the comments above it.
fn documented<'a>(target: &Target, emitted: &'a EmittedFunction) -> Documented<'a> {
    let lines = comment::lines(documentation(emitted));
    (comments(target, &lines), emitted)
}

fn header(request: &EffectRequest, command: &str) -> Vec<String> {
    let EffectRequest { effect, method, .. } = request;
    let mut lines = vec![
        MARK.to_owned(),
        licence_line(),
        format!("Regenerate: {command}"),
        String::new(),
        format!("{}: {}", effect.name, effect.summary),
    ];
    if let Some(subject) = request.subject {
        let (name, what) = (&subject.name, &subject.material.summary);
        lines.push(format!(
            "For {name} ({what}). Functions that no material changes are without its name."
        ));
        let index = &subject.effective.channels;
        let three = |values: [f64; 3]| values.map(|value| format!("{value:.5}")).join(", ");
        lines.push(format!("n of red, green and blue: {}", three(index.n)));
        if index.k.iter().any(|k| *k > 1e-5) {
            lines.push(format!("k of red, green and blue: {}", three(index.k)));
        }
    } else if request.unusual_method().is_some() {
        let usual = "Functions that another method does not change are without its name.";
        lines.push(usual.to_owned());
    }
    lines.extend(effect.formula.iter().map(|line| format!("    {line}")));
    lines.push(format!("Source: {}", effect.source.line()));
    let mut functions = effect.functions.iter();
    if functions.any(|function| function.reflectance.is_used()) {
        let (name, source) = (method.name, method.source_in_full());
        lines.push(format!("R by {name}: {}. {source}", method.summary));
    }
    lines.extend(effect.conventions.iter().map(|line| (*line).to_owned()));
    lines.extend(effect.fails.iter().map(|line| format!("Wrong: {line}")));
    lines
}

/// What a function returns, what each argument means, and how accurate the function is.
fn documentation(emitted: &EmittedFunction) -> Vec<String> {
    let part = emitted.effect.map(|part| part.function);
    let meaning = |param: &Param| -> &str {
        let own = part.iter().flat_map(|part| part.arguments);
        let own = own.map(|argument| (argument.name, argument.meaning));
        let own = own.chain(part.is_none().then_some(("cos_theta", COSINE)));
        let inputs = emitted.method.inputs.iter();
        let mut all = own.chain(inputs.map(|input| (input.name, input.meaning)));
        let found = all.find(|(name, _)| *name == param.name);
        found.map_or("", |(_, meaning)| meaning)
    };
    let gives = part.map_or(emitted.method.summary, |part| part.gives);
    let mut lines = vec![format!("{}: {gives}", emitted.name)];
    let params = emitted.function.params.iter();
    lines.extend(params.map(|param| format!("  {}: {}", param.name, meaning(param))));
    let error = match &emitted.code {
        Measured::Yes(bound) => format!(
            "at most {:e}, relative where the result is above 1, besides what a change of each argument by 2^-22 of itself and 2^-23 does",
            bound.value()
        ),
        Measured::No(why) => format!("not stated: {why}"),
    };
    lines.push(format!(
        "Code error: {error}. Cost: {} operations",
        emitted.function.work()
    ));
    lines
}
