//! HLSL, as FXC and DXC take it, under language versions 2018 and 2021 alike: no vector condition before `?`.

use crate::ir::Op;
use crate::num::Precision;

use super::spelling::{C_FAMILY, Form, Spelling};
use super::target::{Compiler, Finish, Frame, GLSLANG, HalfText, Page, Target, Validator};

/// The record of this target.
pub static TARGET: Target = Target {
    name: "hlsl",
    summary: "HLSL 2018 and 2021 for Direct3D, Unity and Unreal",
    source: "HLSL reference, Microsoft, https://learn.microsoft.com/windows/win32/direct3dhlsl/dx-graphics-hlsl-reference",
    extension: "hlsl",
    by_default: true,
    spelling: Spelling {
        rgb: "float3",
        texture: "Texture2D<float4> {name}, SamplerState {name}_sampler",
        differs: &[
            (Op::Splat, Form::Postfix(".xxx")),
            (Op::Compose, Form::Call("float3")),
            (
                Op::Sample,
                Form::Pattern("{0}.SampleLevel({0}_sampler, float2({1}, {2}), 0.0).rgb"),
            ),
        ],
        ..C_FAMILY
    },
    half: HalfText {
        spelling: HALF_SPELLING,
        directive: "",
        remark: "half has 16 bits where DXC is called with -enable-16bit-types for shader model 6.2 and later, and 32 else; \
                 an engine may define it as min16float.",
        validators: HALF_VALIDATORS,
    },
    reserved: &[RESERVED],
    reserved_prefixes: &["SV_"],
    pages: &[Page {
        suffix: "",
        template: include_str!("../../templates/hlsl.tera"),
    }],
    catalogue: Some(include_str!("../../templates/catalogue.hlsl.tera")),
    finish: Finish::Text,
    validators: &[
        Validator {
            name: "glslang",
            compiler: &GLSLANG,
            options: GLSLANG_OPTIONS,
            frame: FRAME,
        },
        Validator {
            name: "dxc -HV 2018",
            compiler: &DXC,
            options: "-T ps_6_0 -E main -HV 2018 -Wall -Wextra -WX -Fo OUT FILE",
            frame: FRAME,
        },
        Validator {
            name: "dxc -HV 2021",
            compiler: &DXC,
            options: "-T ps_6_0 -E main -HV 2021 -Wall -Wextra -WX -Fo OUT FILE",
            frame: FRAME,
        },
    ],
};

const GLSLANG_OPTIONS: &str = "-D -V -S frag -e main -o OUT FILE";

const HALF_SPELLING: Spelling = Spelling {
    precision: Precision::F16,
    scalar: "half",
    rgb: "half3",
    texture: "Texture2D<float4> {name}, SamplerState {name}_sampler",
    suffix: "h",
    differs: &[
        (Op::Splat, Form::Postfix(".xxx")),
        (Op::Compose, Form::Call("half3")),
        (
            Op::Sample,
            Form::Pattern("half3({0}.SampleLevel({0}_sampler, float2({1}, {2}), 0.0).rgb)"),
        ),
    ],
    ..C_FAMILY
};

const HALF_VALIDATORS: &[Validator] = &[
    Validator {
        name: "glslang",
        compiler: &GLSLANG,
        options: GLSLANG_OPTIONS,
        frame: HALF_FRAME,
    },
    Validator {
        name: "dxc -HV 2018",
        compiler: &DXC,
        options: "-T ps_6_2 -enable-16bit-types -E main -HV 2018 -Wall -Wextra -WX -Fo OUT FILE",
        frame: HALF_FRAME,
    },
    Validator {
        name: "dxc -HV 2021",
        compiler: &DXC,
        options: "-T ps_6_2 -enable-16bit-types -E main -HV 2021 -Wall -Wextra -WX -Fo OUT FILE",
        frame: HALF_FRAME,
    },
    Validator {
        name: "dxc, 32 bits",
        compiler: &DXC,
        options: "-T ps_6_0 -E main -HV 2021 -Wall -Wextra -WX -Fo OUT FILE",
        frame: HALF_FRAME,
    },
];

