//! Checks the directives and macros of a user's text. Those that could read another file, or give the audited function another
//! meaning, are refused before any compiler sees them.
//!
//! Comments have been removed by then, and continued lines have been refused. So a directive is a line that begins with `#`, and a
//! `#` anywhere else is refused. Lines that define and undefine macros are found here too.

use std::collections::BTreeSet;

use super::language::bare;
use crate::lab::verify::shader_words::{Token, tokens};

/// Directives that read no file. Includes, imports, embeds and any others of a compiler are not among them.
const ALLOWED: [&str; 13] = [
    "define",
    "undef",
    "if",
    "ifdef",
    "ifndef",
    "elif",
    "else",
    "endif",
    "error",
    "line",
    "pragma",
    "version",
    "extension",
];

/// Pragmas of GLSL and HLSL that read no file and run nothing.
const PRAGMAS: [&str; 8] = [
    "optimize",
    "debug",
    "STDGL",
    "invariant",
    "once",
    "pack_matrix",
    "warning",
    "def",
];

/// A fault in a text: line, column, message.
pub type TextFault = (usize, usize, String);

/// The first thing in a text that could read another file, or be read in two ways.
pub fn fault(text: &str) -> Option<TextFault> {
    let code = bare(text, false);
    let tokens = tokens(&code);
    each_line(&tokens).find_map(|line| directive(line).or_else(|| line.windows(2).find_map(pair)))
}

/// The directive that defines or undefines this name.
pub fn redefinition(text: &str, name: &str) -> Option<TextFault> {
    let code = bare(text, false);
    let tokens = tokens(&code);
    let mut names = each_line(&tokens).filter_map(macro_name);
    let found = names.find(|found| found.text == name)?;
    let what = format!(
        "a macro is named `{name}`, as the audited function is: compilers would call the macro; rename one of them"
    );
    Some((found.line, found.column, what))
}

/// The names of all macros that a text defines, in order, each once.
pub fn macros(text: &str) -> BTreeSet<String> {
    let code = bare(text, false);
    let tokens = tokens(&code);
    definitions(&tokens)
        .map(|one| one.name.to_owned())
        .collect()
}

/// What is wrong with a line as a directive.
fn directive(line: &[Token]) -> Option<TextFault> {
    let found = |token: &Token, what: String| Some((token.line, token.column, what));
    let [first, rest @ ..] = line else {
        return None;
    };
    if first.text != "#" {
        let sign = line.iter().find(|token| token.text == "#")?;
        let what = "a `#` that begins no line: it could be a directive to a compiler";
        return found(sign, what.to_owned());
    }
    if let Some(sign) = rest.iter().find(|token| token.text == "#") {
        return found(
            sign,
            "a second `#` in a directive: write the text out".to_owned(),
        );
    }
    match rest {
        [] => None,
        [name, ..] if !ALLOWED.contains(&name.text) => found(
            name,
            format!(
                "`#{}` is not allowed: one file alone is audited, so paste what it needs; allowed are {}",
                name.text,
                ALLOWED.join(", ")
            ),
        ),
        [name, pragma, ..] if name.text == "pragma" && !PRAGMAS.contains(&pragma.text) => found(
            pragma,
            format!(
                "`#pragma {}` is not allowed; allowed are {}",
                pragma.text,
                PRAGMAS.join(", ")
            ),
        ),
        _ => None,
    }
}

