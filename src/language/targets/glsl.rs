//! GLSL 4.50, for desktop OpenGL and for front ends of Vulkan.

use super::spelling::{C_FAMILY, Form, Spelling};
use super::target::{
    Finish, Frame, GLSLANG, HalfText, Harness, Page, PointHarness, Stack, Target, Validator,
};
use crate::language::ir::Op;
use crate::language::methods::Gpu;
use crate::physics::num::Precision;

/// The record of this target.
pub static TARGET: Target = Target {
    name: "glsl",
    summary: "GLSL 4.50 for desktop OpenGL and for Vulkan through glslang",
    source: "The OpenGL Shading Language 4.50, Khronos, https://registry.khronos.org/OpenGL/specs/gl/GLSLangSpec.4.50.pdf",
    extension: "glsl",
    other_extensions: &[],
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
        template: include_str!("../../../templates/glsl.tera"),
    }],
    catalogue: Some(include_str!("../../../templates/catalogue.glsl.tera")),
    finish: Finish::Text,
    validators: VALIDATORS,
    nests_comments: false,
    stack: Stack::None,
    gpu: Gpu::DESKTOP,
};

/// The harness that runs a user's desktop GLSL, which glslang compiles to SPIR-V.
pub static DESKTOP: Harness = Harness {
    before: "#version 450\n",
    member: "    layout(offset = {offset}) {type} {name};\n",
    block: "layout(std140, set = 0, binding = 0) uniform FgParameters\n{\n{members}} fg_parameters;\n",
    argument: "fg_parameters.{name}",
    uniform: "{name}",
    texture: "",
    texture_argument: "",
    cosines: "",
    count: "",
    cosine: "fg_cosines[gl_GlobalInvocationID.x]",
    splat: "vec3({value})",
    converts: false,
    points: &POINTS,
    after: "
{block}layout(std430, set = 0, binding = 1) readonly buffer FgCosines { float fg_cosines[]; };
layout(std430, set = 0, binding = 2) buffer FgReflectances { vec4 fg_reflectances[]; };
layout(local_size_x = 64) in;
void main()
{
    if (gl_GlobalInvocationID.x < uint(fg_cosines.length()))
    {
        fg_reflectances[gl_GlobalInvocationID.x] = vec4({value}, 1.0);
    }
}
",
};

