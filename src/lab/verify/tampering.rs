//! A file in the folder compared with what would be written today: declarations that were added or are missing, narrower types, and
//! comments that state something else. Other differences are no findings: what the code does is found by running it.

use std::collections::{BTreeMap, BTreeSet};

use similar::{DiffTag, TextDiff};

use super::outline::{Item, Outline, function_name};

/// Beginnings of comments that state what a function promises or costs. One that would not be written today is a false promise.
const PROMISES: [&str; 12] = [
    "Model error",
    "Code error",
    "Average",
    "Cost:",
    "Truth:",
    "Domain:",
    "Index per channel",
    "Half precision:",
    "Table:",
    "Form:",
    "Written as:",
    "Licence",
];
/// The most findings of a kind that are reported.
const MOST: usize = 10;

/// The findings in a file, a sentence each, with its line. `path` is for the message. `is_wanted` says whether the file must hold a
/// function.
pub fn findings(
    path: &str,
    found: &Outline,
    today: &Outline,
    is_wanted: &dyn Fn(&str) -> bool,
) -> Vec<String> {
    let place = |item: &Item| match item.line {
        0 => path.to_owned(),
        line => format!("{path}:{line}"),
    };
    let mut all = Vec::new();
    for item in missing_from(&today.declared, &found.declared).take(MOST) {
        all.push(format!(
            "{}: it declares `{}`, which fresnel-gen does not write",
            place(item),
            shown(&item.words)
        ));
    }
    for item in missing_from(&today.narrow, &found.narrow).take(MOST) {
        all.push(format!(
            "{}: it says `{}`, which makes numbers narrower than fresnel-gen does",
            place(item),
            item.words
        ));
    }
    let wanted = |item: &&Item| function_name(&item.words).is_none_or(is_wanted);
    let absent = missing_from(&found.declared, &today.declared).filter(wanted);
    all.extend(
        absent
            .take(MOST)
            .map(|item| format!("{path}: it lacks `{}`", shown(&item.words))),
    );
    let statements = false_statements(&found.comments, &today.comments);
    for (item, right) in statements.into_iter().take(MOST) {
        let (place, said) = (place(item), shown(&item.words));
        all.push(match right {
            Some(right) => format!("{place}: it says `{said}`, and right is `{right}`"),
            None => format!("{place}: it says `{said}`, which fresnel-gen does not say of it"),
        });
    }
    all
}

/// The items of `all` that `known` lacks, by their words. An item that occurs twice must occur twice in both.
fn missing_from<'a>(known: &'a [Item], all: &'a [Item]) -> impl Iterator<Item = &'a Item> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for item in known {
        *counts.entry(&item.words).or_default() += 1;
    }
    all.iter()
        .filter(move |item| match counts.get_mut(item.words.as_str()) {
            Some(count) if *count > 0 => {
                *count -= 1;
                false
            }
            _ => true,
        })
}

/// Comments that would not be written today and state something: anything with a digit, a promise, or another text after the
/// label of a line (`Licence`, `Data`, a function's name). Each comes with the nearest right words, where there are any. The
/// command of a file is left out: it names the flags and files of whoever ran it.
fn false_statements<'a>(found: &'a [Item], today: &'a [Item]) -> Vec<(&'a Item, Option<&'a str>)> {
    let (found, today) = (without_command(found), without_command(today));
    let words = |items: &[&'a Item]| items.iter().map(|item| item.words.as_str()).collect();
    let (old, new): (Vec<&str>, Vec<&str>) = (words(&today), words(&found));
    let mut changes: Vec<(Vec<&str>, Vec<&Item>)> = Vec::new();
    for change in TextDiff::from_slices(&old, &new).ops() {
        if change.tag() != DiffTag::Equal {
            let (gone, added) = (&old[change.old_range()], &found[change.new_range()]);
            changes.push((gone.to_vec(), added.to_vec()));
        }
    }
    let mut moved: Vec<&str> = changes.iter().flat_map(|(gone, _)| gone.clone()).collect();
    let labels: BTreeSet<&str> = old.iter().filter_map(|words| label(words)).collect();
    let mut wrong = Vec::new();
    for (gone, added) in &mut changes {
        for item in added.iter() {
            let words = item.words.as_str();
            if let Some(at) = moved.iter().position(|other| *other == words) {
                // A line that has only moved is unchanged.
                moved.remove(at);
                continue;
            }
            let (mask, own) = (
                masked(words),
                label(words).filter(|label| labels.contains(label)),
            );
            let right = gone.iter().position(|other| masked(other) == mask);
            let is_labelled = |other: &&str| own.is_some() && label(other) == own;
            let right = right.or_else(|| gone.iter().position(is_labelled));
            let has_digit = words.bytes().any(|byte| byte.is_ascii_digit());
            if right.is_some() || has_digit || own.is_some() || is_promise(words) {
                wrong.push((*item, right.map(|at| gone.remove(at))));
            }
        }
    }
    wrong
}

/// The comments without the command that regenerates the file, which ends at an empty line.
fn without_command(comments: &[Item]) -> Vec<&Item> {
    let mut is_command = false;
    let mut is_other = |item: &&Item| {
        is_command = item.words.starts_with("Regenerate: ") || is_command && !item.words.is_empty();
        !is_command
    };
    comments.iter().filter(|item| is_other(item)).collect()
}

