//! Text as a terminal may have it: characters that move its cursor, change its title or turn its lines are shown as escapes. It is a
//! second fence: a message holds no such text of others, since [`foreign`](crate::physics::foreign) cleans what is put into it.

use crate::physics::materials::is_hidden;

/// The text with such characters as `\u{1b}`. Line breaks and tabs stay.
pub fn legible(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(c) = letters.next() {
        let ends_line = c == '\n' || c == '\r' && letters.peek() == Some(&'\n');
        if is_hidden(c) && !ends_line && c != '\t' {
            safe += &format!("\\u{{{:x}}}", u32::from(c));
        } else {
            safe.push(c);
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::legible;

    #[test]
    fn what_a_terminal_obeys_is_shown() {
        for (text, shown) in [
            (
                "plain \u{3bb}\ttext\r\nend\n",
                "plain \u{3bb}\ttext\r\nend\n",
            ),
            ("\u{1b}[31mred", "\\u{1b}[31mred"),
            ("\u{1b}]0;title\u{7}", "\\u{1b}]0;title\\u{7}"),
            ("a\u{9b}b\u{7f}c\rd", "a\\u{9b}b\\u{7f}c\\u{d}d"),
            (
                "a\u{202e}b\u{2066}c\u{2028}d",
                "a\\u{202e}b\\u{2066}c\\u{2028}d",
            ),
        ] {
            assert_eq!(legible(text), shown);
        }
    }
}
