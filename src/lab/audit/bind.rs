//! Binds each argument of a user's function: to the cosine, to a value given with `--arg`, or to a value of the material.

use super::cosine::{CosineForm, cosine, is_named};
use super::error::{Error, FunctionPlace, MissingArgument, MissingCosine};
use super::hidden::HiddenInput;
use super::quantity::{Quantity, meanings, plain};
use super::request::{DefaultArgument, Given, GivenValue, defaults, given_cosine};
use super::slice::Slice;
use crate::generator::reference::MaterialInMedium;
use crate::lab::verify::function_head::{FunctionHead, NumberShape};
use crate::lab::verify::shader_words::tokens;
use crate::physics::names::UnknownName;

/// A function with all its arguments bound.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The function.
    pub function: FunctionHead,
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

/// Binds all arguments of a function.
///
/// # Errors
/// A value is given for an unknown argument, has the wrong number of components, or is missing.
pub fn bind(
    file: &str,
    function: FunctionHead,
    slice: &Slice,
    given: &[Given],
    subject: &MaterialInMedium,
) -> Result<Bound, Error> {
    let binding = Binding {
        file,
        function: &function,
        slice,
        given,
        defaults: defaults(&function, given),
        subject,
    };
    binding.check_names()?;
    let values = binding.values()?;
    let (cosine, form, cosine_words) = binding.cosine(&values)?;
    let defaults = binding.defaults;
    Ok(Bound {
        function,
        cosine,
        form,
        cosine_words,
        defaults,
        arguments: values.into_iter().flatten().collect(),
        hidden: slice.hidden.clone(),
    })
}

/// What the arguments of a function are bound from.
struct Binding<'a> {
    file: &'a str,
    function: &'a FunctionHead,
    slice: &'a Slice,
    given: &'a [Given],
    defaults: Vec<DefaultArgument>,
    subject: &'a MaterialInMedium,
}

