//! A user's text as parts that stand outside of all others: functions, structs, variables, blocks of inputs. What stands in bodies is for
//! compilers to judge.

use crate::emit::shader_words::{Token, tokens};

use super::language::Language;
use super::scan::{FoundFunction, behind, function, parts_between_commas};
use super::type_names::TypeNames;

/// A part, by places of words.
#[derive(Clone, Debug)]
pub struct Part {
    /// Where it begins.
    pub start: usize,
    /// Where its body begins, or the sign that ends it.
    pub head_end: usize,
    /// The place behind it.
    pub end: usize,
    /// What it is.
    pub kind: PartKind,
}

/// What a part is.
#[derive(Clone, Debug)]
pub enum PartKind {
    /// A function with its body.
    Function(FoundFunction),
    /// The head of a function whose body stands elsewhere.
    Prototype(String),
    /// A type: its name, and its members.
    Type(String, Vec<Variable>),
    /// Variables: one declaration may have several.
    Variables(Vec<Variable>),
    /// Inputs in a block of this name: its members, and the name that they are read by, where there is one.
    Block(String, Vec<Variable>, Option<String>),
    /// What holds for all that follows: `precision highp float;`, `enable f16;`.
    Setting,
    /// Something else.
    Other,
}

/// A variable, or a member of a type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its line.
    pub line: usize,
    /// Its type with what is said of its precision, as it is written.
    pub ty: String,
    /// Whether it is an array.
    pub is_array: bool,
    /// The words of its name, and of how many it is.
    pub declarator: (usize, usize),
    /// The words of its value, where it has one.
    pub value: Option<(usize, usize)>,
    /// Where its value comes from.
    pub storage: Storage,
}

/// Where the value of a variable comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// It never changes.
    Constant,
    /// The text keeps it.
    Own,
    /// What runs the shader sets it.
    Input,
}

impl Part {
    /// The names that it gives a meaning.
    pub fn names(&self) -> Vec<&str> {
        match &self.kind {
            PartKind::Function(found) => vec![found.name.as_str()],
            PartKind::Prototype(name) | PartKind::Type(name, _) => vec![name.as_str()],
            PartKind::Variables(all) => all.iter().map(|one| one.name.as_str()).collect(),
            PartKind::Block(_, _, Some(name)) => vec![name.as_str()],
            PartKind::Block(_, members, None) => {
                members.iter().map(|one| one.name.as_str()).collect()
            }
            PartKind::Setting | PartKind::Other => Vec::new(),
        }
    }
}

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
    let is_inside = |place| {
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
    match spans.is_empty() {
        true => code.to_owned(),
        false => code.lines().enumerate().map(line).collect(),
    }
}

/// The parts of a text in order.
pub fn parts(tokens: &[Token], names: &TypeNames, language: Language) -> Vec<Part> {
    let mut found: Vec<Part> = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let part = part(tokens, at, names, language);
        at = part.end;
        found.push(part);
    }
    found
}

/// The place behind words of engines that no declaration needs: `CBUFFER_START(UnityPerMaterial)`, `CBUFFER_END`.
fn behind_marks(tokens: &[Token], start: usize) -> usize {
    let marks = ["CBUFFER_", "UNITY_INSTANCING_BUFFER_", "GLOBAL_CBUFFER_"];
    let mut at = start;
    while let Some(token) = tokens.get(at) {
        if !marks.iter().any(|mark| token.text.starts_with(mark)) {
            break;
        }
        at = match tokens.get(at + 1) {
            Some(open) if open.text == "(" => behind(tokens, at + 1),
            _ => at + 1,
        };
    }
    at
}

/// The part that begins here.
fn part(tokens: &[Token], start: usize, names: &TypeNames, language: Language) -> Part {
    let start = match language {
        Language::Hlsl => behind_marks(tokens, start),
        _ => start,
    };
    let mut head_end = start;
    while let Some(token) = tokens.get(head_end) {
        match token.text {
            "{" | ";" | "}" => break,
            "(" | "[" => head_end = behind(tokens, head_end),
            _ => head_end += 1,
        }
    }
    let head_end = head_end.min(tokens.len());
    let has_body = tokens.get(head_end).is_some_and(|token| token.text == "{");
    let mut end = match has_body {
        true => behind(tokens, head_end),
        false => (head_end + 1).min(tokens.len()),
    };
    let head = names.replaced(&tokens[start..head_end]);
    let kind = match function(&head, language) {
        Some(found) if has_body => PartKind::Function(found),
        Some(found) if language != Language::Wgsl => PartKind::Prototype(found.name),
        _ => {
            if has_body {
                end = tail(tokens, start, head_end, end, language);
            }
            other_kind(tokens, (start, head_end, end), language)
        }
    };
    Part {
        start,
        head_end,
        end,
        kind,
    }
}

