//! Shaders on a real graphics stack: what they give, and what is said where they cannot run. Without the stack a test
//! says that it did not check; with `CI` set it fails.

mod agree;
mod bounds;
mod catalogue;
mod contract;
mod faults;
mod stream;
mod table;
mod texture;

use super::not_checked;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::{Backend, Device, Program, ShaderCode, Uniform, Wanted};

/// A device with this interface, or a word that there is none.
#[track_caller]
pub fn device(backend: Backend) -> Option<Device> {
    let wanted = Wanted {
        backend: Some(backend),
        name: None,
    };
    match Device::open(&wanted) {
        Ok(device) => Some(device),
        Err(fault @ Fault::Absent(_)) => {
            let remark = format!("shaders on {}: {fault}", backend.name());
            assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
            not_checked(&remark);
            None
        }
        Err(fault) => panic!("{}: {fault}", backend.name()),
    }
}

pub fn program<'a>(code: ShaderCode<'a>, uniforms: &'a [Uniform]) -> Program<'a> {
    Program {
        code,
        entry: "main",
        uniforms,
        texture: None,
    }
}

/// The declarations of the arguments and the arguments of a call, as both languages want them.
fn joined(parts: &[&str], one: impl Fn(&str) -> String) -> String {
    parts.iter().map(|part| one(part)).collect()
}

/// A compute module around a function of WGSL, as the template of SPIR-V has it. All arguments are colours.
fn wgsl(functions: &str, name: &str, arguments: &[&str]) -> String {
    let members = joined(arguments, |name| format!("{name}: vec3<f32>, "));
    let block = format!(
        "struct Parameters {{ {members} }}\n@group(0) @binding(0) var<uniform> parameters: Parameters;"
    );
    let block = if arguments.is_empty() { "" } else { &block };
    let passed = joined(arguments, |name| format!(", parameters.{name}"));
    format!(
        "{functions}
{block}
@group(0) @binding(1) var<storage, read> cosines: array<f32>;
@group(0) @binding(2) var<storage, read_write> reflectances: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) invocation: vec3<u32>) {{
    let index = invocation.x;
    if index < arrayLength(&cosines) {{
        reflectances[index] = vec4<f32>({name}(cosines[index]{passed}), 1.0);
    }}
}}
"
    )
}

/// A vertex shader around a function of GLSL ES. All arguments are colours.
fn gles(functions: &str, name: &str, arguments: &[&str]) -> String {
    let uniforms = joined(arguments, |name| format!("uniform highp vec3 {name};\n"));
    let passed = joined(arguments, |name| format!(", {name}"));
    format!(
        "#version 300 es
{functions}
{uniforms}in highp float cos_theta;
out highp vec3 reflectance;
void main() {{
    reflectance = {name}(cos_theta{passed});
}}
"
    )
}
