//! Heads of functions in shader text, in all languages: names, arguments, and the shapes of their types.

use super::shader_words::{Token, behind, holds, parts_between_commas, text_at};

/// A function as its head declares it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FunctionHead {
    /// Its name.
    pub name: String,
    /// The line of its name, from 1.
    pub line: usize,
    /// The column of its name, from 1.
    pub column: usize,
    /// Its arguments, without an `out` one.
    pub params: Vec<Parameter>,
    /// The shape of its result.
    pub result: NumberShape,
    /// The `out` argument that receives the result, where it returns nothing.
    pub out: Option<OutArgument>,
    /// The namespaces and types around it.
    pub scope: Vec<String>,
    /// Whether it needs an object of the type around it.
    pub needs_object: bool,
}

/// An argument that receives a function's result: `out float3 Out`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutArgument {
    /// Its index among all arguments.
    pub place: usize,
    /// Its type, as it is written.
    pub ty: String,
}

/// An argument of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// The shape of its type.
    pub shape: NumberShape,
    /// Its type as it is written.
    pub ty: String,
    /// Its default value.
    pub default: Option<String>,
}

/// A type as far as it matters here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NumberShape {
    /// One number.
    Scalar,
    /// Three.
    Rgb,
    /// Another, as it is written.
    Other(String),
}

impl NumberShape {
    /// In words, for messages.
    pub fn words(&self) -> &str {
        match self {
            NumberShape::Scalar => "one number",
            NumberShape::Rgb => "three numbers",
            NumberShape::Other(written) if written.is_empty() => "nothing",
            NumberShape::Other(written) => written,
        }
    }
}

impl FunctionHead {
    /// Its name with the scopes around it: `brdf::schlick`.
    pub fn path(&self) -> String {
        let around = self.scope.iter().filter(|name| !name.is_empty());
        let around: String = around.map(|name| format!("{name}::")).collect();
        around + &self.name
    }
}

/// The function of a head, where it is one of a function.
pub fn function_head(head: &[Token], is_wgsl: bool) -> Option<FunctionHead> {
    let head = without_attributes(head);
    let name = if is_wgsl {
        head.iter().position(|token| token.text == "fn")? + 1
    } else {
        c_name(head)?
    };
    let open = name + 1;
    if head.get(open)?.text != "(" || !head[name].is_word() {
        return None;
    }
    let close = behind(head, open);
    let inside = head.get(open + 1..close - 1)?;
    let params = parts_between_commas(inside).into_iter();
    let params = params.filter(|part| !matches!(part, [] | [Token { text: "void", .. }]));
    let (mut params, mut result): (Vec<Parameter>, NumberShape) = if is_wgsl {
        let params = params.map(wgsl_parameter).collect();
        (params, wgsl_result(&head[close..]))
    } else {
        let params = params.map(c_parameter).collect();
        (params, shape(&without_qualifiers(&head[..name])))
    };
    let out = out_argument(&mut params, &mut result);
    Some(FunctionHead {
        name: head[name].text.to_owned(),
        line: head[name].line,
        column: head[name].column,
        params,
        result,
        out,
        scope: Vec::new(),
        needs_object: false,
    })
}

/// Removes from the arguments the one that receives the result of a function that returns nothing.
fn out_argument(params: &mut Vec<Parameter>, result: &mut NumberShape) -> Option<OutArgument> {
    let written = |param: &Parameter| match &param.shape {
        NumberShape::Other(written) => written.strip_prefix(OUT).map(str::to_owned),
        _ => None,
    };
    let mut all = params.iter().enumerate();
    let (place, ty) = all.find_map(|(place, param)| Some((place, written(param)?)))?;
    let is_alone = *result == NumberShape::Other("void".to_owned())
        && !params[place + 1..]
            .iter()
            .any(|param| written(param).is_some());
    let known = Some(shape(&ty)).filter(|known| !matches!(known, NumberShape::Other(_)));
    *result = known.filter(|_| is_alone)?;
    params.remove(place);
    Some(OutArgument { place, ty })
}

/// Precedes the type of an output argument.
const OUT: &str = "out ";

/// A head without `[numthreads(1, 1, 1)]` before it.
fn without_attributes<'t, 'a>(head: &'t [Token<'a>]) -> &'t [Token<'a>] {
    let mut at = 0;
    while head.get(at).is_some_and(|token| token.text == "[") {
        at = behind(head, at);
    }
    &head[at..]
}

