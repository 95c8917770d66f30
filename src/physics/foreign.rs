//! Untrusted text in messages: names and texts of files, paths, words of a command line, messages of compilers.
//!
//! Each such value is put into a message by one of these functions.
//! - It becomes one line: control characters, line breaks and marks of text direction are escaped.
//! - It is no command: build servers obey a line that begins with `::` (GitHub), or that holds `##[`, `##vso[` or `##teamcity[`.
//! - It is shortened to what a person reads.
//! - Escaping it again changes nothing, so that messages may hold messages.

use core::fmt::{self, Display};
use std::path::Path;

/// The number of characters of a long value that are shown: its first and its last.
const VALUE: [usize; 2] = [400, 100];
/// The same of a line that holds values. No list of ours is longer.
const LINE: [usize; 2] = [5000, 1000];
/// The number of lines of a compiler that are shown, and of characters of each.
const LINES: usize = 200;
const WIDTH: usize = 2000;
/// The prefix of each line of a compiler.
const MARGIN: &str = "  | ";

/// Whether a character is invisible and obeyed by a terminal: C0 and C1 controls (line breaks and tabs included), Unicode line
/// breaks, and marks of text direction.
pub fn is_hidden(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns || matches!(c, '\u{2028}' | '\u{2029}')
}

/// JSON or TOML text with these characters escaped in its strings. Line breaks and tabs stay: a writer of either format has
/// escaped those in strings itself.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        if is_hidden(c) && !['\n', '\t'].contains(&c) {
            safe += &format!("\\u{:04x}", u32::from(c));
        } else {
            safe.push(c);
        }
    }
    safe
}

/// An untrusted value in a message: displayed as one line, shortened.
#[derive(Clone, Copy, Debug)]
pub struct Foreign<T>(pub T);

impl<T: Display> Display for Foreign<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&clipped(&one_line(&self.0.to_string()), VALUE))
    }
}

/// A path in a message.
pub fn path<P: AsRef<Path> + ?Sized>(path: &P) -> Foreign<String> {
    Foreign(path.as_ref().to_string_lossy().into_owned())
}

/// A message that holds untrusted values, as one line. Each word is shortened like a value.
pub fn one_line(text: &str) -> String {
    clipped(&words_clipped(&unbroken(text)), LINE)
}

/// A line of a file, as one line. Words are not shortened, since compared lines may differ anywhere in a long word.
pub fn line_of_file(text: &str) -> String {
    clipped(&unbroken(text), LINE)
}

/// A text whose words (separated by white space) are each shortened like a value.
fn words_clipped(text: &str) -> String {
    text.split_inclusive(char::is_whitespace)
        .map(|word| clipped(word, VALUE))
        .collect()
}

/// A text with line breaks, control characters and commands escaped.
fn unbroken(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    // GitHub's runner trims white space before it looks for a command.
    let begins_command = text.trim_start().starts_with("::");
    let mut letters = text.chars().peekable();
    let mut before = ' ';
    let mut is_start = true;
    while let Some(c) = letters.next() {
        match c {
            '\n' => line += "\\n",
            '\r' => line += "\\r",
            '\t' => line += "\\t",
            c if is_hidden(c) => line += &format!("\\u{{{:x}}}", u32::from(c)),
            ':' if is_start && begins_command => line += "\\u{3a}",
            '#' if before == '#' && letters.peek().is_some_and(|c| opens(*c)) => line += "\\u{23}",
            c => line.push(c),
        }
        is_start &= c.is_whitespace();
        before = c;
    }
    line
}

/// Whether this may follow `##` in a command: a bracket, or the word before it.
fn opens(c: char) -> bool {
    c == '[' || c.is_ascii_alphabetic()
}

/// A message of several lines: the lines below the first stand behind a margin.
pub fn lines(text: &str) -> String {
    match text.trim_end().split_once('\n') {
        None => one_line(text.trim_end()),
        Some((first, rest)) => format!("{}\n{}", one_line(first.trim_end()), behind_margin(rest)),
    }
}

