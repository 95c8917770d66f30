//! The shape of a text: the text with a mark in the place of each number.

/// What stands in the place of a number.
const MARK: char = '#';

/// A text of any of our languages with [`MARK`] in the place of each number, its sign included. Digits in names stay.
pub(super) fn without_numbers(text: &str) -> String {
    let mut shape = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let name = length(rest, |c| c.is_ascii_alphanumeric() || c == '_');
        let taken = if is_number(rest) {
            if shape.ends_with('-') && !follows_operand(&shape) {
                shape.pop();
            }
            shape.push(MARK);
            number_length(rest)
        } else {
            let taken = name.max(first.len_utf8());
            shape.push_str(&rest[..taken]);
            taken
        };
        rest = &rest[taken..];
    }
    shape
}

/// How many bytes at the beginning are such characters.
fn length(text: &str, is_such: impl Fn(char) -> bool) -> usize {
    text.find(|c| !is_such(c)).unwrap_or(text.len())
}

fn is_number(text: &str) -> bool {
    let digits = text.strip_prefix('.').unwrap_or(text);
    digits.starts_with(|c: char| c.is_ascii_digit())
}

/// Digits, a point, an exponent with its sign, and letters that say the type.
fn number_length(text: &str) -> usize {
    let plain = length(text, |c| c.is_ascii_alphanumeric() || c == '.');
    let is_open = text[..plain].ends_with(['e', 'E']);
    let exponent = match text[plain..].strip_prefix(['+', '-']) {
        Some(digits) if is_open => 1 + length(digits, |c| c.is_ascii_alphanumeric()),
        _ => 0,
    };
    plain + exponent
}

/// Whether the sign at the end takes away from what stands before it.
fn follows_operand(shape: &str) -> bool {
    let before = shape[..shape.len() - 1].trim_end();
    let is_operand = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | ')' | ']' | MARK);
    before.ends_with(is_operand) && !before.ends_with("return")
}

#[cfg(test)]
mod tests {
    use super::without_numbers;

    #[track_caller]
    fn check(text: &str, shape: &str) {
        assert_eq!(without_numbers(text), shape);
    }

    #[test]
    fn numbers_are_marked_and_names_stay() {
        check("let m2 = c0 * 0.5;", "let m2 = c0 * #;");
        check("vec3<f32>(1.0, -0.25, 3e-7)", "vec3<f32>(#, #, #)");
        check("float3(1e12f, .5h, 2)", "float3(#, #, #)");
        check("return -1.5E+03;", "return #;");
        check("r0.x * r0.y", "r0.x * r0.y");
        check("exp2(-8.35 * c)", "exp2(# * c)");
    }

    #[test]
    fn a_difference_is_no_sign() {
        check("1.0 - m", "# - m");
        check("m - 1.0", "m - #");
        check("(a) - 2.0 - -3.0", "(a) - # - #");
        check("b[1]-4.0", "b[#]-#");
    }
}
