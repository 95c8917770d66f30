//! The Metal Shading Language. Names of the standard library are qualified, so that an including file may say
//! `using namespace metal` but need not.

use super::spelling::{C_FAMILY, Form, Spelling};
use super::target::{Compiler, Finish, Frame, HalfText, Page, Stack, Target, Validator};
use crate::language::ir::Op;
use crate::language::methods::Gpu;
use crate::physics::num::Precision;

/// The record of this target.
pub static TARGET: Target = Target {
    name: "msl",
    summary: "the Metal Shading Language, version 1.2 and later",
    source: "Metal Shading Language Specification, Apple, https://developer.apple.com/metal/Metal-Shading-Language-Specification.pdf",
    extension: "metal",
    other_extensions: &[],
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
        template: include_str!("../../../templates/msl.tera"),
    }],
    catalogue: Some(include_str!("../../../templates/catalogue.msl.tera")),
    finish: Finish::Text,
    validators: VALIDATORS,
    nests_comments: false,
    stack: Stack::None,
    gpu: Gpu::DESKTOP,
};

const VALIDATORS: &[Validator] = &[Validator {
    name: "metal",
    compiler: &METAL,
    options: "-sdk macosx metal -std=macos-metal1.2 -c FILE -o OUT",
    frame: Frame::NONE,
}];

/// The spelling that both precisions share.
const SHARED: Spelling = Spelling {
    texture: "metal::texture2d<float> {name}, metal::sampler {name}_sampler",
    cube: "metal::texturecube<float> {name}, metal::sampler {name}_sampler",
    vec2: "metal::float2",
    vec4: "metal::float4",
    mat4: "metal::float4x4",
    head: "inline {type} {name}({params})",
    mixed_min_max: false,
    ..C_FAMILY
};

const FORMS: [(Op, Form); 17] = forms(
    "metal::float3",
    "{0}.sample({0}_sampler, metal::float2({1}, {2}), metal::level(0.0f)).rgb",
);

const HALF_FORMS: [(Op, Form); 17] = forms(
    "metal::half3",
    "metal::half3({0}.sample({0}_sampler, metal::float2({1}, {2}), metal::level(0.0f)).rgb)",
);

/// The library's functions accept both precisions.
const fn forms(rgb: &'static str, sample: &'static str) -> [(Op, Form); 17] {
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
        (Op::Sin, Form::Call("metal::sin")),
        (Op::Cos, Form::Call("metal::cos")),
        (Op::Dot, Form::Call("metal::dot")),
        (
            Op::Transform,
            Form::Pattern("({0} * metal::float4({1}, 1.0f)).{w}"),
        ),
        (Op::Sample, Form::Pattern(sample)),
        (
            Op::SampleAlpha,
            Form::Pattern("{0}.sample({0}_sampler, metal::float2({1}, {2}), metal::level(0.0f)).a"),
        ),
        (
            Op::SampleCube,
            Form::Pattern("{0}.sample({0}_sampler, {1}, metal::level(0.0f)).rgb"),
        ),
    ]
}

/// Apple's Metal compiler.
static METAL: Compiler = Compiler {
    name: "metal",
    command: Some("xcrun"),
    get: "Xcode, on macOS only",
};

