//! XML that is well-formed whatever text it holds: documents of MaterialX, text of SVG, comments in templates.
//!
//! Source: Extensible Markup Language (XML) 1.0, fifth edition, <https://www.w3.org/TR/xml/>: a document holds no control
//! characters except tabs and line breaks (2.2), a comment no two hyphens in a row and none at its end (2.5), an attribute no `<`
//! (3.1). In names of elements and attributes, characters that are not allowed become `_`.

use crate::physics::materials::is_hidden;

/// An XML document under construction, one element per line.
#[derive(Clone, Debug)]
pub struct XmlDocument {
    text: String,
    open: Vec<String>,
}

impl XmlDocument {
    /// A document whose first line holds this comment.
    pub fn new(comment: &str) -> XmlDocument {
        XmlDocument {
            text: format!(
                "<?xml version=\"1.0\"?> <!-- {} -->\n",
                xml_comment(comment)
            ),
            open: Vec::new(),
        }
    }

    /// A comment of several lines.
    pub fn comment(&mut self, lines: &[String]) {
        let lines = lines
            .iter()
            .map(|line| format!("  {}\n", xml_comment(line)));
        self.text += &format!("<!--\n{}-->\n", lines.collect::<String>());
    }

    /// Opens an element that holds others.
    pub fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.tag(name, attributes, ">");
        self.open.push(xml_name(name));
    }

    /// An element without content.
    pub fn empty(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.tag(name, attributes, " />");
    }

    /// Closes the element that was opened last.
    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.text += &format!("{}</{name}>\n", self.indent());
        }
    }

    /// The whole text, with all elements closed.
    pub fn finished(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    fn tag(&mut self, name: &str, attributes: &[(&str, &str)], end: &str) {
        let attribute =
            |(name, value): &(&str, &str)| format!(" {}=\"{}\"", xml_name(name), xml_text(value));
        let attributes: String = attributes.iter().map(attribute).collect();
        self.text += &format!("{}<{}{attributes}{end}\n", self.indent(), xml_name(name));
    }

    fn indent(&self) -> String {
        "  ".repeat(self.open.len())
    }
}

/// Text that is safe inside an element or a quoted attribute.
pub fn xml_text(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars().map(legal) {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&apos;"),
            other => safe.push(other),
        }
    }
    safe
}

/// Text that is safe inside a comment which goes on with a blank or a line break: no two hyphens in a row, and none at the end.
pub fn xml_comment(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars().map(legal) {
        if letter == '-' && safe.ends_with('-') {
            safe.push(' ');
        }
        safe.push(letter);
    }
    safe
}

/// XML 1.0 cannot carry control characters and U+FFFE, not even as references. Characters that change the direction of text can
/// deceive a reader.
fn legal(letter: char) -> char {
    match letter {
        '\u{FFFE}' | '\u{FFFF}' => '\u{FFFD}',
        other if is_hidden(other) => ' ',
        other => other,
    }
}

fn xml_name(name: &str) -> String {
    let is_kept = |c: char| c.is_ascii_alphanumeric() || "_.-".contains(c);
    let kept: String = name
        .chars()
        .map(|c| if is_kept(c) { c } else { '_' })
        .collect();
    if kept.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
        kept
    } else {
        format!("_{kept}")
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Texts that have broken out of XML, or could.
    const HOSTILE: [&str; 14] = [
        "--->",
        "---",
        "--",
        "-",
        "-->",
        "--!>",
        "]]>",
        "<![CDATA[",
        "\u{1b}[31m",
        "\0",
        "\u{fffe}",
        "\u{2028}",
        "&#0;",
        "\"'<>&",
    ];

    #[track_caller]
    fn is_well_formed(text: &str) {
        let mut document = XmlDocument::new(text);
        document.comment(&[text.to_owned(), format!("a{text}")]);
        document.open(text, &[(text, text)]);
        document.empty("b", &[("c", text)]);
        let written = document.finished();
        let read = roxmltree::Document::parse(&written);
        let read = read.unwrap_or_else(|fault| panic!("{fault} in {written}"));
        let value = read.root_element().first_element_child().unwrap();
        let want: String = text.chars().map(legal).collect();
        assert_eq!(value.attribute("c"), Some(want.as_str()), "{written}");
    }

    #[test]
    fn hostile_texts_stay_where_they_are_put() {
        for first in HOSTILE {
            is_well_formed(first);
            for second in HOSTILE {
                is_well_formed(&format!("{first}{second}"));
            }
        }
    }

    #[test]
    fn markup_and_forbidden_characters_are_escaped() {
        let cases = [
            ("plain ° text", "plain ° text"),
            ("a < b & c > d", "a &lt; b &amp; c &gt; d"),
            ("\"it's\"", "&quot;it&apos;s&quot;"),
            ("&amp;", "&amp;amp;"),
            ("a\r\nb\u{0}", "a  b "),
            ("\u{FFFF}", "\u{FFFD}"),
        ];
        for (text, expected) in cases {
            assert_eq!(xml_text(text), expected);
        }
    }

    #[test]
    fn comments_hold_no_two_hyphens() {
        assert_eq!(xml_comment("a ---> b--"), "a - - -> b- -");
        assert_eq!(xml_comment("Regenerate: x --as y"), "Regenerate: x - -as y");
    }

    proptest! {
        #[test]
        fn any_text_gives_a_document(text in "\\PC*|(-|>|<|!|&|;|\\]|.|\n)*") {
            is_well_formed(&text);
        }
    }
}
