//! Why a user's function cannot be audited. Each error names the file or the flag, the fault, and what is allowed.

use thiserror::Error;

use super::cosine::CosineForm;
use super::quantity;
use crate::generator::emit;
use crate::lab::process;
use crate::lab::verify::function_head::FunctionHead;
use crate::physics::foreign::{Foreign, one_line};
use crate::physics::names::{UnknownName, nearest_names, offered};
use crate::physics::num::{POINT_NOT_COMMA, has_decimal_commas};

/// Why a user's function cannot be audited.
#[derive(Debug, Error)]
pub enum Error {
    /// A language, a function or an argument that does not exist.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// The processes of a run cannot be started.
    #[error(transparent)]
    Process(#[from] process::Error),
    /// A function of ours cannot be written.
    #[error(transparent)]
    Emit(#[from] emit::Error),
    /// The file's extension is not that of a language.
    #[error(
        "{}: its ending does not tell a language; say --language wgsl, glsl, hlsl or slang",
        Foreign(_0)
    )]
    NoLanguage(String),
    /// A value in the wrong form.
    #[error(
        "--arg {}: {fault}; it is name=number, name=number,number,number, name=quantity, or name=cos for the cosine{}",
        Foreign(word),
        of_commas(word)
    )]
    Value {
        /// The word after `--arg`.
        word: String,
        /// What is wrong with it.
        fault: ValueFault,
    },
    /// Three values for an argument that takes one.
    #[error(
        "--arg {}: it is one number in a function that gives three, and {given} are given",
        Foreign(name)
    )]
    ValueCount {
        /// The argument.
        name: String,
        /// How many are given.
        given: usize,
    },
    /// The text holds no function at all.
    #[error("{}: it holds no function", Foreign(_0))]
    NoFunction(String),
    /// None of its functions can be a reflectance function.
    #[error(
        "{}: it holds no function from a cosine to a reflectance: numbers or three of them in, the same out; --function NAME says of one why",
        Foreign(_0)
    )]
    NoReflectance(String),
    /// Several of its functions can be reflectance functions and none is named, or several have the name.
    #[error("{}: it holds {} functions; say which with --function: {}", Foreign(file), names.len(), one_line(&names.join(", ")))]
    SeveralFunctions {
        /// The file.
        file: String,
        /// Their names.
        names: Vec<String>,
    },
    /// The line given after the function's name holds no function of that name.
    #[error(
        "{}: there is no function `{}` in line `{}`; there are {}",
        Foreign(file),
        Foreign(name),
        Foreign(line),
        one_line(&lines_words(name, lines))
    )]
    NoFunctionInLine {
        /// The file.
        file: String,
        /// The name.
        name: String,
        /// The line as it was given.
        line: String,
        /// The lines in which there are functions of that name.
        lines: Vec<String>,
    },
    /// A name that cannot be defined.
    #[error(
        "-D {}: it is NAME=VALUE, or NAME for 1: the name of letters, digits and `_`, free of `fg_` and `__` at its beginning, the value without quotes, backslashes, `#` and comments",
        Foreign(_0)
    )]
    Define(String),
    /// The function reads something for which no value can be given.
    #[error("{place}: line {line}: {}", one_line(why))]
    Unread {
        /// The function, with its place in the file.
        place: FunctionPlace,
        /// The line that reads it.
        line: usize,
        /// What it reads.
        why: String,
    },
    /// The named function cannot be a reflectance function.
    #[error(
        "{place}: {}; arguments and result are one number or three (float, vec3), the cosine is one",
        one_line(why)
    )]
    Unfit {
        /// The function, with its place in the file.
        place: FunctionPlace,
        /// What is wrong with it.
        why: String,
    },
    /// It is not clear whether an argument is the cosine or the angle.
    #[error(
        "{place}: whether `{}` is the cosine or the angle is not clear: say so with --arg {}=cos or --arg {}=angle (in radians); {} are other answers",
        Foreign(argument),
        Foreign(argument),
        Foreign(argument),
        other_forms()
    )]
    UnclearCosine {
        /// The function, with its place in the file.
        place: FunctionPlace,
        /// The argument.
        argument: String,
    },
    /// The argument given as the cosine is not a single number.
    #[error(
        "{place}: --arg {}={form}: it is no argument of one number",
        Foreign(argument)
    )]
    NoNumber {
        /// The function, with its place in the file.
        place: FunctionPlace,
        /// The argument.
        argument: String,
        /// The form that it was given.
        form: &'static str,
    },
    /// The function is a member of a type, and not static.
    #[error(
        "{place}: it is a function of objects of `{}`, which a cosine does not make: let it be `static`, or write a function that makes the object and calls it",
        Foreign(ty)
    )]
    NeedsObject {
        /// The function, with its place in the file.
        place: FunctionPlace,
        /// The type.
        ty: String,
    },
    /// All arguments have values, and one must be the cosine.
    #[error("{0}: no argument is left for the cosine; bind one fewer with --arg")]
    NoCosine(FunctionPlace),
    /// An argument without a value.
    #[error("{place}: {}", one_line(&unbound(material, missing, *cosine)))]
    Unbound {
        /// The function, with its place in the file.
        place: FunctionPlace,
        /// The material.
        material: String,
        /// The arguments without a value.
        missing: Box<[MissingArgument]>,
        /// Which argument is the cosine.
        cosine: MissingCosine,
    },
    /// The text holds something that prevents making a program of it.
    #[error("{}:{line}:{column}: {}", Foreign(file), one_line(what))]
    Text {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What stands there, and what is allowed.
        what: String,
    },
}

