//! Remarks of hosts in HLSL, which no compiler of ours reads.

use crate::generator::emit::shader_words::{Token, tokens};

/// A text of HLSL without the remarks that hosts put behind variables: `float a < string label = "A"; > = 0.5;`. No expression holds a
/// semicolon between these signs.
pub fn without_annotations(code: &str) -> String {
    let found = tokens(code);
    let mut spans: Vec<((usize, usize), (usize, usize))> = Vec::new();
    for (at, open) in found.iter().enumerate() {
        let place = (open.line, open.column);
        let is_begun = at > 0 && (found[at - 1].is_word() || found[at - 1].text == "]");
        if open.text != "<" || !is_begun || spans.last().is_some_and(|(_, end)| place <= *end) {
            continue;
        }
        let inside = found[at..]
            .iter()
            .take_while(|token| !["{", "}"].contains(&token.text));
        let inside: Vec<&Token> = inside.collect();
        let close = inside
            .windows(2)
            .find(|pair| pair[0].text == ";" && pair[1].text == ">");
        spans.extend(close.map(|pair| (place, (pair[1].line, pair[1].column))));
    }
    let is_inside = |place: (usize, usize)| {
        spans
            .iter()
            .any(|(from, to)| (*from..=*to).contains(&place))
    };
    let line = |(number, line): (usize, &str)| {
        let signs = line.chars().enumerate();
        let kept = signs.map(|(at, c)| {
            if is_inside((number + 1, at + 1)) {
                ' '
            } else {
                c
            }
        });
        kept.collect::<String>() + "\n"
    };
    if spans.is_empty() {
        code.to_owned()
    } else {
        code.lines().enumerate().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remarks_behind_variables_are_no_code() {
        let text = "uniform float a <\n string label = \"A <1>\"; float maximum = 1; > = 0.5;\nfloat f(float c) { for (int i = 0; i < 3; i++) { if (c > 2) c = 1; } return c; }\n";
        let kept = without_annotations(text);
        assert_eq!(kept.lines().count(), 3);
        assert_eq!(
            kept.lines().next().map(str::trim_end),
            Some("uniform float a")
        );
        assert!(kept.contains("= 0.5;"));
        assert!(kept.contains("i < 3; i++") && !kept.contains("label"));
        assert_eq!(without_annotations("a < b;"), "a < b;");
    }
}
