//! A user's text made a program: a function of ours around theirs, so that all that comes after knows one kind of call.

use crate::emit::shader_words::tokens;
use crate::gpu::{Argument as Value, Uniform};
use crate::ir::{Param, Ty};
use crate::num::Precision;
use crate::verify::harness::{self, Call};

use super::bind::{Bound, BoundArgument};
use super::directives;
use super::error::Error;
use super::language::{Language, bare};
use super::loops::{MARK, TURNS, counted, counter, is_in_macro};
use super::scan::{NumberShape, without_stage};

/// What our function around theirs is called: as [`crate::cost::Probe`] calls what it measures.
pub const NAME: &str = "fg_measured";
/// Names of the program around it that GLSL cannot keep apart: theirs are renamed while their text is read.
const RENAMED: [&str; 3] = ["main", "cos_theta", "reflectance"];
/// What goes before them.
const THEIRS: &str = "fg_their_";

/// A text with our function behind it.
#[derive(Clone, Debug)]
pub struct AuditProgram {
    /// Its language.
    pub language: Language,
    /// The text. The lines of theirs keep their numbers.
    pub text: String,
    /// What our function takes, the cosine first.
    pub params: Vec<Param>,
    /// The values of the others.
    pub values: Vec<[f32; 3]>,
    /// Whether our function gives one number.
    pub is_scalar: bool,
}

impl AuditProgram {
    /// The program of a text, and the one that is run: its loops count their turns.
    pub fn pair(language: Language, text: &str, bound: &Bound) -> (AuditProgram, AuditProgram) {
        let plain = AuditProgram::new(language, text, bound, false);
        let run = match counted(text, language) {
            Some(counted) => AuditProgram::new(language, &counted, bound, true),
            None => plain.clone(),
        };
        (plain, run)
    }

    /// The program whose cost is counted: a function of one channel is called once, for one channel.
    pub fn measured(language: Language, text: &str, bound: &Bound) -> AuditProgram {
        match bound.is_one_channel() {
            true => {
                let wrapper = |params: &[Param]| one_channel(language, bound, params);
                AuditProgram {
                    is_scalar: true,
                    ..AuditProgram::around(language, text, &bound.first_channel(), false, wrapper)
                }
            }
            false => AuditProgram::new(language, text, bound, false),
        }
    }

    fn new(language: Language, text: &str, bound: &Bound, counts: bool) -> AuditProgram {
        let wrapper = |params: &[Param]| wrapper(language, bound, params, counts);
        AuditProgram::around(language, text, bound, counts, wrapper)
    }

    /// The text with a function of ours behind it.
    fn around(
        language: Language,
        text: &str,
        bound: &Bound,
        counts: bool,
        wrapper: impl Fn(&[Param]) -> String,
    ) -> AuditProgram {
        let mut params = vec![param("cos_theta", Ty::Scalar)];
        let ty = |argument: &BoundArgument| match argument.is_rgb || argument.is_split() {
            true => Ty::Rgb,
            false => Ty::Scalar,
        };
        let named = bound.arguments.iter().enumerate();
        params.extend(named.map(|(i, argument)| param(&format!("a{i}"), ty(argument))));
        let wrapper = without_macros(text, language) + &wrapper(&params);
        let counter = match counts {
            true => counter(language),
            false => String::new(),
        };
        let text = match (language, counts) {
            (Language::Gles, _) => format!("{counter}{}", framed(text, &wrapper)),
            (Language::Hlsl | Language::Slang, true) => {
                format!("{counter}#line 1\n{text}\n{wrapper}")
            }
            _ => format!("{text}\n{wrapper}{counter}"),
        };
        AuditProgram {
            language,
            text,
            params,
            values: bound.arguments.iter().map(|a| a.value).collect(),
            is_scalar: false,
        }
    }

    /// The whole program that is run over cosines.
    pub fn harnessed(&self) -> String {
        let call = Call {
            name: NAME,
            params: &self.params,
            is_scalar: false,
            precision: Precision::F32,
        };
        harness::program(self.language.target(), &self.text, &call)
            .expect("users' languages are run as text")
    }

    /// The arguments as the harness binds them.
    pub fn uniforms(&self) -> Vec<Uniform> {
        let harness = self.language.target().stack.harness();
        let named = harness.map_or("{name}", |harness| harness.uniform);
        let each = self.params[1..].iter().zip(&self.values);
        each.map(|(param, value)| Uniform {
            name: named.replace("{name}", &param.name),
            value: match param.ty {
                Ty::Rgb => Value::Rgb(*value),
                _ => Value::Scalar(value[0]),
            },
        })
        .collect()
    }
}

