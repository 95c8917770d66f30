//! Loops and branches of a user's text. Loops get a counter of iterations, so that an infinite loop terminates and is reported. A
//! device could hang in one. A software driver leaves it after some number of iterations, without a message and with a
//! meaningless result.
//!
//! The cost of a function that branches is not comparable with that of ours, which do not. Compilers count code behind a branch
//! in their own ways: RADV's inverse throughput discounts it, and instruction counts count both sides.
//!
//! A choice by `?:`, `select` or `mix` is no branch: both values are computed.

use std::collections::BTreeSet;

use super::directives::definitions;
use super::language::{Language, bare};
use super::parts;
use super::type_names::TypeNames;
use crate::lab::verify::shader_words::{Token, behind, tokens};

/// The most iterations of all loops together in one evaluation.
pub const TURNS: usize = 10_000;
/// The result of our function where loops took more. No reflectance is near it.
pub const MARK: f32 = 1e30;

/// The text with counted loops, where it holds any. Lines keep their numbers.
pub fn counted(text: &str, language: Language) -> Option<String> {
    let code = bare(text, language.has_preprocessor());
    let tokens = tokens(&code);
    let mut marks: Vec<(usize, usize, &str)> = Vec::new();
    for at in 0..tokens.len() {
        match language {
            Language::Wgsl => marks.extend(in_body(&tokens, at)),
            _ => marks.extend(in_condition(&tokens, at).into_iter().flatten()),
        }
    }
    if marks.is_empty() {
        return None;
    }
    Some(inserted(text, &marks))
}

/// Whether a macro holds a loop, pastes words that might form one, or holds one bracket of a pair, so that a loop's condition ends
/// elsewhere than it seems to. Its iterations could not be counted.
pub fn is_in_macro(text: &str) -> bool {
    let count = |text: &str| {
        let words = ["for", "while", "do", "loop"];
        let tokens = tokens(text);
        let loops = tokens.iter().filter(|token| words.contains(&token.text));
        loops.count()
    };
    let (whole, code) = (bare(text, false), bare(text, true));
    let (all, in_code) = (count(&whole), count(&code));
    all > in_code
        || whole.contains("##")
        || in_code > 0 && definitions(&tokens(&whole)).any(|found| has_lone_bracket(found.body))
}

/// Whether a bracket is not closed by one of its own kind.
fn has_lone_bracket(tokens: &[Token]) -> bool {
    let mut open = Vec::new();
    for token in tokens {
        match token.text {
            "(" => open.push(")"),
            "[" => open.push("]"),
            "{" => open.push("}"),
            ")" | "]" | "}" if open.pop() != Some(token.text) => return true,
            _ => {}
        }
    }
    !open.is_empty()
}

/// The declarations of the counter and of the function that counts. They precede the text in languages that declare before use.
pub fn counter(language: Language) -> String {
    match language {
        Language::Wgsl => "var<private> fg_turns: i32;\n".to_owned(),
        _ => {
            let keeps = if [Language::Hlsl, Language::Slang].contains(&language) {
                "static "
            } else {
                ""
            };
            format!(
                "{keeps}int fg_turns = 0; bool fg_turn(bool fg_goes) {{ fg_turns += 1; return fg_goes && fg_turns <= {TURNS}; }}\n"
            )
        }
    }
}

/// In WGSL every body has braces.
const IN_BODY: &str = " fg_turns += 1; if fg_turns > 10000 { break; }";

fn in_body<'a>(tokens: &[Token], at: usize) -> Option<(usize, usize, &'a str)> {
    if !["loop", "while", "for"].contains(&tokens[at].text) {
        return None;
    }
    let body = tokens[at..].iter().find(|token| token.text == "{")?;
    Some((body.line, body.column + 1, IN_BODY))
}

/// `while (fg_turn(…))`, `for (…; fg_turn(…); …)`. A loop that is to be unrolled terminates, or compilers refuse it.
fn in_condition<'a>(tokens: &[Token], at: usize) -> Option<Vec<(usize, usize, &'a str)>> {
    let is_for = tokens[at].text == "for";
    let mut before = tokens[..at].iter().rev();
    let is_unrolled = before.next().is_some_and(|token| token.text == "]")
        && before
            .take_while(|token| token.text != "[")
            .any(|token| token.text == "unroll");
    if !is_for && tokens[at].text != "while" || is_unrolled {
        return None;
    }
    let open = at + 1;
    tokens.get(open).filter(|token| token.text == "(")?;
    let close = behind(tokens, open) - 1;
    tokens.get(close).filter(|token| token.text == ")")?;
    let (first, last) = if is_for {
        let mut ends = (open..close).filter(|i| tokens[*i].text == ";");
        (ends.next()?, ends.next()?)
    } else {
        (open, close)
    };
    let (from, to) = (&tokens[first], &tokens[last]);
    let whole = (from.line, from.column + 1, " fg_turn(0 == 0) ");
    Some(if last == first + 1 {
        vec![whole]
    } else {
        vec![
            (from.line, from.column + 1, " fg_turn("),
            (to.line, to.column, ") "),
        ]
    })
}

/// A text with words inserted before these places.
fn inserted(text: &str, marks: &[(usize, usize, &str)]) -> String {
    let mut lines: Vec<Vec<char>> = text
        .split('\n')
        .map(|line| line.chars().collect())
        .collect();
    let mut marks = marks.to_vec();
    marks.sort_unstable();
    for (line, column, word) in marks.into_iter().rev() {
        if let Some(line) = lines.get_mut(line - 1) {
            let at = (column - 1).min(line.len());
            line.splice(at..at, word.chars());
        }
    }
    let lines: Vec<String> = lines.into_iter().map(String::from_iter).collect();
    lines.join("\n")
}

