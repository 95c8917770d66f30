//! Why a user's function cannot be audited, and compilers' messages with the place in the user's file before them. Each error
//! names the file or the flag, the fault, and what is allowed.

use thiserror::Error;

use super::cosine::CosineForm;
use super::program::own_names;
use super::quantity;
use crate::generator::emit;
use crate::lab::process;
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
        Foreign(file)
    )]
    NoLanguage {
        /// The file.
        file: String,
    },
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
    #[error("{}: it holds no function", Foreign(file))]
    NoFunction {
        /// The file.
        file: String,
    },
    /// None of its functions can be a reflectance function.
    #[error(
        "{}: it holds no function from a cosine to a reflectance: numbers or three of them in, the same out; --function NAME says of one why",
        Foreign(file)
    )]
    NoReflectance {
        /// The file.
        file: String,
    },
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
        Foreign(word)
    )]
    Define {
        /// The word after the flag.
        word: String,
    },
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
    #[error("{place}: no argument is left for the cosine; bind one fewer with --arg")]
    NoCosine {
        /// The function, with its place in the file.
        place: FunctionPlace,
    },
    /// An argument without a value.
    #[error("{place}: {}", one_line(&unbound(material, missing, *cosine)))]
    Unbound {
        /// The function, with its place in the file.
        place: FunctionPlace,
        /// The material.
        material: String,
        /// The arguments without a value.
        missing: Vec<MissingArgument>,
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
    Likely(u32),
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
            missing.get(place as usize).map_or("NAME", |one| &one.name),
            other_forms()
        ),
        MissingCosine::Absent => ", and no single number is left for the cosine: write a function of the cosine that calls it".to_owned(),
    };
    format!(
        "{material} has no value for {}{like}{cosine}; bind with --arg {first}=NUMBER or --arg {first}=QUANTITY",
        names.join(", ")
    )
}

/// A compiler's message with the place of its first fault before it: `FILE:LINE:COL: what`.
pub fn placed(file: &str, lines: usize, words: &str) -> String {
    let (file, words) = (Foreign(file), own_names(words));
    let first = words.lines().enumerate().find_map(|(i, line)| {
        let (line_number, column) = place(line)?;
        Some((i, line_number, column))
    });
    let Some((i, line, column)) = first else {
        return format!("{file}: {}", words.trim_end());
    };
    let all: Vec<&str> = words.lines().collect();
    // naga puts the message in the line before the place.
    let is_arrow = all[i].contains("┌─") || all[i].trim_start().starts_with("-->");
    let said = if is_arrow && i > 0 {
        all[i - 1]
    } else {
        all[i]
    };
    let said = message(said);
    let column = column.map_or(String::new(), |column| format!("{column}:"));
    if line > lines {
        // What is unclosed at the end is reported in the code after it.
        return format!("{file}:{}: at the end of the file: {said}", lines.max(1));
    }
    format!("{file}:{line}:{column} {said}")
}

/// Whether a compiler's message names a place in the text. Others may be about the compiler or the machine.
pub fn names_place(words: &str) -> bool {
    words.lines().any(|line| place(line).is_some())
}

/// The line and column that a compiler names: `shader.hlsl:3:5: error`, `0:3(5): error`, `ERROR: 0:3:`, `┌─ wgsl:3:5`.
fn place(line: &str) -> Option<(usize, Option<usize>)> {
    let marks = [
        "wgsl:",
        "shader.hlsl:",
        "shader.vert:",
        "shader.frag:",
        "shader.comp:",
        "shader.wgsl:",
        "shader.slang:",
        "0:",
    ];
    // `10:03:05` is a time.
    let is_apart = |at: usize| !line[..at].ends_with(|c: char| c.is_alphanumeric());
    let mark = marks.iter().find_map(|mark| {
        let mut found = line.match_indices(mark).map(|(at, _)| at);
        let at = found.find(|at| mark.len() > 2 || is_apart(*at))?;
        Some(at + mark.len())
    })?;
    let rest = &line[mark..];
    let line_number = number(rest)?;
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    let column = after.strip_prefix([':', '(']).and_then(number);
    Some((line_number, column))
}

fn number(text: &str) -> Option<usize> {
    let end = text.find(|c: char| !c.is_ascii_digit());
    text[..end.unwrap_or(text.len())].parse().ok()
}

/// A compiler's message without the place before it.
fn message(line: &str) -> &str {
    let heads = ["error:", "ERROR:"];
    let found = heads
        .iter()
        .find_map(|head| Some(line.find(head)? + head.len()));
    let rest = found.map_or(line, |at| line[at..].trim_start());
    // glslang: `ERROR: 0:3: 'x' : undeclared identifier`.
    match place(rest) {
        Some(_) => rest.splitn(3, ':').nth(2).unwrap_or(rest).trim_start(),
        None => rest,
    }
}

#[cfg(test)]
mod tests {
    use super::{names_place, placed};

    #[test]
    fn a_name_of_a_file_makes_no_line() {
        let (name, shown) = ("f\n::error::x.glsl", "f\\n::error::x.glsl");
        for (words, said) in [
            ("gone", format!("{shown}: gone")),
            ("0:3(7): error: a", format!("{shown}:3:7: a")),
            (
                "0:9(1): error: a",
                format!("{shown}:5: at the end of the file: a"),
            ),
        ] {
            assert_eq!(placed(name, 5, words), said);
        }
    }

    #[test]
    fn every_compiler_s_words_get_the_user_s_place() {
        let naga = "error: no definition in scope for identifier: `x`\n  ┌─ wgsl:2:12\n  │";
        let mesa = "the shader was refused: 0:3(7): error: `x' undeclared\n0:4(1): error: b";
        let dxc = "shader.hlsl:2:9: error: use of undeclared identifier 'x'\n  return x;";
        let glslang = "shader.vert\nERROR: 0:2: 'x' : undeclared identifier";
        let slangc = "error[E30015]: undefined identifier\n --> shader.slang:3:12\n  |";
        let told = |words| placed("f.x", 5, words);
        assert_eq!(
            told(naga),
            "f.x:2:12: no definition in scope for identifier: `x`"
        );
        assert_eq!(told(mesa), "f.x:3:7: `x' undeclared");
        assert_eq!(told(dxc), "f.x:2:9: use of undeclared identifier 'x'");
        assert_eq!(told(glslang), "f.x:2: 'x' : undeclared identifier");
        assert_eq!(
            told(slangc),
            "f.x:3:12: error[E30015]: undefined identifier"
        );
        assert_eq!(told("gone"), "f.x: gone");
        assert!(
            [naga, mesa, dxc, glslang, slangc]
                .into_iter()
                .all(names_place)
        );
        for other in [
            "gone",
            "10:03:05 out of memory",
            "Validation Error\n  Binding is missing",
        ] {
            assert!(!names_place(other), "{other}");
        }
        assert_eq!(
            placed("f.x", 2, dxc.replace("2:9", "7:1").as_str()),
            "f.x:2: at the end of the file: use of undeclared identifier 'x'"
        );
    }
}
