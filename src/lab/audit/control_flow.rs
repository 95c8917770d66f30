//! Whether a function branches. Compilers count code behind a branch in their own ways: RADV's inverse throughput discounts it, and
//! instruction counts count both sides. So the cost of a function that branches is not comparable with that of ours, which do not.
//!
//! A choice by `?:`, `select` or `mix` is no branch: both values are computed.

use std::collections::BTreeSet;

use crate::generator::emit::shader_words::{Token, tokens};

use super::language::{Language, bare};
use super::scan;
use super::type_names::TypeNames;

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
    /// Why costs are not compared, in a sentence without its full stop.
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
    let functions = scan::bodies(&tokens, &names, language);
    let mut parts: Vec<(String, &[Token])> =
        functions.map(|(found, body)| (found.name, body)).collect();
    if language.has_preprocessor() {
        let lines = all.chunk_by(|a, b| a.line == b.line);
        parts.extend(lines.filter_map(macro_body));
    }
    first_branch(&parts, function, &mut BTreeSet::new())
}

/// A macro with what it stands for.
fn macro_body<'t, 'a>(line: &'t [Token<'a>]) -> Option<(String, &'t [Token<'a>])> {
    match line {
        [hash, define, name, body @ ..] if hash.text == "#" && define.text == "define" => {
            Some((name.text.to_owned(), body))
        }
        _ => None,
    }
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
