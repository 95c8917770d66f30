//! Harnesses: what is put around the text of a file so that one of its functions can be run over cosines. The text itself
//! stays as it is, to the byte.
//!
//! All have one interface, that of our SPIR-V compute modules: group 0 with the run-time arguments in a uniform block at
//! binding 0, cosines at 1, reflectances at 2, a texture and its sampler at 3 and 4. OpenGL ES 3.0 has no compute shaders:
//! there a vertex shader gives its result to transform feedback, exact to the last bit.

use crate::emit::{Emitted, uniform_offsets};
use crate::ir::{Param, Ty};
use crate::num::Precision;
use crate::targets::{self, Spelling};

use super::second::Gles;

/// A function as a harness calls it.
#[derive(Clone, Copy, Debug)]
pub struct Call<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its arguments, `cos_theta` first where it depends on it.
    pub params: &'a [Param],
    /// Whether it gives one channel.
    pub is_scalar: bool,
    /// What it computes in; what goes in and comes out is f32 all the same.
    pub precision: Precision,
}

/// The entry point of every harness.
pub const ENTRY: &str = "fg_main";

impl Call<'_> {
    /// The call of a function.
    pub fn of(emitted: &Emitted) -> Call<'_> {
        Call {
            name: &emitted.name,
            params: &emitted.function.params,
            is_scalar: emitted.function.ty() == Ty::Scalar,
            precision: emitted.precision,
        }
    }

    fn numbers(&self) -> impl Iterator<Item = &Param> {
        let params = self.params.iter();
        params.filter(|param| param.ty != Ty::Texture && !param.is_cosine())
    }

    /// Whether it reads a texture.
    pub fn is_textured(&self) -> bool {
        self.params.iter().any(|param| param.ty == Ty::Texture)
    }

    /// The call, with each argument as this language has it.
    fn text(&self, cos_theta: &str, texture: &str, number: impl Fn(&str) -> String) -> String {
        let argument = |param: &Param| match param.ty {
            Ty::Texture => texture.to_owned(),
            _ if param.is_cosine() => cos_theta.to_owned(),
            _ => number(&param.name),
        };
        let arguments: Vec<String> = self.params.iter().map(argument).collect();
        format!("{}({})", self.name, arguments.join(", "))
    }
}

/// A number as a function of WGSL takes it, which converts nothing by itself.
fn narrowed(call: &Call, ty: Ty, value: String) -> String {
    match call.precision {
        Precision::F32 => value,
        Precision::F16 => format!("{}({value})", HALF_WGSL[usize::from(ty == Ty::Rgb)]),
    }
}

/// f32 of what a function of WGSL gives.
fn widened(call: &Call, value: String) -> String {
    match call.precision {
        Precision::F32 => value,
        Precision::F16 if call.is_scalar => format!("f32({value})"),
        Precision::F16 => format!("vec3<f32>({value})"),
    }
}

/// A number and a colour.
const HALF_WGSL: [&str; 2] = ["f16", "vec3<f16>"];

/// The spelling of a target that is always there.
fn spelling(target: &str) -> &'static Spelling {
    &targets::find(target)
        .expect("the targets of harnesses exist; a test runs all")
        .spelling
}

/// A compute module of a WGSL file.
pub fn wgsl(file: &str, call: &Call) -> String {
    let input = "@group(0) @binding(1) var<storage, read> fg_cosines: array<f32>;";
    wgsl_over(
        file,
        call,
        input,
        "arrayLength(&fg_cosines)",
        "fg_cosines[i]",
    )
}

/// The same over all numbers from a first one on: `first` holds its bits, and each point has the next number.
pub fn wgsl_stream(file: &str, call: &Call) -> String {
    let input = "@group(0) @binding(1) var<uniform> fg_first: u32;";
    wgsl_over(
        file,
        call,
        input,
        "arrayLength(&fg_reflectances)",
        "bitcast<f32>(fg_first + i)",
    )
}

fn wgsl_over(file: &str, call: &Call, input: &str, length: &str, cos_theta: &str) -> String {
    let spelling = spelling("wgsl");
    let members: String = call
        .numbers()
        .map(|param| format!("    {}: {},\n", param.name, spelling.ty(param.ty)))
        .collect();
    let block = if members.is_empty() {
        String::new()
    } else {
        format!(
            "struct FgParameters {{\n{members}}}\n@group(0) @binding(0) var<uniform> fg_parameters: FgParameters;\n"
        )
    };
    let texture = if call.is_textured() {
        "@group(0) @binding(3) var fg_table: texture_2d<f32>;\n@group(0) @binding(4) var fg_sampler: sampler;\n"
    } else {
        ""
    };
    let cos_theta = narrowed(call, Ty::Scalar, cos_theta.to_owned());
    let value = call.text(&cos_theta, "fg_table, fg_sampler", |name| {
        let ty = call.numbers().find(|param| param.name == name);
        let ty = ty.map_or(Ty::Scalar, |param| param.ty);
        narrowed(call, ty, format!("fg_parameters.{name}"))
    });
    let value = widened(call, value);
    format!(
        "{file}
{block}{texture}{input}
@group(0) @binding(2) var<storage, read_write> fg_reflectances: array<vec4<f32>>;
@compute @workgroup_size(64)
fn {ENTRY}(@builtin(global_invocation_id) at: vec3<u32>) {{
    let i = at.x;
    if i < {length} {{
        fg_reflectances[i] = vec4<f32>(vec3<f32>({value}), 1.0);
    }}
}}
"
    )
}

