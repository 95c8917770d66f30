//! The top-level parts of a user's text: functions, structs, variables, blocks of inputs. The contents of bodies are left to
//! compilers.

use super::language::Language;
use super::type_names::TypeNames;
use super::variables::{Variable, c_variables, wgsl_member, wgsl_variable};
use crate::lab::verify::function_head::{FunctionHead, function_head};
use crate::lab::verify::shader_words::{Token, behind, holds, parts_between_commas, text_at};

/// A part, by indices of words.
#[derive(Clone, Debug)]
pub struct Part {
    /// The index of its first word.
    pub start: usize,
    /// The index at which its body begins, or of the character that ends it.
    pub head_end: usize,
    /// The index after it.
    pub end: usize,
    /// Its kind.
    pub kind: PartKind,
    /// The namespaces around it.
    pub scope: Vec<String>,
}

/// The kind of a part.
#[derive(Clone, Debug)]
pub enum PartKind {
    /// A function with its body.
    Function(FunctionHead),
    /// The head of a function whose body stands elsewhere.
    Prototype(FunctionHead),
    /// A type: its name, its members, and the constants in its declaration, such as `K` of `const struct T { … } K = …;` or the
    /// names of an `enum`.
    Type(String, Vec<Variable>, Vec<String>),
    /// The variables of one declaration.
    Variables(Vec<Variable>),
    /// A block of inputs: its name, its members, and the instance name that they are read by, where there is one.
    Block(String, Vec<Variable>, Option<String>),
    /// A setting for all that follows: `precision highp float;`, `enable f16;`.
    Setting,
    /// A call of a macro, which may stand for functions and variables: its words.
    MacroCall(Vec<String>),
    /// Something else.
    Other,
}

impl Part {
    /// The names that it declares.
    pub fn names(&self) -> Vec<&str> {
        match &self.kind {
            PartKind::Function(found) | PartKind::Prototype(found) => vec![found.name.as_str()],
            PartKind::Type(name, _, constants) => {
                let constants = constants.iter().map(String::as_str);
                constants.chain([name.as_str()]).collect()
            }
            PartKind::Variables(all) => all.iter().map(|one| one.name.as_str()).collect(),
            PartKind::Block(_, _, Some(name)) => vec![name.as_str()],
            PartKind::Block(_, members, None) => {
                members.iter().map(|one| one.name.as_str()).collect()
            }
            PartKind::MacroCall(given) => given.iter().map(String::as_str).collect(),
            PartKind::Setting | PartKind::Other => Vec::new(),
        }
    }
}

/// The parts of a text in order.
pub fn parts(tokens: &[Token], names: &TypeNames, language: Language) -> Vec<Part> {
    let mut found: Vec<Part> = Vec::new();
    // The open namespaces: where each closes, and its names.
    let mut open: Vec<(usize, Vec<String>)> = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if let Some((close, _)) = open.last().filter(|(close, _)| *close <= at) {
            at += usize::from(*close == at);
            open.pop();
            continue;
        }
        if let Some((inside, names)) = namespace(tokens, at, language) {
            open.push((behind(tokens, inside - 1) - 1, names));
            at = inside;
            continue;
        }
        let mut part = part(tokens, at, names, language);
        at = part.end;
        part.scope = open.iter().flat_map(|(_, names)| names.clone()).collect();
        if let PartKind::Function(found) = &mut part.kind {
            found.scope.clone_from(&part.scope);
        }
        found.push(part);
    }
    found
}

/// A namespace that begins here: the index after its brace, and its names.
fn namespace(tokens: &[Token], at: usize, language: Language) -> Option<(usize, Vec<String>)> {
    let has_namespaces = matches!(language, Language::Hlsl | Language::Slang);
    let is_inline = usize::from(tokens[at].text == "inline");
    if !has_namespaces || tokens.get(at + is_inline)?.text != "namespace" {
        return None;
    }
    let head = &tokens[at + is_inline + 1..];
    let open = head.iter().position(|token| token.text == "{")?;
    let (names, signs): (Vec<&Token>, Vec<&Token>) = head[..open].iter().partition(|t| t.is_word());
    let is_head = signs.iter().all(|token| [":", "."].contains(&token.text));
    let mut names: Vec<String> = names.iter().map(|name| name.text.to_owned()).collect();
    if names.is_empty() {
        names.push(String::new());
    }
    is_head.then_some((at + is_inline + open + 2, names))
}

