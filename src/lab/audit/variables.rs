//! Declarations of variables and of members, in all languages. Annotations in HLSL, which are for hosts, are removed, since none
//! of our compilers reads them.

use super::language::Language;
use crate::lab::verify::shader_words::{Token, behind, parts_between_commas, tokens};

/// A variable, or a member of a type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its line.
    pub line: usize,
    /// Its type with its precision, as it is written.
    pub ty: String,
    /// Whether it is an array.
    pub is_array: bool,
    /// The range of words of its name and array size.
    pub declarator: (usize, usize),
    /// The range of words of its value, where it has one.
    pub value: Option<(usize, usize)>,
    /// Where its value comes from.
    pub storage: Storage,
}

/// Where the value of a variable comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// It never changes.
    Constant,
    /// It is a variable of the text itself.
    Own,
    /// The host or another shader stage sets it.
    Input,
}

/// `name: type`, attributes before it.
pub fn wgsl_member(part: &[Token]) -> Option<Variable> {
    let colon = part.iter().position(|token| token.text == ":")?;
    let name = part[..colon].last()?;
    Some(Variable {
        name: name.text.to_owned(),
        line: name.line,
        ty: part[colon + 1..].iter().map(|token| token.text).collect(),
        is_array: false,
        declarator: (0, 0),
        value: None,
        storage: Storage::Input,
    })
}

/// `@group(0) @binding(1) var<uniform> name: type = value`, `override name = value`, `const name = value`.
pub fn wgsl_variable(part: &[Token], start: usize) -> Option<Variable> {
    let words = ["var", "override", "const"];
    let at = part.iter().position(|token| words.contains(&token.text))?;
    let space = part.get(at + 1).filter(|token| token.text == "<");
    let close = space.and_then(|_| part.iter().position(|token| token.text == ">"));
    let storage = match (part[at].text, close.map(|_| part[at + 2].text)) {
        ("const", _) => Storage::Constant,
        ("var", Some("private" | "workgroup")) => Storage::Own,
        _ => Storage::Input,
    };
    let name = close.map_or(at + 1, |close| close + 1);
    let equals = part.iter().position(|token| token.text == "=");
    let end = equals.unwrap_or(part.len());
    let ty = part.get(name + 2..end).unwrap_or(&[]);
    let found = part.get(name).filter(|token| token.is_word())?;
    Some(Variable {
        name: found.text.to_owned(),
        line: found.line,
        ty: ty.iter().map(|token| token.text).collect(),
        is_array: false,
        declarator: (start + name, start + name + 1),
        value: equals.map(|equals| (start + equals + 1, start + part.len())),
        storage,
    })
}

/// Words before a type that say where a value comes from or how it is interpolated.
const STORAGES: [&str; 23] = [
    "uniform",
    "const",
    "static",
    "extern",
    "in",
    "out",
    "inout",
    "varying",
    "attribute",
    "buffer",
    "shared",
    "groupshared",
    "flat",
    "smooth",
    "noperspective",
    "centroid",
    "readonly",
    "writeonly",
    "coherent",
    "precise",
    "volatile",
    "row_major",
    "column_major",
];

/// `qualifiers type name[2] : place = value, name = value`.
pub fn c_variables(
    part: &[Token],
    start: usize,
    language: Language,
    is_member: bool,
) -> Vec<Variable> {
    let mut at = 0;
    // `[[vk::binding(0)]]`, `layout(std140)`.
    loop {
        match part.get(at).map(|token| token.text) {
            Some("[") => at = behind(part, at),
            Some("layout") => at = behind(part, at + 1),
            _ => break,
        }
    }
    let mut qualifiers: Vec<&str> = Vec::new();
    while let Some(token) = part.get(at).filter(|token| STORAGES.contains(&token.text)) {
        qualifiers.push(token.text);
        at += 1;
        if part.get(at).is_some_and(|token| token.text == "layout") {
            at = behind(part, at + 1);
        }
    }
    let storage = if is_member {
        Storage::Input
    } else {
        c_storage(&qualifiers, language)
    };
    let (mut found, mut ty) = (Vec::new(), String::new());
    let mut from = at;
    for (number, one) in parts_between_commas(part.get(at..).unwrap_or(&[]))
        .into_iter()
        .enumerate()
    {
        let end = one
            .iter()
            .position(|t| ["=", ":"].contains(&t.text))
            .unwrap_or(one.len());
        let open = one[..end].iter().position(|token| token.text == "[");
        let name = one[..open.unwrap_or(end)].iter().rposition(Token::is_word);
        if let Some(name) = name.filter(|name| number > 0 || *name > 0) {
            if number == 0 {
                let words: Vec<&str> = one[..name].iter().map(|token| token.text).collect();
                ty = words.join(" ");
            }
            let equals = one.iter().position(|token| token.text == "=");
            found.push(Variable {
                name: one[name].text.to_owned(),
                line: one[name].line,
                ty: ty.clone(),
                is_array: open.is_some() || ty.contains('['),
                declarator: (start + from + name, start + from + end),
                value: equals.map(|equals| (start + from + equals + 1, start + from + one.len())),
                storage,
            });
        }
        from += one.len() + 1;
    }
    found
}

fn c_storage(qualifiers: &[&str], language: Language) -> Storage {
    let has = |word: &&str| qualifiers.contains(word);
    let inputs = [
        "uniform",
        "in",
        "varying",
        "attribute",
        "buffer",
        "out",
        "inout",
        "extern",
    ];
    if language.is_glsl() {
        return match (inputs.iter().any(has), qualifiers.contains(&"const")) {
            (true, _) => Storage::Input,
            (_, true) => Storage::Constant,
            _ => Storage::Own,
        };
    }
    // Without `static` a variable of HLSL is set from outside, whatever its initial value.
    match (
        qualifiers.contains(&"static"),
        qualifiers.contains(&"const"),
    ) {
        (true, true) => Storage::Constant,
        (true, false) => Storage::Own,
        _ if qualifiers.contains(&"groupshared") => Storage::Own,
        _ => Storage::Input,
    }
}

/// HLSL without the annotations after variables: `float a < string label = "A"; > = 0.5;`. No expression holds a semicolon
/// between `<` and `>`.
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
