//! The check of a user's text: whatever could read another file, hide a name, or be read in two ways is refused before any
//! compiler sees it.

use super::directives::{self, TextFault, definition};
use super::error::Error;
use super::language::{Language, bare};
use super::loops::is_in_macro;
use super::preprocess::{Define, Preprocessed, joined_comments, joined_lines, preprocessed};
use crate::lab::verify::shader_words::tokens;

/// The text as compilers would see it: preprocessed, without comments.
///
/// # Errors
/// It holds a reserved name, asks for another file, or holds characters that are not text.
pub fn admitted(
    file: &str,
    text: &str,
    language: Language,
    defines: &[Define],
) -> Result<Preprocessed, Error> {
    let refuse = |found: Option<TextFault>| found.map_or(Ok(()), |fault| Err(error(file, fault)));
    refuse(no_text(text))?;
    let joined = if language.has_preprocessor() {
        refuse(ambiguous(text))?;
        joined_comments(&joined_lines(text))
    } else {
        text.to_owned()
    };
    let live = preprocessed(&bare(&joined, false), language, defines);
    let live = live.map_err(|fault| error(file, fault))?;
    refuse(own_name(&live.text))?;
    if language.has_preprocessor() {
        // The body of a macro is checked where the function needs it.
        refuse(directives::fault(&without_definitions(&live.text)))?;
    }
    Ok(live)
}

/// Refuses a slice from which no program can be made.
///
/// # Errors
/// A macro that hides a loop or a name.
pub fn check_needed(file: &str, slice: &str, language: Language) -> Result<(), Error> {
    if !language.has_preprocessor() {
        return Ok(());
    }
    if is_in_macro(slice) {
        let what = "a macro holds a loop or one bracket of a pair, or joins words with ##: write it out, so that its turns can be counted";
        return Err(error(file, (first_definition(slice), 1, what.to_owned())));
    }
    directives::fault(slice).map_or(Ok(()), |fault| Err(error(file, fault)))
}

/// Refuses a text in which the name of the audited function means something else to compilers.
///
/// # Errors
/// A macro has that name.
pub fn check_name(file: &str, text: &str, language: Language, name: &str) -> Result<(), Error> {
    let found = language
        .has_preprocessor()
        .then(|| directives::redefinition(text, name))
        .flatten();
    found.map_or(Ok(()), |fault| Err(error(file, fault)))
}

fn error(file: &str, (line, column, what): TextFault) -> Error {
    Error::Text {
        file: file.to_owned(),
        line,
        column,
        what,
    }
}

fn first_definition(text: &str) -> usize {
    let at = text.lines().position(|line| line.contains('#'));
    at.map_or(1, |at| at + 1)
}

fn without_definitions(text: &str) -> String {
    let line = |line: &str| match definition(&tokens(line)) {
        Some(_) => String::new(),
        None => line.to_owned(),
    };
    let lines: Vec<String> = text.lines().map(line).collect();
    lines.join("\n")
}

/// Whether a character ends a line in WGSL only.
fn is_line_end(c: char) -> bool {
    ['\u{2028}', '\u{2029}'].contains(&c)
}

fn no_text(text: &str) -> Option<TextFault> {
    let what = "this is not text, or ends a line in some languages only";
    text.lines().enumerate().find_map(|(number, line)| {
        let mut signs = line.chars();
        let at = signs.position(|c| c.is_control() && c != '\t' || is_line_end(c))?;
        Some((number + 1, at + 1, what.to_owned()))
    })
}

fn own_name(text: &str) -> Option<TextFault> {
    let ours = ["fg_", "FgParameters", "FgArguments"];
    let found = tokens(text)
        .into_iter()
        .find(|token| ours.iter().any(|name| token.text.starts_with(name)))?;
    let what = format!(
        "the name `{}` is one of the program around it; names that begin with `fg_` are not free",
        found.text
    );
    Some((found.line, found.column, what))
}

/// The line at which comments could be read in two ways, and why. What is a comment to us must be one to compilers.
fn ambiguous(text: &str) -> Option<TextFault> {
    let code = bare(text, false);
    let lines = text.lines().zip(code.lines()).enumerate();
    let mut found = lines.filter_map(|(number, (line, code))| {
        // An include is refused elsewhere: `#include "res://a"`.
        let words = code.trim().trim_start_matches('#').trim_start();
        let is_include = code.trim_start().starts_with('#') && words.starts_with("include");
        let has_comment = !is_include && (line.contains("/*") || line.contains("//"));
        let is_open = line.trim_end().ends_with('\\') && line.ends_with(char::is_whitespace);
        let what = if is_open || line.contains("??/") {
            "the line may go on behind its end: write it in one, or let it end in the backslash"
        } else if has_comment && code.contains(['"', '\'']) {
            "a comment stands beside a string: take them apart"
        } else {
            return None;
        };
        Some((number + 1, 1, what.to_owned()))
    });
    found.next().or_else(|| nested(text))
}

/// The line at which a comment begins inside another. In some languages the first `*/` ends both.
fn nested(text: &str) -> Option<TextFault> {
    let (mut rest, mut line) = (text, 1);
    while let Some(start) = rest.find("/*") {
        let begins = rest[..start].rfind('\n').map_or(0, |end| end + 1);
        let (before, after) = rest.split_at(start);
        line += before.matches('\n').count();
        if before[begins..].contains("//") {
            // It stands in a line comment.
            rest = after.split_once('\n').map_or("", |(_, rest)| rest);
            line += usize::from(!rest.is_empty());
            continue;
        }
        let inner = &after[2..];
        let end = inner.find("*/").unwrap_or(inner.len());
        if inner[..end].contains("/*") {
            let what = "a comment begins in a comment: let the first end before";
            return Some((line, 1, what.to_owned()));
        }
        line += inner[..end].matches('\n').count();
        rest = inner.get(end + 2..).unwrap_or("");
    }
    None
}