/// The functions of a part: itself, or the members of a type.
pub fn functions_of(
    part: &Part,
    tokens: &[Token],
    names: &TypeNames,
    language: Language,
) -> Vec<FunctionHead> {
    match &part.kind {
        PartKind::Function(found) => vec![found.clone()],
        PartKind::Type(name, _, _) if matches!(language, Language::Hlsl | Language::Slang) => {
            let has_body = tokens[part.head_end].text == "{";
            let close = behind(tokens, part.head_end) - 1;
            let from = part.head_end + 1;
            let inside = &tokens[from.min(close)..close];
            let all = if has_body {
                parts(inside, names, language)
            } else {
                Vec::new()
            };
            let member = |one: Part| {
                let head = &inside[one.start..one.head_end];
                let is_static = holds(head, "static");
                let PartKind::Function(mut found) = one.kind else {
                    return None;
                };
                found.scope = part.scope.iter().chain([name]).cloned().collect();
                found.needs_object = !is_static;
                Some(found)
            };
            all.into_iter().filter_map(member).collect()
        }
        _ => Vec::new(),
    }
}

/// The functions among words, each with the words of its body.
pub fn bodies<'t, 'a>(
    tokens: &'t [Token<'a>],
    names: &TypeNames,
    language: Language,
) -> impl Iterator<Item = (FunctionHead, &'t [Token<'a>])> {
    let parts = parts(tokens, names, language).into_iter();
    parts.flat_map(move |one| {
        let body = &tokens[one.head_end..one.end];
        let found = functions_of(&one, tokens, names, language).into_iter();
        found.map(move |found| (found, body))
    })
}

/// The index after words of engines that no declaration needs: `CBUFFER_START(UnityPerMaterial)`, `CBUFFER_END`.
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

/// `NAME(a, b)` with a declaration or `;` after it, which can only be a macro: its words, and the index after it.
fn macro_call(tokens: &[Token], start: usize, language: Language) -> Option<(Vec<String>, usize)> {
    let has_macros = language.has_preprocessor();
    let name = tokens
        .get(start)
        .filter(|name| has_macros && name.is_word())?;
    let open = tokens.get(start + 1)?;
    let close = behind(tokens, start + 1);
    if name.text == "layout" || open.text != "(" {
        return None;
    }
    let given = tokens[start + 2..close]
        .iter()
        .filter(|word| word.is_word());
    let given = given.map(|word| word.text.to_owned()).collect();
    match tokens.get(close) {
        Some(next) if next.text == ";" => Some((given, close + 1)),
        Some(next) => next.is_word().then_some((given, close)),
        None => Some((given, close)),
    }
}

/// The part that begins here.
fn part(tokens: &[Token], start: usize, names: &TypeNames, language: Language) -> Part {
    let start = match language {
        Language::Hlsl => behind_marks(tokens, start),
        _ => start,
    };
    if let Some((given, end)) = macro_call(tokens, start, language) {
        return Part {
            start,
            head_end: end,
            end,
            kind: PartKind::MacroCall(given),
            scope: Vec::new(),
        };
    }
    let mut head_end = start;
    while let Some(token) = tokens.get(head_end) {
        match token.text {
            "{" | ";" | "}" => break,
            "(" | "[" => head_end = behind(tokens, head_end),
            _ => head_end += 1,
        }
    }
    let head_end = head_end.min(tokens.len());
    let has_body = text_at(tokens, head_end) == "{";
    let mut end = if has_body {
        behind(tokens, head_end)
    } else {
        (head_end + 1).min(tokens.len())
    };
    let head = names.replaced(&tokens[start..head_end]);
    let kind = match function_head(&head, language == Language::Wgsl) {
        Some(found) if has_body => PartKind::Function(found),
        Some(found) if language != Language::Wgsl => PartKind::Prototype(found),
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
        scope: Vec::new(),
    }
}

