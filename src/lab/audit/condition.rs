//! The integer expressions after `#if` and `#elif`, with macros in them.

use std::collections::BTreeMap;

use super::directives::{Definition, definition};
use crate::lab::verify::shader_words::{Token, tokens};

/// A macro: its arguments and its body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Macro {
    /// The names of its arguments. None for a macro without an argument list.
    pub params: Option<Vec<String>>,
    /// Its words.
    pub body: Vec<String>,
}

/// Macros by their names.
pub type Macros = BTreeMap<String, Macro>;

/// Operators of two characters.
const PAIRS: [&str; 8] = ["&&", "||", "==", "!=", "<=", ">=", "<<", ">>"];
/// Binary operators, the lowest precedence first.
const LEVELS: [&[&str]; 10] = [
    &["||"],
    &["&&"],
    &["|"],
    &["^"],
    &["&"],
    &["==", "!="],
    &["<", ">", "<=", ">="],
    &["<<", ">>"],
    &["+", "-"],
    &["*", "/", "%"],
];
/// The deepest nesting of macros and brackets.
const DEPTH: usize = 64;
/// The most words that macros may expand to.
const MOST_WORDS: usize = 4096;

/// The words of a line, with each operator of two characters as one word.
pub fn words(line: &[Token]) -> Vec<String> {
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(token) = line.get(at) {
        let pair = line.get(at + 1);
        let pair = pair.filter(|next| next.line == token.line && next.column == token.end());
        let pair = pair.map(|next| format!("{}{}", token.text, next.text));
        let pair = pair.filter(|pair| PAIRS.contains(&pair.as_str()));
        at += 1 + usize::from(pair.is_some());
        found.push(pair.unwrap_or_else(|| token.text.to_owned()));
    }
    found
}

/// The macro that a line defines, with its name.
pub fn defined_macro(line: &[Token]) -> Option<(String, Macro)> {
    let Definition { name, params, body } = definition(line)?;
    let owned = |names: Vec<&str>| names.into_iter().map(str::to_owned).collect();
    let own = Macro {
        params: params.map(owned),
        body: words(body),
    };
    Some((name.to_owned(), own))
}

/// The macro that stands for this text.
pub fn plain_macro(text: &str) -> Macro {
    Macro {
        params: None,
        body: words(&tokens(text)),
    }
}

/// The value of an expression.
///
/// # Errors
/// It is not a valid expression; the error says why.
pub fn condition_value(words: &[String], macros: &Macros) -> Result<i64, String> {
    let expanded = expanded(words, macros, &mut Vec::new())?;
    let mut expression = Expression {
        words: &expanded,
        at: 0,
    };
    let value = expression.choice(0)?;
    match expression.peek() {
        None => Ok(value),
        Some(word) => Err(format!("`{word}` is not expected there")),
    }
}

/// Words with macros replaced and `defined` answered.
fn expanded(
    words: &[String],
    macros: &Macros,
    within: &mut Vec<String>,
) -> Result<Vec<String>, String> {
    let (mut all, mut at) = (Vec::new(), 0);
    while let Some(word) = words.get(at) {
        at += 1;
        if word == "defined" {
            let has_bracket = words.get(at).is_some_and(|next| next == "(");
            let name = words.get(at + usize::from(has_bracket));
            let name = name.ok_or("`defined` asks for no name")?;
            all.push(u8::from(macros.contains_key(name)).to_string());
            at += if has_bracket { 3 } else { 1 };
            continue;
        }
        let known = macros.get(word).filter(|_| !within.contains(word));
        let Some(known) = known else {
            all.push(word.clone());
            continue;
        };
        let body = match &known.params {
            None => known.body.clone(),
            Some(params) => {
                let (arguments, end) = arguments(words, at)
                    .ok_or_else(|| format!("the macro `{word}` takes arguments"))?;
                at = end;
                substituted(&known.body, params, &arguments)
            }
        };
        if within.len() > DEPTH || all.len() + body.len() > MOST_WORDS {
            return Err("its macros are too many".to_owned());
        }
        within.push(word.clone());
        all.extend(expanded(&body, macros, within)?);
        within.pop();
    }
    if all.len() > MOST_WORDS {
        return Err("its macros are too many".to_owned());
    }
    Ok(all)
}

