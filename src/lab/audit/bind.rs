//! Binds each argument of a user's function: to the cosine, to a value given with `--arg`, or to a value of the material.

use super::cosine::{CosineForm, cosine, is_named};
use super::error::{Error, FunctionPlace, MissingArgument, MissingCosine};
use super::hidden::HiddenInput;
use super::inputs::{DefaultArgument, Given, GivenValue, defaults, given_cosine};
use super::quantity::{Quantity, meanings, plain};
use super::scan::{FoundFunction, NumberShape, Parameter};
use super::slice::Slice;
use crate::generator::emit::shader_words::tokens;
use crate::generator::reference::MaterialInMedium;
use crate::physics::names::UnknownName;

/// A function with all its arguments bound.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The function.
    pub function: FoundFunction,
    /// The index of the cosine among its arguments.
    pub cosine: usize,
    /// The quantity of the angle that this argument takes.
    pub form: CosineForm,
    /// How that is known, in words, where its name alone does not say so.
    pub cosine_words: Option<String>,
    /// The arguments that keep the default value in the text.
    pub defaults: Vec<DefaultArgument>,
    /// The others, in order, followed by the inputs from outside.
    pub arguments: Vec<BoundArgument>,
    /// The inputs that it reads from outside.
    pub hidden: Vec<HiddenInput>,
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
    /// The quantity of the material whose value was taken. None where numbers were given.
    pub quantity: Option<Quantity>,
    /// The quantities that its name may stand for.
    pub meanings: Vec<Quantity>,
    /// Whether its name alone says what it stands for.
    pub is_by_name: bool,
}

impl Bound {
    /// Whether the function is called once for each channel, since it takes one number where the channels differ.
    pub fn is_per_channel(&self) -> bool {
        self.arguments.iter().any(BoundArgument::is_split)
    }

    /// The arguments that were filled in, in words.
    pub fn filled(&self) -> Vec<String> {
        self.arguments
            .iter()
            .filter_map(BoundArgument::filled)
            .collect()
    }

    /// Whether it returns one number.
    pub fn is_one_channel(&self) -> bool {
        self.function.result == NumberShape::Scalar
    }

    /// This function for the first channel alone.
    pub fn first_channel(&self) -> Bound {
        let mut one = self.clone();
        for argument in one.arguments.iter_mut().filter(|argument| !argument.is_rgb) {
            argument.value = [argument.value[0]; 3];
        }
        one
    }

    /// How many numbers describe a material.
    pub fn input_numbers(&self) -> usize {
        self.arguments.iter().map(BoundArgument::numbers).sum()
    }

    /// This function with one argument bound to another quantity. None where the material has no value for it.
    pub fn with(
        &self,
        place: usize,
        quantity: Quantity,
        subject: &MaterialInMedium,
    ) -> Option<Bound> {
        let mut other = self.clone();
        let argument = other.arguments.get_mut(place)?;
        let value = quantity.value(subject)?;
        if !(argument.is_rgb || self.is_one_channel() || same(&value)) {
            return None;
        }
        argument.value = value.map(|value| value as f32);
        argument.quantity = Some(quantity);
        Some(other)
    }
}

impl BoundArgument {
    /// Whether it is one number in the text and has a different value for each channel.
    pub fn is_split(&self) -> bool {
        let [r, g, b] = self.value;
        !self.is_rgb && (r != g || g != b)
    }

    /// What was filled in, in words.
    fn filled(&self) -> Option<String> {
        let quantity = self.quantity?;
        let meaning = if plain(&self.name) == plain(quantity.name) {
            String::new()
        } else {
            format!(" ({})", quantity.name)
        };
        Some(format!("{}{meaning} = {}", self.name, numbers(self.value)))
    }

    /// The quantity that it stands for, as far as that is known.
    pub fn meaning(&self) -> Option<Quantity> {
        self.quantity.or(self.meanings.first().copied())
    }

    /// How many numbers of a material it takes.
    fn numbers(&self) -> usize {
        let known = self.meaning().map_or(1, |quantity| quantity.numbers());
        if self.is_rgb || self.is_split() {
            3
        } else {
            known
        }
    }
}

