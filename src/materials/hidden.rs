//! Characters that a reader does not see and a terminal obeys: controls of C0 and C1, line breaks of Unicode, controls of the
//! direction of text.

/// Whether a character is one of these; line breaks and tabs are.
pub fn is_hidden(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns || matches!(c, '\u{2028}' | '\u{2029}')
}

/// A text of JSON or TOML with these as escapes inside of its strings. Line breaks and tabs stay: a writer of either escapes
/// them itself where they stand in a string.
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
}
