//! GLSL 4.50, as desktop OpenGL and Vulkan front ends take it.

use crate::ir::Op;
use crate::num::Precision;

use super::spelling::{C_FAMILY, Form, Spelling};
use super::target::{Finish, Frame, GLSLANG, HalfText, Page, Target, Validator};

/// The record of this target.
pub static TARGET: Target = Target {
    name: "glsl",
    summary: "GLSL 4.50 for desktop OpenGL and for Vulkan through glslang",
    source: "The OpenGL Shading Language 4.50, Khronos, https://registry.khronos.org/OpenGL/specs/gl/GLSLangSpec.4.50.pdf",
    extension: "glsl",
    by_default: false,
    spelling: SPELLING,
    half: HalfText {
        spelling: HALF_SPELLING,
        directive: "",
        remark: "mediump says that half precision will do: by glslang RelaxedPrecision in Vulkan, nothing in OpenGL.",
        validators: VALIDATORS,
    },
    reserved: &[RESERVED],
    reserved_prefixes: &["gl_"],
    pages: &[Page {
        suffix: "",
        template: include_str!("../../templates/glsl.tera"),
    }],
    catalogue: Some(include_str!("../../templates/catalogue.glsl.tera")),
    finish: Finish::Text,
    validators: VALIDATORS,
};

const VALIDATORS: &[Validator] = &[Validator {
    name: "glslang",
    compiler: &GLSLANG,
    options: "-S frag FILE",
    frame: Frame {
        beginnings: &["#version 450\n#line 1\n"],
        ending: ENDING,
    },
}];

/// Shared with GLSL ES.
pub(super) const ENDING: &str = "
uniform highp sampler2D a_texture;
in highp vec3 at;
out highp vec4 colour;
void main() {
    highp vec3 sum = vec3(0.0);
CALLS
    colour = vec4(sum, 1.0);
}
";

/// Shared with GLSL ES.
pub(super) const SPELLING: Spelling = Spelling {
    differs: &[
        (Op::Saturate, Form::CallUnit("clamp")),
        (Op::InverseSqrt, Form::Call("inversesqrt")),
    ],
    ..C_FAMILY
};

/// Shared with GLSL ES: each declaration says it, since a statement `precision` would leak into the including shader.
pub(super) const HALF_SPELLING: Spelling = Spelling {
    precision: Precision::F16,
    param: "mediump {type} {name}",
    texture: "highp sampler2D {name}",
    local: "mediump {type} {name} = {value};",
    head: "mediump {type} {name}({params})",
    ..SPELLING
};

/// Keywords and words kept for the future, from section 3.6 of GLSL 4.50 and 3.7 of GLSL ES 3.00, and the built-in
/// functions that a function of the same name would hide.
#[rustfmt::skip]
pub(super) const RESERVED: &[&str] = &[
    "attribute", "const", "uniform", "varying", "buffer", "shared", "coherent", "volatile", "restrict", "readonly",
    "writeonly", "atomic_uint", "layout", "centroid", "flat", "smooth", "noperspective", "patch", "sample", "break",
    "continue", "do", "for", "while", "switch", "case", "default", "if", "else", "subroutine", "in", "out", "inout",
    "float", "double", "int", "void", "bool", "true", "false", "invariant", "precise", "discard", "return", "mat2",
    "mat3", "mat4", "dmat2", "dmat3", "dmat4", "mat2x2", "mat2x3", "mat2x4", "mat3x2", "mat3x3", "mat3x4", "mat4x2",
    "mat4x3", "mat4x4", "vec2", "vec3", "vec4", "ivec2", "ivec3", "ivec4", "bvec2", "bvec3", "bvec4", "dvec2",
    "dvec3", "dvec4", "uint", "uvec2", "uvec3", "uvec4", "lowp", "mediump", "highp", "precision", "sampler1D",
    "sampler2D", "sampler3D", "samplerCube", "sampler2DShadow", "samplerCubeShadow", "sampler2DArray", "struct",
    "common", "partition", "active", "asm", "class", "union", "enum", "typedef", "template", "this", "packed",
    "resource", "goto", "inline", "noinline", "public", "static", "extern", "external", "interface", "long", "short",
    "half", "fixed", "unsigned", "superp", "input", "output", "hvec2", "hvec3", "hvec4", "fvec2", "fvec3", "fvec4",
    "filter", "image1D", "image2D", "image3D", "imageCube", "sizeof", "cast", "namespace", "using", "main", "radians",
    "degrees", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "pow", "exp", "log", "exp2",
    "log2", "sqrt", "inversesqrt", "abs", "sign", "floor", "trunc", "round", "ceil", "fract", "mod", "modf", "min",
    "max", "clamp", "mix", "step", "smoothstep", "isnan", "isinf", "fma", "length", "distance", "dot", "cross",
    "normalize", "reflect", "refract", "any", "all", "not", "texture", "transpose", "inverse", "determinant",
    "sampler", "samplerShadow", "texture1D", "texture2D", "texture3D", "textureCube", "subpassInput",
];