impl Binding<'_> {
    fn check_names(&self) -> Result<(), Error> {
        let params = self.function.params.iter().map(|param| &param.name);
        let hidden = self.slice.hidden.iter().map(|input| &input.path);
        let initialised = self.slice.initialised.iter().map(|one| &one.name);
        let all = params.chain(hidden).chain(initialised);
        let all: Vec<&str> = all.map(String::as_str).collect();
        let is_unknown = |given: &&Given| !all.contains(&given.name.as_str());
        self.given.iter().find(is_unknown).map_or(Ok(()), |given| {
            Err(UnknownName::new("argument", &given.name, &all).into())
        })
    }

    /// The value given for an argument.
    fn given(&self, name: &str) -> Option<&GivenValue> {
        let own = self.given.iter().rfind(|given| given.name == name);
        own.map(|given| &given.value)
    }

    fn is_default(&self, name: &str) -> bool {
        self.defaults.iter().any(|one| one.name == name)
    }

    fn place(&self) -> FunctionPlace {
        FunctionPlace::new(self.file, self.function)
    }

    /// The arguments, followed by the inputs from outside. None for those without a value, or with a default.
    fn values(&self) -> Result<Vec<Option<BoundArgument>>, Error> {
        let mut values = Vec::new();
        for param in &self.function.params {
            values.push(if self.is_default(&param.name) {
                None
            } else {
                let meanings = meanings(&param.name, self.function);
                self.argument(&param.name, param.shape == NumberShape::Rgb, meanings)?
            });
        }
        for input in &self.slice.hidden {
            // The name of an input from outside says less (`k.x`, `bias`), so its value is asked for.
            values.push(self.argument(&input.path, input.is_rgb, Vec::new())?);
        }
        Ok(values)
    }

    /// An argument with its value, where there is one.
    fn argument(
        &self,
        name: &str,
        is_rgb: bool,
        meanings: Vec<Quantity>,
    ) -> Result<Option<BoundArgument>, Error> {
        let may_differ = is_rgb || self.function.result == NumberShape::Scalar;
        // The material's value, where the argument can take it.
        let filled = |quantity: Quantity| {
            let value = quantity.value(self.subject)?;
            (may_differ || same(&value)).then(|| value.map(|value| value as f32))
        };
        let given = self.given(name);
        let (value, quantity) = match given {
            Some(GivenValue::Numbers(values)) => (Some(spread(name, values, may_differ)?), None),
            Some(GivenValue::Quantity(quantity)) => (filled(*quantity), Some(*quantity)),
            Some(GivenValue::Cosine(_)) => (None, None),
            None => {
                let quantity = meanings.first().copied();
                (quantity.and_then(filled), quantity)
            }
        };
        Ok(value.map(|value| BoundArgument {
            name: name.to_owned(),
            is_rgb,
            value,
            quantity,
            meanings,
            is_by_name: given.is_none(),
        }))
    }

    /// The index and the form of the cosine, and how that is known, if all other arguments have values.
    fn cosine(
        &self,
        values: &[Option<BoundArgument>],
    ) -> Result<(usize, CosineForm, Option<String>), Error> {
        let params = &self.function.params;
        let has_value = |place: usize| {
            let param = params.get(place);
            values[place].is_some() || param.is_some_and(|param| self.is_default(&param.name))
        };
        let found = match given_cosine(self.file, self.function, self.given)? {
            Some(given) => Some(given),
            None => {
                let has_value: Vec<bool> = (0..params.len()).map(has_value).collect();
                cosine(self.function, &has_value, &tokens(&self.slice.body))
            }
        };
        let chosen = found.map(|found| found.place);
        let missing =
            (0..values.len()).filter(|place| !has_value(*place) && Some(*place) != chosen);
        let missing: Vec<MissingArgument> = missing.map(|place| self.missing(place)).collect();
        match found {
            Some(found) if missing.is_empty() => {
                let name = &params[found.place].name;
                let form = found.form.ok_or_else(|| Error::UnclearCosine {
                    place: self.place(),
                    argument: name.clone(),
                })?;
                Ok((found.place, form, found.words(form, name)))
            }
            None if missing.is_empty() => Err(Error::NoCosine(self.place())),
            _ => Err(Error::Unbound {
                place: self.place(),
                material: self.subject.label().to_owned(),
                cosine: match chosen {
                    Some(_) => MissingCosine::Known,
                    None => self.likely_cosine(&missing),
                },
                missing: missing.into(),
            }),
        }
    }

    /// The argument without a value that may be the cosine: a single number whose name has no other meaning.
    fn likely_cosine(&self, missing: &[MissingArgument]) -> MissingCosine {
        let is_one = |name: &str| {
            let mut params = self.function.params.iter();
            params.any(|param| param.name == name && param.shape == NumberShape::Scalar)
        };
        let is_likely = |one: &MissingArgument| {
            is_one(&one.name) && (is_named(&one.name) || one.quantity.is_none())
        };
        let found = missing.iter().position(is_likely);
        found.map_or(MissingCosine::Absent, MissingCosine::Likely)
    }

    /// The argument at this place, or the input from outside, with what it stands for.
    fn missing(&self, place: usize) -> MissingArgument {
        let params = &self.function.params;
        let (name, line) = match params.get(place) {
            Some(param) => (&param.name, None),
            None => {
                let input = &self.slice.hidden[place - params.len()];
                (&input.path, Some(input.line))
            }
        };
        let quantity = match self.given(name) {
            Some(GivenValue::Quantity(quantity)) => Some(*quantity),
            // The name of an input from outside says less.
            _ if !params.iter().any(|param| param.name == *name) => None,
            _ => meanings(name, self.function).first().copied(),
        };
        MissingArgument {
            name: name.clone(),
            quantity: quantity.map(|quantity| quantity.name),
            is_one_of_three: quantity
                .is_some_and(|quantity| quantity.value(self.subject).is_some()),
            line,
        }
    }
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
