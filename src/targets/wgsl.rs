//! WGSL, as WebGPU takes it.

use crate::ir::Op;

use super::spelling::{Form, Spelling};
use super::target::{Compiler, Finish, Frame, Page, Target, Validator};

/// The record of this target.
pub static TARGET: Target = Target {
    name: "wgsl",
    summary: "WGSL for WebGPU, wgpu and Bevy",
    source: "WebGPU Shading Language, W3C, https://www.w3.org/TR/WGSL/",
    extension: "wgsl",
    by_default: true,
    spelling: SPELLING,
    reserved: &[
        naga::keywords::wgsl::RESERVED,
        naga::keywords::wgsl::BUILTIN_IDENTIFIERS,
    ],
    reserved_prefixes: &[],
    pages: &[Page {
        suffix: "",
        template: include_str!("../../templates/wgsl.tera"),
    }],
    finish: Finish::ValidWgsl,
    validators: &[
        Validator {
            name: "naga",
            compiler: &NAGA,
            options: "",
            frame: Frame::NONE,
        },
        Validator {
            name: "tint",
            compiler: &TINT,
            options: "--format wgsl -o OUT FILE",
            frame: Frame {
                beginnings: &[""],
                ending: ENDING,
            },
        },
    ],
};

/// wgpu's compiler.
static NAGA: Compiler = Compiler {
    name: "naga",
    command: None,
    get: "always there",
};

/// Chrome's compiler of WGSL.
static TINT: Compiler = Compiler {
    name: "tint",
    command: Some("tint"),
    get: "part of Dawn, https://dawn.googlesource.com/dawn",
};

const ENDING: &str = "
@group(0) @binding(0) var a_texture: texture_2d<f32>;
@group(0) @binding(1) var a_sampler: sampler;
@fragment
fn main(@location(0) at: vec3<f32>) -> @location(0) vec4<f32> {
    var sum = vec3<f32>();
CALLS
    return vec4<f32>(sum, 1.0);
}
";

/// Shared with the targets that go through WGSL.
pub(super) const SPELLING: Spelling = Spelling {
    comment: "//",
    scalar: "f32",
    rgb: "vec3<f32>",
    param: "{name}: {type}",
    texture: "{name}: texture_2d<f32>, {name}_sampler: sampler",
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
    ],
};