/// Words that begin a branch or a loop.
const BRANCHES: [&str; 6] = ["if", "for", "while", "do", "loop", "switch"];

/// The first branch that an evaluation may meet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Branch {
    /// Its word.
    pub word: String,
    /// Its line.
    pub line: usize,
}

impl Branch {
    /// Why costs are not compared: a sentence without its full stop.
    pub fn reason(&self) -> String {
        format!(
            "not compared with ours: it branches (`{}` in line {}), and compilers count code behind a branch differently",
            self.word, self.line
        )
    }
}

/// The first branch in a function, or in one that it calls, macros included.
pub fn branch(text: &str, language: Language, function: &str) -> Option<Branch> {
    let (code, whole) = (bare(text, language.has_preprocessor()), bare(text, false));
    let (tokens, all) = (tokens(&code), tokens(&whole));
    let names = TypeNames::of_text(text, language);
    let functions = parts::bodies(&tokens, &names, language);
    let mut parts: Vec<(String, &[Token])> =
        functions.map(|(found, body)| (found.name, body)).collect();
    if language.has_preprocessor() {
        parts.extend(definitions(&all).map(|one| (one.name.to_owned(), one.body)));
    }
    first_branch(&parts, function, &mut BTreeSet::new())
}

fn first_branch(
    parts: &[(String, &[Token])],
    name: &str,
    seen: &mut BTreeSet<String>,
) -> Option<Branch> {
    if !seen.insert(name.to_owned()) {
        return None;
    }
    let own = parts.iter().filter(|(own, _)| own == name);
    own.flat_map(|(_, body)| body.iter()).find_map(|token| {
        if BRANCHES.contains(&token.text) {
            return Some(Branch {
                word: token.text.to_owned(),
                line: token.line,
            });
        }
        first_branch(parts, token.text, seen)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(language: Language, text: &str, expected: &str) {
        let counted = counted(text, language).unwrap_or_default();
        assert!(counted.ends_with(expected), "{counted}");
        assert_eq!(counted.lines().count(), text.lines().count());
    }

    #[test]
    fn every_loop_counts() {
        check(
            Language::Wgsl,
            "fn f() { loop { while a {} } }",
            "fn f() { loop { fg_turns += 1; if fg_turns > 10000 { break; } while a { fg_turns += 1; if fg_turns > 10000 { break; }} } }",
        );
        check(
            Language::Gles,
            "f() {\n for (;;) g(); // for\n do { } while (a(b)); }",
            "f() {\n for (; fg_turn(0 == 0) ;) g(); // for\n do { } while ( fg_turn(a(b)) ); }",
        );
        check(
            Language::Hlsl,
            "for (int i = 0; i < 3; i++) {}",
            "for (int i = 0; fg_turn( i < 3) ; i++) {}",
        );
        assert!(IN_BODY.contains(&TURNS.to_string()));
    }

    #[test]
    fn loops_in_macros_are_seen() {
        assert!(is_in_macro("#define EVER for (;;)\nfloat f() { EVER; }"));
        assert!(is_in_macro("#define GO(a) wh##a\n"));
        for bracket in ["[", ")", "([)]"] {
            let define = format!("#define B {bracket}\n");
            assert!(is_in_macro(&format!(
                "{define}float f() {{ while (a) {{}} }}"
            )));
            assert!(!is_in_macro(&format!("{define}float f() {{ }}")));
        }
        assert!(!is_in_macro(
            "#define PI (3.1 * a[0])\nfloat f() { for (;;) {} }"
        ));
        assert!(!is_in_macro(
            "#define PI 3.1 // for all\nfloat f() { for (;;) {} }"
        ));
    }

    #[test]
    fn what_holds_no_loop_is_left_alone() {
        for text in [
            "",
            "float f() { return format; }",
            "[unroll] for (;;) {}",
            "while",
            "for (",
            "for (;",
            "while ) for )",
        ] {
            assert_eq!(counted(text, Language::Hlsl), None, "{text}");
        }
        assert_eq!(counted("loop", Language::Wgsl), None);
    }
}

#[cfg(test)]
mod control_flow_tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, language: Language, expected: Option<(&str, usize)>) {
        let found = branch(text, language, "f");
        let found = found.map(|branch| (branch.word, branch.line));
        let expected = expected.map(|(word, line)| (word.to_owned(), line));
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn a_branch_is_found_wherever_an_evaluation_meets_it() {
        let c = "float f(float x) {\n if (x > 0.) return 1.;\n return 0.; }";
        check(c, Language::Gles, Some(("if", 2)));
        check(c, Language::Hlsl, Some(("if", 2)));
        let called = "float g(float x) { while (x > 0.) x -= 1.; return x; }\nfloat f(float x) { return g(x); }";
        check(called, Language::Gles, Some(("while", 1)));
        let wgsl = "fn f(x: f32) -> f32 { switch 1 { default { } } return x; }";
        check(wgsl, Language::Wgsl, Some(("switch", 1)));
        let hidden =
            "#define GUARD(x) if (x < 0.) return 0.\nfloat f(float x) { GUARD(x); return x; }";
        check(hidden, Language::Gles, Some(("if", 1)));
    }

    #[test]
    fn a_choice_is_no_branch_and_others_do_not_count() {
        check(
            "float f(float x) { return x > 0. ? 1. : 0.; }",
            Language::Hlsl,
            None,
        );
        let wgsl = "fn f(x: f32) -> f32 { return select(0., 1., x > 0.); }";
        check(wgsl, Language::Wgsl, None);
        let other = "float g(float x) { if (x > 0.) return 1.; return 0.; }\nfloat f(float x) { return x; } // if\n#if 1\n#endif";
        check(other, Language::Gles, None);
        check("float f(float x) { return f(x); }", Language::Gles, None);
    }
}
