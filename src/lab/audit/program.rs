//! Makes a program of a user's text: a function of ours wraps theirs, so that all later steps know one kind of call.

use super::bind::{Bound, BoundArgument};
use super::directives;
use super::language::Language;
use super::loops::{MARK, TURNS, counted, counter};
use super::request::DefaultArgument;
use super::slice::Slice;
use crate::lab::gpu::{Argument as Value, Uniform};
use crate::lab::verify::function_head::NumberShape;
use crate::lab::verify::harness::{self, Call};
use crate::language::ir::{Param, Ty};
use crate::physics::num::Precision;

/// The name of our function around theirs, which is the one that [`crate::lab::cost::Probe`] measures.
pub const NAME: &str = "fg_measured";
/// Names of the program around the text that would collide in GLSL. The user's are renamed within their text.
const RENAMED: [&str; 3] = ["main", "cos_theta", "reflectance"];
/// The prefix of renamed names.
const THEIRS: &str = "fg_their_";

/// A user's text followed by our function.
#[derive(Clone, Debug)]
pub struct AuditProgram {
    /// Its language.
    pub language: Language,
    /// The text. The lines of theirs keep their numbers.
    pub text: String,
    /// The arguments of our function, the cosine first.
    pub params: Vec<Param>,
    /// The values of the arguments after the cosine.
    pub values: Vec<[f32; 3]>,
    /// Whether our function returns one number.
    pub is_scalar: bool,
    /// The precision of `half`.
    pub precision: Precision,
}

impl AuditProgram {
    /// The program of a text, and the one that is run, whose loops count their iterations.
    pub fn pair(language: Language, slice: &Slice, bound: &Bound) -> (AuditProgram, AuditProgram) {
        let plain = AuditProgram::new(language, slice, bound, false);
        let run = match counted(&slice.text, language) {
            Some(text) => {
                let counted = Slice {
                    text,
                    ..slice.clone()
                };
                AuditProgram::new(language, &counted, bound, true)
            }
            None => plain.clone(),
        };
        (plain, run)
    }

    /// The program whose cost is measured. A function of one channel is called once, for one channel.
    pub fn measured(language: Language, slice: &Slice, bound: &Bound) -> AuditProgram {
        if bound.is_one_channel() {
            let wrapper = |params: &[Param]| one_channel(language, bound, params);
            AuditProgram {
                is_scalar: true,
                ..AuditProgram::around(language, slice, &bound.first_channel(), false, wrapper)
            }
        } else {
            AuditProgram::new(language, slice, bound, false)
        }
    }

    fn new(language: Language, slice: &Slice, bound: &Bound, counts: bool) -> AuditProgram {
        let wrapper = |params: &[Param]| wrapper(language, bound, params, counts);
        AuditProgram::around(language, slice, bound, counts, wrapper)
    }

