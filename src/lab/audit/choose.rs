//! Which function of a file is audited.

use crate::physics::names::UnknownName;

use super::bind::place_of;
use super::error::Error;
use super::language::Language;
use super::scan::{FoundFunction, NumberShape, Parameter};

/// The function that is meant.
///
/// # Errors
/// There is none of that name, or several where none is named, or it is no function of reflectance.
pub fn choose(
    file: &str,
    found: Vec<FoundFunction>,
    name: Option<&str>,
    language: Language,
) -> Result<FoundFunction, Error> {
    let named = match name {
        None => found,
        Some(name) => named(file, &found, name)?,
    };
    let fits = named.iter().filter(|found| found.is_candidate());
    let candidates: Vec<FoundFunction> = fits.cloned().collect();
    match (candidates.as_slice(), name) {
        ([one], _) => Ok(one.clone()),
        ([], Some(_)) => Err(unfit(file, &named[0])),
        ([], None) => match named.iter().find(|found| found.needs_object) {
            Some(found) => Err(unfit(file, found)),
            None => Err(Error::NoReflectance {
                file: file.to_owned(),
            }),
        },
        _ => Err(Error::SeveralFunctions {
            file: file.to_owned(),
            names: told_apart(&candidates, language),
        }),
    }
}

/// The functions of a name, or of a name and a line: `schlick:12`.
fn named(file: &str, found: &[FoundFunction], name: &str) -> Result<Vec<FoundFunction>, Error> {
    let is_number = |line: &str| line.chars().all(|c| c.is_ascii_digit());
    let (name, line) = match name.rsplit_once(':') {
        Some((name, line)) if is_number(line) || !name.ends_with(':') => (name, Some(line)),
        _ => (name, None),
    };
    let of_name = found
        .iter()
        .filter(|found| found.name == name || found.path() == name);
    let of_name: Vec<FoundFunction> = of_name.cloned().collect();
    if of_name.is_empty() {
        let paths: Vec<String> = found.iter().map(FoundFunction::path).collect();
        let mut all: Vec<&str> = paths.iter().map(String::as_str).collect();
        all.dedup();
        return Err(if all.is_empty() {
            Error::NoFunction {
                file: file.to_owned(),
            }
        } else {
            UnknownName::new("function", name, &all).into()
        });
    }
    let Some(line) = line else {
        return Ok(of_name);
    };
    let is_there = |found: &&FoundFunction| line.parse() == Ok(found.line);
    let there: Vec<FoundFunction> = of_name.iter().filter(is_there).cloned().collect();
    if there.is_empty() {
        Err(Error::NoFunctionInLine {
            file: file.to_owned(),
            name: name.to_owned(),
            line: line.to_owned(),
            lines: of_name.iter().map(|found| found.line.to_string()).collect(),
        })
    } else {
        Ok(there)
    }
}

/// Names of functions; those that several have with their lines and arguments with types.
fn told_apart(functions: &[FoundFunction], language: Language) -> Vec<String> {
    let words = |one: &FoundFunction| {
        let is_other = |other: &&FoundFunction| other.path() == one.path();
        if functions.iter().filter(is_other).count() == 1 {
            return one.path();
        }
        let params: Vec<String> = one
            .params
            .iter()
            .map(|param| typed(param, language))
            .collect();
        format!("{}:{} ({})", one.path(), one.line, params.join(", "))
    };
    functions.iter().map(words).collect()
}

/// An argument as a head of this language has it.
fn typed(param: &Parameter, language: Language) -> String {
    match language {
        Language::Wgsl => format!("{}: {}", param.name, param.ty),
        _ => format!("{} {}", param.ty, param.name),
    }
}

/// Why a function cannot be one of reflectance.
fn unfit(file: &str, found: &FoundFunction) -> Error {
    let is_other = |shape: &NumberShape| matches!(shape, NumberShape::Other(_));
    let is_open = |param: &&Parameter| is_other(&param.shape) && param.default.is_none();
    let other = found.params.iter().find(is_open);
    let why = if found.needs_object {
        let around = found.scope.last().map_or("", String::as_str);
        return Error::NeedsObject {
            place: place_of(file, found),
            ty: around.to_owned(),
        };
    } else if let Some(param) = other {
        format!("its argument `{}` is `{}`", param.name, param.shape.words())
    } else if is_other(&found.result) {
        format!("it gives `{}`", found.result.words())
    } else {
        "it takes no single number, which the cosine is".to_owned()
    };
    Error::Unfit {
        place: place_of(file, found),
        why,
    }
}