/// The index of a function's name in C-like languages: before the first parenthesis, after a type.
fn c_name(head: &[Token]) -> Option<usize> {
    let open = head.iter().position(|token| token.text == "(")?;
    // `t[] = f(`, `cbuffer B : register(`
    let is_head = open >= 2 && type_end(&head[..open]).is_none();
    is_head.then(|| open - 1)
}

/// The index of what ends a name and its type: a value or a semantic. `::` in a type ends nothing.
fn type_end(part: &[Token]) -> Option<usize> {
    let is_colon = |at: usize| text_at(part, at) == ":";
    (0..part.len()).find(|&at| {
        let is_half = is_colon(at + 1) || at > 0 && is_colon(at - 1);
        part[at].text == "=" || is_colon(at) && !is_half
    })
}

fn joined(tokens: &[Token]) -> String {
    tokens.iter().map(|token| token.text).collect()
}

/// `name: type`, attributes before it.
fn wgsl_parameter(part: &[Token]) -> Parameter {
    let colon = part.iter().position(|token| token.text == ":");
    let colon = colon.unwrap_or(part.len());
    let name = part[..colon].last().map_or("", |token| token.text);
    let ty = joined(part.get(colon + 1..).unwrap_or(&[]));
    Parameter {
        name: name.to_owned(),
        shape: shape(&ty),
        ty,
        default: None,
    }
}

/// `-> type`, attributes before it.
fn wgsl_result(after: &[Token]) -> NumberShape {
    let arrow = after.iter().position(|token| token.text == ">");
    let written = arrow.map_or(&[][..], |arrow| &after[arrow + 1..]);
    shape(&joined(written))
}

/// `type name`, qualifiers before it, a semantic or a value after it.
fn c_parameter(part: &[Token]) -> Parameter {
    let end = type_end(part);
    let equals = part.iter().position(|token| token.text == "=");
    let default = equals.map(|equals| spaced(&part[equals + 1..]));
    let part = &part[..end.unwrap_or(part.len())];
    let name = part.iter().rposition(Token::is_word).unwrap_or(0);
    let has = |word: &str| holds(part, word);
    let is_array = name + 1 < part.len();
    let written = if is_array || has("inout") {
        joined(part)
    } else {
        without_qualifiers(&part[..name.min(part.len())])
    };
    let written = match written.strip_prefix("out") {
        Some(ty) if has("out") => format!("{OUT}{ty}"),
        _ => written,
    };
    Parameter {
        name: text_at(part, name).to_owned(),
        shape: shape(&written),
        ty: written,
        default,
    }
}

/// The text of tokens, with a space where two would merge.
fn spaced(tokens: &[Token]) -> String {
    let mut all = String::new();
    for (at, token) in tokens.iter().enumerate() {
        let is_behind_word = at > 0 && tokens[at - 1].is_word();
        if is_behind_word && token.is_word() {
            all.push(' ');
        }
        all += token.text;
    }
    all
}

/// Qualifiers, which say nothing of a type.
const QUALIFIERS: [&str; 18] = [
    "const",
    "in",
    "highp",
    "mediump",
    "lowp",
    "precise",
    "invariant",
    "static",
    "inline",
    "uniform",
    "export",
    "nointerpolation",
    "linear",
    "public",
    "private",
    "internal",
    "constexpr",
    "noinline",
];

fn without_qualifiers(tokens: &[Token]) -> String {
    let kept = tokens.iter().map(|token| token.text);
    kept.filter(|word| !QUALIFIERS.contains(word)).collect()
}

/// The type among words of types and qualifiers. None where there are only qualifiers.
pub type TypeShape = Option<NumberShape>;

/// The type that words stand for. None where one of them is neither a type nor a qualifier.
pub fn type_shape(words: &[&str]) -> Option<TypeShape> {
    let kept = words.iter().filter(|word| !QUALIFIERS.contains(word));
    let written: String = kept.copied().collect();
    match shape(&written) {
        _ if written.is_empty() => Some(None),
        NumberShape::Other(_) => None,
        known => Some(Some(known)),
    }
}

fn shape(written: &str) -> NumberShape {
    match written {
        "f32" | "float" | "half" | "min16float" => NumberShape::Scalar,
        "vec3<f32>" | "vec3f" | "vec3" | "float3" | "half3" | "min16float3" => NumberShape::Rgb,
        other => NumberShape::Other(other.to_owned()),
    }
}