/// Microsoft's compiler of HLSL.
pub static DXC: Compiler = Compiler {
    name: "dxc",
    command: Some("dxc"),
    get: "https://github.com/microsoft/DirectXShaderCompiler; in a checkout, tests/run fetches it",
};

const FRAME: Frame = Frame {
    beginnings: &[""],
    ending: "
Texture2D<float4> a_texture;
SamplerState a_sampler;
float4 main(float3 at : TEXCOORD0) : SV_Target
{
    float3 sum = 0.0;
CALLS
    return float4(sum, 1.0);
}
",
};

const HALF_FRAME: Frame = Frame {
    beginnings: &[""],
    ending: "
Texture2D<float4> a_texture;
SamplerState a_sampler;
float4 main(float3 wide : TEXCOORD0) : SV_Target
{
    half3 at = half3(wide);
    half3 sum = 0.0h;
CALLS
    return float4(sum, 1.0);
}
",
};

/// Keywords, reserved words and the intrinsic functions that a name would hide, from the reference's appendix.
#[rustfmt::skip]
const RESERVED: &[&str] = &[
    "AppendStructuredBuffer", "asm", "asm_fragment", "BlendState", "bool", "break", "Buffer", "ByteAddressBuffer",
    "case", "cbuffer", "centroid", "class", "column_major", "compile", "compile_fragment", "CompileShader", "const",
    "continue", "ComputeShader", "ConsumeStructuredBuffer", "default", "DepthStencilState", "DepthStencilView",
    "discard", "do", "double", "DomainShader", "dword", "else", "export", "extern", "false", "float", "for", "fxgroup",
    "GeometryShader", "groupshared", "half", "Hullshader", "if", "in", "inline", "inout", "InputPatch", "int",
    "interface", "line", "lineadj", "linear", "LineStream", "matrix", "min16float", "min10float", "min16int",
    "min12int", "min16uint", "namespace", "nointerpolation", "noperspective", "NULL", "out", "OutputPatch",
    "packoffset", "pass", "pixelfragment", "PixelShader", "point", "PointStream", "precise", "RasterizerState",
    "RenderTargetView", "return", "register", "row_major", "RWBuffer", "RWByteAddressBuffer", "RWStructuredBuffer",
    "RWTexture1D", "RWTexture2D", "RWTexture3D", "sample", "sampler", "SamplerState", "SamplerComparisonState",
    "shared", "snorm", "stateblock", "stateblock_state", "static", "string", "struct", "switch", "StructuredBuffer",
    "tbuffer", "technique", "technique10", "technique11", "texture", "Texture1D", "Texture2D", "Texture3D",
    "TextureCube", "true", "typedef", "triangle", "triangleadj", "TriangleStream", "uint", "uniform", "unorm",
    "unsigned", "vector", "vertexfragment", "VertexShader", "void", "volatile", "while", "auto", "catch", "char",
    "const_cast", "delete", "dynamic_cast", "enum", "explicit", "friend", "goto", "long", "mutable", "new", "operator",
    "private", "protected", "public", "reinterpret_cast", "short", "signed", "sizeof", "static_cast", "template",
    "this", "throw", "try", "typename", "union", "using", "virtual", "float2", "float3", "float4", "real", "fixed",
    "abs", "acos", "all", "any", "asin", "atan", "ceil", "clamp", "clip", "cos", "cosh", "cross", "ddx", "ddy",
    "degrees", "determinant", "distance", "dot", "exp", "exp2", "floor", "fma", "fmod", "frac", "isfinite", "isinf",
    "isnan", "length", "lerp", "lit", "log", "log10", "log2", "mad", "max", "min", "modf", "mul", "noise", "normalize",
    "pow", "radians", "rcp", "reflect", "refract", "round", "rsqrt", "saturate", "select", "sign", "sin", "sincos",
    "sinh", "smoothstep", "sqrt", "step", "tan", "tanh", "transpose", "trunc", "main",
];
