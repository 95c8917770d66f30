//! HLSL for FXC and DXC, under language versions 2018 and 2021 alike: no vector condition before `?`.
//!
//! Every function takes the cosine, but a constant one does not use it. DXC's warning about that is switched off, because the text
//! cannot silence it: glslang rejects `(void)`, and older compilers require a name for every argument.

use super::spelling::{C_FAMILY, Form, Spelling};
use super::target::{
    Compiler, Finish, Frame, GLSLANG, HalfText, Harness, Page, PointHarness, Stack, Target,
    Validator,
};
use crate::language::ir::Op;
use crate::language::methods::Gpu;
use crate::physics::num::Precision;

/// The record of this target.
pub static TARGET: Target = Target {
    name: "hlsl",
    summary: "HLSL 2018 and 2021 for Direct3D, Unity and Unreal",
    source: "HLSL reference, Microsoft, https://learn.microsoft.com/windows/win32/direct3dhlsl/dx-graphics-hlsl-reference",
    extension: "hlsl",
    other_extensions: &["cginc", "fxh", "hlsli", "usf", "ush"],
    by_default: true,
    spelling: Spelling {
        rgb: "float3",
        texture: "Texture2D<float4> {name}, SamplerState {name}_sampler",
        cube: "TextureCube<float4> {name}, SamplerState {name}_sampler",
        vec2: "float2",
        vec4: "float4",
        mat4: "float4x4",
        differs: &[
            (Op::Splat, Form::Postfix(".xxx")),
            (Op::Compose, Form::Call("float3")),
            (
                Op::Transform,
                Form::Pattern("mul({0}, float4({1}, 1.0)).{w}"),
            ),
            (
                Op::SampleAlpha,
                Form::Pattern("{0}.SampleLevel({0}_sampler, float2({1}, {2}), 0.0).a"),
            ),
            (
                Op::SampleCube,
                Form::Pattern("{0}.SampleLevel({0}_sampler, {1}, 0.0).rgb"),
            ),
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
        template: include_str!("../../../templates/hlsl.tera"),
    }],
    catalogue: Some(include_str!("../../../templates/catalogue.hlsl.tera")),
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
            options: "-T ps_6_0 -E main -HV 2018 -Wall -Wextra -Wno-unused-parameter -WX -Fo OUT FILE",
            frame: FRAME,
        },
        Validator {
            name: "dxc -HV 2021",
            compiler: &DXC,
            options: "-T ps_6_0 -E main -HV 2021 -Wall -Wextra -Wno-unused-parameter -WX -Fo OUT FILE",
            frame: FRAME,
        },
    ],
    nests_comments: false,
    stack: Stack::DxcToVulkan(&HARNESS),
    gpu: Gpu::DESKTOP,
};

static HARNESS: Harness = Harness {
    before: "",
    member: "    [[vk::offset({offset})]] {type} {name};\n",
    block: "struct FgParameters\n{\n{members}};\n[[vk::binding(0, 0)]] ConstantBuffer<FgParameters> fg_parameters;\n",
    argument: "fg_parameters.{name}",
    uniform: "{name}",
    texture: "[[vk::binding(3, 0)]] Texture2D<float4> fg_table;\n[[vk::binding(4, 0)]] SamplerState fg_sampler;\n",
    texture_argument: "fg_table, fg_sampler",
    cosines: "",
    count: "",
    cosine: "fg_cosines[at.x]",
    splat: "({value}).xxx",
    converts: false,
    points: &POINTS,
    after: "
{block}{texture}[[vk::binding(1, 0)]] StructuredBuffer<float> fg_cosines;
[[vk::binding(2, 0)]] RWStructuredBuffer<float4> fg_reflectances;
[numthreads(64, 1, 1)]
void fg_main(uint3 at : SV_DispatchThreadID)
{
    uint count, stride;
    fg_cosines.GetDimensions(count, stride);
    if (at.x < count)
    {
        fg_reflectances[at.x] = float4({value}, 1.0);
    }
}
",
};

/// HLSL constructs a matrix from rows.
static POINTS: PointHarness = PointHarness {
    input: "",
    place: "fg_points[at.x * {stride} + {at}]",
    matrix: "transpose({type}({columns}))",
    cube: "[[vk::binding(3, 0)]] TextureCube<float4> fg_cube;\n[[vk::binding(4, 0)]] SamplerState fg_sampler;\n",
    cube_argument: "fg_cube, fg_sampler",
    declarations: "
{texture}[[vk::binding(1, 0)]] StructuredBuffer<float4> fg_points;
[[vk::binding(2, 0)]] RWStructuredBuffer<float4> fg_results;
",
    entry: "
[numthreads(64, 1, 1)]
void {entry}(uint3 at : SV_DispatchThreadID)
{
    uint count, stride;
    fg_results.GetDimensions(count, stride);
    if (at.x < count)
    {
        fg_results[at.x] = float4({value}, 1.0);
    }
}
",
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
        options: "-T ps_6_2 -enable-16bit-types -E main -HV 2018 -Wall -Wextra -Wno-unused-parameter -WX -Fo OUT FILE",
        frame: HALF_FRAME,
    },
    Validator {
        name: "dxc -HV 2021",
        compiler: &DXC,
        options: "-T ps_6_2 -enable-16bit-types -E main -HV 2021 -Wall -Wextra -Wno-unused-parameter -WX -Fo OUT FILE",
        frame: HALF_FRAME,
    },
    Validator {
        name: "dxc, 32 bits",
        compiler: &DXC,
        options: "-T ps_6_0 -E main -HV 2021 -Wall -Wextra -Wno-unused-parameter -WX -Fo OUT FILE",
        frame: HALF_FRAME,
    },
];

