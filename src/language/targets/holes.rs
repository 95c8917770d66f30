//! Texts with holes: `{name}` stands for what a program puts there.

/// A text with its holes filled. Each value comes with the name of its hole, and need not be used. What is filled in may hold
/// braces: it is not searched for holes.
///
/// # Panics
/// In tests, where the text has a hole without a value. Outside of tests such a hole stays, and a compiler refuses the text.
pub fn filled(text: &str, values: &[(&str, &str)]) -> String {
    let mut whole = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        whole += before;
        let is_hole = |(name, _): &(&str, &str)| name.bytes().all(|byte| byte.is_ascii_lowercase());
        let hole = after.split_once('}').filter(is_hole);
        let value = hole.and_then(|(name, _)| values.iter().find(|(known, _)| *known == name));
        match (hole, value) {
            (Some((_, behind)), Some((_, value))) => {
                whole += value;
                rest = behind;
            }
            _ => {
                debug_assert!(
                    hole.is_none_or(|(name, _)| name.is_empty()),
                    "a hole is left in {text}"
                );
                whole.push('{');
                rest = after;
            }
        }
    }
    whole + rest
}

#[cfg(test)]
mod tests {
    use super::filled;

    #[test]
    fn holes_are_filled_once() {
        let values = [("name", "{type}"), ("type", "f32"), ("unused", "")];
        assert_eq!(filled("{name}: {type};", &values), "{type}: f32;");
        assert_eq!(filled("fn f() { g(); } {}", &values), "fn f() { g(); } {}");
    }

    #[test]
    #[should_panic(expected = "a hole is left")]
    fn a_hole_without_a_value_is_a_fault() {
        filled("{other}", &[]);
    }
}
