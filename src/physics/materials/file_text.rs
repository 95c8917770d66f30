//! A user's text: where a fault stands in it.

use crate::physics::names::{nearest_names, offered};

use super::file::FileFault;

/// A text and its file's name: made once, so that every check of what it says is short.
pub struct FileText<'a> {
    /// For messages.
    pub file: &'a str,
    /// What the file holds.
    pub text: &'a str,
}

impl FileText<'_> {
    /// A fault at an offset in bytes.
    pub fn fault(&self, offset: usize, what: String) -> FileFault {
        FileFault::at(self.file, self.text, offset, what)
    }

    /// What the parser of TOML says, with the nearest of the keys that it would take for an unknown one.
    pub fn toml_fault(&self, error: &toml::de::Error) -> FileFault {
        let mut what = error.message().trim().replace('\n', "; ");
        if what.starts_with("unknown field `") {
            let mut quoted = what.split('`').skip(1).step_by(2);
            let unknown = quoted.next().unwrap_or("");
            let known: Vec<&str> = quoted.collect();
            what += &offered(&nearest_names(unknown, &known));
        }
        let at = error.span().map_or(0, |span| span.start);
        // `"C:\\mine\\x.toml"`: the place is the backslash, or the letter behind it.
        let near = self.text.get(at.saturating_sub(1)..).unwrap_or("");
        let is_escape = what.contains("escape") && near.chars().take(2).any(|c| c == '\\');
        if is_escape {
            what += "; in a path write `/`, or put it in single quotes: '...'";
        }
        self.fault(at, what)
    }
}