/// The arguments in the bracket that opens here, and the index after it.
fn arguments(words: &[String], open: usize) -> Option<(Vec<Vec<String>>, usize)> {
    words.get(open).filter(|word| *word == "(")?;
    let (mut all, mut depth) = (vec![Vec::new()], 0usize);
    for (at, word) in words.iter().enumerate().skip(open) {
        match word.as_str() {
            "(" => depth += 1,
            ")" => depth -= 1,
            _ => {}
        }
        match (word.as_str(), depth) {
            (")", 0) => return Some((all, at + 1)),
            ("(", 1) => {}
            (",", 1) => all.push(Vec::new()),
            _ => all.last_mut()?.push(word.clone()),
        }
    }
    None
}

fn substituted(body: &[String], params: &[String], arguments: &[Vec<String>]) -> Vec<String> {
    let mut all = Vec::new();
    for word in body {
        let place = params.iter().position(|param| param == word);
        match place.and_then(|place| arguments.get(place)) {
            Some(argument) => all.extend(argument.iter().cloned()),
            None => all.push(word.clone()),
        }
    }
    all
}

/// A parser of words from left to right.
struct Expression<'a> {
    words: &'a [String],
    at: usize,
}

impl Expression<'_> {
    fn peek(&self) -> Option<&str> {
        self.words.get(self.at).map(String::as_str)
    }

    fn takes(&mut self, word: &str) -> bool {
        let is_next = self.peek() == Some(word);
        self.at += usize::from(is_next);
        is_next
    }

    fn choice(&mut self, depth: usize) -> Result<i64, String> {
        let condition = self.binary(0, depth)?;
        if !self.takes("?") {
            return Ok(condition);
        }
        let yes = self.choice(depth + 1)?;
        if !self.takes(":") {
            return Err("a `?` has no `:`".to_owned());
        }
        let no = self.choice(depth + 1)?;
        Ok(if condition != 0 { yes } else { no })
    }

    fn binary(&mut self, level: usize, depth: usize) -> Result<i64, String> {
        let Some(operators) = LEVELS.get(level) else {
            return self.unary(depth);
        };
        let mut left = self.binary(level + 1, depth)?;
        while let Some(operator) = self.peek().filter(|word| operators.contains(word)) {
            let operator = operator.to_owned();
            self.at += 1;
            let right = self.binary(level + 1, depth)?;
            left = combined(&operator, left, right)?;
        }
        Ok(left)
    }

    fn unary(&mut self, depth: usize) -> Result<i64, String> {
        if depth > DEPTH {
            return Err("its brackets are too deep".to_owned());
        }
        let word = self.peek().ok_or("something is missing in it")?.to_owned();
        self.at += 1;
        match word.as_str() {
            "!" => Ok(i64::from(self.unary(depth + 1)? == 0)),
            "-" => Ok(self.unary(depth + 1)?.wrapping_neg()),
            "+" => self.unary(depth + 1),
            "~" => Ok(!self.unary(depth + 1)?),
            "(" => {
                let value = self.choice(depth + 1)?;
                if self.takes(")") {
                    Ok(value)
                } else {
                    Err("a bracket is not closed".to_owned())
                }
            }
            word if word.starts_with(|c: char| c.is_alphabetic() || c == '_') => Ok(0),
            word => number(word).ok_or_else(|| format!("`{word}` is no whole number")),
        }
    }
}

