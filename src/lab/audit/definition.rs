//! Lines that define and undefine macros.

use crate::lab::verify::shader_words::Token;

/// `#define name body`, or `#define name(params) body`.
pub struct Definition<'t, 'a> {
    /// The macro's name.
    pub name: &'a str,
    /// The names of its arguments. None for a macro without an argument list.
    pub params: Option<Vec<&'a str>>,
    /// What it stands for.
    pub body: &'t [Token<'a>],
}

/// The tokens of each line that has any.
pub fn each_line<'t, 'a>(tokens: &'t [Token<'a>]) -> impl Iterator<Item = &'t [Token<'a>]> {
    tokens.chunk_by(|a, b| a.line == b.line)
}

/// The macro that a line defines.
pub fn definition<'t, 'a>(line: &'t [Token<'a>]) -> Option<Definition<'t, 'a>> {
    let [hash, define, name, rest @ ..] = line else {
        return None;
    };
    if hash.text != "#" || define.text != "define" || !name.is_word() {
        return None;
    }
    // `#define f(x)` takes arguments, `#define f (x)` does not.
    let is_list = |first: &Token| first.text == "(" && first.column == name.end();
    let has_list = rest.first().is_some_and(is_list);
    let close = rest.iter().position(|token| token.text == ")");
    let (params, body) = match close.filter(|_| has_list) {
        Some(close) => {
            let names = rest[1..close].iter().filter(|token| token.is_word());
            let names = names.map(|token| token.text).collect();
            (Some(names), &rest[close + 1..])
        }
        None => (None, rest),
    };
    Some(Definition {
        name: name.text,
        params,
        body,
    })
}

/// The definitions among tokens.
pub fn definitions<'t, 'a>(tokens: &'t [Token<'a>]) -> impl Iterator<Item = Definition<'t, 'a>> {
    each_line(tokens).filter_map(definition)
}

/// The name that a line defines or undefines.
pub fn macro_name<'t, 'a>(line: &'t [Token<'a>]) -> Option<&'t Token<'a>> {
    match line {
        [hash, word, name, ..] if hash.text == "#" && ["define", "undef"].contains(&word.text) => {
            Some(name)
        }
        _ => None,
    }
}