/// What a line of a comment is about: the words before its first colon.
fn label(words: &str) -> Option<&str> {
    words.split_once(": ").map(|(label, _)| label)
}

fn is_promise(words: &str) -> bool {
    PROMISES.iter().any(|promise| words.starts_with(promise)) || words.contains("scalar operations")
}

/// The words with `#` in place of each number. Digits of names (`f0`) stay.
fn masked(words: &str) -> String {
    let mut out = String::new();
    let (mut before, mut rest) = (' ', words);
    while let Some(c) = rest.chars().next() {
        let is_number = c.is_ascii_digit() && !(before.is_alphanumeric() || before == '_');
        let taken = if is_number {
            number(rest)
        } else {
            c.len_utf8()
        };
        if is_number {
            out.push('#');
        } else {
            out.push(c);
        }
        before = rest[..taken].chars().next_back().unwrap_or(' ');
        rest = &rest[taken..];
    }
    out
}

/// The length in bytes of the number that begins here: digits, a point before a digit, an exponent.
fn number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut at = 1;
    loop {
        let follows = match bytes.get(at) {
            Some(b'.') if digit(at + 1) => 1,
            Some(b'e') if digit(at + 1) => 1,
            Some(b'e') if matches!(bytes.get(at + 1), Some(b'-' | b'+')) && digit(at + 2) => 2,
            Some(byte) if byte.is_ascii_digit() => 1,
            _ => return at,
        };
        at += follows;
    }
}

/// The first words of a long declaration.
fn shown(words: &str) -> String {
    const MOST: usize = 160;
    let mut shown: String = words.chars().take(MOST).collect();
    if shown.len() < words.len() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::verify::outline::outline;

    const TODAY: &str = "// F0 at 8 degrees\n// Model error: at most 0.01 (at 8.5 degrees).\nfloat f(float c0) {\n}\n// Model error: at most 0.02 (at 9 degrees).\nfloat g(float c0) {\n}\n";

    #[track_caller]
    fn check(from: &str, to: &str, expected: &[&str]) {
        let found = outline(&TODAY.replacen(from, to, 1), false);
        let findings = findings("a.glsl", &found, &outline(TODAY, false), &|_| true);
        assert_eq!(findings.len(), expected.len(), "{findings:?}");
        for (finding, words) in findings.iter().zip(expected) {
            assert!(finding.contains(words), "{finding}");
        }
    }

    #[test]
    fn numbers_and_promises_are_held() {
        check("", "", &[]);
        check("F0 at 8 degrees", "of a metal", &[]);
        check("at 8 degrees", "at 80 degrees", &["F0 at 80 degrees"]);
        check("F0 at", "at most 1e-9, F0 at", &["a.glsl:1: it says"]);
        check(
            "Model error: at most 0.01 (at 8.5 degrees).",
            "Model error: as small as can be",
            &["and right is `Model error: at most 0.01"],
        );
        check(
            "0.01",
            "0.1",
            &["a.glsl:2: it says `Model error: at most 0.1 (at 8.5 degrees).`, and right is"],
        );
        check(
            "at most 0.02 (at 9 degrees)",
            "none",
            &["a.glsl:5: it says `Model error: none.`, and right is"],
        );
        check("0.01 (at 8.5", "0.02 (at 9.5", &["a.glsl:2"]);
    }

    #[test]
    fn narrow_numbers_are_held() {
        let heads = ["mediump float f", "it says `mediump`", "it lacks"];
        check("float f(", "mediump float f(", &heads);
        check(
            "(float c0) {",
            "(float c0) { lowp float x;",
            &["a.glsl:3: it says `lowp`"],
        );
    }

    #[test]
    fn what_moved_is_as_it_was_and_commands_are_nobodys_claim() {
        let g = TODAY
            .find("// Model error: at most 0.02")
            .expect("it is there");
        let first = TODAY.find("// Model error").expect("it is there");
        let moved = [&TODAY[..first], &TODAY[g..], &TODAY[first..g]].concat();
        let commanded = "// Regenerate: fresnel-gen --matching-angle 80\n//\n".to_owned() + TODAY;
        for text in [moved, commanded] {
            let found = outline(&text, false);
            let findings = findings("a.glsl", &found, &outline(TODAY, false), &|_| true);
            assert!(findings.is_empty(), "{findings:?}");
        }
    }

    #[test]
    fn declarations_are_held() {
        check(
            "float g",
            "float h",
            &["a.glsl:6: it declares `float h", "it lacks `float g"],
        );
        check(
            "\n",
            "\nuniform float x;\n",
            &["a.glsl:2: it declares `uniform float x ;`"],
        );
        check(
            "float f(float c0) {\n}",
            "",
            &["it lacks `float f ( float c0 ) {`"],
        );
    }

    #[test]
    fn a_number_is_masked_and_a_name_is_not() {
        assert_eq!(
            masked("f0 at 1.5e-7, 2^-22 of c1_2."),
            "f0 at #, #^-# of c1_2."
        );
    }
}
