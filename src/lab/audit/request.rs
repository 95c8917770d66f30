//! The request for an audit, the same request for another dialect of the language, and the values of arguments that are known before
//! the material is asked: those that the user gives with `--arg`, and defaults in the text.

use core::time::Duration;
use std::path::PathBuf;

use super::cosine::{CosineArgument, CosineForm, is_named};
use super::error::{Error, FunctionPlace, ValueFault};
use super::language::Language;
use super::preprocess::Define;
use super::quantity::{self, Quantity};
use crate::lab::cost::Family;
use crate::lab::verify::function_head::{FunctionHead, NumberShape, Parameter};
use crate::physics::spectra::Space;

/// A request for an audit.
#[derive(Clone, Debug)]
pub struct Audit {
    /// The file's name, for messages.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Its language.
    pub language: Language,
    /// The name of the function. If none is given, the file must hold one only.
    pub function: Option<String>,
    /// Names that are defined for the preprocessor.
    pub defines: Vec<Define>,
    /// Values of its arguments.
    pub given: Vec<Given>,
    /// The colour space, for errors under viewing conditions.
    pub space: Space,
    /// The largest error that is not a finding.
    pub max_error: Option<f64>,
    /// The most numbers of a material that a compared method of ours may take.
    pub max_inputs: Option<usize>,
    /// The GPUs whose compilers are asked.
    pub families: Vec<&'static Family>,
    /// The user's folder of compilers.
    pub tools: Option<PathBuf>,
    /// Seconds that one step may take.
    pub seconds: u64,
    /// Processes that run at once.
    pub workers: usize,
}

impl Audit {
    /// This audit with the constants of Godot's shaders, if the text is one of them.
    pub fn in_godot(&self) -> Option<Audit> {
        let constants = [("PI", "3.1415926535897932"), ("TAU", "6.2831853071795864")];
        let is_of_godot = self.file.ends_with(".gdshader") || self.file.ends_with(".gdshaderinc");
        (is_of_godot && self.language == Language::Gles).then(|| {
            let mut audit = self.clone();
            let own = constants.iter().filter(|(name, _)| {
                let defines = |one: &Define| one.name == *name;
                !self.text.contains(&format!("define {name}")) && !self.defines.iter().any(defines)
            });
            audit.defines.extend(own.map(|(name, value)| Define {
                name: (*name).to_owned(),
                value: (*value).to_owned(),
            }));
            audit
        })
    }

    /// This audit with the text as desktop GLSL of this version.
    pub fn on_the_desktop(&self, version: u32) -> Audit {
        let mut audit = self.clone();
        audit.language = Language::Glsl;
        audit.defines.insert(0, Define::of("__VERSION__", version));
        audit
    }

    /// How long one step may take.
    pub fn limit(&self) -> Duration {
        Duration::from_secs(self.seconds)
    }
}

/// What a user gives for an argument: `name=v`, `name=v,v,v`, `name=quantity`, or `name=angle`.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// The argument's name.
    pub name: String,
    /// Its value.
    pub(super) value: GivenValue,
}

/// The value that a user gives for an argument.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenValue {
    /// One number, or three.
    Numbers(Vec<f32>),
    /// The material's value of a quantity.
    Quantity(Quantity),
    /// A form of the angle of incidence.
    Cosine(CosineForm),
}

impl Given {
    /// Parses the word after `--arg`.
    ///
    /// # Errors
    /// It is not of that form.
    pub fn read(word: &str) -> Result<Given, Error> {
        let wrong = |fault: ValueFault| Error::Value {
            word: word.to_owned(),
            fault,
        };
        let (name, list) = word
            .split_once('=')
            .ok_or_else(|| wrong(ValueFault::NoName))?;
        let name = name.trim().to_owned();
        if let Some(quantity) = quantity::find(list.trim()) {
            let value = GivenValue::Quantity(quantity);
            return Ok(Given { name, value });
        }
        if let Some(form) = CosineForm::find(list.trim()) {
            let value = GivenValue::Cosine(form);
            return Ok(Given { name, value });
        }
        let number = |text: &str| {
            let read = text.trim().parse::<f32>().ok();
            let read = read.filter(|value| value.is_finite());
            let fault = || {
                if is_word(text) {
                    ValueFault::NoQuantity(quantity::unknown(text.trim()))
                } else {
                    ValueFault::NoNumber(text.to_owned())
                }
            };
            read.ok_or_else(|| wrong(fault()))
        };
        let values: Vec<f32> = list.split(',').map(number).collect::<Result<_, _>>()?;
        if ![1, 3].contains(&values.len()) {
            return Err(wrong(ValueFault::Count(values.len())));
        }
        let value = GivenValue::Numbers(values);
        Ok(Given { name, value })
    }
}

/// Whether a word looks like the name of a quantity and is not one: it holds a letter, and does not parse as a number such as
/// `inf`.
fn is_word(text: &str) -> bool {
    let word = text.trim();
    let is_number = word.parse::<f32>().is_ok();
    word.contains(char::is_alphabetic) && !is_number && quantity::find(word).is_none()
}

/// An argument that keeps its default value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DefaultArgument {
    /// Its index.
    pub place: usize,
    /// Its name.
    pub name: String,
    /// Its type, as it is written.
    pub ty: String,
    /// The value, as it is written.
    pub value: String,
}

/// The argument that the user declares to be the cosine, or to stand for it.
///
/// # Errors
/// It is not a single number.
pub fn given_cosine(
    file: &str,
    function: &FunctionHead,
    given: &[Given],
) -> Result<Option<CosineArgument>, Error> {
    let own = given.iter().rev().find_map(|given| match given.value {
        GivenValue::Cosine(form) => Some((&given.name, form)),
        _ => None,
    });
    let Some((name, form)) = own else {
        return Ok(None);
    };
    let params = &function.params;
    let is_it = |one: &Parameter| one.name == *name && one.shape == NumberShape::Scalar;
    let place = params.iter().position(is_it);
    let place = place.ok_or_else(|| Error::NoNumber {
        place: FunctionPlace::new(file, function),
        argument: name.clone(),
        form: form.name(),
    })?;
    Ok(Some(CosineArgument {
        place,
        form: Some(form),
        is_alone: false,
    }))
}

/// The arguments that keep their default values. One that is named as a cosine is run over cosines, whatever its default.
pub fn defaults(function: &FunctionHead, given: &[Given]) -> Vec<DefaultArgument> {
    let params = function.params.iter().enumerate();
    let is_given = |name: &str| given.iter().any(|given| given.name == name);
    let default = |(place, param): (usize, &Parameter)| {
        let value = param.default.clone()?;
        (!is_given(&param.name) && !is_named(&param.name)).then(|| DefaultArgument {
            place,
            name: param.name.clone(),
            ty: param.ty.clone(),
            value,
        })
    };
    params.filter_map(default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_one_number_or_three() {
        let read = |word: &str| Given::read(word).map(|given| given.value).ok();
        let numbers = |all: &[f32]| Some(GivenValue::Numbers(all.to_vec()));
        assert_eq!(read("f0=.5"), numbers(&[0.5]));
        assert_eq!(read("f0=1.03,.73, .36"), numbers(&[1.03, 0.73, 0.36]));
        let inverse = quantity::find("1/eta").map(GivenValue::Quantity);
        assert_eq!(read("ior=1/eta"), inverse);
        for wrong in [
            "f0",
            "f0=",
            "f0=1,2",
            "f0=red",
            "f0=nan",
            "f0=1e99",
            "f0=1,2,3,4",
        ] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
