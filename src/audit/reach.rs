//! What a function needs of its text: the parts and macros that it names, and what these name; and which variables all of them read.

use std::collections::{BTreeMap, BTreeSet};

use crate::emit::shader_words::Token;

use super::language::Language;
use super::parts::{Part, PartKind};

/// The words of a macro's definitions; its arguments are not among them.
pub type MacroBodies<'t, 'a> = BTreeMap<&'a str, Vec<Vec<&'t Token<'a>>>>;

/// What is reached.
#[derive(Debug, Default)]
pub struct Reached {
    /// The part that all is reached from.
    pub start: usize,
    /// The parts, by their places.
    pub parts: BTreeSet<usize>,
    /// The macros.
    pub macros: BTreeSet<String>,
    /// The variables that are read or written.
    pub uses: Vec<Use>,
    /// Other names, which the language or nobody knows, with their lines.
    pub foreign: Vec<(String, usize)>,
}

/// A variable outside of functions where it is read or written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Use {
    /// Its name.
    pub name: String,
    /// The members behind it: `.a.b`.
    pub path: Vec<String>,
    /// The line.
    pub line: usize,
    /// Whether an element of an array follows.
    pub is_indexed: bool,
    /// Whether all of it gets a value there, whatever holds.
    pub is_set: bool,
    /// The part that it stands in.
    pub part: usize,
    /// The part outside of functions that reads it, where one does.
    pub by_global: Option<usize>,
}

/// What the part of this place reaches.
pub fn reached(
    start: usize,
    tokens: &[Token],
    parts: &[Part],
    macros: &MacroBodies,
    language: Language,
) -> Reached {
    let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (place, part) in parts.iter().enumerate() {
        for name in part.names() {
            by_name.entry(name).or_default().push(place);
        }
    }
    let mut reached = Reached {
        start,
        ..Reached::default()
    };
    let settings = parts.iter().enumerate();
    let settings = settings.filter(|(_, part)| matches!(part.kind, PartKind::Setting));
    let mut open: Vec<usize> = settings.map(|(place, _)| place).chain([start]).collect();
    while let Some(place) = open.pop() {
        if !reached.parts.insert(place) {
            continue;
        }
        let part = &parts[place];
        let words: Vec<&Token> = tokens[part.start..part.end].iter().collect();
        // A type has functions among its members, but in GLSL and WGSL.
        let has_members = matches!(language, Language::Hlsl | Language::Slang);
        let has_code = match &part.kind {
            PartKind::Function(_) => true,
            PartKind::Type(..) => has_members,
            _ => false,
        };
        let mut own: BTreeSet<&str> = match has_code {
            true => locals(&words, language),
            false => BTreeSet::new(),
        };
        if !matches!(part.kind, PartKind::Function(_)) {
            own.extend(part.names());
        }
        let context = Context {
            own: &own,
            part: place,
            by_global: (!has_code).then_some(place),
            counts_uses: has_code || matches!(part.kind, PartKind::Variables(_)),
        };
        visit(&words, &context, &by_name, macros, &mut reached, &mut open);
    }
    reached
}

/// Where words stand.
#[derive(Clone, Copy)]
struct Context<'a> {
    /// Names that mean something else there.
    own: &'a BTreeSet<&'a str>,
    part: usize,
    by_global: Option<usize>,
    counts_uses: bool,
}

fn visit(
    words: &[&Token],
    context: &Context,
    by_name: &BTreeMap<&str, Vec<usize>>,
    macros: &MacroBodies,
    reached: &mut Reached,
    open: &mut Vec<usize>,
) {
    for (at, token) in words.iter().enumerate() {
        let is_member = at > 0 && words[at - 1].text == ".";
        if !token.is_word() || is_member || context.own.contains(token.text) {
            continue;
        }
        if let Some(bodies) = macros.get(token.text) {
            if reached.macros.insert(token.text.to_owned()) {
                let anywhere = Context {
                    own: &BTreeSet::new(),
                    ..*context
                };
                for body in bodies {
                    visit(body, &anywhere, by_name, macros, reached, open);
                }
            }
            continue;
        }
        let Some(places) = by_name.get(token.text) else {
            reached.foreign.push((token.text.to_owned(), token.line));
            continue;
        };
        open.extend(places);
        if context.counts_uses {
            reached.uses.push(use_of(words, at, context));
        }
    }
}

fn use_of(words: &[&Token], at: usize, context: &Context) -> Use {
    let (mut path, mut next) = (Vec::new(), at + 1);
    while let [dot, member, ..] = words.get(next..).unwrap_or(&[]) {
        if dot.text != "." || !member.is_word() {
            break;
        }
        path.push(member.text.to_owned());
        next += 2;
    }
    let sign = |at: usize| words.get(at).map_or("", |token| token.text);
    let is_assigned = sign(next) == "=" && sign(next + 1) != "=" && path.is_empty();
    // A statement of the body itself, behind no condition.
    let depth = words[..at]
        .iter()
        .fold(0i32, |depth, word| match word.text {
            "{" | "(" => depth + 1,
            "}" | ")" => depth - 1,
            _ => depth,
        });
    let begins = at > 0 && ["{", ";", "}"].contains(&words[at - 1].text);
    Use {
        name: words[at].text.to_owned(),
        path,
        line: words[at].line,
        is_indexed: sign(next) == "[",
        is_set: is_assigned && begins && depth == 1,
        part: context.part,
        by_global: context.by_global,
    }
}

/// The names that a function gives a meaning of its own: its arguments, and its variables.
fn locals<'a>(words: &[&Token<'a>], language: Language) -> BTreeSet<&'a str> {
    let mut found = BTreeSet::new();
    let text = |at: usize| words.get(at).map_or("", |token| token.text);
    for at in 1..words.len() {
        if !words[at].is_word() {
            continue;
        }
        let (before, after) = (words[at - 1], text(at + 1));
        let is_declared = match language {
            Language::Wgsl => {
                ["let", "var", "const"].contains(&before.text)
                    || before.text == ">" && after == ":"
                    || ["(", ","].contains(&before.text) && after == ":"
            }
            _ => {
                let no_types = ["return", "else", "do", "case"];
                let is_type = before.is_word() && !no_types.contains(&before.text);
                is_type && ["=", ";", ",", ")", "[", ":"].contains(&after)
            }
        };
        if is_declared {
            found.insert(words[at].text);
            if language != Language::Wgsl {
                found.extend(further(&words[at + 1..]));
            }
        }
    }
    found
}

/// The names behind the first of a declaration: `= 1.0, b, c;`.
fn further<'a>(words: &[&Token<'a>]) -> Vec<&'a str> {
    let (mut found, mut depth) = (Vec::new(), 0i32);
    for (at, token) in words.iter().enumerate() {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth < 0 || token.text == ";" && depth == 0 {
            break;
        }
        // A type and a name are another argument.
        let is_name = |at: usize| words.get(at).is_some_and(|word| word.is_word());
        let next = words
            .get(at + 1)
            .filter(|_| is_name(at + 1) && !is_name(at + 2));
        if let Some(next) = next.filter(|_| token.text == "," && depth == 0) {
            found.push(next.text);
        }
    }
    found
}
