//! WGSL, for WebGPU.

use super::spelling::{Form, Spelling};
use super::target::{
    Compiler, Finish, Frame, HalfText, Harness, Page, PointHarness, Stack, Target, Validator,
};
use crate::language::ir::Op;
use crate::language::methods::Gpu;
use crate::physics::num::Precision;

/// The record of this target.
pub static TARGET: Target = Target {
    name: "wgsl",
    summary: "WGSL for WebGPU, wgpu and Bevy",
    source: "WebGPU Shading Language, W3C, https://www.w3.org/TR/WGSL/",
    extension: "wgsl",
    other_extensions: &[],
    by_default: true,
    spelling: SPELLING,
    half: HalfText {
        spelling: HALF_SPELLING,
        directive: HALF_DIRECTIVE,
        remark: "f16 wants a device with the feature shader-f16. `enable f16;` must stand before all other code of a module: \
                 a file that is joined to others leaves it to the first.",
        validators: &[NAGA_VALIDATOR, tint(HALF_ENDING)],
    },
    reserved: &[
        naga::keywords::wgsl::RESERVED,
        naga::keywords::wgsl::BUILTIN_IDENTIFIERS,
    ],
    reserved_prefixes: &[],
    pages: &[Page {
        suffix: "",
        template: include_str!("../../../templates/wgsl.tera"),
    }],
    catalogue: Some(include_str!("../../../templates/catalogue.wgsl.tera")),
    finish: Finish::ValidWgsl,
    validators: &[NAGA_VALIDATOR, tint(ENDING)],
    nests_comments: true,
    stack: Stack::Wgpu(&HARNESS),
    gpu: Gpu::DESKTOP,
};

const PROGRAM: Harness = Harness {
    before: "",
    member: "    {name}: {type},\n",
    block: "struct FgParameters {\n{members}}\n@group(0) @binding(0) var<uniform> fg_parameters: FgParameters;\n",
    argument: "fg_parameters.{name}",
    uniform: "{name}",
    texture: "@group(0) @binding(3) var fg_table: texture_2d<f32>;\n@group(0) @binding(4) var fg_sampler: sampler;\n",
    texture_argument: "fg_table, fg_sampler",
    cosines: "@group(0) @binding(1) var<storage, read> fg_cosines: array<f32>;",
    count: "arrayLength(&fg_cosines)",
    cosine: "fg_cosines[i]",
    splat: "{value}",
    converts: true,
    points: &POINTS,
    after: "
{block}{texture}{cosines}
@group(0) @binding(2) var<storage, read_write> fg_reflectances: array<vec4<f32>>;
@compute @workgroup_size(64)
fn fg_main(@builtin(global_invocation_id) at: vec3<u32>) {
    let i = at.x;
    if i < {count} {
        fg_reflectances[i] = vec4<f32>(vec3<f32>({value}), 1.0);
    }
}
",
};
static HARNESS: Harness = PROGRAM;

static POINTS: PointHarness = PointHarness {
    input: "",
    place: "fg_points[i * {stride}u + {at}u]",
    matrix: "{type}({columns})",
    cube: "@group(0) @binding(3) var fg_cube: texture_cube<f32>;\n@group(0) @binding(4) var fg_sampler: sampler;\n",
    cube_argument: "fg_cube, fg_sampler",
    declarations: "
{texture}@group(0) @binding(1) var<storage, read> fg_points: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> fg_results: array<vec4<f32>>;
",
    entry: "
@compute @workgroup_size(64)
fn {entry}(@builtin(global_invocation_id) at: vec3<u32>) {
    let i = at.x;
    if i < arrayLength(&fg_results) {
        fg_results[i] = vec4<f32>(vec3<f32>({value}), 1.0);
    }
}
",
};

/// A harness without a buffer of cosines: they are consecutive f32, by their bits, from a first one.
pub static STREAM: Harness = Harness {
    cosines: "@group(0) @binding(1) var<uniform> fg_first: u32;",
    count: "arrayLength(&fg_reflectances)",
    cosine: "bitcast<f32>(fg_first + i)",
    ..PROGRAM
};

