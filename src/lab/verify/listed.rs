//! The manifest's entry of a file compared with what is true today (functions, signatures, errors, costs), and the difference
//! between a file and the one that would be written today, in words.

use std::fmt::Display;

use serde_json::{Value, json};

use crate::generator::emit::{Artifact, Detail};
use crate::generator::output::manifest::{self, Entry, Manifest};
use crate::generator::output::ownership::is_listed;

/// The manifest's entry of a file.
pub(super) struct Listed<'a> {
    entry: &'a Entry,
    text: &'a str,
    /// How often the manifest lists the file.
    times: usize,
}

impl<'a> Listed<'a> {
    /// The entry of a file, where there is one.
    pub fn new(manifest: &'a Manifest, text: &'a str, path: &str) -> Option<Listed<'a>> {
        let mut entries = manifest.files.iter().filter(|entry| entry.file == path);
        Some(Listed {
            entry: entries.next()?,
            text,
            times: 1 + entries.count(),
        })
    }

    /// Whether it lists a function.
    pub fn has(&self, name: &str) -> bool {
        self.entry.function_names().any(|listed| listed == name)
    }

    /// The entries that differ from those that a run would write today.
    pub fn findings(&self, artifact: &Artifact) -> Vec<String> {
        let mut found = Vec::new();
        if self.times > 1 {
            found.push(format!(
                "{}: it lists {} {} times; a run that writes the file lists it once",
                manifest::FILE,
                self.entry.file,
                self.times
            ));
        }
        for (claim, said, right) in [
            ("method", &self.entry.method, &artifact.method),
            ("material", &self.entry.material, &artifact.material),
        ] {
            if said != right {
                let [said, right] = [said, right].map(|name| name.as_deref().unwrap_or("null"));
                found.push(self.false_claim(claim, said, right));
            }
        }
        let today = artifact.detail.functions();
        for function in self.entry.functions() {
            let name = function["name"].as_str().unwrap_or_default();
            match today.iter().find(|other| other.name == name) {
                None => found.push(self.finding(
                    name,
                    "name",
                    "lists it, and fresnel-gen does not write it",
                )),
                Some(right) => found.extend(self.claims(name, function, &json!(right))),
            }
        }
        if let Detail::Functions(today) = &artifact.detail {
            found.extend(self.of_material("seen", &json!(today.seen)));
            found.extend(self.of_material("data", &json!(today.data)));
        }
        found
    }

    /// A wrong entry of the material's viewing conditions or source.
    fn of_material(&self, claim: &str, right: &Value) -> Option<String> {
        let said = self.entry.detail.get(claim).filter(|said| *said != right)?;
        Some(self.false_claim(claim, said, right))
    }

    fn false_claim(&self, claim: &str, said: impl Display, right: impl Display) -> String {
        let mark = format!("\"{claim}\":");
        let what = format!("says `{claim}` is {said}, and right is {right}");
        self.of_file(&[&mark], &what)
    }

    /// A finding about the file, at the line of the last of these marks.
    fn of_file(&self, marks: &[&str], what: &str) -> String {
        let (line, file) = (self.line(marks), &self.entry.file);
        format!("{}:{line}: of {file} it {what}", manifest::FILE)
    }

    /// The functions of the file that the entry does not list.
    pub fn unlisted(&self, in_file: &[&str]) -> Vec<String> {
        let missing = in_file.iter().filter(|name| !self.has(name));
        missing
            .map(|name| self.of_file(&[], &format!("does not list {name}")))
            .collect()
    }

    fn claims(&self, name: &str, function: &Value, right: &Value) -> Vec<String> {
        let claims = function.as_object().into_iter().flatten();
        let is_false = |(claim, said): &(&String, &Value)| right.get(claim.as_str()) != Some(said);
        let words = |(claim, said): (&String, &Value)| {
            let what = format!(
                "says `{claim}` is {said}, and right is {}",
                right[claim.as_str()]
            );
            self.finding(name, claim, &what)
        };
        claims.filter(is_false).map(words).collect()
    }

    /// A wrong hash, for a file whose bytes are those that a run would write today.
    pub fn hash_finding(&self, bytes: &[u8]) -> Option<String> {
        let what = "says a `sha256` that is not the file's";
        (!is_listed(self.entry, bytes)).then(|| self.of_file(&["\"sha256\":"], what))
    }

    fn finding(&self, name: &str, claim: &str, what: &str) -> String {
        let line = self.line(&[&format!("\"name\": \"{name}\""), &format!("\"{claim}\":")]);
        format!(
            "{}:{line}: of {name} in {} it {what}",
            manifest::FILE,
            self.entry.file
        )
    }

    /// The line of a claim in the manifest: that of the last of these marks, each searched for after the one before.
    fn line(&self, marks: &[&str]) -> usize {
        let file = format!("\"file\": \"{}\"", self.entry.file);
        let mut lines = self.text.lines().enumerate().peekable();
        let mut at = 1;
        for mark in [file.as_str()].iter().chain(marks) {
            while let Some((i, line)) = lines.peek() {
                if line.contains(mark) {
                    at = i + 1;
                    break;
                }
                lines.next();
            }
        }
        at
    }
}