/// The result of a binary operator. GLSL's compilers compute in 32 bits and others in 64. Where that could change the result, it
/// is an error.
fn combined(operator: &str, a: i64, b: i64) -> Result<i64, String> {
    let by_zero = || "it divides by 0".to_owned();
    let bits = u32::try_from(b.clamp(0, 63)).unwrap_or(0);
    let value = match operator {
        "||" => i64::from(a != 0 || b != 0),
        "&&" => i64::from(a != 0 && b != 0),
        "|" => a | b,
        "^" => a ^ b,
        "&" => a & b,
        "==" => i64::from(a == b),
        "!=" => i64::from(a != b),
        "<" => i64::from(a < b),
        ">" => i64::from(a > b),
        "<=" => i64::from(a <= b),
        ">=" => i64::from(a >= b),
        "<<" => a.wrapping_shl(bits),
        ">>" => a.wrapping_shr(bits),
        "+" => a.wrapping_add(b),
        "-" => a.wrapping_sub(b),
        "*" => a.wrapping_mul(b),
        "/" => a.checked_div(b).ok_or_else(by_zero)?,
        _ => a.checked_rem(b).ok_or_else(by_zero)?,
    };
    let is_wide = |x: i64| i32::try_from(x).is_err();
    let beyond = match operator {
        "<" | ">" | "<=" | ">=" => is_wide(a) || is_wide(b),
        "<<" | ">>" | "+" | "-" | "*" | "/" | "%" => is_wide(a) || is_wide(value),
        _ => false,
    };
    if beyond {
        return Err(
            "it takes a number beyond 32 bits, of which compilers make different ones".to_owned(),
        );
    }
    Ok(value)
}

/// `12`, `0x1F`, `017`, `300u`, `1L`.
fn number(word: &str) -> Option<i64> {
    let digits = word.trim_end_matches(['u', 'U', 'l', 'L']);
    if let Some(hex) = digits
        .strip_prefix("0x")
        .or_else(|| digits.strip_prefix("0X"))
    {
        return i64::from_str_radix(hex, 16).ok();
    }
    match digits.strip_prefix('0') {
        Some(octal) if !octal.is_empty() => i64::from_str_radix(octal, 8).ok(),
        _ => digits.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: i64) {
        let mut macros = Macros::new();
        for line in [
            "#define THREE 3",
            "#define SUM(a, b) ((a) + (b))",
            "#define SELF SELF",
            "#define EMPTY",
        ] {
            macros.extend(defined_macro(&tokens(line)));
        }
        assert_eq!(
            condition_value(&words(&tokens(text)), &macros),
            Ok(expected),
            "{text}"
        );
    }

    #[test]
    fn expressions_are_those_of_c() {
        check("1 + 2 * 3 == 7 && !(4 < 2)", 1);
        check("THREE >= 3 ? 10 : 20", 10);
        check("SUM(THREE, 4) << 1", 14);
        check("defined THREE + defined(EMPTY) + defined(NONE)", 2);
        check("NONE || SELF", 0);
        check("0x10 | 010 | 1u", 25);
        check("-1 < 0 ^ 1", 0);
        check("~0 == -1", 1);
        check("7 % 4 - 1", 2);
    }

    #[test]
    fn what_is_no_expression_is_refused() {
        for text in ["", "1 +", "(1", "1 2", "1 / 0", "1.5", "defined", "? 1"] {
            let value = condition_value(&words(&tokens(text)), &Macros::new());
            assert!(value.is_err(), "{text}");
        }
        // To GLSL's compilers the first is less than 0, to C's it is not.
        for text in ["(1 << 31) < 0", "0x80000000 < 0", "65536 * 65536"] {
            let value = condition_value(&words(&tokens(text)), &Macros::new());
            assert!(value.unwrap_err().contains("beyond 32 bits"), "{text}");
        }
        check("0x80000000 & 0x80000000", 0x8000_0000);
        let deep = "(".repeat(100_000);
        assert!(condition_value(&words(&tokens(&deep)), &Macros::new()).is_err());
        let mut macros = Macros::new();
        for i in 0..40 {
            let line = format!("#define A{} A{i} A{i} A{i}", i + 1);
            macros.extend(defined_macro(&tokens(&line)));
        }
        assert!(condition_value(&words(&tokens("A40")), &macros).is_err());
    }
}