/// Shared with GLSL ES.
pub(super) static POINTS: PointHarness = PointHarness {
    input: "in highp vec4 fg_{at};\n",
    place: "fg_{at}",
    matrix: "{type}({columns})",
    cube: "uniform highp samplerCube fg_cube;\n",
    cube_argument: "fg_cube",
    declarations: "\n{inputs}{texture}out highp vec3 reflectance;\n",
    entry: "
void main() {
    reflectance = vec3({value});
    gl_Position = vec4(0.0);
}
",
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
uniform highp samplerCube a_cube;
in highp vec3 at;
out highp vec4 colour;
void main() {
    highp vec3 sum = vec3(0.0);
{calls}    colour = vec4(sum, 1.0);
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

/// Shared with GLSL ES. Each declaration states its precision, since a `precision` statement would leak into the including shader.
pub(super) const HALF_SPELLING: Spelling = Spelling {
    precision: Precision::F16,
    param: "mediump {type} {name}",
    texture: "highp sampler2D {name}",
    local: "mediump {type} {name} = {value};",
    head: "mediump {type} {name}({params})",
    ..SPELLING
};

/// Keywords and words reserved for future use, from section 3.6 of GLSL 4.50 and 3.7 of GLSL ES 3.00, and the built-in
/// functions that a function of the same name would hide.
#[rustfmt::skip]
pub(super) const RESERVED: &[&str] = &[
    "abs", "absoluteDifference", "acos", "acosh", "active", "addSaturate", "all", "allInvocations",
    "allInvocationsEqual", "any", "anyInvocation", "asin", "asinh", "asm", "atan", "atanh", "atomic_uint", "atomicAdd",
    "atomicAnd", "atomicCompSwap", "atomicCounter", "atomicCounterAdd", "atomicCounterAnd", "atomicCounterCompSwap",
    "atomicCounterDecrement", "atomicCounterExchange", "atomicCounterIncrement", "atomicCounterMax", "atomicCounterMin",
    "atomicCounterOr", "atomicCounterSubtract", "atomicCounterXor", "atomicExchange", "atomicMax", "atomicMin",
    "atomicOr", "atomicXor", "attribute", "average", "averageRounded", "barrier", "beginInvocationInterlockARB",
    "bitCount", "bitfieldExtract", "bitfieldInsert", "bitfieldReverse", "bool", "break", "buffer", "bvec2", "bvec3",
    "bvec4", "case", "cast", "ceil", "centroid", "clamp", "class", "coherent", "common", "const", "continue",
    "controlBarrier", "cos", "cosh", "countLeadingZeros", "countTrailingZeros", "cross", "debugPrintfEXT", "default",
    "degrees", "determinant", "dFdx", "dFdxCoarse", "dFdxFine", "dFdy", "dFdyCoarse", "dFdyFine", "discard", "distance",
    "dmat2", "dmat2x2", "dmat2x3", "dmat2x4", "dmat3", "dmat3x2", "dmat3x3", "dmat3x4", "dmat4", "dmat4x2", "dmat4x3",
    "dmat4x4", "do", "dot", "double", "dvec2", "dvec3", "dvec4", "else", "EmitStreamVertex", "EmitVertex",
    "endInvocationInterlockARB", "EndPrimitive", "EndStreamPrimitive", "enum", "equal", "exp", "exp2", "extern",
    "external", "faceforward", "false", "filter", "findLSB", "findMSB", "fixed", "flat", "float", "floatBitsToInt",
    "floatBitsToUint", "floor", "fma", "for", "fract", "frexp", "ftransform", "fvec2", "fvec3", "fvec4", "fwidth",
    "fwidthCoarse", "fwidthFine", "goto", "greaterThan", "greaterThanEqual", "groupMemoryBarrier", "half",
    "helperInvocationEXT", "highp", "hvec2", "hvec3", "hvec4", "if", "iimage1D", "iimage1DArray", "iimage2D",
    "iimage2DArray", "iimage2DMS", "iimage2DMSArray", "iimage2DRect", "iimage3D", "iimageBuffer", "iimageCube",
    "iimageCubeArray", "image1D", "image1DArray", "image1DArrayShadow", "image1DShadow", "image2D", "image2DArray",
    "image2DArrayShadow", "image2DMS", "image2DMSArray", "image2DRect", "image2DShadow", "image3D", "imageAtomicAdd",
    "imageAtomicAnd", "imageAtomicCompSwap", "imageAtomicExchange", "imageAtomicMax", "imageAtomicMin", "imageAtomicOr",
    "imageAtomicXor", "imageBuffer", "imageCube", "imageCubeArray", "imageLoad", "imageSamples", "imageSize",
    "imageStore", "imulExtended", "in", "inline", "inout", "input", "int", "intBitsToFloat", "interface",
    "interpolateAtCentroid", "interpolateAtOffset", "interpolateAtSample", "invariant", "inverse", "inversesqrt",
    "isampler1D", "isampler1DArray", "isampler2D", "isampler2DArray", "isampler2DMS", "isampler2DMSArray",
    "isampler2DRect", "isampler3D", "isamplerBuffer", "isamplerCube", "isamplerCubeArray", "isinf", "isnan",
    "isubpassInput", "isubpassInputMS", "itexture1D", "itexture1DArray", "itexture2D", "itexture2DArray",
    "itexture2DMS", "itexture2DMSArray", "itexture2DRect", "itexture3D", "itextureBuffer", "itextureCube",
    "itextureCubeArray", "ivec2", "ivec3", "ivec4", "layout", "ldexp", "length", "lessThan", "lessThanEqual", "log",
    "log2", "long", "lowp", "main", "mat2", "mat2x2", "mat2x3", "mat2x4", "mat3", "mat3x2", "mat3x3", "mat3x4", "mat4",
    "mat4x2", "mat4x3", "mat4x4", "matrixCompMult", "max", "mediump", "memoryBarrier", "memoryBarrierAtomicCounter",
    "memoryBarrierBuffer", "memoryBarrierImage", "memoryBarrierShared", "min", "mix", "mod", "modf", "multiply32x16",
    "namespace", "noinline", "noise1", "noise2", "noise3", "noise4", "noperspective", "normalize", "not", "notEqual",
    "out", "outerProduct", "output", "packDouble2x32", "packed", "packHalf2x16", "packSnorm2x16", "packSnorm4x8",
    "packUnorm2x16", "packUnorm4x8", "partition", "patch", "pow", "precise", "precision", "public", "radians",
    "readonly", "reflect", "refract", "resource", "restrict", "return", "round", "roundEven", "row_major", "sample",
    "sampler", "sampler1D", "sampler1DArray", "sampler1DArrayShadow", "sampler1DShadow", "sampler2D", "sampler2DArray",
    "sampler2DArrayShadow", "sampler2DMS", "sampler2DMSArray", "sampler2DRect", "sampler2DRectShadow",
    "sampler2DShadow", "sampler3D", "sampler3DRect", "samplerBuffer", "samplerCube", "samplerCubeArray",
    "samplerCubeArrayShadow", "samplerCubeShadow", "samplerShadow", "shadow1D", "shadow1DLod", "shadow1DProj",
    "shadow1DProjLod", "shadow2D", "shadow2DEXT", "shadow2DLod", "shadow2DProj", "shadow2DProjEXT", "shadow2DProjLod",
    "shared", "short", "sign", "sin", "sinh", "sizeof", "smooth", "smoothstep", "sqrt", "static", "step", "struct",
    "subpassInput", "subpassInputMS", "subpassLoad", "subroutine", "subtractSaturate", "superp", "switch", "tan",
    "tanh", "template", "texelFetch", "texelFetchOffset", "texture", "texture1D", "texture1DArray", "texture1DLod",
    "texture1DProj", "texture1DProjLod", "texture2D", "texture2DArray", "texture2DGradEXT", "texture2DLod",
    "texture2DLodEXT", "texture2DMS", "texture2DMSArray", "texture2DProj", "texture2DProjGradEXT", "texture2DProjLod",
    "texture2DProjLodEXT", "texture2DRect", "texture3D", "texture3DLod", "texture3DProj", "texture3DProjLod",
    "textureBuffer", "textureCube", "textureCubeArray", "textureCubeGradEXT", "textureCubeLod", "textureCubeLodEXT",
    "textureGather", "textureGatherOffset", "textureGatherOffsets", "textureGrad", "textureGradOffset", "textureLod",
    "textureLodOffset", "textureOffset", "textureProj", "textureProjGrad", "textureProjGradOffset", "textureProjLod",
    "textureProjLodOffset", "textureProjOffset", "textureQueryLevels", "textureQueryLod", "textureSamples",
    "textureSize", "this", "transpose", "true", "trunc", "typedef", "uaddCarry", "uimage1D", "uimage1DArray",
    "uimage2D", "uimage2DArray", "uimage2DMS", "uimage2DMSArray", "uimage2DRect", "uimage3D", "uimageBuffer",
    "uimageCube", "uimageCubeArray", "uint", "uintBitsToFloat", "umulExtended", "uniform", "union", "unpackDouble2x32",
    "unpackHalf2x16", "unpackSnorm2x16", "unpackSnorm4x8", "unpackUnorm2x16", "unpackUnorm4x8", "unsigned",
    "usampler1D", "usampler1DArray", "usampler2D", "usampler2DArray", "usampler2DMS", "usampler2DMSArray",
    "usampler2DRect", "usampler3D", "usamplerBuffer", "usamplerCube", "usamplerCubeArray", "using", "usubBorrow",
    "usubpassInput", "usubpassInputMS", "utexture1D", "utexture1DArray", "utexture2D", "utexture2DArray",
    "utexture2DMS", "utexture2DMSArray", "utexture2DRect", "utexture3D", "utextureBuffer", "utextureCube",
    "utextureCubeArray", "uvec2", "uvec3", "uvec4", "varying", "vec2", "vec3", "vec4", "void", "volatile", "while",
    "writeonly",
];
