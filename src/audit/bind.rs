//! What each argument of a user's function is: the cosine, a value given with `--arg`, or one that the material has.

use std::collections::BTreeSet;

use crate::fit::values_for_material;
use crate::methods::{self, Class, Method, find_input};
use crate::names::UnknownName;
use crate::reference::MaterialInMedium;

use super::error::{Error, FunctionPlace, ValueFault};
use super::scan::{FoundFunction, NumberShape};

/// A function with all that it takes.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The function.
    pub function: FoundFunction,
    /// The place of the cosine among its arguments.
    pub cosine: usize,
    /// The others, in order.
    pub arguments: Vec<BoundArgument>,
}

/// An argument with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundArgument {
    /// Its name in the text.
    pub name: String,
    /// Whether the function takes three numbers.
    pub is_rgb: bool,
    /// The value of each channel.
    pub value: [f32; 3],
    /// Whether the material's value was taken.
    pub is_filled: bool,
}

impl Bound {
    /// Whether the function is called once for each channel: it takes one number where the channels differ.
    pub fn is_per_channel(&self) -> bool {
        self.arguments.iter().any(BoundArgument::is_split)
    }

    /// What was filled in, for people.
    pub fn filled(&self) -> Vec<String> {
        let filled = self.arguments.iter().filter(|argument| argument.is_filled);
        filled
            .map(|argument| format!("{} = {}", argument.name, numbers(argument.value)))
            .collect()
    }
}

impl BoundArgument {
    /// Whether it is one number in the text and has another for each channel.
    pub fn is_split(&self) -> bool {
        let [r, g, b] = self.value;
        !self.is_rgb && (r != g || g != b)
    }
}

fn numbers([r, g, b]: [f32; 3]) -> String {
    if r == g && g == b {
        format!("{r}")
    } else {
        format!("{r}, {g}, {b}")
    }
}

/// A value that a user gives: `name=v` or `name=v,v,v`.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    name: String,
    values: Vec<f32>,
}

impl Given {
    /// Reads one.
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
        let number = |text: &str| {
            let read = text.trim().parse::<f32>().ok();
            let read = read.filter(|value| value.is_finite());
            read.ok_or_else(|| wrong(ValueFault::NoNumber(text.to_owned())))
        };
        let values: Vec<f32> = list.split(',').map(number).collect::<Result<_, _>>()?;
        if ![1, 3].contains(&values.len()) {
            return Err(wrong(ValueFault::Count(values.len())));
        }
        let name = name.trim().to_owned();
        Ok(Given { name, values })
    }
}

/// The function that is meant.
///
/// # Errors
/// There is none of that name, or several where none is named, or it is no function of reflectance.
pub fn choose(
    file: &str,
    found: Vec<FoundFunction>,
    name: Option<&str>,
) -> Result<FoundFunction, Error> {
    if let Some(name) = name {
        let mut all: Vec<&str> = found.iter().map(|found| found.name.as_str()).collect();
        all.dedup();
        let missing = match all.is_empty() {
            true => Error::NoFunction {
                file: file.to_owned(),
            },
            false => UnknownName::new("function", name, &all).into(),
        };
        let mut named = found.iter().filter(|found| found.name == name);
        let first = named.next().cloned().ok_or(missing)?;
        let fits = first.is_candidate().then_some(&first);
        let fits = fits.or_else(|| named.find(|found| found.is_candidate()));
        return fits.cloned().ok_or_else(|| unfit(file, &first));
    }
    let candidates: Vec<FoundFunction> = found
        .into_iter()
        .filter(FoundFunction::is_candidate)
        .collect();
    match candidates.as_slice() {
        [] => Err(Error::NoReflectance {
            file: file.to_owned(),
        }),
        [one] => Ok(one.clone()),
        _ => Err(Error::SeveralFunctions {
            file: file.to_owned(),
            names: candidates.iter().map(|found| found.name.clone()).collect(),
        }),
    }
}