    /// The text followed by a function of ours.
    fn around(
        language: Language,
        slice: &Slice,
        bound: &Bound,
        counts: bool,
        wrapper: impl Fn(&[Param]) -> String,
    ) -> AuditProgram {
        let mut params = vec![param("cos_theta", Ty::Scalar)];
        let ty = |argument: &BoundArgument| {
            if argument.is_rgb || argument.is_split() {
                Ty::Vec3
            } else {
                Ty::Scalar
            }
        };
        let named = bound.arguments.iter().enumerate();
        params.extend(named.map(|(i, argument)| param(&format!("a{i}"), ty(argument))));
        let wrapper = defaults(bound) + &without_macros(slice, language) + &wrapper(&params);
        let counter = if counts {
            counter(language)
        } else {
            String::new()
        };
        let Slice { before, text, .. } = slice;
        let text = match language {
            Language::Gles | Language::Glsl => {
                format!("{counter}{}", framed(slice, &wrapper, language))
            }
            Language::Hlsl | Language::Slang if counts || !before.is_empty() => {
                format!("{counter}{before}#line 1\n{text}\n{wrapper}")
            }
            _ => format!("{text}\n{wrapper}{counter}"),
        };
        AuditProgram {
            language,
            text,
            params,
            values: bound.arguments.iter().map(|a| a.value).collect(),
            is_scalar: false,
            precision: match slice.half {
                Some(_) => Precision::F16,
                None => Precision::F32,
            },
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
        if self.language == Language::Glsl {
            return harness::desktop(&self.text, &call);
        }
        harness::program(self.language.target(), &self.text, &call)
            .expect("users' languages are run as text")
    }

    /// The arguments in the form that the harness binds.
    pub fn uniforms(&self) -> Vec<Uniform> {
        let harness = self.language.target().stack.harness();
        let named = harness.map_or("{name}", |harness| harness.uniform);
        let each = self.params[1..].iter().zip(&self.values);
        each.map(|(param, value)| Uniform {
            name: named.replace("{name}", &param.name),
            value: match param.ty {
                Ty::Vec3 => Value::Rgb(*value),
                _ => Value::Scalar(value[0]),
            },
        })
        .collect()
    }
}

/// The default values of arguments, declared where the text's macros are still defined.
fn defaults(bound: &Bound) -> String {
    let value = |one: &DefaultArgument| {
        format!(
            "static const {} fg_d{} = {};\n",
            one.ty, one.place, one.value
        )
    };
    bound.defaults.iter().map(value).collect()
}

fn param(name: &str, ty: Ty) -> Param {
    Param {
        name: name.to_owned(),
        ty,
    }
}

/// Their text in GLSL, with names renamed that the program around it uses.
fn framed(slice: &Slice, wrapper: &str, language: Language) -> String {
    let each = |line: fn(&str) -> String| RENAMED.map(line).concat();
    let define = each(|name| format!("#define {name} {THEIRS}{name}\n"));
    let undefine = each(|name| format!("#undef {name}\n"));
    // They mean nothing on the desktop, but something in Vulkan.
    let (define, undefine) = match language {
        Language::Glsl => (
            define + "#define mediump highp\n#define lowp highp\n",
            undefine + "#undef mediump\n#undef lowp\n",
        ),
        _ => (define, undefine),
    };
    let Slice { before, text, .. } = slice;
    format!("{define}{before}#line 1\n{text}\n{wrapper}{undefine}")
}

/// A compiler's message with the user's names as they wrote them.
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

/// Our function around theirs: it takes the cosine, then all others in order, and returns one number.
fn one_channel(language: Language, bound: &Bound, params: &[Param]) -> String {
    let (list, ty) = (declared(language, params), language.ty(Ty::Scalar));
    let called = called(language, &bound.first_channel(), "x");
    let (before, value) = (called.before, called.value);
    match language {
        Language::Wgsl => format!("fn {NAME}({list}) -> {ty} {{ {before}return {value}; }}\n"),
        _ => format!("{ty} {NAME}({list}) {{ {before}return {value}; }}\n"),
    }
}

/// As [`one_channel`], but it returns three numbers.
fn wrapper(language: Language, bound: &Bound, params: &[Param], counts: bool) -> String {
    let list = declared(language, params);
    let rgb = language.ty(Ty::Vec3);
    let constructor = bare_type(rgb);
    let (before, value) = if bound.is_per_channel() {
        let calls = ["x", "y", "z"].map(|channel| called(language, bound, channel));
        if bound.hidden.is_empty() && bound.function.out.is_none() {
            let calls = calls.map(|call| call.value);
            (
                String::new(),
                format!("{constructor}({})", calls.join(", ")),
            )
        } else {
            // Inputs from outside are set again before each call.
            let kept = calls.iter().zip(["x", "y", "z"]).map(|(call, channel)| {
                let kept = variable(language, Ty::Scalar, &format!("fg_{channel}"));
                format!("{}{kept} = {}; ", call.before, call.value)
            });
            let value = format!("{constructor}(fg_x, fg_y, fg_z)");
            (kept.collect(), value)
        }
    } else {
        let one = called(language, bound, "x");
        let value = match (bound.function.result == NumberShape::Scalar, language) {
            (true, Language::Hlsl | Language::Slang) => format!("({}).xxx", one.value),
            (true, _) => format!("{constructor}({})", one.value),
            (false, _) => one.value,
        };
        (one.before, value)
    };
    let body = match (counts, language) {
        (false, _) => format!("{before}return {value};"),
        (true, Language::Wgsl) => format!(
            "fg_turns = 0; {before}let fg_r = {value}; if fg_turns > {TURNS} {{ return {rgb}({MARK:e}); }} return fg_r;"
        ),
        (true, _) => format!(
            "fg_turns = 0; {before}{rgb} fg_r = {value}; if (fg_turns > {TURNS}) {{ fg_r = {constructor}({MARK:e}, {MARK:e}, {MARK:e}); }} return fg_r;"
        ),
    };
    match language {
        Language::Wgsl => format!("fn {NAME}({list}) -> {rgb} {{ {body} }}\n"),
        _ => format!("{rgb} {NAME}({list}) {{ {body} }}\n"),
    }
}

/// A type without its precision.
fn bare_type(ty: &str) -> &str {
    ty.trim_start_matches("highp ")
}

/// A variable as it is declared before its value.
fn variable(language: Language, ty: Ty, name: &str) -> String {
    match language {
        Language::Wgsl => format!("let {name}"),
        _ => format!("{} {name}", language.ty(ty)),
    }
}

/// A call of theirs.
struct CallText {
    /// The statements before it.
    before: String,
    /// Its result.
    value: String,
}

/// The call of theirs for a channel.
fn called(language: Language, bound: &Bound, channel: &str) -> CallText {
    let function = &bound.function;
    let value = |i: usize, argument: &BoundArgument| {
        if argument.is_split() {
            format!("fg_a{i}.{channel}")
        } else {
            format!("fg_a{i}")
        }
    };
    let others: Vec<String> = bound
        .arguments
        .iter()
        .enumerate()
        .map(|(i, argument)| value(i, argument))
        .collect();
    let mut before = String::new();
    let (others, values) = others.split_at(others.len() - bound.hidden.len());
    let inputs = bound.hidden.iter().zip(values);
    for (input, value) in inputs {
        for (place, channel) in input.places() {
            let value = match channel {
                "" => value.clone(),
                channel => format!("{value}.{channel}"),
            };
            before += &match &input.cast {
                Some(ty) => format!("{place} = {ty}({value}); "),
                None => format!("{place} = {value}; "),
            };
        }
    }
    let default = |place: usize| {
        let name = &function.params[place].name;
        let mut all = bound.defaults.iter();
        all.find(|one| one.name == *name)
    };
    let mut others = others.iter().cloned();
    let argument = |place: usize| match default(place) {
        _ if place == bound.cosine => "fg_cos_theta".to_owned(),
        Some(one) => format!("fg_d{}", one.place),
        None => others.next().unwrap_or_default(),
    };
    let mut all: Vec<String> = (0..function.params.len()).map(argument).collect();
    let name = function.path();
    let Some(out) = &function.out else {
        let value = format!("{name}({})", all.join(", "));
        return CallText { before, value };
    };
    let kept = format!("fg_out_{channel}");
    all.insert(out.place, kept.clone());
    before += &format!("{} {kept}; {name}({}); ", out.ty, all.join(", "));
    let ty = match function.result {
        NumberShape::Scalar => Ty::Scalar,
        _ => Ty::Vec3,
    };
    let value = format!("{}({kept})", bare_type(language.ty(ty)));
    CallText { before, value }
}

/// Undefines their macros before our text follows, so that no macro changes its meaning.
fn without_macros(slice: &Slice, language: Language) -> String {
    if !language.has_preprocessor() {
        return String::new();
    }
    let names = directives::macros(&format!("{}{}", slice.before, slice.text)).into_iter();
    names
        .filter(|name| !RENAMED.contains(&name.as_str()))
        .map(|name| format!("#undef {name}\n"))
        .collect()
}