fn param(name: &str, ty: Ty) -> Param {
    Param {
        name: name.to_owned(),
        ty,
    }
}

/// Their text in GLSL: their shader around it is left out, names that the program around it has are theirs under other names,
/// and it has a version already.
fn framed(text: &str, wrapper: &str) -> String {
    let each = |line: fn(&str) -> String| RENAMED.map(line).concat();
    let define = each(|name| format!("#define {name} {THEIRS}{name}\n"));
    let undefine = each(|name| format!("#undef {name}\n"));
    let text = without_stage(text);
    let kept: Vec<&str> = text
        .lines()
        .map(|line| if is_head(line) { "" } else { line })
        .collect();
    format!("{define}#line 1\n{}\n{wrapper}{undefine}", kept.join("\n"))
}

/// Whether a line may stand at the head of a program only.
fn is_head(line: &str) -> bool {
    let directive = line.trim_start().strip_prefix('#').map(str::trim_start);
    let heads = ["version", "extension"];
    directive.is_some_and(|word| heads.iter().any(|head| word.starts_with(head)))
}

/// Words of compilers, with their names as they wrote them.
pub fn own_names(words: &str) -> String {
    words.replace(THEIRS, "")
}

/// The arguments of our function, as the language declares them.
fn declared(language: Language, params: &[Param]) -> String {
    let declared = |param: &Param| {
        let (name, ty) = (format!("fg_{}", param.name), language.ty(param.ty));
        match language {
            Language::Wgsl => format!("{name}: {ty}"),
            _ => format!("{ty} {name}"),
        }
    };
    let list: Vec<String> = params.iter().map(declared).collect();
    list.join(", ")
}

/// Our function around theirs: the cosine, then all others in order; one number out.
fn one_channel(language: Language, bound: &Bound, params: &[Param]) -> String {
    let (list, ty) = (declared(language, params), language.ty(Ty::Scalar));
    let call = call(&bound.first_channel(), "x");
    match language {
        Language::Wgsl => format!("fn {NAME}({list}) -> {ty} {{ return {call}; }}\n"),
        _ => format!("{ty} {NAME}({list}) {{ return {call}; }}\n"),
    }
}

/// The same with three numbers out.
fn wrapper(language: Language, bound: &Bound, params: &[Param], counts: bool) -> String {
    let list = declared(language, params);
    let rgb = language.ty(Ty::Rgb);
    let constructor = rgb.trim_start_matches("highp ");
    let value = if bound.is_per_channel() {
        let calls = ["x", "y", "z"].map(|channel| call(bound, channel));
        format!("{constructor}({})", calls.join(", "))
    } else if bound.function.result == NumberShape::Scalar {
        let one = call(bound, "x");
        match language {
            Language::Hlsl | Language::Slang => format!("({one}).xxx"),
            _ => format!("{constructor}({one})"),
        }
    } else {
        call(bound, "x")
    };
    let body = match (counts, language) {
        (false, _) => format!("return {value};"),
        (true, Language::Wgsl) => format!(
            "fg_turns = 0; let fg_r = {value}; if fg_turns > {TURNS} {{ return {rgb}({MARK:e}); }} return fg_r;"
        ),
        (true, _) => format!(
            "fg_turns = 0; {rgb} fg_r = {value}; if (fg_turns > {TURNS}) {{ fg_r = {constructor}({MARK:e}, {MARK:e}, {MARK:e}); }} return fg_r;"
        ),
    };
    match language {
        Language::Wgsl => format!("fn {NAME}({list}) -> {rgb} {{ {body} }}\n"),
        _ => format!("{rgb} {NAME}({list}) {{ {body} }}\n"),
    }
}

/// The call of theirs for a channel.
fn call(bound: &Bound, channel: &str) -> String {
    let mut others = bound.arguments.iter().enumerate();
    let argument = |place: usize| {
        if place == bound.cosine {
            return "fg_cos_theta".to_owned();
        }
        let Some((i, argument)) = others.next() else {
            return String::new();
        };
        match argument.is_split() {
            true => format!("fg_a{i}.{channel}"),
            false => format!("fg_a{i}"),
        }
    };
    let all: Vec<String> = (0..bound.function.params.len()).map(argument).collect();
    format!("{}({})", bound.function.name, all.join(", "))
}