/// Why a function cannot be one of reflectance.
fn unfit(file: &str, found: &FoundFunction) -> Error {
    let is_other = |shape: &NumberShape| matches!(shape, NumberShape::Other(_));
    let other = found.params.iter().find(|param| is_other(&param.shape));
    let why = if let Some(param) = other {
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

fn place_of(file: &str, found: &FoundFunction) -> FunctionPlace {
    FunctionPlace {
        file: file.to_owned(),
        line: found.line,
        column: found.column,
        name: found.name.clone(),
    }
}

/// Binds all arguments of a function.
///
/// # Errors
/// A value is given for what it does not take, or in the wrong count, or one is missing.
pub fn bind(
    file: &str,
    function: FoundFunction,
    given: &[Given],
    subject: &MaterialInMedium,
) -> Result<Bound, Error> {
    check_names(&function, given)?;
    let is_per_channel = function.result == NumberShape::Scalar;
    let mut values = Vec::new();
    for param in &function.params {
        let is_rgb = param.shape == NumberShape::Rgb;
        let own = given.iter().rfind(|given| given.name == param.name);
        let value = match own {
            Some(given) => Some((spread(given, is_rgb || is_per_channel)?, false)),
            None => material_value(subject, &param.name)
                .filter(|value| is_rgb || is_per_channel || same(value))
                .map(|value| (value.map(|v| v as f32), true)),
        };
        values.push(value.map(|(value, is_filled)| BoundArgument {
            name: param.name.clone(),
            is_rgb,
            value,
            is_filled,
        }));
    }
    let cosine = cosine(file, &function, &values, subject)?;
    let arguments = values.into_iter().flatten().collect();
    Ok(Bound {
        function,
        cosine,
        arguments,
    })
}

fn check_names(function: &FoundFunction, given: &[Given]) -> Result<(), Error> {
    let params = function.params.iter();
    let all: Vec<&str> = params.map(|param| param.name.as_str()).collect();
    let wrong = given
        .iter()
        .find(|given| !all.contains(&given.name.as_str()));
    wrong.map_or(Ok(()), |given| {
        Err(UnknownName::new("argument", &given.name, &all).into())
    })
}

/// The value of each channel.
fn spread(given: &Given, may_differ: bool) -> Result<[f32; 3], Error> {
    match given.values.as_slice() {
        [one] => Ok([*one; 3]),
        [r, g, b] if may_differ => Ok([*r, *g, *b]),
        _ => Err(Error::ValueCount {
            name: given.name.clone(),
            given: given.values.len(),
        }),
    }
}

fn same(value: &[f64; 3]) -> bool {
    value[0] == value[1] && value[1] == value[2]
}

/// What the material has for an argument of this name: the same value that our methods take.
fn material_value(subject: &MaterialInMedium, name: &str) -> Option<[f64; 3]> {
    let lower = name.to_lowercase();
    // A letter alone may be a vector of the scene: N.
    let name = if name.len() > 1 { lower.as_str() } else { name };
    find_input(name)?;
    let takes = |method: &&&Method| method.inputs.iter().any(|input| input.name == name);
    let fits = |method: &&&Method| {
        let is_usual = !method.is_fitted() || subject.default_methods().contains(&method.name);
        is_usual && is_given(method) && !method.is_textured() && subject.is_described_by(method)
    };
    let exact = methods::find(subject.exact_method()).into_iter();
    let exact: Vec<&'static Method> = exact.collect();
    let exact = exact.iter().filter(takes);
    let method = exact
        .chain(methods::ALL.iter().filter(takes).filter(fits))
        .next()?;
    values_for_material(subject, method).get(name).copied()
}

/// Whether a material's value of an input is the one that the method was given: others replace colours by those of an index.
fn is_given(method: &Method) -> bool {
    method.replacement.is_none() || method.class == Class::Dielectric
}

/// The names of all arguments that a material has a value for.
pub fn material_inputs() -> Vec<&'static str> {
    let given = methods::ALL.iter().filter(|method| is_given(method));
    let inputs = given.flat_map(|method| method.inputs);
    let own = inputs.filter(|input| input.is_of_material());
    own.map(|input| input.name)
        .collect::<BTreeSet<_>>()
        .into_iter()
        .collect()
}

/// Names that mean the cosine, in small letters without `_`.
const COSINES: [&str; 25] = [
    "costheta",
    "costhetai",
    "cosine",
    "cosi",
    "cos",
    "costh",
    "ct",
    "c",
    "mu",
    "ndotv",
    "ndotl",
    "ndoth",
    "vdoth",
    "ldoth",
    "hdotv",
    "hdotl",
    "vdotn",
    "ldotn",
    "nov",
    "nol",
    "voh",
    "loh",
    "vdoth01",
    "dotnv",
    "dotvh",
];

/// The place of the cosine: by its name, or what alone is left.
fn cosine(
    file: &str,
    function: &FoundFunction,
    values: &[Option<BoundArgument>],
    subject: &MaterialInMedium,
) -> Result<usize, Error> {
    let plain = |name: &str| name.to_lowercase().replace('_', "");
    let is_open = |place: &usize| {
        values[*place].is_none() && function.params[*place].shape == NumberShape::Scalar
    };
    let is_named = |place: &usize| COSINES.contains(&plain(&function.params[*place].name).as_str());
    let open: Vec<usize> = (0..values.len()).filter(is_open).collect();
    let named: Vec<usize> = open.iter().copied().filter(is_named).collect();
    let chosen = match (named.as_slice(), open.as_slice()) {
        ([one], _) | ([], [one]) => Some(*one),
        _ => None,
    };
    let missing = |place: &usize| values[*place].is_none() && Some(*place) != chosen;
    let missing: Vec<&str> = (0..values.len())
        .filter(missing)
        .map(|place| function.params[place].name.as_str())
        .collect();
    match (chosen, missing.as_slice()) {
        (Some(place), []) => Ok(place),
        (_, []) => Err(Error::NoCosine {
            place: place_of(file, function),
        }),
        (_, missing) => Err(Error::Unbound {
            place: place_of(file, function),
            material: subject.argument.clone(),
            missing: missing.iter().map(|name| (*name).to_owned()).collect(),
            has_cosine: chosen.is_some(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_one_number_or_three() {
        let read = |word: &str| Given::read(word).map(|given| given.values).ok();
        assert_eq!(read("f0=.5"), Some(vec![0.5]));
        assert_eq!(read("f0=1.03,.73, .36"), Some(vec![1.03, 0.73, 0.36]));
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