/// What is wrong with a value.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ValueFault {
    /// There is no `=` between a name and a value.
    #[error("it has no `=`")]
    NoName,
    /// A number cannot be read.
    #[error("`{}` is not a number", Foreign(_0))]
    NoNumber(String),
    /// Neither a number nor a quantity.
    #[error("{0}")]
    NoQuantity(UnknownName),
    /// It is neither one number nor three.
    #[error("it has {0} numbers")]
    Count(usize),
}

/// Which argument is the cosine, when others have no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MissingCosine {
    /// It is known.
    Known,
    /// It may be the one with this index among those without a value.
    Likely(usize),
    /// No argument can be.
    Absent,
}

/// An argument without a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingArgument {
    /// Its name.
    pub name: String,
    /// What it stands for, as far as that is known.
    pub quantity: Option<&'static str>,
    /// Whether the material has three values for it, and it takes one.
    pub is_one_of_three: bool,
    /// The line of its declaration, where it is not an argument but is read from outside of the function.
    pub line: Option<usize>,
}

impl MissingArgument {
    fn words(&self) -> String {
        let meaning = self.quantity.filter(|quantity| *quantity != self.name);
        let meaning = meaning.map_or(String::new(), |quantity| format!(" ({quantity})"));
        let why = if self.is_one_of_three {
            ", which is one number here and differs between the channels"
        } else {
            ""
        };
        let from = self.line.map_or(String::new(), |line| {
            format!(", which it reads from outside (line {line})")
        });
        format!("`{}`{meaning}{from}{why}", self.name)
    }
}

/// A function and where its name stands.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}:{line}:{column}: `{}`", Foreign(file), Foreign(name))]
pub struct FunctionPlace {
    /// The file.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// The function.
    pub name: String,
}

impl FunctionPlace {
    /// The place of a function of this file.
    pub fn new(file: &str, function: &FunctionHead) -> FunctionPlace {
        FunctionPlace {
            file: file.to_owned(),
            line: function.line,
            column: function.column,
            name: function.name.clone(),
        }
    }
}

impl Error {
    /// Whether the machine lacks something. Otherwise the user's flags or text are at fault.
    pub fn is_lacking(&self) -> bool {
        matches!(self, Error::Process(error) if error.is_lacking())
    }
}

fn of_commas(word: &str) -> String {
    let value = word.split_once('=').map_or("", |(_, value)| value.trim());
    if has_decimal_commas(value) {
        format!("; {POINT_NOT_COMMA}")
    } else {
        String::new()
    }
}

fn lines_words(name: &str, lines: &[String]) -> String {
    let each = lines.iter().map(|line| format!("{name}:{line}"));
    each.collect::<Vec<_>>().join(", ")
}

/// The other forms that `--arg` takes for the cosine's argument.
fn other_forms() -> String {
    let names = CosineForm::NAMED[1..].iter().map(|(name, _)| *name);
    names.collect::<Vec<_>>().join(", ")
}

fn unbound(material: &str, missing: &[MissingArgument], cosine: MissingCosine) -> String {
    let names: Vec<String> = missing.iter().map(MissingArgument::words).collect();
    let first = missing.first().map_or("", |argument| &argument.name);
    let is_known = missing
        .first()
        .is_some_and(|first| first.quantity.is_some() || first.line.is_some());
    let like = if is_known {
        String::new()
    } else {
        offered(&nearest_names(first, &quantity::names()))
    };
    let cosine = match cosine {
        MissingCosine::Known => String::new(),
        MissingCosine::Likely(place) => format!(
            ", and which of its arguments is the cosine is not clear: say so with --arg {}=cos, or with {} where it is another thing",
            missing.get(place).map_or("NAME", |one| &one.name),
            other_forms()
        ),
        MissingCosine::Absent => ", and no single number is left for the cosine: write a function of the cosine that calls it".to_owned(),
    };
    format!(
        "{material} has no value for {}{like}{cosine}; bind with --arg {first}=NUMBER or --arg {first}=QUANTITY",
        names.join(", ")
    )
}