/// A vertex shader of a WGSL file, with the values of the arguments in it: naga makes GLSL ES of that.
pub fn wgsl_vertex(file: &str, call: &Call, values: &[[f32; 3]]) -> String {
    let texture = if call.is_textured() {
        "@group(0) @binding(3) var fg_table: texture_2d<f32>;\n@group(0) @binding(4) var fg_sampler: sampler;\n"
    } else {
        ""
    };
    let value = call.text("fg_cosine", "fg_table, fg_sampler", |name| {
        let place = call.numbers().position(|param| param.name == name);
        let is_rgb = call
            .numbers()
            .any(|param| param.name == name && param.ty == Ty::Rgb);
        let [r, g, b] = place
            .and_then(|i| values.get(i))
            .copied()
            .unwrap_or_default();
        if is_rgb {
            format!("vec3<f32>({r:?}f, {g:?}f, {b:?}f)")
        } else {
            format!("{r:?}f")
        }
    });
    format!(
        "{file}
{texture}struct FgResult {{
    @builtin(position) fg_position: vec4<f32>,
    @location(0) fg_value: vec3<f32>,
}}
@vertex
fn {ENTRY}(@location(0) fg_cosine: f32) -> FgResult {{
    return FgResult(vec4<f32>(), vec3<f32>({value}));
}}
"
    )
}

/// naga's GLSL ES with the names that are bound here.
pub fn renamed(made: &Gles) -> String {
    let pairs = [
        (made.inputs.get(&0), "cos_theta"),
        (made.outputs.get(&0), "reflectance"),
        (made.textures.get(&(0, 3)), "table"),
    ];
    pairs
        .iter()
        .fold(made.text.clone(), |text, (from, to)| match from {
            Some(from) => text.replace(from.as_str(), to),
            None => text,
        })
}

/// A vertex shader of a GLSL ES file.
pub fn gles(file: &str, call: &Call) -> String {
    let spelling = spelling("gles");
    let uniforms: String = call
        .numbers()
        .map(|param| {
            format!(
                "uniform highp {} fg_{};\n",
                spelling.ty(param.ty),
                param.name
            )
        })
        .collect();
    let texture = if call.is_textured() {
        "uniform highp sampler2D table;\n"
    } else {
        ""
    };
    let value = call.text("cos_theta", "table", |name| format!("fg_{name}"));
    format!(
        "#version 300 es
precision highp float;
{file}
in highp float cos_theta;
{uniforms}{texture}out highp vec3 reflectance;
void main() {{
    reflectance = vec3({value});
    gl_Position = vec4(0.0);
}}
"
    )
}

/// A compute shader of an HLSL file. DXC places what stands in buffers by these marks.
pub fn hlsl(file: &str, call: &Call) -> String {
    let spelling = spelling("hlsl");
    let params: Vec<&Param> = call.numbers().collect();
    let offsets = uniform_offsets(call.params);
    let members: String = params
        .iter()
        .zip(offsets)
        .map(|(param, offset)| {
            format!(
                "    [[vk::offset({offset})]] {} {};\n",
                spelling.ty(param.ty),
                param.name
            )
        })
        .collect();
    let block = if members.is_empty() {
        String::new()
    } else {
        format!(
            "struct FgParameters\n{{\n{members}}};\n[[vk::binding(0, 0)]] ConstantBuffer<FgParameters> fg_parameters;\n"
        )
    };
    let texture = if call.is_textured() {
        "[[vk::binding(3, 0)]] Texture2D<float4> fg_table;\n[[vk::binding(4, 0)]] SamplerState fg_sampler;\n"
    } else {
        ""
    };
    let value = call.text("fg_cosines[at.x]", "fg_table, fg_sampler", |name| {
        format!("fg_parameters.{name}")
    });
    let shown = if call.is_scalar {
        format!("({value}).xxx")
    } else {
        value
    };
    format!(
        "{file}
{block}{texture}[[vk::binding(1, 0)]] StructuredBuffer<float> fg_cosines;
[[vk::binding(2, 0)]] RWStructuredBuffer<float4> fg_reflectances;
[numthreads(64, 1, 1)]
void {ENTRY}(uint3 at : SV_DispatchThreadID)
{{
    uint count, stride;
    fg_cosines.GetDimensions(count, stride);
    if (at.x < count)
    {{
        fg_reflectances[at.x] = float4({shown}, 1.0);
    }}
}}
"
    )
}