/// Bytes in a word of a module. Its second and third words give the version of SPIR-V and the program that wrote it.
const WORD: usize = 4;
const HEAD: std::ops::Range<usize> = WORD..3 * WORD;

/// How a module differs.
pub fn of_modules(found: &[u8], today: &[u8]) -> &'static str {
    if found.get(HEAD) == today.get(HEAD) {
        "its instructions differ"
    } else {
        "its head differs: the version of SPIR-V, or the program that wrote it"
    }
}

/// How a text differs.
pub fn of_texts(found: &str, today: &str) -> String {
    let (comments, code) = (
        first_difference(found, today, true),
        first_difference(found, today, false),
    );
    match (code, comments) {
        (Some(place), _) => format!("its code differs, first {place}"),
        (None, Some(place)) => {
            format!("its comments differ, first {place}, and its code does not")
        }
        (None, None) => "its blanks and empty lines differ".to_owned(),
    }
}

/// The first line that differs from the other text, among its comments or in its code. Lines count from 1.
fn first_difference(found: &str, today: &str, of_comments: bool) -> Option<String> {
    let lines = |text: &'_ str| -> Vec<(usize, String)> {
        let all = text
            .lines()
            .enumerate()
            .map(|(at, line)| (at + 1, line.trim()));
        let is_comment = |line: &str| line.starts_with("//") || line.starts_with("/*");
        let own = all.filter(|(_, line)| !line.is_empty() && is_comment(line) == of_comments);
        own.map(|(at, line)| (at, line.to_owned())).collect()
    };
    let (found_lines, today_lines) = (lines(found), lines(today));
    let pairs = found_lines.iter().zip(&today_lines);
    let same = pairs.take_while(|((_, a), (_, b))| a == b).count();
    match (found_lines.get(same), today_lines.get(same)) {
        (Some((line, _)), _) => Some(format!("in line {line}")),
        (None, Some((line, _))) => Some(format!("by today's line {line}, which it lacks")),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{of_modules, of_texts};

    #[test]
    fn the_first_line_is_named() {
        let today = "// head\n// error .1\n\nfn f() {\n    a\n}\n";
        for (found, says) in [
            (
                "// head\n// error .2\n\nfn f() {\n    a\n}\n",
                "its comments differ, first in line 2, and its code does not",
            ),
            (
                "// head\n\nfn f() {\n    a\n}\n",
                "its comments differ, first by today's line 2, which it lacks, and its code does not",
            ),
            (
                "// other\nfn f() {\n    b\n}\n",
                "its code differs, first in line 3",
            ),
            (
                "// head\n// error .1\nfn f() {\n",
                "its code differs, first by today's line 5, which it lacks",
            ),
            (
                "// head\n// error .1\nfn f() {\n  a\n}\n",
                "its blanks and empty lines differ",
            ),
        ] {
            assert_eq!(of_texts(found, today), says, "{found}");
        }
    }

    #[test]
    fn a_module_has_a_head() {
        let module =
            |version: u8, last: u8| [3, 2, 35, 7, 0, version, 1, 0, 28, 0, 0, 0, last, 0, 0, 0];
        assert!(of_modules(&module(3, 1), &module(4, 1)).starts_with("its head"));
        assert!(of_modules(&module(3, 2), &module(3, 1)).starts_with("its instructions"));
        assert!(of_modules(&[], &module(3, 1)).starts_with("its head"));
    }
}