/// The end of a part that has a body and is not a function: `struct S { … } s;`, `float a[2] = { … };`.
fn tail(tokens: &[Token], start: usize, head_end: usize, end: usize, language: Language) -> usize {
    let head = &tokens[start..head_end];
    let has = |word: &str| holds(head, word);
    let goes_on = has("=")
        || language != Language::Wgsl
            && (["struct", "class", "enum"].into_iter().any(has)
                || language.is_glsl()
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

/// The kind of a part that is not a function.
fn other_kind(
    tokens: &[Token],
    (start, head_end, end): (usize, usize, usize),
    language: Language,
) -> PartKind {
    let head = &tokens[start..head_end];
    let first = text_at(head, 0);
    // DXC does not know such a line.
    let is_using =
        language == Language::Slang && first == "using" && text_at(head, 1) == "namespace";
    if is_using || ["precision", "enable", "requires", "diagnostic"].contains(&first) {
        return PartKind::Setting;
    }
    let has_body = text_at(tokens, head_end) == "{";
    let has_value = holds(head, "=");
    if has_body && !has_value {
        return with_body(tokens, (start, head_end, end), language);
    }
    let all = &tokens[start..end.saturating_sub(1).max(start)];
    match first {
        "typedef" => PartKind::Type(last_word(all), Vec::new(), Vec::new()),
        "alias" => PartKind::Type(text_at(all, 1).to_owned(), Vec::new(), Vec::new()),
        "" | "import" | "using" | "const_assert" => PartKind::Other,
        _ if language == Language::Wgsl => match wgsl_variable(all, start) {
            Some(variable) => PartKind::Variables(vec![variable]),
            None => PartKind::Other,
        },
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
        let name = text_at(head, at + 1).to_owned();
        let constants = constants(tokens, (head_end, end), head, language);
        return PartKind::Type(name, inside(), constants);
    }
    if let Some(at) = ["cbuffer", "tbuffer"].into_iter().find_map(place) {
        return PartKind::Block(text_at(head, at + 1).to_owned(), inside(), None);
    }
    let is_block = ["uniform", "buffer", "in", "out"]
        .into_iter()
        .any(|word| place(word).is_some());
    if language.is_glsl() && is_block {
        let instance = tokens[(close + 1).min(end)..end]
            .iter()
            .find(|token| token.is_word());
        let instance = instance.map(|token| token.text.to_owned());
        PartKind::Block(last_word(head), inside(), instance)
    } else {
        PartKind::Other
    }
}

/// The constants in the declaration of a type: the names of an unscoped `enum`, and variables with a value after the body. HLSL's
/// constants that are not static are left out, since a pipeline sets them.
fn constants(
    tokens: &[Token],
    (head_end, end): (usize, usize),
    head: &[Token],
    language: Language,
) -> Vec<String> {
    let has = |word: &str| holds(head, word);
    let close = behind(tokens, head_end) - 1;
    let first_words = |from: usize, to: usize| -> Vec<String> {
        let named = parts_between_commas(&tokens[from.min(to)..to]);
        let words = named.into_iter().filter_map(|part| {
            let word = part.first().filter(|token| token.is_word())?;
            Some(word.text.to_owned())
        });
        words.collect()
    };
    let behind_it = (close + 1).min(end)..end.saturating_sub(1).max(close + 1).min(end);
    let has_value = holds(&tokens[behind_it.clone()], "=");
    if has("enum") && !has("class") && !has("struct") {
        first_words((head_end + 1).min(close), close)
    } else if has("const") && has_value && (language.is_glsl() || has("static")) {
        first_words(behind_it.start, behind_it.end)
    } else {
        Vec::new()
    }
}

fn last_word(tokens: &[Token]) -> String {
    let last = tokens.iter().rfind(|token| token.is_word());
    last.map_or(String::new(), |token| token.text.to_owned())
}

/// The members between two places.
fn members(tokens: &[Token], from: usize, to: usize, language: Language) -> Vec<Variable> {
    let inside = &tokens[from.min(to)..to];
    if language == Language::Wgsl {
        let each = parts_between_commas(inside).into_iter();
        return each.filter_map(wgsl_member).collect();
    }
    let mut found = Vec::new();
    for one in parts(inside, &TypeNames::default(), language) {
        let member = &inside[one.start..one.end];
        let member = match member.split_last() {
            Some((last, rest)) if last.text == ";" => rest,
            _ => member,
        };
        if !matches!(one.kind, PartKind::Function(_) | PartKind::Prototype(_)) {
            found.extend(c_variables(member, from + one.start, language, true));
        }
    }
    found
}

/// The functions of a text in order.
#[cfg(test)]
pub fn functions(text: &str, language: Language) -> Vec<FunctionHead> {
    let code = super::language::bare(text, language.has_preprocessor());
    let tokens = crate::lab::verify::shader_words::tokens(&code);
    let names = TypeNames::of_text(text, language);
    let found = bodies(&tokens, &names, language);
    found.map(|(found, _)| found).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::verify::shader_words::tokens;

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
            PartKind::Prototype(found) => format!("prototype {}", found.name),
            PartKind::Type(name, members, constants) => {
                let constants = constants.iter().map(|name| format!(" {name}"));
                format!(
                    "type {name} {{{}}}{}",
                    all(members),
                    constants.collect::<String>()
                )
            }
            PartKind::Variables(variables) => all(variables),
            PartKind::Block(name, members, instance) => {
                format!("block {name} {{{}}} {instance:?}", all(members))
            }
            PartKind::Setting => "setting".to_owned(),
            PartKind::MacroCall(given) => format!("macro of {}", given.join(", ")),
            PartKind::Other => "other".to_owned(),
        };
        let found = parts(&tokens, &TypeNames::default(), language);
        let found: Vec<String> = found.iter().map(shown).collect();
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn parts_of_glsl_are_distinguished() {
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
    fn calls_of_macros_are_parts() {
        check(
            Language::Gles,
            "DEF(p5)\nvec3 f(float c) { } DEF(a, b); layout(std140) uniform B { vec3 c; }; OF(x)",
            &[
                "macro of p5",
                "function f",
                "macro of a, b",
                "block B {Input vec3 c} None",
                "macro of x",
            ],
        );
    }

    #[test]
    fn parts_of_hlsl_are_distinguished() {
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
    fn parts_of_wgsl_are_distinguished() {
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

#[cfg(test)]
mod head_tests {
    use super::*;
    use crate::lab::verify::function_head::NumberShape;

    #[track_caller]
    fn check(text: &str, language: Language, expected: &[&str]) {
        let shown = |found: &FunctionHead| {
            let params: Vec<String> = found
                .params
                .iter()
                .map(|param| format!("{} {}", param.name, param.shape.words()))
                .collect();
            format!(
                "{}:{} {}({}) {}",
                found.line,
                found.column,
                found.name,
                params.join(", "),
                found.result.words()
            )
        };
        let found: Vec<String> = functions(text, language).iter().map(shown).collect();
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn heads_of_wgsl_are_read() {
        check(
            "const a = array<f32, 2>(1.0, 2.0);\nstruct S { x: f32 }\n@must_use fn f(\n  c: f32, // c\n f0: vec3<f32>,\n) -> vec3f { if c > 0. { } return f0; }\nfn g() {}",
            Language::Wgsl,
            &[
                "3:14 f(c one number, f0 three numbers) three numbers",
                "7:4 g() nothing",
            ],
        );
    }

    #[test]
    fn heads_of_glsl_are_read() {
        check(
            "#version 300 es\n#define F(x) { \\\n }\nlayout(std140) uniform B { vec3 a; } b;\nconst float t[2] = float[](1., 2.);\nhighp vec3 f(const in highp float c, vec3 f0, out float d)\n{\n}\nvoid main(void) {}",
            Language::Gles,
            &[
                "6:12 f(c one number, f0 three numbers, d out float) three numbers",
                "9:6 main() void",
            ],
        );
    }

    #[test]
    fn heads_of_hlsl_are_read() {
        check(
            "static const float t[2] = { 1, 2 };\ncbuffer B : register(b0) { float3 a; };\n[numthreads(1, 1, 1)] void k() {}\nfloat3 f(float c : A, half3 f0 = 1, float x[2]) : SV_Target { }\nfloat g(float c);",
            Language::Hlsl,
            &[
                "3:28 k() void",
                "4:8 f(c one number, f0 three numbers, x floatx[2]) three numbers",
            ],
        );
    }

    #[test]
    fn a_result_may_be_given_in_an_argument() {
        let found = functions(
            "void f(float c, out half3 o, float3 f0) { } void g(out float a, out float b) { } float h(out float a) { }",
            Language::Hlsl,
        );
        let out = found[0]
            .out
            .as_ref()
            .map(|out| (out.place, out.ty.as_str()));
        assert_eq!(out, Some((1, "half3")));
        assert_eq!(
            (found[0].params.len(), &found[0].result),
            (2, &NumberShape::Rgb)
        );
        assert!(found[1].out.is_none() && found[2].out.is_none());
    }

    #[test]
    fn what_is_broken_ends() {
        for text in [
            "fn",
            "fn f(",
            "}}}{{{",
            "fn (a: f32) {",
            "float f( {",
            "[[[",
        ] {
            for language in [Language::Wgsl, Language::Gles, Language::Hlsl] {
                let _ = functions(text, language);
            }
        }
    }
}
