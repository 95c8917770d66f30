//! The part of a user's text that compilers see: the audited function, what it needs, and nothing else. Lines keep their numbers. Inputs
//! from outside become variables that our function sets.

use crate::emit::shader_words::{Token, tokens};

use super::condition::definition;
use super::hidden::{DeclaredTypes, HiddenInput, UnreadFault, distinct, held};
use super::language::{Language, bare};
use super::parts::{Part, PartKind, Storage, Variable, parts, without_annotations};
use super::preprocess::{Condition, Define, Preprocessed};
use super::reach::{MacroBodies, Reached, Use, reached};
use super::scan::FoundFunction;
use super::type_names::TypeNames;

/// What compilers see of a text.
#[derive(Clone, Debug, Default)]
pub struct Slice {
    /// Definitions of the user's that stand before the first line.
    pub before: String,
    /// The text.
    pub text: String,
    /// What it reads from outside and has no value for.
    pub hidden: Vec<HiddenInput>,
    /// What it reads from outside that has a value in the text.
    pub initialised: Vec<Initialised>,
    /// The conditions that what is kept depends on.
    pub conditions: Vec<Condition>,
    /// Whether it computes in 16 bits: the word that says so.
    pub half: Option<String>,
}

/// An input with the value that the text gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Initialised {
    /// Its name.
    pub name: String,
    /// Its line.
    pub line: usize,
    /// The value as it is written.
    pub value: String,
}

/// A text whose functions are known.
pub struct SlicedText<'a> {
    language: Language,
    preprocessed: &'a Preprocessed,
    defines: &'a [Define],
    names: TypeNames,
    code: String,
}

impl<'a> SlicedText<'a> {
    /// A text behind the preprocessor.
    pub fn new(
        language: Language,
        preprocessed: &'a Preprocessed,
        defines: &'a [Define],
    ) -> SlicedText<'a> {
        let code = bare(&preprocessed.text, language.has_preprocessor());
        let code = match language {
            Language::Hlsl => without_annotations(&code),
            _ => code,
        };
        let all = format!("{}{}", definitions(defines), preprocessed.text);
        SlicedText {
            language,
            preprocessed,
            defines,
            names: TypeNames::of_text(&all, language),
            code,
        }
    }

    /// Its functions in order.
    pub fn functions(&self) -> Vec<FoundFunction> {
        let tokens = tokens(&self.code);
        let parts = parts(&tokens, &self.names, self.language).into_iter();
        let functions = parts.filter_map(|part| match part.kind {
            PartKind::Function(found) => Some(found),
            _ => None,
        });
        functions.collect()
    }

    /// What compilers see where this function is audited and these inputs are given values.
    ///
    /// # Errors
    /// It needs what no number stands for.
    pub fn around(&self, function: &FoundFunction, given: &[&str]) -> Result<Slice, UnreadFault> {
        let words = tokens(&self.code);
        let parts = parts(&words, &self.names, self.language);
        let is_it =
            |part: &Part| matches!(&part.kind, PartKind::Function(found) if found == function);
        let Some(start) = parts.iter().position(is_it) else {
            return Ok(Slice::default());
        };
        let before = definitions(self.defines);
        let (theirs, own) = (tokens(&before), tokens(&self.preprocessed.text));
        let macros = macro_bodies(&theirs, &own);
        let reached = reached(start, &words, &parts, &macros, self.language);
        check_pixel_words(&reached)?;
        let inputs = Inputs {
            slicer: self,
            words: &words,
            parts: &parts,
            reached: &reached,
            given,
        };
        let numbers = inputs.numbers()?;
        let (pieces, initialised) = inputs.pieces(&numbers);
        let lines = lines_of(&reached, &parts, &words);
        let conditions = self.preprocessed.conditions.iter();
        let conditions = conditions.filter(|one| {
            let is_met = |(from, to): &(usize, usize)| *from <= one.end && *to >= one.line;
            lines.iter().any(is_met)
        });
        let kept_macros = self.macro_lines(&reached);
        let text = placed_pieces(
            pieces.into_iter().chain(kept_macros).collect(),
            self.preprocessed.text.lines().count(),
        );
        let used = self
            .defines
            .iter()
            .filter(|one| reached.macros.contains(&one.name));
        let used: Vec<Define> = used.cloned().collect();
        Ok(Slice {
            before: definitions(&used),
            half: half_word(&text, &self.names, self.language),
            text,
            hidden: numbers,
            initialised,
            conditions: conditions.cloned().collect(),
        })
    }

    /// The lines that define the macros that are reached, and take them away.
    fn macro_lines(&self, reached: &Reached) -> Vec<Piece> {
        let lines = self.preprocessed.text.lines().enumerate();
        let kept = lines.filter(|(_, line)| match tokens(line).as_slice() {
            [hash, word, name, ..] if self.language.has_preprocessor() && hash.text == "#" => {
                ["define", "undef"].contains(&word.text) && reached.macros.contains(name.text)
            }
            _ => false,
        });
        let piece = |(number, line): (usize, &str)| (number + 1, 1, line.to_owned());
        kept.map(piece).collect()
    }
}