/// Each line escaped, behind a margin.
fn behind_margin(text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut rest = text.trim_end().lines();
    for line in rest.by_ref().take(LINES) {
        let line = one_line(&line.replace('\t', "    "));
        let shown = format!("{MARGIN}{}", beginning(&line, WIDTH));
        lines.push(shown.trim_end().to_owned());
    }
    let left = rest.count();
    if left > 0 {
        lines.push(format!("{MARGIN}… and {left} more lines"));
    }
    lines.join("\n")
}

fn beginning(text: &str, most: usize) -> &str {
    let end = text.char_indices().nth(most);
    end.map_or(text, |(end, _)| &text[..end])
}

fn clipped(text: &str, [first, last]: [usize; 2]) -> String {
    let count = text.chars().count();
    if count <= first + last {
        return text.to_owned();
    }
    let start = beginning(text, count - last).len();
    format!("{}…{}", beginning(text, first), &text[start..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_hidden_and_letters_are_not() {
        for c in "\u{1b}\u{7}\r\n\t\u{7f}\u{85}\u{9b}\u{9d}\u{61c}\u{200e}\u{202e}\u{2028}\u{2066}"
            .chars()
        {
            assert!(is_hidden(c), "{c:?}");
        }
        for c in "a \u{e9}\u{3bb}\u{b5}\u{a0}\u{4e2d}\u{fffd}\u{2014}".chars() {
            assert!(!is_hidden(c), "{c:?}");
        }
    }

    #[test]
    fn json_keeps_its_meaning() {
        let value = serde_json::json!({ "a": "x\u{1b}\u{7f}\u{9b}\u{202e}\n\"" });
        let text = escaped(&serde_json::to_string_pretty(&value).expect("it has text keys"));
        assert!(text.is_ascii(), "{text}");
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&text).ok(),
            Some(value)
        );
    }

    #[test]
    fn a_value_is_one_line_that_nothing_obeys() {
        for (text, shown) in [
            (
                "plain \u{3bb} a::b #1 ## two",
                "plain \u{3bb} a::b #1 ## two",
            ),
            ("a\nb\r\nc\td", "a\\nb\\r\\nc\\td"),
            ("\u{1b}[31mred", "\\u{1b}[31mred"),
            (
                "a\u{9b}\u{7f}\u{202e}\u{2028}",
                "a\\u{9b}\\u{7f}\\u{202e}\\u{2028}",
            ),
            ("::error::x", "\\u{3a}:error::x"),
            (" \u{a0}::error::x", " \u{a0}\\u{3a}:error::x"),
            (
                "a ##[error]b ##vso[x] ###[y]",
                "a #\\u{23}[error]b #\\u{23}vso[x] ##\\u{23}[y]",
            ),
        ] {
            assert_eq!(Foreign(text).to_string(), shown);
            assert_eq!(Foreign(shown).to_string(), shown, "it is shown twice alike");
        }
    }

    #[test]
    fn a_long_value_shows_its_ends() {
        let text = Foreign(format!("a{}z", "x".repeat(1 << 20))).to_string();
        assert_eq!(text.chars().count(), VALUE[0] + VALUE[1] + 1);
        assert!(text.starts_with("ax") && text.ends_with("xz"));
    }

    #[test]
    fn a_long_word_of_a_message_shows_its_ends() {
        let long = "x".repeat(1 << 20);
        let text = one_line(&format!("no value for `{long}`; bind it with {long}=1"));
        assert!(text.chars().count() < 1100, "{text}");
        assert!(text.starts_with("no value for `x") && text.ends_with("xx=1"));
        assert_eq!(one_line(&text), text);
        assert_eq!(line_of_file(&long).chars().count(), LINE[0] + LINE[1] + 1);
    }

    #[test]
    fn words_of_a_compiler_stand_behind_a_margin() {
        assert_eq!(
            behind_margin("a\n::error::b\r\n\u{1b}c\n"),
            "  | a\n  | \\u{3a}:error::b\n  | \\u{1b}c"
        );
        assert_eq!(lines("f: no\n::b\n"), "f: no\n  | \\u{3a}:b");
        assert!(behind_margin(&"x\n".repeat(500)).ends_with("  | … and 300 more lines"));
    }
}