/// What ends a line in WGSL, and is a character like others elsewhere.
fn is_line_end(c: char) -> bool {
    ['\u{2028}', '\u{2029}'].contains(&c)
}

/// The line at which comments could be read in two ways, and why: what is hidden from us must be hidden from compilers.
fn ambiguous(text: &str) -> Option<(usize, &'static str)> {
    let code = bare(text, false);
    let lines = text.lines().zip(code.lines()).enumerate();
    let mut found = lines.filter_map(|(number, (line, code))| {
        let has_comment = line.contains("/*") || line.contains("//");
        let what = if line.trim_end().ends_with('\\') || line.contains("??/") {
            "the line goes on behind its end: write it in one"
        } else if has_comment && code.contains(['"', '\'']) {
            "a comment stands beside a string: take them apart"
        } else {
            return None;
        };
        Some((number + 1, what))
    });
    found.next().or_else(|| nested(text))
}

/// The line at which a comment begins in another: in some languages the first end of one ends both.
fn nested(text: &str) -> Option<(usize, &'static str)> {
    let (mut rest, mut line) = (text, 1);
    while let Some(start) = rest.find("/*") {
        let begins = rest[..start].rfind('\n').map_or(0, |end| end + 1);
        let (before, after) = rest.split_at(start);
        line += before.matches('\n').count();
        if before[begins..].contains("//") {
            // It stands in a comment that ends with its line.
            rest = after.split_once('\n').map_or("", |(_, rest)| rest);
            line += usize::from(!rest.is_empty());
            continue;
        }
        let inner = &after[2..];
        let end = inner.find("*/").unwrap_or(inner.len());
        if inner[..end].contains("/*") {
            return Some((
                line,
                "a comment begins in a comment: let the first end before",
            ));
        }
        line += inner[..end].matches('\n').count();
        rest = inner.get(end + 2..).unwrap_or("");
    }
    None
}

/// Refuses what no program can be made of.
///
/// # Errors
/// A name that is ours, a file that asks for others, or signs that are no text.
pub fn check(file: &str, text: &str, language: Language) -> Result<(), Error> {
    let refuse = |line: usize, column: usize, what: String| {
        Err(Error::Text {
            file: file.to_owned(),
            line,
            column,
            what,
        })
    };
    for (number, line) in text.lines().enumerate() {
        let control = line
            .chars()
            .position(|c| c.is_control() && c != '\t' || is_line_end(c));
        if let Some(at) = control {
            let what = "this is not text, or ends a line in some languages only";
            return refuse(number + 1, at + 1, what.to_owned());
        }
    }
    if let Some((line, what)) = language
        .has_preprocessor()
        .then(|| ambiguous(text))
        .flatten()
    {
        return refuse(line, 1, what.to_owned());
    }
    if language.has_preprocessor() && is_in_macro(text) {
        let what = "a macro holds a loop, or joins words with ##: write it out, so that its turns can be counted";
        return refuse(1, 1, what.to_owned());
    }
    let code = bare(text, false);
    let tokens = tokens(&code);
    for token in &tokens {
        let ours = ["fg_", "FgParameters", "FgArguments"];
        if ours.iter().any(|name| token.text.starts_with(name)) {
            let what = format!(
                "the name `{}` is one of the program around it; names that begin with `fg_` are not free",
                token.text
            );
            return refuse(token.line, token.column, what);
        }
    }
    let found = language
        .has_preprocessor()
        .then(|| directives::fault(text))
        .flatten();
    found.map_or(Ok(()), |(line, column, what)| refuse(line, column, what))
}

/// Refuses a text in which the name of the audited function means another thing to compilers.
///
/// # Errors
/// A macro has that name.
pub fn check_name(file: &str, text: &str, language: Language, name: &str) -> Result<(), Error> {
    let found = language
        .has_preprocessor()
        .then(|| directives::redefinition(text, name))
        .flatten();
    found.map_or(Ok(()), |(line, column, what)| {
        Err(Error::Text {
            file: file.to_owned(),
            line,
            column,
            what,
        })
    })
}

/// Takes their macros away before our text goes on: it means what it says, whatever they are named.
fn without_macros(text: &str, language: Language) -> String {
    if !language.has_preprocessor() {
        return String::new();
    }
    let names = directives::macros(text).into_iter();
    names
        .filter(|name| !RENAMED.contains(&name.as_str()))
        .map(|name| format!("#undef {name}\n"))
        .collect()
}