/// The end of what has a body and is no function: `struct S { … } s;`, `float a[2] = { … };`.
fn tail(tokens: &[Token], start: usize, head_end: usize, end: usize, language: Language) -> usize {
    let head = &tokens[start..head_end];
    let has = |word: &str| head.iter().any(|token| token.text == word);
    let goes_on = has("=")
        || language != Language::Wgsl
            && (["struct", "class", "enum"].into_iter().any(has)
                || language == Language::Gles
                    && ["uniform", "buffer", "in", "out", "layout"]
                        .into_iter()
                        .any(has));
    let mut at = end;
    while goes_on && tokens.get(at).is_some_and(|token| token.text != ";") {
        at = match tokens[at].text {
            "(" | "[" | "{" => behind(tokens, at),
            _ => at + 1,
        };
    }
    match tokens.get(at) {
        Some(token) if token.text == ";" => at + 1,
        _ => at.min(tokens.len()),
    }
}

/// What a part is that is no function.
fn other_kind(
    tokens: &[Token],
    (start, head_end, end): (usize, usize, usize),
    language: Language,
) -> PartKind {
    let head = &tokens[start..head_end];
    let first = head.first().map_or("", |token| token.text);
    if ["precision", "enable", "requires", "diagnostic"].contains(&first) {
        return PartKind::Setting;
    }
    let has_body = tokens.get(head_end).is_some_and(|token| token.text == "{");
    let has_value = head.iter().any(|token| token.text == "=");
    if has_body && !has_value {
        return with_body(tokens, (start, head_end, end), language);
    }
    let all = &tokens[start..end.saturating_sub(1).max(start)];
    match first {
        "typedef" => PartKind::Type(last_word(all), Vec::new()),
        "alias" => PartKind::Type(word_at(all, 1), Vec::new()),
        "" | "import" | "using" | "const_assert" => PartKind::Other,
        _ if language == Language::Wgsl => wgsl_variable(all, start),
        _ => match c_variables(all, start, language, false) {
            all if all.is_empty() => PartKind::Other,
            all => PartKind::Variables(all),
        },
    }
}

/// A type, or a block of inputs.
fn with_body(
    tokens: &[Token],
    (start, head_end, end): (usize, usize, usize),
    language: Language,
) -> PartKind {
    let head = &tokens[start..head_end];
    let place = |word: &str| head.iter().position(|token| token.text == word);
    let close = behind(tokens, head_end) - 1;
    let inside = || members(tokens, head_end + 1, close, language);
    if let Some(at) = ["struct", "class", "enum", "interface"]
        .into_iter()
        .find_map(place)
    {
        return PartKind::Type(word_at(head, at + 1), inside());
    }
    if let Some(at) = ["cbuffer", "tbuffer"].into_iter().find_map(place) {
        return PartKind::Block(word_at(head, at + 1), inside(), None);
    }
    let is_block = ["uniform", "buffer", "in", "out"]
        .into_iter()
        .any(|word| place(word).is_some());
    match language == Language::Gles && is_block {
        true => {
            let instance = tokens[(close + 1).min(end)..end]
                .iter()
                .find(|token| token.is_word());
            let instance = instance.map(|token| token.text.to_owned());
            PartKind::Block(last_word(head), inside(), instance)
        }
        false => PartKind::Other,
    }
}

fn last_word(tokens: &[Token]) -> String {
    let last = tokens.iter().rfind(|token| token.is_word());
    last.map_or(String::new(), |token| token.text.to_owned())
}

fn word_at(tokens: &[Token], at: usize) -> String {
    tokens
        .get(at)
        .map_or(String::new(), |token| token.text.to_owned())
}

/// The members between two places.
fn members(tokens: &[Token], from: usize, to: usize, language: Language) -> Vec<Variable> {
    let inside = &tokens[from.min(to)..to];
    if language == Language::Wgsl {
        let each = parts_between_commas(inside).into_iter();
        return each.filter_map(wgsl_member).collect();
    }
    let mut at = from;
    let mut found = Vec::new();
    for member in inside.split(|token| token.text == ";") {
        found.extend(c_variables(member, at, language, true));
        at += member.len() + 1;
    }
    found
}

