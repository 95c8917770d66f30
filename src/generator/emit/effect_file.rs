//! The files of effects: the functions of one effect, for any material, with another method, or for one material.

use std::collections::BTreeMap;

use super::batch::batch_program;
use super::comment;
use super::detail::{Detail, functions_detail};
use super::figures::CodeBound;
use super::file::{Error, File, check_names};
use super::function::{EmittedFunction, FunctionForm, Naming};
use super::header::{MARK, OUTPUT_LICENCE};
use super::page::{self, PageRequest, comments, guard, render};
use crate::generator::fit::{Measured, values_for_material};
use crate::generator::reference::MaterialInMedium;
use crate::language::effects::{Effect, EffectFunction, Reflectance, USUAL_METHOD};
use crate::language::ir::{BrokenRule, Checked, Param};
use crate::language::methods::{self, Contract, Method, Values};
use crate::language::targets::{Finish, Target};
use crate::physics::num::Precision;

/// A requested function of an effect.
#[derive(Clone, Copy, Debug)]
pub struct EffectPart {
    /// The effect.
    pub effect: &'static Effect,
    /// The function.
    pub function: &'static EffectFunction,
}

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
            .map_or(USUAL_METHOD, MaterialInMedium::exact_method)
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
        let asks = part.function.reflectance.is_used();
        if self.unusual_method().is_some() && !asks {
            return Ok(Vec::new());
        }
        let built = part.function.built(self.method);
        let built = built.map_err(|fault| self.broken(&fault))?;
        let emitted = |built: crate::language::effects::BuiltEffect| {
            let scalar = built.name.strip_prefix(part.function.name).unwrap_or("");
            let form = match scalar {
                "" => FunctionForm::Library,
                _ => FunctionForm::Scalar,
            };
            let name = format!("{}{}{scalar}", part.function.name, self.suffix());
            self.emitted(part, (naming, name), form, built.function)
        };
        Ok(built.into_iter().map(emitted).collect())
    }

    fn of_material(
        &self,
        part: EffectPart,
        subject: &MaterialInMedium,
        naming: &Naming,
    ) -> Result<Option<EmittedFunction>, Error> {
        let asks = part.function.reflectance.is_used();
        if asks && !subject.is_described_by(self.method) {
            return Err(self.refused(
                subject,
                &format!("it describes {}", self.method.class.media()),
            ));
        }
        let Some(mut values) = self.values_of_r(part.function.reflectance, subject) else {
            return Ok(None);
        };
        values.extend(index_values(subject));
        let function = match part.function.specialised(self.method, &values) {
            None => return Ok(None),
            Some(built) => built.map_err(|fault| self.refused(subject, &fault.to_string()))?,
        };
        let name = format!("{}{}", part.function.name, self.suffix());
        let form = FunctionForm::Specialised;
        Ok(Some(self.emitted(part, (naming, name), form, function)))
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
        (naming, name): (&Naming, String),
        form: FunctionForm,
        function: Checked,
    ) -> EmittedFunction {
        EmittedFunction {
            name: format!("{}{name}", naming.prefix),
            method: self.method,
            effect: Some(part),
            form,
            precision: Precision::F32,
            function,
            constants: Values::new(),
            model_error: None,
            code: stated(part.function, self.method),
            plain_for: None,
            written_as: None,
            missed: None,
        }
    }

    fn broken(&self, fault: &BrokenRule) -> Error {
        Error::Generated {
            file: self.effect.name.to_owned(),
            what: fault.to_string(),
        }
    }

    fn refused(&self, subject: &MaterialInMedium, what: &str) -> Error {
        Error::Specialise {
            method: self.method.name.to_owned(),
            material: subject.name.clone(),
            what: what.to_owned(),
        }
    }
}

/// The code error that a function states: its own, and that of R, in which a unit in the last place is at most 2^-24.
fn stated(function: &EffectFunction, method: &Method) -> Measured<CodeBound> {
    let of_r = match (function.reflectance, method.contract) {
        (Reflectance::Unused, _) => 0.0,
        (_, Contract::Exempt(why)) => return Measured::No(why.to_owned()),
        (_, Contract::Kept) => method.claims.code_ulp / f64::from(1 << 24),
    };
    let rounded = format!("{:.0e}", function.code_abs + of_r);
    Measured::Yes(CodeBound::Absolute(
        rounded.parse().unwrap_or(f64::INFINITY),
    ))
}