/// C++14's keywords, Metal's own, and the library names that would clash in a file with `using namespace metal`.
#[rustfmt::skip]
const RESERVED: &[&str] = &[
    "abs", "acos", "alignas", "alignof", "all", "and", "and_eq", "any", "as_type", "asin", "asm", "assert", "atan",
    "atomic", "atomic_bool", "atomic_float", "atomic_int", "atomic_uint", "atomic_ulong", "auto", "bfloat", "bfloat2",
    "bfloat3", "bfloat4", "bitand", "bitor", "bool", "bool2", "bool3", "bool4", "break", "case", "catch", "ceil",
    "char", "char16_t", "char2", "char3", "char32_t", "char4", "CHAR_BIT", "CHAR_MAX", "CHAR_MIN", "clamp", "class",
    "compl", "complex", "const", "const_cast", "constant", "constexpr", "continue", "cos", "cross", "DBL_DECIMAL_DIG",
    "DBL_DIG", "DBL_EPSILON", "DBL_MANT_DIG", "DBL_MAX", "DBL_MAX_10_EXP", "DBL_MAX_EXP", "DBL_MIN", "DBL_MIN_10_EXP",
    "DBL_MIN_EXP", "DBL_RADIX", "decltype", "default", "DefaultConstructible", "delete", "device", "distance", "do",
    "dot", "double", "dynamic_cast", "else", "enum", "exp", "exp2", "explicit", "export", "extern", "fabs", "false",
    "float", "float2", "float2x2", "float2x3", "float2x4", "float3", "float3x2", "float3x3", "float3x4", "float4",
    "float4x2", "float4x3", "float4x4", "floor", "FLT_DECIMAL_DIG", "FLT_DIG", "FLT_EPSILON", "FLT_MANT_DIG", "FLT_MAX",
    "FLT_MAX_10_EXP", "FLT_MAX_EXP", "FLT_MIN", "FLT_MIN_10_EXP", "FLT_MIN_EXP", "FLT_RADIX", "fma", "for", "FP_ILOGB0",
    "FP_ILOGBNAN", "fract", "fragment", "friend", "goto", "half", "half2", "half2x2", "half2x3", "half2x4", "half3",
    "half3x2", "half3x3", "half3x4", "half4", "half4x2", "half4x3", "half4x4", "HALF_DECIMAL_DIG", "HALF_DIG",
    "HALF_EPSILON", "HALF_MANT_DIG", "HALF_MAX", "HALF_MAX_10_EXP", "HALF_MAX_EXP", "HALF_MIN", "HALF_MIN_10_EXP",
    "HALF_MIN_EXP", "HALF_RADIX", "HUGE_VAL", "HUGE_VALF", "HUGE_VALH", "if", "imaginary", "INFINITY", "inline", "int",
    "int16_t", "int2", "int3", "int32_t", "int4", "int64_t", "int8_t", "INT_MAX", "INT_MIN", "isnan", "kernel",
    "length", "llong", "LLONG_MAX", "LLONG_MIN", "log", "log2", "long", "long2", "long3", "long4", "LONG_MAX",
    "LONG_MIN", "M_1_PI", "M_1_PI_F", "M_1_PI_H", "M_2_PI", "M_2_PI_F", "M_2_PI_H", "M_2_SQRTPI", "M_2_SQRTPI_F",
    "M_2_SQRTPI_H", "M_E", "M_E_F", "M_E_H", "M_LN10", "M_LN10_F", "M_LN10_H", "M_LN2", "M_LN2_F", "M_LN2_H",
    "M_LOG10E", "M_LOG10E_F", "M_LOG10E_H", "M_LOG2E", "M_LOG2E_F", "M_LOG2E_H", "M_PI", "M_PI_2", "M_PI_2_F",
    "M_PI_2_H", "M_PI_4", "M_PI_4_F", "M_PI_4_H", "M_PI_F", "M_PI_H", "M_SQRT1_2", "M_SQRT1_2_F", "M_SQRT1_2_H",
    "M_SQRT2", "M_SQRT2_F", "M_SQRT2_H", "main", "matrix", "max", "MAXDOUBLE", "MAXFLOAT", "MAXHALF", "metal", "min",
    "mix", "mutable", "namespace", "NAN", "new", "noexcept", "normalize", "not", "not_eq", "nullptr", "object_data",
    "operator", "or", "or_eq", "packed_bfloat2", "packed_bfloat3", "packed_bfloat4", "packed_bool2", "packed_bool3",
    "packed_bool4", "packed_char2", "packed_char3", "packed_char4", "packed_float2", "packed_float3", "packed_float4",
    "packed_half2", "packed_half3", "packed_half4", "packed_int2", "packed_int3", "packed_int4", "packed_long2",
    "packed_long3", "packed_long4", "packed_short2", "packed_short3", "packed_short4", "packed_uchar2", "packed_uchar3",
    "packed_uchar4", "packed_uint2", "packed_uint3", "packed_uint4", "packed_ushort2", "packed_ushort3",
    "packed_ushort4", "packed_vec", "pow", "powr", "private", "protected", "ptrdiff_t", "public", "quad", "ray_data",
    "reflect", "refract", "register", "reinterpret_cast", "restrict", "return", "round", "rsqrt", "sampler", "saturate",
    "SCHAR_MAX", "SCHAR_MIN", "select", "short", "short2", "short3", "short4", "SHRT_MAX", "SHRT_MIN", "sign", "signed",
    "sin", "size_t", "sizeof", "smoothstep", "sqrt", "static", "static_assert", "static_cast", "step", "struct",
    "switch", "tan", "template", "texture", "texture2d", "this", "thread", "thread_local", "threadgroup",
    "threadgroup_imageblock", "throw", "true", "trunc", "try", "typedef", "typeid", "typename", "uchar", "uchar2",
    "uchar3", "uchar4", "UCHAR_MAX", "uint", "uint16_t", "uint2", "uint3", "uint32_t", "uint4", "uint64_t", "uint8_t",
    "UINT_MAX", "ullong", "ULLONG_MAX", "ulong2", "ulong3", "ulong4", "ULONG_MAX", "union", "unsigned", "ushort",
    "ushort2", "ushort3", "ushort4", "USHRT_MAX", "using", "vec", "vertex", "virtual", "void", "volatile", "wchar_t",
    "while", "xor", "xor_eq",
];
