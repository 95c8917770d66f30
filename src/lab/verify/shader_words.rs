//! Shader text as tokens with their positions. Comments and preprocessor lines are skipped.

/// A word or a symbol, with its position counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'a> {
    /// Its text.
    pub text: &'a str,
    /// Its line.
    pub line: usize,
    /// Its column, in characters.
    pub column: usize,
}

impl Token<'_> {
    /// Whether it is a name or a keyword of the language.
    pub fn is_word(&self) -> bool {
        let starts = |c: char| c.is_alphabetic() || c == '_';
        self.text.starts_with(starts)
    }

    /// The column after it.
    pub fn end(&self) -> usize {
        self.column + self.text.chars().count()
    }
}

/// What counts as no code.
#[derive(Clone, Copy, Debug)]
pub struct Hidden {
    /// Whether lines that begin with `#` are skipped.
    pub directives: bool,
    /// Whether comments nest.
    pub nests: bool,
}

/// The text with spaces in place of what is not code: comments, and directives if those are skipped.
pub fn code_alone(text: &str, hides: Hidden) -> String {
    let mut out = String::with_capacity(text.len());
    let (mut rest, mut begins_line) = (text, true);
    while let Some(first) = rest.chars().next() {
        let hidden = hidden(rest, begins_line, hides);
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

/// The length in bytes of the comment or directive that begins here; 0 if none does.
fn hidden(rest: &str, begins_line: bool, hides: Hidden) -> usize {
    if hides.directives && begins_line && rest.starts_with('#') {
        return directive(rest);
    }
    if rest.starts_with("//") {
        return rest.find('\n').unwrap_or(rest.len());
    }
    if rest.starts_with("/*") {
        return block_comment(rest, hides.nests);
    }
    0
}

/// The length of a directive. A line that ends in `\` continues it.
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

/// The length in bytes of the comment that begins here. One without an end takes the rest. `nests`: whether comments nest.
pub fn block_comment(rest: &str, nests: bool) -> usize {
    let (mut at, mut depth) = (2, 1);
    while depth > 0 {
        let Some(next) = rest[at..].find(['/', '*']).map(|next| at + next) else {
            return rest.len();
        };
        let opens = nests && rest[next..].starts_with("/*");
        let closes = rest[next..].starts_with("*/");
        depth = if opens {
            depth + 1
        } else {
            depth - usize::from(closes)
        };
        at = next + if opens || closes { 2 } else { 1 };
    }
    at
}

/// Whether a character may stand in a name.
pub fn is_name_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The words and symbols of a text.
pub fn tokens(bare: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    for (number, line) in bare.lines().enumerate() {
        let (mut rest, mut column) = (line, 1);
        while let Some(first) = rest.chars().next() {
            let length = if is_name_part(first) {
                rest.find(|c| !is_name_part(c)).unwrap_or(rest.len())
            } else {
                first.len_utf8()
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

/// The text of the token with this index. Empty where there is none.
pub fn text_at<'a>(tokens: &[Token<'a>], at: usize) -> &'a str {
    tokens.get(at).map_or("", |token| token.text)
}

/// Whether one of the tokens is this word.
pub fn holds(tokens: &[Token], word: &str) -> bool {
    tokens.iter().any(|token| token.text == word)
}

/// The index after the bracket that closes the one here.
pub fn behind(tokens: &[Token], open: usize) -> usize {
    let mut depth = 0usize;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    tokens.len()
}

/// Splits tokens at commas outside of brackets.
pub fn parts_between_commas<'t, 'a>(tokens: &'t [Token<'a>]) -> Vec<&'t [Token<'a>]> {
    let (mut parts, mut start, mut depth) = (Vec::new(), 0, 0i32);
    for (at, token) in tokens.iter().enumerate() {
        match token.text {
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" | ">" => depth -= 1,
            "," if depth == 0 => {
                parts.push(&tokens[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&tokens[start..]);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bare(text: &str, directives: bool) -> String {
        let nests = true;
        code_alone(text, Hidden { directives, nests })
    }

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