/// A piece of the text with its line and column.
type Piece = (usize, usize, String);

/// Pieces at their places.
fn placed_pieces(mut pieces: Vec<Piece>, lines: usize) -> String {
    pieces.sort();
    let (mut out, mut line, mut column) = (String::new(), 1, 1);
    for (at, from, text) in pieces {
        while line < at {
            out.push('\n');
            (line, column) = (line + 1, 1);
        }
        let gap = from.saturating_sub(column).max(usize::from(column > 1));
        out.extend(std::iter::repeat_n(' ', gap));
        line += text.matches('\n').count();
        column = match text.rfind('\n') {
            Some(end) => text[end + 1..].chars().count() + 1,
            None => column + gap + text.chars().count(),
        };
        out += &text;
    }
    out.extend(std::iter::repeat_n('\n', lines.saturating_sub(line)));
    out
}

/// The user's definitions as lines.
fn definitions(defines: &[Define]) -> String {
    let line = |one: &Define| format!("#define {} {}\n", one.name, one.value);
    defines.iter().map(line).collect()
}

/// The words of macros, of the command line and of the text.
fn macro_bodies<'t, 'a>(theirs: &'t [Token<'a>], own: &'t [Token<'a>]) -> MacroBodies<'t, 'a> {
    let mut found = MacroBodies::new();
    for line in theirs
        .chunk_by(on_one_line)
        .chain(own.chunk_by(on_one_line))
    {
        let Some((_, known)) = definition(line) else {
            continue;
        };
        let params = known.params.unwrap_or_default();
        let body = line[3..].iter();
        let body = body.filter(|token| !params.iter().any(|param| param == token.text));
        found.entry(line[2].text).or_default().push(body.collect());
    }
    found
}

fn on_one_line(a: &Token, b: &Token) -> bool {
    a.line == b.line
}

/// The first and last lines of what is kept.
fn lines_of(reached: &Reached, parts: &[Part], words: &[Token]) -> Vec<(usize, usize)> {
    let part = |place: &usize| {
        let part = &parts[*place];
        (words[part.start].line, words[part.end - 1].line)
    };
    let is_setting = |place: &&usize| matches!(parts[**place].kind, PartKind::Setting);
    reached
        .parts
        .iter()
        .filter(|place| !is_setting(place))
        .map(part)
        .collect()
}

/// Words for what only a pixel beside others has.
const PIXEL_WORDS: [&str; 16] = [
    "fwidth",
    "dFdx",
    "dFdy",
    "ddx",
    "ddy",
    "dpdx",
    "dpdy",
    "fwidthFine",
    "fwidthCoarse",
    "dpdxFine",
    "dpdxCoarse",
    "dpdyFine",
    "dpdyCoarse",
    "ddx_fine",
    "ddy_fine",
    "discard",
];

fn check_pixel_words(reached: &Reached) -> Result<(), UnreadFault> {
    let is_pixel = |name: &str| name.starts_with("gl_") || PIXEL_WORDS.contains(&name);
    let found = reached.foreign.iter().find(|(name, _)| is_pixel(name));
    found.map_or(Ok(()), |(name, line)| {
        Err((
            *line,
            format!("it needs `{name}`, which a pixel of a picture has and a cosine has not: give the function what it takes from it as an argument"),
        ))
    })
}

/// The word by which a text computes in 16 bits.
fn half_word(text: &str, names: &TypeNames, language: Language) -> Option<String> {
    let code = bare(text, language.has_preprocessor());
    let found = tokens(&code);
    let found = names.replaced(&found);
    let is_half = |token: &&Token| match language {
        Language::Wgsl => false,
        Language::Gles => ["mediump", "lowp"].contains(&token.text),
        Language::Hlsl | Language::Slang => {
            let kinds = ["half", "min16float", "min10float", "float16_t"];
            let bare = token
                .text
                .trim_end_matches(|c: char| c.is_ascii_digit() || c == 'x');
            kinds.contains(&token.text) || kinds.contains(&bare)
        }
    };
    found
        .iter()
        .find(is_half)
        .map(|token| token.text.to_owned())
}

/// The inputs of what is reached.
struct Inputs<'a> {
    slicer: &'a SlicedText<'a>,
    words: &'a [Token<'a>],
    parts: &'a [Part],
    reached: &'a Reached,
    given: &'a [&'a str],
}