/// What is wrong with two neighbouring tokens, or with the first of them: characters that compilers read as others, and tests for
/// files.
fn pair(pair: &[Token]) -> Option<TextFault> {
    let [first, second] = pair else { return None };
    let together = first.end() == second.column;
    let asks = |token: &&Token| {
        let word = token.text;
        word.starts_with("__has_") || ["_Pragma", "__pragma", "__import__"].contains(&word)
    };
    if let Some(word) = [first, second].into_iter().find(asks) {
        let what = format!(
            "`{}` is not allowed: it asks about what lies outside of the file",
            word.text
        );
        return Some((word.line, word.column, what));
    }
    if let Some(sign) = [first, second].into_iter().find(|token| token.text == "\\") {
        let what = "a backslash outside of comments: it can hide what a name is";
        return Some((sign.line, sign.column, what.to_owned()));
    }
    let signs = [
        ("%", ":"),
        ("<", "%"),
        ("%", ">"),
        ("<", ":"),
        (":", ">"),
        ("?", "?"),
    ];
    let is_digraph = together && signs.contains(&(first.text, second.text));
    let is_raw = together && first.text.ends_with('R') && second.text == "\"";
    let what = if is_digraph {
        "some compilers read these two signs as another one: put a space between them"
    } else if is_raw {
        "a raw string: what it hides is not read; write it as a plain one"
    } else {
        return None;
    };
    Some((first.line, first.column, what.to_owned()))
}

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
fn each_line<'t, 'a>(tokens: &'t [Token<'a>]) -> impl Iterator<Item = &'t [Token<'a>]> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn refused(text: &str, line: usize, column: usize, says: &str) {
        let (at, from, what) = fault(text).expect("a fault");
        assert!(what.contains(says), "{what}");
        assert_eq!((at, from), (line, column), "{text}: {what}");
    }

    #[test]
    fn what_could_read_a_file_is_refused() {
        refused("\n#include \"a\"\n", 2, 2, "`#include` is not allowed");
        refused("# /* b */ include <a>", 1, 11, "`#include`");
        refused("/* a */ #\tinclude_next <a>", 1, 11, "`#include_next`");
        refused("#import \"a\"", 1, 2, "`#import`");
        refused("#embed \"a\"", 1, 2, "`#embed`");
        refused(
            "#if __has_include(\"/etc/passwd\")\n#endif",
            1,
            5,
            "`__has_include`",
        );
        refused("#if 1 == __has_embed(\"a\")", 1, 10, "`__has_embed`");
        refused("float a = __has_include(<a>);", 1, 11, "`__has_include`");
        refused("#pragma GCC dependency \"a\"", 1, 9, "`#pragma GCC`");
        refused(
            "#pragma include_alias(\"a\", \"b\")",
            1,
            9,
            "`#pragma include_alias`",
        );
        refused("_Pragma(\"a\")", 1, 1, "`_Pragma`");
        refused("%:include \"a\"", 1, 1, "read these two signs");
        refused("??=include \"a\"", 1, 1, "read these two signs");
        refused("float f() <% return 1.0; %>", 1, 11, "read these two signs");
        refused("\u{200b}#include \"a\"", 1, 2, "begins no line");
        refused("#define A #x", 1, 11, "a second `#`");
        refused("x = R\"(\n/*\n)\";", 1, 5, "a raw string");
        refused("float \\u0066;", 1, 7, "a backslash");
    }

    #[test]
    fn what_reads_none_is_free() {
        for text in [
            "",
            "#",
            "#version 300 es\n#extension GL_OES_standard_derivatives : enable\n",
            "#ifdef A\n#define B(x) (x % 2 ? x : 1)\n#elif defined(C)\n#undef B\n#else\n#error no\n#endif\n",
            "#pragma once\n#pragma pack_matrix(row_major)\n#line 3\n",
            "// #include \"a\"\n/* __has_include(a) %: */ float a = b < c ? 1.0 : 2.0;\n",
        ] {
            assert_eq!(fault(text), None, "{text}");
        }
    }

    #[test]
    fn a_macro_with_the_functions_name_is_found() {
        let text = "float f(float c) { return 5.0; }\n# /* a */ define f(x) 0.5\n";
        let (line, column, what) = redefinition(text, "f").expect("it is found");
        assert_eq!((line, column), (2, 18));
        assert!(what.contains("a macro is named `f`"), "{what}");
        assert!(redefinition("#undef f\n", "f").is_some());
        assert!(redefinition("#define f2 f\n// #define f\n", "f").is_none());
        let names = macros("#define B 1\n#define A(x) x\n#define B 2\n#undef A\n");
        assert!(names.iter().eq(["A", "B"]));
    }
}
