//! The choice of the function of a file that is audited.

use super::error::{Error, FunctionPlace};
use super::language::Language;
use crate::lab::verify::function_head::{FunctionHead, NumberShape, Parameter};
use crate::physics::names::UnknownName;

/// The function that is audited.
///
/// # Errors
/// There is none of that name, or several where none is named, or it cannot be a reflectance function.
pub fn choose(
    file: &str,
    found: Vec<FunctionHead>,
    name: Option<&str>,
    language: Language,
) -> Result<FunctionHead, Error> {
    let named = match name {
        None => found,
        Some(name) => named(file, &found, name)?,
    };
    let fits = named.iter().filter(|found| is_candidate(found));
    let candidates: Vec<FunctionHead> = fits.cloned().collect();
    match (candidates.as_slice(), name) {
        ([one], _) => Ok(one.clone()),
        ([], Some(_)) => Err(unfit(file, &named[0])),
        ([], None) => match named.iter().find(|found| found.needs_object) {
            Some(found) => Err(unfit(file, found)),
            None => Err(Error::NoReflectance(file.to_owned())),
        },
        _ => Err(Error::SeveralFunctions {
            file: file.to_owned(),
            names: distinct_names(&candidates, language),
        }),
    }
}

/// Whether it can be a reflectance function: numbers in, one of them the cosine, and numbers out.
fn is_candidate(function: &FunctionHead) -> bool {
    let known = |shape: &NumberShape| !matches!(shape, NumberShape::Other(_));
    let scalar = |param: &Parameter| param.shape == NumberShape::Scalar;
    !function.needs_object
        && known(&function.result)
        && function
            .params
            .iter()
            .all(|param| known(&param.shape) || param.default.is_some())
        && function.params.iter().any(scalar)
}

/// The functions of a name, or of a name and a line: `schlick:12`.
fn named(file: &str, found: &[FunctionHead], name: &str) -> Result<Vec<FunctionHead>, Error> {
    let is_number = |line: &str| line.chars().all(|c| c.is_ascii_digit());
    let (name, line) = match name.rsplit_once(':') {
        Some((name, line)) if is_number(line) || !name.ends_with(':') => (name, Some(line)),
        _ => (name, None),
    };
    let of_name = found
        .iter()
        .filter(|found| found.name == name || found.path() == name);
    let of_name: Vec<FunctionHead> = of_name.cloned().collect();
    if of_name.is_empty() {
        let paths: Vec<String> = found.iter().map(FunctionHead::path).collect();
        let mut all: Vec<&str> = paths.iter().map(String::as_str).collect();
        all.dedup();
        return Err(if all.is_empty() {
            Error::NoFunction(file.to_owned())
        } else {
            UnknownName::new("function", name, &all).into()
        });
    }
    let Some(line) = line else {
        return Ok(of_name);
    };
    let is_there = |found: &&FunctionHead| line.parse() == Ok(found.line);
    let there: Vec<FunctionHead> = of_name.iter().filter(is_there).cloned().collect();
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

/// Names of functions. A name that several share comes with their lines and typed arguments.
fn distinct_names(functions: &[FunctionHead], language: Language) -> Vec<String> {
    let words = |one: &FunctionHead| {
        let is_other = |other: &&FunctionHead| other.path() == one.path();
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

/// An argument in the form of this language's function heads.
fn typed(param: &Parameter, language: Language) -> String {
    match language {
        Language::Wgsl => format!("{}: {}", param.name, param.ty),
        _ => format!("{} {}", param.ty, param.name),
    }
}

/// Why a function cannot be a reflectance function.
fn unfit(file: &str, found: &FunctionHead) -> Error {
    let is_other = |shape: &NumberShape| matches!(shape, NumberShape::Other(_));
    let is_open = |param: &&Parameter| is_other(&param.shape) && param.default.is_none();
    let other = found.params.iter().find(is_open);
    let why = if found.needs_object {
        let around = found.scope.last().map_or("", String::as_str);
        return Error::NeedsObject {
            place: FunctionPlace::new(file, found),
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
        place: FunctionPlace::new(file, found),
        why,
    }
}