/// tint validates a file followed by calls of its functions.
const fn tint(ending: &'static str) -> Validator {
    Validator {
        name: "tint",
        compiler: &TINT,
        options: TINT_OPTIONS,
        frame: Frame {
            beginnings: &[""],
            ending,
        },
    }
}

const NAGA_VALIDATOR: Validator = Validator {
    name: "naga",
    compiler: &NAGA,
    options: "",
    frame: Frame::NONE,
};

const TINT_OPTIONS: &str = "--format wgsl -o OUT FILE";

/// wgpu's shader compiler.
static NAGA: Compiler = Compiler {
    name: "naga",
    command: None,
    get: "always there",
};

/// Chrome's WGSL compiler.
static TINT: Compiler = Compiler {
    name: "tint",
    command: Some("tint"),
    get: "part of Dawn, https://dawn.googlesource.com/dawn",
};

const ENDING: &str = "
@group(0) @binding(0) var a_texture: texture_2d<f32>;
@group(0) @binding(1) var a_sampler: sampler;
@group(0) @binding(2) var a_cube: texture_cube<f32>;
@fragment
fn main(@location(0) at: vec3<f32>) -> @location(0) vec4<f32> {
    var sum = vec3<f32>();
{calls}    return vec4<f32>(sum, 1.0);
}
";

const HALF_ENDING: &str = "
@group(0) @binding(0) var a_texture: texture_2d<f32>;
@group(0) @binding(1) var a_sampler: sampler;
@fragment
fn main(@location(0) wide: vec3<f32>) -> @location(0) vec4<f32> {
    let at = vec3<f16>(wide);
    var sum = vec3<f16>();
{calls}    return vec4<f32>(vec3<f32>(sum), 1.0);
}
";

/// Shared with the targets that go through WGSL.
pub(super) const HALF_DIRECTIVE: &str = "enable f16;";

/// Shared with the targets that go through WGSL.
pub(super) const HALF_SPELLING: Spelling = Spelling {
    precision: Precision::F16,
    scalar: "f16",
    rgb: "vec3<f16>",
    suffix: "h",
    differs: &[
        (Op::Splat, Form::Call("vec3<f16>")),
        (Op::Compose, Form::Call("vec3<f16>")),
        (Op::InverseSqrt, Form::Call("inverseSqrt")),
        (Op::Select, Form::CallSelect("select")),
        (
            Op::Sample,
            Form::Pattern(
                "vec3<f16>(textureSampleLevel({0}, {0}_sampler, vec2<f32>(vec2<f16>({1}, {2})), 0.0).rgb)",
            ),
        ),
    ],
    ..SPELLING
};

/// Shared with the targets that go through WGSL.
pub(super) const SPELLING: Spelling = Spelling {
    precision: Precision::F32,
    comment: "//",
    scalar: "f32",
    rgb: "vec3<f32>",
    param: "{name}: {type}",
    texture: "{name}: texture_2d<f32>, {name}_sampler: sampler",
    cube: "{name}: texture_cube<f32>, {name}_sampler: sampler",
    vec2: "vec2<f32>",
    vec4: "vec4<f32>",
    mat4: "mat4x4<f32>",
    local: "let {name} = {value};",
    head: "fn {name}({params}) -> {type}",
    suffix: "",
    mixed_min_max: false,
    guard: false,
    differs: &[
        (Op::Splat, Form::Call("vec3<f32>")),
        (Op::Compose, Form::Call("vec3<f32>")),
        (Op::InverseSqrt, Form::Call("inverseSqrt")),
        (Op::Select, Form::CallSelect("select")),
        (
            Op::Sample,
            Form::Pattern("textureSampleLevel({0}, {0}_sampler, vec2<f32>({1}, {2}), 0.0).rgb"),
        ),
        (
            Op::Transform,
            Form::Pattern("({0} * vec4<f32>({1}, 1.0)).{w}"),
        ),
        (
            Op::SampleAlpha,
            Form::Pattern("textureSampleLevel({0}, {0}_sampler, vec2<f32>({1}, {2}), 0.0).a"),
        ),
        (
            Op::SampleCube,
            Form::Pattern("textureSampleLevel({0}, {0}_sampler, {1}, 0.0).rgb"),
        ),
    ],
};