/// `name: type`, attributes before it.
fn wgsl_member(part: &[Token]) -> Option<Variable> {
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
fn wgsl_variable(part: &[Token], start: usize) -> PartKind {
    let words = ["var", "override", "const"];
    let Some(at) = part.iter().position(|token| words.contains(&token.text)) else {
        return PartKind::Other;
    };
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
    let Some(found) = part.get(name).filter(|token| token.is_word()) else {
        return PartKind::Other;
    };
    PartKind::Variables(vec![Variable {
        name: found.text.to_owned(),
        line: found.line,
        ty: ty.iter().map(|token| token.text).collect(),
        is_array: false,
        declarator: (start + name, start + name + 1),
        value: equals.map(|equals| (start + equals + 1, start + part.len())),
        storage,
    }])
}

/// Words before a type that say where a value comes from, or how it is read.
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
fn c_variables(part: &[Token], start: usize, language: Language, is_member: bool) -> Vec<Variable> {
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
    let storage = match is_member {
        true => Storage::Input,
        false => c_storage(&qualifiers, language),
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
    if language == Language::Gles {
        return match (inputs.iter().any(has), qualifiers.contains(&"const")) {
            (true, _) => Storage::Input,
            (_, true) => Storage::Constant,
            _ => Storage::Own,
        };
    }
    // Without `static` a variable of HLSL is set from outside, whatever value stands there.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(language: Language, text: &str, expected: &[&str]) {
        let tokens = tokens(text);
        let variable = |one: &Variable| {
            let value = one.value.map(|(from, to)| {
                let words: Vec<&str> = tokens[from..to].iter().map(|token| token.text).collect();
                format!("={}", words.concat())
            });
            let array = if one.is_array { "[]" } else { "" };
            let value = value.unwrap_or_default();
            format!("{:?} {} {}{array}{value}", one.storage, one.ty, one.name)
        };
        let all = |all: &[Variable]| all.iter().map(variable).collect::<Vec<_>>().join(", ");
        let shown = |part: &Part| match &part.kind {
            PartKind::Function(found) => format!("function {}", found.name),
            PartKind::Prototype(name) => format!("prototype {name}"),
            PartKind::Type(name, members) => format!("type {name} {{{}}}", all(members)),
            PartKind::Variables(variables) => all(variables),
            PartKind::Block(name, members, instance) => {
                format!("block {name} {{{}}} {instance:?}", all(members))
            }
            PartKind::Setting => "setting".to_owned(),
            PartKind::Other => "other".to_owned(),
        };
        let found = parts(&tokens, &TypeNames::default(), language);
        let found: Vec<String> = found.iter().map(shown).collect();
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn parts_of_glsl_are_told_apart() {
        check(
            Language::Gles,
            "precision highp float; uniform mediump vec3 a, b[2]; layout(std140) uniform B { vec3 c; float d; } b; in vec2 uv; const float t[2] = float[](1., 2.); struct S { float x, y; }; float g = 1.0; float f(float c);\nfloat f(float c) { } layout(early_fragment_tests) in;",
            &[
                "setting",
                "Input mediump vec3 a, Input mediump vec3 b[]",
                "block B {Input vec3 c, Input float d} Some(\"b\")",
                "Input vec2 uv",
                "Constant float t[]=float[](1.,2.)",
                "type S {Input float x, Input float y}",
                "Own float g=1.0",
                "prototype f",
                "function f",
                "other",
            ],
        );
    }

    #[test]
    fn parts_of_hlsl_are_told_apart() {
        check(
            Language::Hlsl,
            "float a = 0.02; static const float t[2] = { 1, 2 }; cbuffer B : register(b0) { float4 c : packoffset(c0); float d; }\n[[vk::binding(3)]] Texture2D<float4> tex : register(t0); ConstantBuffer<S> s; typedef float3 rgb; static float m; [numthreads(1,1,1)] void main() {}",
            &[
                "Input float a=0.02",
                "Constant float t[]={1,2}",
                "block B {Input float4 c, Input float d} None",
                "Input Texture2D < float4 > tex",
                "Input ConstantBuffer < S > s",
                "type rgb {}",
                "Own float m",
                "function main",
            ],
        );
    }

    #[test]
    fn parts_of_wgsl_are_told_apart() {
        check(
            Language::Wgsl,
            "enable f16; struct W { @size(16) a: f32, b: vec3<f32>, } @group(0) @binding(0) var<uniform> w: W; var<private> p: f32 = 1.0; override o: f32 = 0.5; const c = 1.0; var t: texture_2d<f32>; alias r = f32; fn f(c: f32) -> f32 { }",
            &[
                "setting",
                "type W {Input f32 a, Input vec3<f32> b}",
                "Input W w",
                "Own f32 p=1.0",
                "Input f32 o=0.5",
                "Constant  c=1.0",
                "Input texture_2d<f32> t",
                "type r {}",
                "function f",
            ],
        );
    }

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

    #[test]
    fn what_is_broken_ends() {
        for text in [
            "struct",
            "{",
            "}}}",
            "uniform",
            "cbuffer {",
            "a b[",
            "layout(",
            "@",
            "float a = {",
            "var<",
        ] {
            for language in [Language::Wgsl, Language::Gles, Language::Hlsl] {
                let tokens = tokens(text);
                let _ = parts(&tokens, &TypeNames::default(), language);
            }
        }
    }
}