/// Microsoft's HLSL compiler.
pub static DXC: Compiler = Compiler {
    name: "dxc",
    command: Some("dxc"),
    get: "https://github.com/microsoft/DirectXShaderCompiler; in a checkout, bash tests/fetch-dxc FOLDER puts it there",
};

const FRAME: Frame = Frame {
    beginnings: &[""],
    ending: "
Texture2D<float4> a_texture;
TextureCube<float4> a_cube;
SamplerState a_sampler;
float4 main(float3 at : TEXCOORD0) : SV_Target
{
    float3 sum = at;
{calls}    return float4(sum, 1.0);
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
{calls}    return float4(sum, 1.0);
}
",
};

/// Keywords, reserved words and the intrinsic functions that a name would hide, from the appendix of the reference.
#[rustfmt::skip]
const RESERVED: &[&str] = &[
    "abort", "abs", "AcceptHitAndEndSearch", "acos", "AddUint64", "all", "AllMemoryBarrier",
    "AllMemoryBarrierWithGroupSync", "AllocateRayQuery", "and", "any", "AppendStructuredBuffer", "asdouble", "asfloat",
    "asfloat16", "asin", "asint", "asint16", "asm", "asm_fragment", "asuint", "asuint16", "atan", "atan2", "auto",
    "BlendState", "bool", "break", "Buffer", "ByteAddressBuffer", "CallShader", "case", "catch", "cbuffer", "ceil",
    "center", "centroid", "char", "CheckAccessFullyMapped", "clamp", "class", "clip", "column_major", "compile",
    "compile_fragment", "CompileShader", "ComputeShader", "const", "const_cast", "ConstantBuffer",
    "ConsumeStructuredBuffer", "continue", "cos", "cosh", "countbits", "CreateResourceFromHeap", "cross",
    "D3DCOLORtoUBYTE4", "ddx", "ddx_coarse", "ddx_fine", "ddy", "ddy_coarse", "ddy_fine", "decl", "default", "degrees",
    "delete", "DepthStencilState", "DepthStencilView", "determinant", "DeviceMemoryBarrier",
    "DeviceMemoryBarrierWithGroupSync", "discard", "DispatchMesh", "DispatchRaysDimensions", "DispatchRaysIndex",
    "distance", "do", "DomainShader", "dot", "dot2add", "dot4add_i8packed", "dot4add_u8packed", "double", "dst",
    "dword", "dynamic_cast", "else", "enum", "errorf", "EvaluateAttributeAtSample", "EvaluateAttributeCentroid",
    "EvaluateAttributeSnapped", "exp", "exp2", "explicit", "export", "extern", "f16tof32", "f32tof16", "faceforward",
    "false", "FeedbackTexture2D", "FeedbackTexture2DArray", "firstbithigh", "firstbitlow", "fixed", "float",
    "float16_t", "float2", "float3", "float32_t", "float4", "float64_t", "floor", "fma", "fmod", "for", "frac", "frexp",
    "friend", "fwidth", "fxgroup", "GeometryIndex", "GeometryShader", "GetAttributeAtVertex",
    "GetRenderTargetSampleCount", "GetRenderTargetSamplePosition", "globallycoherent", "goto", "GroupMemoryBarrier",
    "GroupMemoryBarrierWithGroupSync", "groupshared", "half", "HitKind", "Hullshader", "if", "IgnoreHit", "in",
    "indices", "inline", "inout", "InputPatch", "InstanceID", "InstanceIndex", "int", "int16_t", "int32_t", "int64_t",
    "int8_t4_packed", "interface", "InterlockedAdd", "InterlockedAnd", "InterlockedCompareExchange",
    "InterlockedCompareExchangeFloatBitwise", "InterlockedCompareStore", "InterlockedCompareStoreFloatBitwise",
    "InterlockedExchange", "InterlockedMax", "InterlockedMin", "InterlockedOr", "InterlockedXor", "isfinite",
    "IsHelperLane", "isinf", "isnan", "ldexp", "length", "lerp", "line", "lineadj", "linear", "LineStream", "lit",
    "log", "log10", "log2", "long", "mad", "main", "matrix", "max", "min", "min10float", "min12int", "min16float",
    "min16int", "min16uint", "modf", "msad4", "mul", "mutable", "namespace", "new", "nointerpolation", "noise",
    "NonUniformResourceIndex", "noperspective", "normalize", "NULL", "ObjectRayDirection", "ObjectRayOrigin",
    "ObjectToWorld", "ObjectToWorld3x4", "ObjectToWorld4x3", "operator", "or", "out", "OutputPatch", "pack_clamp_s8",
    "pack_clamp_u8", "pack_s8", "pack_u8", "packoffset", "pass", "payload", "pixelfragment", "PixelShader", "point",
    "PointStream", "pow", "precise", "PrimitiveIndex", "primitives", "printf", "private", "Process2DQuadTessFactorsAvg",
    "Process2DQuadTessFactorsMax", "Process2DQuadTessFactorsMin", "ProcessIsolineTessFactors",
    "ProcessQuadTessFactorsAvg", "ProcessQuadTessFactorsMax", "ProcessQuadTessFactorsMin", "ProcessTriTessFactorsAvg",
    "ProcessTriTessFactorsMax", "ProcessTriTessFactorsMin", "protected", "public", "QuadAll", "QuadAny",
    "QuadReadAcrossDiagonal", "QuadReadAcrossX", "QuadReadAcrossY", "QuadReadLaneAt", "radians",
    "RasterizerOrderedBuffer", "RasterizerOrderedByteAddressBuffer", "RasterizerOrderedStructuredBuffer",
    "RasterizerOrderedTexture1D", "RasterizerOrderedTexture1DArray", "RasterizerOrderedTexture2D",
    "RasterizerOrderedTexture2DArray", "RasterizerOrderedTexture3D", "RasterizerState", "RayDesc", "RayFlags",
    "RayQuery", "RayTCurrent", "RayTMin", "RaytracingAccelerationStructure", "rcp", "real", "reflect", "refract",
    "register", "reinterpret_cast", "RenderTargetView", "ReportHit", "return", "reversebits", "round", "row_major",
    "rsqrt", "RWBuffer", "RWByteAddressBuffer", "RWStructuredBuffer", "RWTexture1D", "RWTexture1DArray", "RWTexture2D",
    "RWTexture2DArray", "RWTexture2DMS", "RWTexture2DMSArray", "RWTexture3D", "RWTextureCube", "RWTextureCubeArray",
    "sample", "sampler", "sampler_state", "SamplerComparisonState", "SamplerState", "saturate", "select",
    "SetMeshOutputCounts", "shared", "short", "sign", "signed", "sin", "sincos", "sinh", "sizeof", "smoothstep",
    "snorm", "source_mark", "sqrt", "stateblock", "stateblock_state", "static", "static_cast", "step", "string",
    "struct", "StructuredBuffer", "switch", "tan", "tanh", "tbuffer", "Technique", "technique", "technique10",
    "technique11", "template", "tex1D", "tex1Dbias", "tex1Dgrad", "tex1Dlod", "tex1Dproj", "tex2D", "tex2Dbias",
    "tex2Dgrad", "tex2Dlod", "tex2Dproj", "tex3D", "tex3Dbias", "tex3Dgrad", "tex3Dlod", "tex3Dproj", "texCUBE",
    "texCUBEbias", "texCUBEgrad", "texCUBElod", "texCUBEproj", "texture", "Texture1D", "Texture1DArray", "Texture2D",
    "Texture2DArray", "Texture2DMS", "Texture2DMSArray", "Texture3D", "TextureBuffer", "TextureCube",
    "TextureCubeArray", "this", "throw", "TraceRay", "transpose", "triangle", "triangleadj", "TriangleStream", "true",
    "trunc", "try", "typedef", "typeid", "typename", "uint", "uint16_t", "uint32_t", "uint64_t", "uint8_t4_packed",
    "uniform", "union", "unorm", "unpack_s8s16", "unpack_s8s32", "unpack_u8u16", "unpack_u8u32", "unsigned", "using",
    "vector", "vertexfragment", "VertexShader", "vertices", "virtual", "void", "volatile", "WaveActiveAllEqual",
    "WaveActiveAllTrue", "WaveActiveAnyTrue", "WaveActiveBallot", "WaveActiveBitAnd", "WaveActiveBitOr",
    "WaveActiveBitXor", "WaveActiveCountBits", "WaveActiveMax", "WaveActiveMin", "WaveActiveProduct", "WaveActiveSum",
    "WaveGetLaneCount", "WaveGetLaneIndex", "WaveIsFirstLane", "WaveMatch", "WaveMultiPrefixBitAnd",
    "WaveMultiPrefixBitOr", "WaveMultiPrefixBitXor", "WaveMultiPrefixCountBits", "WaveMultiPrefixProduct",
    "WaveMultiPrefixSum", "WavePrefixCountBits", "WavePrefixProduct", "WavePrefixSum", "WaveReadLaneAt",
    "WaveReadLaneFirst", "wchar_t", "while", "WorldRayDirection", "WorldRayOrigin", "WorldToObject", "WorldToObject3x4",
    "WorldToObject4x3",
];
