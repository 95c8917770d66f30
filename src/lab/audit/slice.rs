//! The part of a user's text that compilers see: the audited function, what it needs, and nothing else. Lines keep their numbers.
//! Inputs from outside become variables that our function sets.

use super::directives::{definitions, macro_name};
use super::hidden::{HiddenInput, UnreadFault};
use super::inputs::{Initialised, Inputs, Piece};
use super::language::{Language, bare};
use super::parts::{Part, PartKind, functions_of, parts};
use super::preprocess::{Condition, Define, Preprocessed};
use super::reach::{MacroBodies, Reached, reached};
use super::type_names::TypeNames;
use super::variables::without_annotations;
use crate::lab::verify::function_head::FunctionHead;
use crate::lab::verify::shader_words::{Token, tokens};

/// What compilers see of a text.
#[derive(Clone, Debug, Default)]
pub struct Slice {
    /// The user's definitions, which stand before the first line.
    pub before: String,
    /// The text.
    pub text: String,
    /// The audited function's own text.
    pub body: String,
    /// The inputs from outside that have no value.
    pub hidden: Vec<HiddenInput>,
    /// The inputs from outside that have a value in the text.
    pub initialised: Vec<Initialised>,
    /// The conditions that the kept lines depend on.
    pub conditions: Vec<Condition>,
    /// The word by which it computes in 16 bits, if it does.
    pub half: Option<String>,
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
    /// The functions of a preprocessed text.
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
        let all = format!("{}{}", define_lines(defines), preprocessed.text);
        SlicedText {
            language,
            preprocessed,
            defines,
            names: TypeNames::of_text(&all, language),
            code,
        }
    }

    /// Its functions in order.
    pub fn functions(&self) -> Vec<FunctionHead> {
        let tokens = tokens(&self.code);
        let parts = parts(&tokens, &self.names, self.language);
        let heads = parts.iter().filter_map(|part| match &part.kind {
            PartKind::Prototype(head) => Some(head),
            _ => None,
        });
        let heads: Vec<&FunctionHead> = heads.collect();
        let functions = parts.iter();
        let functions = functions
            .flat_map(|part| functions_of(part, &tokens, &self.names, self.language))
            .map(|mut found| {
                // In HLSL a prototype before the function may state its defaults.
                let is_head = |head: &&&FunctionHead| {
                    let types = |one: &FunctionHead| {
                        let each = one.params.iter();
                        each.map(|param| param.ty.clone()).collect::<Vec<_>>()
                    };
                    head.name == found.name && types(head) == types(&found)
                };
                if let Some(head) = heads.iter().find(is_head) {
                    for (own, stated) in found.params.iter_mut().zip(&head.params) {
                        own.default = own.default.take().or(stated.default.clone());
                    }
                }
                found
            });
        functions.collect()
    }

    /// What compilers see if this function is audited and these inputs are given values.
    ///
    /// # Errors
    /// It needs an input that is not made of numbers.
    pub fn around(&self, function: &FunctionHead, given: &[&str]) -> Result<Slice, UnreadFault> {
        let words = tokens(&self.code);
        let parts = parts(&words, &self.names, self.language);
        let place = (function.line, function.column);
        let is_it = |part: &Part| {
            let mut inside = words[part.start..part.end].iter();
            inside.any(|word| (word.line, word.column) == place)
        };
        let Some(start) = parts.iter().position(is_it) else {
            return Ok(Slice::default());
        };
        let before = define_lines(self.defines);
        let (theirs, own) = (tokens(&before), tokens(&self.preprocessed.text));
        let macros = macro_bodies(&theirs, &own);
        let reached = reached(start, &words, &parts, &macros, self.language);
        check_pixel_words(&reached)?;
        check_enumerations(self.language, &reached, &parts, &words)?;
        let inputs = Inputs {
            language: self.language,
            names: &self.names,
            code: &self.code,
            words: &words,
            parts: &parts,
            reached: &reached,
            given,
        };
        let body: Vec<&str> = words[parts[start].start..parts[start].end]
            .iter()
            .map(|word| word.text)
            .collect();
        let body = body.join(" ");
        let numbers = inputs.numbers()?;
        let (pieces, initialised) = inputs.pieces(&numbers);
        let mut lines = lines_of(&reached, &parts, &words);
        let kept_macros = self.macro_lines(&reached);
        lines.extend(kept_macros.iter().map(|(line, ..)| (*line, *line)));
        let conditions = self.preprocessed.conditions.iter();
        let conditions = conditions.filter(|one| {
            let is_met = |(from, to): &(usize, usize)| *from <= one.end && *to >= one.line;
            lines.iter().any(is_met)
        });
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
            before: define_lines(&used),
            half: half_word(&text, &self.names, self.language),
            text,
            body,
            hidden: numbers,
            initialised,
            conditions: conditions.cloned().collect(),
        })
    }

    /// The lines that define or undefine the macros that are reached.
    fn macro_lines(&self, reached: &Reached) -> Vec<Piece> {
        if !self.language.has_preprocessor() {
            return Vec::new();
        }
        let lines = self.preprocessed.text.lines().enumerate();
        let is_reached = |name: &Token| reached.macros.contains(name.text);
        let kept = lines.filter(|(_, line)| macro_name(&tokens(line)).is_some_and(is_reached));
        kept.map(|(number, line)| (number + 1, 1, line.to_owned()))
            .collect()
    }
}

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
fn define_lines(defines: &[Define]) -> String {
    let line = |one: &Define| format!("#define {} {}\n", one.name, one.value);
    defines.iter().map(line).collect()
}

/// The words of the macros of the command line and of the text.
fn macro_bodies<'t, 'a>(theirs: &'t [Token<'a>], own: &'t [Token<'a>]) -> MacroBodies<'t, 'a> {
    let mut found = MacroBodies::new();
    for one in definitions(theirs).chain(definitions(own)) {
        let params = one.params.unwrap_or_default();
        let body = one
            .body
            .iter()
            .filter(|token| !params.contains(&token.text));
        found.entry(one.name).or_default().push(body.collect());
    }
    found
}

/// The first and last lines of the parts that are kept.
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

/// Words that only a pixel in a picture has: derivatives, and `discard`.
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

/// Refuses enumerations where DXC compiles them wrongly. In SPIR-V, which is what runs here, `float(E)` with E = 5 is 7e-45.
fn check_enumerations(
    language: Language,
    reached: &Reached,
    parts: &[Part],
    words: &[Token],
) -> Result<(), UnreadFault> {
    let of_part = |place: &usize| words[parts[*place].start..parts[*place].end].iter();
    let mut all = reached.parts.iter().flat_map(of_part);
    match all.find(|word| language == Language::Hlsl && word.text == "enum") {
        None => Ok(()),
        Some(word) => Err((
            word.line,
            "it needs an `enum`, of whose numbers DXC makes others in SPIR-V, which runs here: write them as `static const int`".to_owned(),
        )),
    }
}

/// The word by which a text computes in 16 bits.
fn half_word(text: &str, names: &TypeNames, language: Language) -> Option<String> {
    let code = bare(text, language.has_preprocessor());
    let found = tokens(&code);
    let found = names.replaced(&found);
    let is_half = |token: &&Token| match language {
        Language::Wgsl | Language::Glsl => false,
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
