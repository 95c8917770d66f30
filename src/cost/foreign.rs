//! The shader that is measured around a function of a user's in HLSL or GLSL: as [`Probe`](super::Probe) has it in WGSL, for
//! compilers that make SPIR-V of those languages.
//!
//! The function is `fg_measured`, with its cosine first and three channels out.

use crate::ir::{Param, Ty};

use super::probe::{BLOCKS, ENTRY};

/// A function that gives its cosine: what a chain costs where nothing is evaluated in it.
pub const EMPTY_HLSL: &str = "float3 fg_measured(float c) { return float3(c, c, c); }\n";
/// The same in GLSL.
pub const EMPTY_GLSL: &str = "vec3 fg_measured(float c) { return vec3(c); }\n";

/// A pixel shader in HLSL.
pub fn hlsl(text: &str, params: &[Param], evaluations: usize) -> String {
    let block = block(params, "float4");
    let block = match block.is_empty() {
        true => block,
        false => format!(
            "{block}[[vk::binding(0, 0)]] cbuffer FgBlock {{ FgArguments fg_arguments[{BLOCKS}]; }};\n"
        ),
    };
    let steps = steps(params, evaluations, "float3");
    format!(
        "{text}
{block}float4 {ENTRY}([[vk::location(0)]] float4 fg_in : TEXCOORD0) : SV_Target0
{{
    float3 fg_w = fg_in.xyz;
    float fg_c0 = fg_in.w;
{steps}    return float4(fg_r{}, 1.0);
}}
",
        evaluations - 1
    )
}

/// A fragment shader in GLSL 4.50 for Vulkan.
pub fn glsl(text: &str, params: &[Param], evaluations: usize) -> String {
    let block = block(params, "vec4");
    let block = match block.is_empty() {
        true => block,
        false => format!(
            "{block}layout(std140, set = 0, binding = 0) uniform FgBlock {{ FgArguments fg_arguments[{BLOCKS}]; }};\n"
        ),
    };
    let steps = steps(params, evaluations, "vec3");
    format!(
        "#version 450
{text}
layout(location = 0) in vec4 fg_in;
layout(location = 0) out vec4 fg_colour;
{block}void main()
{{
    vec3 fg_w = fg_in.xyz;
    float fg_c0 = fg_in.w;
{steps}    fg_colour = vec4(fg_r{}, 1.0);
}}
",
        evaluations - 1
    )
}

/// The arguments of an evaluation; nothing where there are none.
fn block(params: &[Param], four: &str) -> String {
    let member = |param: &Param| format!("    {four} {};\n", param.name);
    let members: String = params.iter().skip(1).map(member).collect();
    match members.is_empty() {
        true => members,
        false => format!("struct FgArguments {{\n{members}}};\n"),
    }
}

fn steps(params: &[Param], evaluations: usize, rgb: &str) -> String {
    let step = |i: usize| {
        let argument = |param: &Param| {
            let parts = if param.ty == Ty::Rgb { "xyz" } else { "x" };
            format!("fg_arguments[{i}].{}.{parts}", param.name)
        };
        let others = params.iter().skip(1).map(argument);
        let all: Vec<String> = [format!("fg_c{i}")].into_iter().chain(others).collect();
        let call = format!("    {rgb} fg_r{i} = fg_measured({});\n", all.join(", "));
        match i.checked_sub(1) {
            None => call,
            Some(p) => {
                format!("    float fg_c{i} = fg_r{p}.x * fg_r{p}.y - fg_r{p}.z + fg_w.z;\n{call}")
            }
        }
    };
    (0..evaluations).map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evaluations_are_chained_and_have_arguments_of_their_own() {
        let param = |name: &str, ty| Param {
            name: name.to_owned(),
            ty,
        };
        let params = [
            param("cos_theta", Ty::Scalar),
            param("a0", Ty::Rgb),
            param("a1", Ty::Scalar),
        ];
        let text = hlsl("", &params, 2);
        assert!(text.contains("fg_measured(fg_c1, fg_arguments[1].a0.xyz, fg_arguments[1].a1.x)"));
        assert!(text.contains("fg_c1 = fg_r0.x * fg_r0.y - fg_r0.z + fg_w.z;"));
        assert!(!glsl(EMPTY_GLSL, &params[..1], 2).contains("FgArguments"));
    }
}
