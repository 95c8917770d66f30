//! What a function needs of its text: the parts and macros that it names, directly or through others, and the variables that they
//! read.

use std::collections::{BTreeMap, BTreeSet};

use super::language::Language;
use super::parts::{Part, PartKind};
use crate::lab::verify::shader_words::Token;

/// The words of each macro's definitions, without its arguments.
pub type MacroBodies<'t, 'a> = BTreeMap<&'a str, Vec<Vec<&'t Token<'a>>>>;

/// The parts, macros and variables that a part needs.
#[derive(Debug, Default)]
pub struct Reached {
    /// The index of the part that all is reached from.
    pub start: usize,
    /// The parts, by their indices.
    pub parts: BTreeSet<usize>,
    /// The macros.
    pub macros: BTreeSet<String>,
    /// The variables that are read or written.
    pub uses: Vec<Use>,
    /// Names that the text does not declare, with their lines.
    pub foreign: Vec<(String, usize)>,
}

/// A variable outside of functions where it is read or written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Use {
    /// Its name.
    pub name: String,
    /// The members that follow: `.a.b`.
    pub path: Vec<String>,
    /// The line.
    pub line: usize,
    /// Whether an element of an array follows.
    pub is_indexed: bool,
    /// Whether it is assigned there as a whole and unconditionally.
    pub is_set: bool,
    /// The index of the part that it stands in.
    pub part: usize,
    /// The index of the part outside of functions that reads it, where one does.
    pub by_global: Option<usize>,
}

/// What the part with this index reaches.
pub fn reached(
    start: usize,
    tokens: &[Token],
    parts: &[Part],
    macros: &MacroBodies,
    language: Language,
) -> Reached {
    let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (place, part) in parts.iter().enumerate() {
        // A macro of an engine that this text does not define is left out.
        let is_macro = matches!(part.kind, PartKind::MacroCall(_));
        if is_macro && !macros.contains_key(tokens[part.start].text) {
            continue;
        }
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
        // Types have functions among their members, except in GLSL and WGSL.
        let has_members = matches!(language, Language::Hlsl | Language::Slang);
        let has_code = match &part.kind {
            PartKind::Function(_) | PartKind::MacroCall(_) => true,
            PartKind::Type(..) => has_members,
            _ => false,
        };
        let mut own: Vec<Own> = if has_code {
            locals(&words, language)
        } else {
            Vec::new()
        };
        if !matches!(part.kind, PartKind::Function(_) | PartKind::MacroCall(_)) {
            own.extend(part.names().into_iter().map(Own::everywhere));
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
    /// Names that are shadowed there.
    own: &'a [Own<'a>],
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
        let is_own = |own: &Own| own.name == token.text && own.holds(at);
        if !token.is_word() || is_member || context.own.iter().any(is_own) {
            continue;
        }
        if let Some(bodies) = macros.get(token.text) {
            if reached.macros.insert(token.text.to_owned()) {
                let anywhere = Context {
                    own: &[],
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
    // An unconditional statement at the top level of the body.
    let depth: i32 = words[..at].iter().map(|word| step(word)).sum();
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

/// A name that shadows an outer one, and the words between which it does.
struct Own<'a> {
    name: &'a str,
    /// The index of its declaration.
    at: usize,
    from: usize,
    to: usize,
}

impl<'a> Own<'a> {
    fn everywhere(name: &'a str) -> Own<'a> {
        Own {
            name,
            at: 0,
            from: 0,
            to: usize::MAX,
        }
    }

    fn holds(&self, place: usize) -> bool {
        place == self.at || (self.from..self.to).contains(&place)
    }

    /// The name at this place, from its declaration to the end of the block.
    fn declared(words: &[&Token<'a>], at: usize, language: Language) -> Own<'a> {
        // The value of `float x = x + 1.0;` reads the outer x in GLSL and WGSL, and its own in HLSL and Slang.
        let is_own_in_value = matches!(language, Language::Hlsl | Language::Slang);
        let from = if is_own_in_value {
            at
        } else {
            value_end(words, at)
        };
        Own {
            name: words[at].text,
            at,
            from,
            to: scope_end(words, at),
        }
    }
}

/// The names that a function declares: its arguments and its variables.
fn locals<'a>(words: &[&Token<'a>], language: Language) -> Vec<Own<'a>> {
    let mut found = Vec::new();
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
            let more = match language {
                Language::Wgsl => Vec::new(),
                _ => further(words, at + 1),
            };
            let all = [at].into_iter().chain(more);
            found.extend(all.map(|at| Own::declared(words, at, language)));
        }
    }
    found
}

/// By how much a word changes the depth of brackets.
fn step(token: &Token) -> i32 {
    match token.text {
        "(" | "[" | "{" => 1,
        ")" | "]" | "}" => -1,
        _ => 0,
    }
}

/// The index of the end of the value declared here: its `,` or `;`, or the bracket that closes around it.
fn value_end(words: &[&Token], at: usize) -> usize {
    let mut depth = 0;
    for (place, token) in words.iter().enumerate().skip(at) {
        depth += step(token);
        if depth < 0 || depth == 0 && [",", ";"].contains(&token.text) {
            return place;
        }
    }
    words.len()
}

/// The index at which the scope of a name declared here ends: the end of its block. For an argument, or a variable in the head of
/// a loop, it is the end of what follows the head.
fn scope_end(words: &[&Token], at: usize) -> usize {
    let (mut depth, mut is_in_head) = (0, false);
    for (place, token) in words.iter().enumerate().skip(at) {
        depth += step(token);
        match token.text {
            "}" if depth < 0 => return place,
            ")" if depth < 0 => (depth, is_in_head) = (0, true),
            "}" | ";" if is_in_head && depth == 0 => return place + 1,
            _ => {}
        }
    }
    words.len()
}

/// The indices of the names after the first in a declaration: `= 1.0, b, c;`.
fn further(words: &[&Token], from: usize) -> Vec<usize> {
    let (mut found, mut depth) = (Vec::new(), 0i32);
    for (at, token) in words.iter().enumerate().skip(from) {
        depth += step(token);
        if depth < 0 || token.text == ";" && depth == 0 {
            break;
        }
        // A type and a name form another argument.
        let is_name = |at: usize| words.get(at).is_some_and(|word| word.is_word());
        let is_next = is_name(at + 1) && !is_name(at + 2);
        if is_next && token.text == "," && depth == 0 {
            found.push(at + 1);
        }
    }
    found
}