fn numbers([r, g, b]: [f32; 3]) -> String {
    if r == g && g == b {
        format!("{r}")
    } else {
        format!("{r}, {g}, {b}")
    }
}

/// The place of a function, for messages.
pub fn place_of(file: &str, found: &FoundFunction) -> FunctionPlace {
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
/// A value is given for an unknown argument, has the wrong number of components, or is missing.
pub fn bind(
    file: &str,
    function: FoundFunction,
    slice: &Slice,
    given: &[Given],
    subject: &MaterialInMedium,
) -> Result<Bound, Error> {
    check_names(&function, slice, given)?;
    let hidden: Vec<Parameter> = slice.hidden.iter().map(hidden_parameter).collect();
    let defaults = defaults(&function, given);
    let mut values = Vec::new();
    let params = function.params.iter();
    let params = params.map(|param| (param, meanings(&param.name, &function)));
    // The name of an input from outside says less (`k.x`, `bias`), so its value is asked for.
    let inputs = hidden.iter().map(|param| (param, Vec::new()));
    for (param, meanings) in params.chain(inputs) {
        let own = given.iter().rfind(|given| given.name == param.name);
        let has_default = own.is_none() && defaults.iter().any(|one| one.name == param.name);
        values.push(if has_default {
            None
        } else {
            bound_argument(&function, (param, meanings), own, subject)?
        });
    }
    let (place, form, words) = checked_cosine(
        file,
        &function,
        (slice, given),
        (&values, &defaults),
        subject,
    )?;
    let arguments = values.into_iter().flatten().collect();
    Ok(Bound {
        function,
        cosine: place,
        form,
        cosine_words: words,
        defaults,
        arguments,
        hidden: slice.hidden.clone(),
    })
}

/// An input from outside as an argument.
fn hidden_parameter(input: &HiddenInput) -> Parameter {
    Parameter {
        name: input.path.clone(),
        shape: input.shape(),
        ty: String::new(),
        default: None,
    }
}

/// An argument with its value, where there is one.
fn bound_argument(
    function: &FoundFunction,
    (param, meanings): (&Parameter, Vec<Quantity>),
    given: Option<&Given>,
    subject: &MaterialInMedium,
) -> Result<Option<BoundArgument>, Error> {
    let is_rgb = param.shape == NumberShape::Rgb;
    let may_differ = is_rgb || function.result == NumberShape::Scalar;
    let (value, quantity) = match given.map(|given| (given, &given.value)) {
        Some((given, GivenValue::Numbers(values))) => {
            (Some(spread(&given.name, values, may_differ)?), None)
        }
        Some((_, GivenValue::Quantity(quantity))) => {
            (filled(*quantity, may_differ, subject), Some(*quantity))
        }
        Some((_, GivenValue::Cosine(_))) => (None, None),
        None => {
            let quantity = meanings.first().copied();
            let value = quantity.and_then(|quantity| filled(quantity, may_differ, subject));
            (value, quantity)
        }
    };
    Ok(value.map(|value| BoundArgument {
        name: param.name.clone(),
        is_rgb,
        value,
        quantity,
        meanings,
        is_by_name: given.is_none(),
    }))
}

/// The material's value of a quantity, where the argument can take it.
fn filled(quantity: Quantity, may_differ: bool, subject: &MaterialInMedium) -> Option<[f32; 3]> {
    let value = quantity.value(subject)?;
    (may_differ || same(&value)).then(|| value.map(|value| value as f32))
}

fn check_names(function: &FoundFunction, slice: &Slice, given: &[Given]) -> Result<(), Error> {
    let params = function.params.iter().map(|param| &param.name);
    let hidden = slice.hidden.iter().map(|input| &input.path);
    let initialised = slice.initialised.iter().map(|one| &one.name);
    let all = params.chain(hidden).chain(initialised);
    let all: Vec<&str> = all.map(String::as_str).collect();
    let wrong = given
        .iter()
        .find(|given| !all.contains(&given.name.as_str()));
    wrong.map_or(Ok(()), |given| {
        Err(UnknownName::new("argument", &given.name, &all).into())
    })
}

/// The value of each channel.
fn spread(name: &str, values: &[f32], may_differ: bool) -> Result<[f32; 3], Error> {
    match values {
        [one] => Ok([*one; 3]),
        [r, g, b] if may_differ => Ok([*r, *g, *b]),
        _ => Err(Error::ValueCount {
            name: name.to_owned(),
            given: values.len(),
        }),
    }
}

fn same(value: &[f64; 3]) -> bool {
    value[0] == value[1] && value[1] == value[2]
}

/// The index and the form of the cosine, if all other arguments have values.
fn checked_cosine(
    file: &str,
    function: &FoundFunction,
    (slice, given): (&Slice, &[Given]),
    (values, defaults): (&[Option<BoundArgument>], &[DefaultArgument]),
    subject: &MaterialInMedium,
) -> Result<(usize, CosineForm, Option<String>), Error> {
    let is_default = |name: &str| defaults.iter().any(|one| one.name == name);
    let params = function.params.iter().zip(values);
    let has_value = params.map(|(param, value)| value.is_some() || is_default(&param.name));
    let has_value: Vec<bool> = has_value.collect();
    let own = given_cosine(file, function, given)?;
    let found = own.or_else(|| cosine(function, &has_value, &tokens(&slice.body)));
    let chosen = found.map(|found| found.place);
    let is_default = |place: usize| {
        let param = function.params.get(place);
        param.is_some_and(|param| is_default(&param.name))
    };
    let missing =
        |place: &usize| values[*place].is_none() && Some(*place) != chosen && !is_default(*place);
    let argument = |place: usize| match function.params.get(place) {
        Some(param) => missing_argument(&param.name, function, given, subject),
        None => {
            let input = &slice.hidden[place - function.params.len()];
            MissingArgument {
                line: Some(input.line),
                ..missing_argument(&input.path, function, given, subject)
            }
        }
    };
    let missing: Vec<MissingArgument> = (0..values.len()).filter(missing).map(argument).collect();
    match (found, missing.as_slice()) {
        (Some(found), []) => {
            let name = &function.params[found.place].name;
            let form = found.form.ok_or_else(|| Error::UnclearCosine {
                place: place_of(file, function),
                argument: name.clone(),
            })?;
            Ok((found.place, form, found.words(form, name)))
        }
        (_, []) => Err(Error::NoCosine {
            place: place_of(file, function),
        }),
        (_, missing) => Err(Error::Unbound {
            place: place_of(file, function),
            material: subject.argument.clone(),
            missing: missing.to_vec(),
            cosine: match chosen {
                Some(_) => MissingCosine::Known,
                None => likely_cosine(function, missing),
            },
        }),
    }
}

/// The argument without a value that may be the cosine: a single number whose name has no other meaning.
fn likely_cosine(function: &FoundFunction, missing: &[MissingArgument]) -> MissingCosine {
    let is_one = |name: &str| {
        let mut params = function.params.iter();
        params.any(|param| param.name == name && param.shape == NumberShape::Scalar)
    };
    let is_likely = |one: &MissingArgument| {
        is_one(&one.name) && (is_named(&one.name) || one.quantity.is_none())
    };
    let found = (0u32..).zip(missing).find(|(_, one)| is_likely(one));
    found.map_or(MissingCosine::Absent, |(place, _)| {
        MissingCosine::Likely(place)
    })
}

/// An argument without a value, with what it stands for.
fn missing_argument(
    name: &str,
    function: &FoundFunction,
    given: &[Given],
    subject: &MaterialInMedium,
) -> MissingArgument {
    let own = given.iter().rfind(|given| given.name == name);
    let quantity = match own.map(|given| &given.value) {
        Some(GivenValue::Quantity(quantity)) => Some(*quantity),
        // The name of an input from outside says less.
        _ if !function.params.iter().any(|param| param.name == name) => None,
        _ => meanings(name, function).first().copied(),
    };
    MissingArgument {
        name: name.to_owned(),
        quantity: quantity.map(|quantity| quantity.name),
        is_one_of_three: quantity.is_some_and(|quantity| quantity.value(subject).is_some()),
        line: None,
    }
}
