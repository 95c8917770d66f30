//! Decodes the bytes of a user's file to text: the only place that knows byte order marks and other encodings. Faults in such a
//! text have their place ([`FileFault`]).
//!
//! A UTF-8 byte order mark (EF BB BF) before a text is not part of it. Source: The Unicode Standard 17.0, section 23.8.

use crate::physics::foreign::{Foreign, one_line};
use crate::physics::names::{nearest_names, offered};

const MARK: &[u8] = b"\xef\xbb\xbf";

/// Why bytes are not text, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextFault {
    /// The line number, from 1.
    pub line: usize,
    /// The column from 1, in bytes.
    pub column: usize,
    /// What they are, and what to do.
    pub what: &'static str,
}

/// The text that the bytes encode, without a byte order mark.
///
/// # Errors
/// They are not UTF-8.
pub fn user_text(bytes: Vec<u8>) -> Result<String, TextFault> {
    let text = String::from_utf8(without_mark(&bytes)?.to_vec());
    text.map(with_line_feeds).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        TextFault {
            line: good.iter().filter(|byte| **byte == b'\n').count() + 1,
            column: good.iter().rev().take_while(|byte| **byte != b'\n').count() + 1,
            what: "the file is not UTF-8 text; save it as UTF-8",
        }
    })
}

/// The text of a mesh. Its names and comments may be in any superset of ASCII: what is not UTF-8 is replaced.
///
/// # Errors
/// The bytes are UTF-16, or no text.
pub fn mesh_text(bytes: Vec<u8>) -> Result<String, TextFault> {
    let bytes = without_mark(&bytes)?;
    if bytes.contains(&0) {
        Err(TextFault::here("a NUL byte: the file is not UTF-8 text"))
    } else {
        Ok(with_line_feeds(String::from_utf8_lossy(bytes).into_owned()))
    }
}

/// The bytes of a text without a byte order mark, for parsers that check UTF-8 themselves.
///
/// # Errors
/// They are UTF-16.
pub fn without_mark(bytes: &[u8]) -> Result<&[u8], TextFault> {
    check_encoding(bytes)?;
    Ok(bytes.strip_prefix(MARK).unwrap_or(bytes))
}

/// The text with LF in place of CR, where lines end with CR alone, as Excel writes them for old Macs.
fn with_line_feeds(text: String) -> String {
    if text.contains('\n') {
        text
    } else {
        text.replace('\r', "\n")
    }
}

impl TextFault {
    fn here(what: &'static str) -> TextFault {
        TextFault {
            line: 1,
            column: 1,
            what,
        }
    }
}

fn check_encoding(bytes: &[u8]) -> Result<(), TextFault> {
    match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Err(TextFault::here(
            "the file is UTF-16, and not UTF-8 text; save it as UTF-8",
        )),
        _ => Ok(()),
    }
}

/// A fault in a file, as `file:line:column: what`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}:{line}:{column}: {}", Foreign(file), one_line(what))]
pub struct FileFault {
    /// The file, as the user named it.
    pub file: String,
    /// The line number, from 1.
    pub line: usize,
    /// The column from 1, in characters.
    pub column: usize,
    /// What was found, and what is allowed.
    pub what: String,
}

impl FileFault {
    /// A fault at a line and a column, both from 1.
    pub fn new(file: &str, line: usize, column: usize, what: String) -> FileFault {
        FileFault {
            file: file.to_owned(),
            line,
            column,
            what,
        }
    }

    /// A fault at a byte offset of a text, from which line and column are counted.
    pub fn at(file: &str, text: &str, offset: usize, what: String) -> FileFault {
        let before = text.get(..offset).unwrap_or("");
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
        FileFault::new(file, line, column, what)
    }
}

/// A text and its file's name, so that every check can report a fault with its place.
pub struct FileText<'a> {
    /// The file, for messages.
    pub file: &'a str,
    /// What the file holds.
    pub text: &'a str,
}

impl FileText<'_> {
    /// A fault at an offset in bytes.
    pub fn fault(&self, offset: usize, what: String) -> FileFault {
        FileFault::at(self.file, self.text, offset, what)
    }

    /// The TOML parser's error, with the nearest allowed key for an unknown one.
    pub fn toml_fault(&self, error: &toml::de::Error) -> FileFault {
        let mut what = error.message().trim().replace('\n', "; ");
        if what.starts_with("unknown field `") {
            let mut quoted = what.split('`').skip(1).step_by(2);
            let unknown = quoted.next().unwrap_or("");
            let known: Vec<&str> = quoted.collect();
            what += &offered(&nearest_names(unknown, &known));
        }
        let at = error.span().map_or(0, |span| span.start);
        // `"C:\\mine\\x.toml"`: the place is the backslash, or the letter after it.
        let near = self.text.get(at.saturating_sub(1)..).unwrap_or("");
        let is_escape = what.contains("escape") && near.chars().take(2).any(|c| c == '\\');
        if is_escape {
            what += "; in a path write `/`, or put it in single quotes: '...'";
        }
        self.fault(at, what)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(bytes: &[u8]) -> Result<String, TextFault> {
        user_text(bytes.to_vec())
    }

    #[test]
    fn a_mark_is_no_part_of_a_text() {
        assert_eq!(text(b"\xef\xbb\xbfv 1\n").as_deref(), Ok("v 1\n"));
        assert_eq!(text(b"\xef\xbb\xbf").as_deref(), Ok(""));
        // One mark is removed, not two: the second is a character.
        assert_eq!(
            text(b"\xef\xbb\xbf\xef\xbb\xbfx").as_deref(),
            Ok("\u{feff}x")
        );
        assert_eq!(without_mark(b"\xef\xbb\xbf{}"), Ok(&b"{}"[..]));
        assert_eq!(without_mark(b"{}"), Ok(&b"{}"[..]));
    }

    #[test]
    fn lines_of_old_macs_are_lines() {
        assert_eq!(text(b"nm,n\r400,1.5\r").as_deref(), Ok("nm,n\n400,1.5\n"));
        assert_eq!(
            text(b"nm,n\r\n400,1.5\r\n").as_deref(),
            Ok("nm,n\r\n400,1.5\r\n")
        );
    }

    #[test]
    fn another_encoding_is_named() {
        for bytes in [&b"\xff\xfev\0"[..], b"\xfe\xff\0v"] {
            let says = "UTF-16, and not UTF-8 text; save it as UTF-8";
            assert!(text(bytes).unwrap_err().what.contains(says));
            assert!(mesh_text(bytes.to_vec()).unwrap_err().what.contains(says));
            assert!(without_mark(bytes).unwrap_err().what.contains(says));
        }
        let fault = text(b"abc\n\xe9t").unwrap_err();
        assert_eq!((fault.line, fault.column), (2, 1));
        assert!(fault.what.contains("not UTF-8"));
    }

    #[test]
    fn a_mesh_may_have_comments_in_latin_1() {
        let mesh = |bytes: &[u8]| mesh_text(bytes.to_vec());
        assert_eq!(
            mesh(b"# \xe9t\xe9\nv 1 2 3\n").as_deref(),
            Ok("# \u{fffd}t\u{fffd}\nv 1 2 3\n")
        );
        assert_eq!(mesh(b"\xef\xbb\xbfv 1\n").as_deref(), Ok("v 1\n"));
        assert!(mesh(b"v 1\0\n").unwrap_err().what.contains("a NUL byte"));
    }
}
