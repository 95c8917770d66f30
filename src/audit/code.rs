//! Text as words with their places: comments are passed over, and lines of the preprocessor.

/// A word or a sign, with its place from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'a> {
    /// Itself.
    pub text: &'a str,
    /// Its line.
    pub line: usize,
    /// Its column, in characters.
    pub column: usize,
}

impl Token<'_> {
    /// Whether it is a name or a word of the language.
    pub fn is_word(&self) -> bool {
        let starts = |c: char| c.is_alphabetic() || c == '_';
        self.text.starts_with(starts)
    }
}

/// The text with spaces in place of comments, and of lines that begin with `#` where those are to be passed over.
pub fn bare(text: &str, skips_directives: bool) -> String {
    let mut out = String::with_capacity(text.len());
    let (mut rest, mut begins_line) = (text, true);
    while let Some(first) = rest.chars().next() {
        let hidden = hidden(rest, skips_directives && begins_line);
        if hidden > 0 {
            let (comment, after) = rest.split_at(hidden);
            out.extend(comment.chars().map(|c| if c == '\n' { c } else { ' ' }));
            rest = after;
            continue;
        }
        begins_line = first == '\n' || begins_line && first.is_whitespace();
        out.push(first);
        rest = &rest[first.len_utf8()..];
    }
    out
}

/// How many bytes of a comment or a directive begin here.
fn hidden(rest: &str, may_be_directive: bool) -> usize {
    if may_be_directive && rest.starts_with('#') {
        return directive(rest);
    }
    if rest.starts_with("//") {
        return rest.find('\n').unwrap_or(rest.len());
    }
    if rest.starts_with("/*") {
        return comment(rest);
    }
    0
}

/// A directive goes on behind a line that ends in `\`.
fn directive(rest: &str) -> usize {
    let mut end = 0;
    for line in rest.split_inclusive('\n') {
        let bare = line.trim_end_matches(['\n', '\r']);
        if !bare.ends_with('\\') {
            return end + bare.len();
        }
        end += line.len();
    }
    end
}

/// Comments of WGSL nest; those of others do not hold a second beginning in practice.
fn comment(rest: &str) -> usize {
    let (mut depth, mut at) = (0usize, 0);
    while at < rest.len() {
        let here = &rest.as_bytes()[at..];
        if here.starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if here.starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    rest.len()
}

/// The words and signs of a text.
pub fn tokens(bare: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    for (number, line) in bare.lines().enumerate() {
        let (mut rest, mut column) = (line, 1);
        while let Some(first) = rest.chars().next() {
            let is_part = |c: char| c.is_alphanumeric() || c == '_';
            let length = match is_part(first) {
                true => rest.find(|c| !is_part(c)).unwrap_or(rest.len()),
                false => first.len_utf8(),
            };
            let (text, after) = rest.split_at(length);
            if !first.is_whitespace() {
                found.push(Token {
                    text,
                    line: number + 1,
                    column,
                });
            }
            column += text.chars().count();
            rest = after;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_directives_keep_their_room() {
        let text = "a // b\n#define f \\\n g\n /* c\n /* é */ */d";
        assert_eq!(
            bare(text, true),
            "a     \n           \n  \n     \n           d"
        );
        assert!(bare(text, false).contains("#define f"));
        assert_eq!(bare("/* never ends", true).trim(), "");
    }

    #[test]
    fn words_know_their_places() {
        let found = tokens("é vec3<f32>\n  (x)");
        let shown: Vec<_> = found.iter().map(|t| (t.text, t.line, t.column)).collect();
        assert_eq!(shown[1], ("vec3", 1, 3));
        assert_eq!(shown[6], ("x", 2, 4));
        assert_eq!(shown.len(), 8);
    }
}
