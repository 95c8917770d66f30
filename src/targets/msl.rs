//! The Metal Shading Language. Names of the standard library are written in full, so that an including file need not
//! (and may) say `using namespace metal`.

use crate::ir::Op;
use crate::num::Precision;

use super::spelling::{C_FAMILY, Form, Spelling};
use super::target::{Compiler, Finish, Frame, HalfText, Page, Target, Validator};

/// The record of this target.
pub static TARGET: Target = Target {
    name: "msl",
    summary: "the Metal Shading Language, version 1.2 and later",
    source: "Metal Shading Language Specification, Apple, https://developer.apple.com/metal/Metal-Shading-Language-Specification.pdf",
    extension: "metal",
    by_default: false,
    spelling: Spelling {
        rgb: "metal::float3",
        suffix: "f",
        differs: &FORMS,
        ..SHARED
    },
    half: HalfText {
        spelling: Spelling {
            precision: Precision::F16,
            scalar: "half",
            rgb: "metal::half3",
            suffix: "h",
            differs: &HALF_FORMS,
            ..SHARED
        },
        directive: "",
        remark: "half has 16 bits.",
        validators: VALIDATORS,
    },
    reserved: &[RESERVED],
    reserved_prefixes: &[],
    pages: &[Page {
        suffix: "",
        template: include_str!("../../templates/msl.tera"),
    }],
    catalogue: Some(include_str!("../../templates/catalogue.msl.tera")),
    finish: Finish::Text,
    validators: VALIDATORS,
};

const VALIDATORS: &[Validator] = &[Validator {
    name: "metal",
    compiler: &METAL,
    options: "-sdk macosx metal -std=macos-metal1.2 -c FILE -o OUT",
    frame: Frame::NONE,
}];

/// What both precisions share.
const SHARED: Spelling = Spelling {
    texture: "metal::texture2d<float> {name}, metal::sampler {name}_sampler",
    head: "inline {type} {name}({params})",
    mixed_min_max: false,
    ..C_FAMILY
};

const FORMS: [(Op, Form); 11] = forms(
    "metal::float3",
    "{0}.sample({0}_sampler, metal::float2({1}, {2}), metal::level(0.0f)).rgb",
);

const HALF_FORMS: [(Op, Form); 11] = forms(
    "metal::half3",
    "metal::half3({0}.sample({0}_sampler, metal::float2({1}, {2}), metal::level(0.0f)).rgb)",
);

/// The library's functions take both kinds of number.
const fn forms(rgb: &'static str, sample: &'static str) -> [(Op, Form); 11] {
    [
        (Op::Splat, Form::Call(rgb)),
        (Op::Compose, Form::Call(rgb)),
        (Op::Abs, Form::Call("metal::abs")),
        (Op::Min, Form::Call("metal::min")),
        (Op::Max, Form::Call("metal::max")),
        (Op::Saturate, Form::Call("metal::saturate")),
        (Op::Sqrt, Form::Call("metal::sqrt")),
        (Op::InverseSqrt, Form::Call("metal::rsqrt")),
        (Op::Exp2, Form::Call("metal::exp2")),
        (Op::Log2, Form::Call("metal::log2")),
        (Op::Sample, Form::Pattern(sample)),
    ]
}

/// Apple's compiler of Metal.
static METAL: Compiler = Compiler {
    name: "metal",
    command: Some("xcrun"),
    get: "Xcode, on macOS only",
};

/// C++14's keywords, Metal's own, and the library names that a file with `using namespace metal` would clash with.
#[rustfmt::skip]
const RESERVED: &[&str] = &[
    "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break", "case", "catch", "char",
    "char16_t", "char32_t", "class", "compl", "const", "constexpr", "const_cast", "continue", "decltype", "default",
    "delete", "do", "double", "dynamic_cast", "else", "enum", "explicit", "export", "extern", "false", "float", "for",
    "friend", "goto", "if", "inline", "int", "long", "mutable", "namespace", "new", "noexcept", "not", "not_eq",
    "nullptr", "operator", "or", "or_eq", "private", "protected", "public", "register", "reinterpret_cast", "return",
    "short", "signed", "sizeof", "static", "static_assert", "static_cast", "struct", "switch", "template", "this",
    "thread", "thread_local", "throw", "true", "try", "typedef", "typeid", "typename", "union", "unsigned", "using",
    "virtual", "void", "volatile", "wchar_t", "while", "xor", "xor_eq", "kernel", "vertex", "fragment", "device",
    "constant", "threadgroup", "half", "half2", "half3", "half4", "float2", "float3", "float4", "uint", "sampler",
    "texture", "texture2d", "metal", "main", "abs", "acos", "all", "any", "asin", "atan", "ceil", "clamp", "cos",
    "cross", "distance", "dot", "exp", "exp2", "fabs", "floor", "fma", "fract", "isnan", "length", "log", "log2", "max",
    "min", "mix", "normalize", "pow", "powr", "reflect", "refract", "round", "rsqrt", "saturate", "select", "sign",
    "sin", "smoothstep", "sqrt", "step", "tan", "trunc",
];