/// The folder of effects in a target's folder.
pub const EFFECTS: &str = "effects";

/// The indices of a material, for arguments that are not inputs of a method.
fn index_values(subject: &MaterialInMedium) -> BTreeMap<String, [f64; 3]> {
    let channels = &subject.effective.channels;
    let absorbs = channels.k.iter().any(|k| *k > 0.0);
    let etas = (!absorbs).then(|| ("etas".to_owned(), channels.n));
    let complex = [("n".to_owned(), channels.n), ("k".to_owned(), channels.k)];
    etas.into_iter().chain(complex).collect()
}

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
) -> Result<File, Error> {
    let is_module = target.finish == Finish::Spirv;
    let unique = format!(
        "{}{}_effect",
        naming.prefix,
        request.stem().replace('/', "_")
    );
    let bytes = page(target, request, functions, &guard(target, &unique), command)?;
    let suffix = if is_module { ".comp" } else { "" };
    let all: Vec<&EmittedFunction> = functions.iter().collect();
    let detail = functions_detail(target, &all, command);
    Ok(File {
        name: format!("{}{suffix}.{}", request.stem(), target.extension),
        bytes,
        detail: Detail::Functions(Box::new(detail)),
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
    let lines = comment::lines(documentation(emitted));
    let bytes = render(&PageRequest {
        target,
        page: &target.pages[0],
        header: &[],
        guard: "",
        functions: &[(comments(target, &lines), emitted.clone())],
        file: &emitted.name,
    })?;
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
    let text_of = if is_module {
        &crate::language::targets::WGSL
    } else {
        target
    };
    let header = comment::lines(header(request, command));
    let documented: Vec<(Vec<String>, EmittedFunction)> = functions
        .iter()
        .map(|emitted| {
            let lines = comment::lines(documentation(emitted));
            (comments(text_of, &lines), emitted.clone())
        })
        .collect();
    let bytes = render(&PageRequest {
        target: text_of,
        page: &text_of.pages[0],
        header: &comments(text_of, &header),
        guard,
        functions: &documented,
        file: request.effect.name,
    })?;
    if !is_module {
        return Ok(bytes);
    }
    let text = String::from_utf8_lossy(&bytes);
    let all: Vec<&EmittedFunction> = functions.iter().collect();
    let program = batch_program(text_of, &text, &all).expect("WGSL is run in batches");
    page::spirv(&program).map_err(|what| Error::Generated {
        file: request.effect.name.to_owned(),
        what,
    })
}

fn header(request: &EffectRequest, command: &str) -> Vec<String> {
    let EffectRequest { effect, method, .. } = request;
    let mut lines = vec![
        MARK.to_owned(),
        format!("Licence of this file: {OUTPUT_LICENCE}"),
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
        let source = method.source_in_full();
        lines.push(format!(
            "R by {}: {}. {source}",
            method.name, method.summary
        ));
    }
    lines.extend(effect.conventions.iter().map(|line| (*line).to_owned()));
    lines.extend(effect.fails.iter().map(|line| format!("Wrong: {line}")));
    lines
}

/// What a function returns, what each argument means, and how accurate the function is.
fn documentation(emitted: &EmittedFunction) -> Vec<String> {
    let part = emitted.effect.expect("a function of an effect");
    let meaning = |param: &Param| -> &str {
        let own = part.function.arguments.iter();
        let own = own.map(|argument| (argument.name, argument.meaning));
        let inputs = emitted.method.inputs.iter();
        let mut all = own.chain(inputs.map(|input| (input.name, input.meaning)));
        let found = all.find(|(name, _)| *name == param.name);
        found.map_or("", |(_, meaning)| meaning)
    };
    let mut lines = vec![format!("{}: {}", emitted.name, part.function.gives)];
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