impl Inputs<'_> {
    /// Whether a value is given for a variable, or for a part of it.
    fn is_given(&self, name: &str) -> bool {
        let is_of_it = |given: &&&str| {
            let rest = given.strip_prefix(name);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        self.given.iter().any(|given| is_of_it(&given))
    }

    /// Whether a variable has no value of its own.
    fn is_open(&self, variable: &Variable) -> bool {
        let mut uses = self.reached.uses.iter();
        match variable.storage {
            Storage::Constant => false,
            Storage::Own => {
                let is_set = uses.any(|one| one.name == variable.name && one.is_assigned);
                variable.value.is_none() && !is_set
            }
            Storage::Input => variable.value.is_none() || self.is_given(&variable.name),
        }
    }

    /// The numbers that are read and have no value.
    fn numbers(&self) -> Result<Vec<HiddenInput>, UnreadFault> {
        let types = DeclaredTypes::new(self.parts, &self.slicer.names);
        let mut all = Vec::new();
        for place in &self.reached.parts {
            let part = &self.parts[*place];
            for used in &self.reached.uses {
                let found = match &part.kind {
                    PartKind::Variables(variables) | PartKind::Block(_, variables, None) => {
                        let mut variables = variables.iter();
                        match variables.find(|one| one.name == used.name && self.is_open(one)) {
                            Some(variable) => types.numbers(variable, used)?,
                            None => continue,
                        }
                    }
                    PartKind::Block(_, members, Some(name)) if *name == used.name => {
                        types.numbers_of_members(members, used)?
                    }
                    _ => continue,
                };
                self.check_order(used)?;
                all.extend(found);
            }
        }
        Ok(distinct(all))
    }

    /// Refuses a variable that is computed from an input before our function has set it.
    fn check_order(&self, used: &Use) -> Result<(), UnreadFault> {
        let Some(place) = used.by_global else {
            return Ok(());
        };
        let names = self.parts[place].names().join("`, `");
        Err((
            used.line,
            format!(
                "`{names}` is computed from `{}` outside of all functions: compute it in the function, or give it a value",
                used.name
            ),
        ))
    }

    /// The text of all that is reached, and the inputs whose values the text gives.
    fn pieces(&self, numbers: &[HiddenInput]) -> (Vec<Piece>, Vec<Initialised>) {
        let (mut pieces, mut initialised) = (Vec::new(), Vec::new());
        for place in &self.reached.parts {
            let part = &self.parts[*place];
            let first = &self.words[part.start];
            let text = match &part.kind {
                PartKind::Variables(all) if all.iter().any(|one| one.storage == Storage::Input) => {
                    let used = all.iter().filter(|one| self.is_used(&one.name));
                    initialised.extend(used.clone().filter_map(|one| self.initialised(one)));
                    used.map(|one| self.declaration(one)).collect()
                }
                PartKind::Block(_, members, None) => {
                    let used = members.iter().filter(|one| self.is_used(&one.name));
                    used.map(|one| self.declaration(one)).collect()
                }
                PartKind::Block(name, members, Some(instance)) => {
                    let member =
                        |one: &Variable| format!("{} {}; ", one.ty, self.source(one.declarator));
                    let members: String = members.iter().map(member).collect();
                    format!("struct {name} {{ {members}}}; {name} {instance};")
                }
                _ => self.source((part.start, part.end)),
            };
            pieces.push((first.line, first.column, text));
        }
        let has_numbers = |one: &Initialised| {
            let is_of_it = |number: &HiddenInput| number.path.split('.').next() == Some(&one.name);
            numbers.iter().any(is_of_it)
        };
        initialised.retain(|one| !has_numbers(one));
        (pieces, initialised)
    }

    fn is_used(&self, name: &str) -> bool {
        self.reached.uses.iter().any(|one| one.name == name)
    }

    fn initialised(&self, variable: &Variable) -> Option<Initialised> {
        Some(Initialised {
            name: variable.name.clone(),
            line: variable.line,
            value: flat(&self.source(variable.value?)),
        })
    }

    /// An input as a variable that the text keeps.
    fn declaration(&self, variable: &Variable) -> String {
        let Variable { ty, name, .. } = variable;
        let value = variable.value.filter(|_| !self.is_open(variable));
        let value = value.map(|value| flat(&self.source(value)));
        if self.slicer.language == Language::Wgsl {
            return match (value, ty.as_str()) {
                (Some(value), "") => format!("const {name} = {value};"),
                (Some(value), ty) => format!("const {name}: {ty} = {value};"),
                (None, "") => format!("var<private> {name}: f32;"),
                (None, ty) => format!("var<private> {name}: {ty};"),
            };
        }
        let keeps = match self.slicer.language {
            Language::Gles => "",
            _ => "static ",
        };
        let declarator = flat(&self.source(variable.declarator));
        let value = value.map_or(String::new(), |value| format!(" = {value}"));
        format!("{keeps}{} {declarator}{value};", held(ty))
    }

    /// The text of words from one place to another.
    fn source(&self, (from, to): (usize, usize)) -> String {
        let Some((first, last)) = self.words.get(from).zip(self.words.get(to.wrapping_sub(1)))
        else {
            return String::new();
        };
        let last_end = last.column + last.text.chars().count();
        let lines = self
            .slicer
            .code
            .lines()
            .skip(first.line - 1)
            .take(last.line + 1 - first.line);
        let cut: Vec<String> = lines
            .enumerate()
            .map(|(number, line)| {
                let begin = if number == 0 { first.column - 1 } else { 0 };
                let end = match number + first.line == last.line {
                    true => last_end - 1,
                    false => usize::MAX,
                };
                line.chars().take(end).skip(begin).collect()
            })
            .collect();
        cut.join("\n")
    }
}

fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
