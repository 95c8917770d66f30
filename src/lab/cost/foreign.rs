//! The measured shader around a user's function in HLSL or GLSL, for compilers that make SPIR-V of those languages. It is the
//! shader that [`Probe`](super::Probe) makes in WGSL.
//!
//! The function is `fg_measured`. It takes its cosine first and returns one channel or three.

use super::chain::{ChainLanguage, MeasuredFunction};
use super::probe::{BLOCKS, ENTRY};
use crate::language::targets::{GLES, HLSL};
use crate::physics::num::Precision;

/// The empty function in HLSL, which returns its cosine. Its chain costs what a chain costs without evaluations.
pub const EMPTY_HLSL: &str = "float3 fg_measured(float c) { return float3(c, c, c); }\n";
/// The empty function in GLSL.
pub const EMPTY_GLSL: &str = "vec3 fg_measured(float c) { return vec3(c); }\n";
/// The empty function of one channel, in both languages.
pub const EMPTY_SCALAR: &str = "float fg_measured(float c) { return c; }\n";

/// A pixel shader in HLSL.
pub fn hlsl(function: MeasuredFunction, evaluations: usize) -> String {
    let block = format!(
        "struct FgArguments {{\n{{members}}}};\n[[vk::binding(0, 0)]] cbuffer FgBlock {{ FgArguments fg_arguments[{BLOCKS}]; }};\n"
    );
    let shader = format!(
        "{{function}}
{{arguments}}float4 {ENTRY}([[vk::location(0)]] float4 fg_in : TEXCOORD0) : SV_Target0
{{
{{chain}}    return float4((float3){{last}}, 1.0);
}}
"
    );
    let language = ChainLanguage {
        spelling: HLSL.spelling_in(Precision::F32),
        member: "    float4 {name};\n",
        block: &block,
        shader: &shader,
        ..C_LIKE
    };
    function.shader(&language, evaluations)
}

/// A fragment shader in GLSL 4.50 for Vulkan.
pub fn glsl(function: MeasuredFunction, evaluations: usize) -> String {
    let block = format!(
        "struct FgArguments {{\n{{members}}}};\nlayout(std140, set = 0, binding = 0) uniform FgBlock {{ FgArguments fg_arguments[{BLOCKS}]; }};\n"
    );
    let language = ChainLanguage {
        spelling: GLES.spelling_in(Precision::F32),
        member: "    vec4 {name};\n",
        block: &block,
        shader: "#version 450
{function}
layout(location = 0) in vec4 fg_in;
layout(location = 0) out vec4 fg_colour;
{arguments}void main()
{
{chain}    fg_colour = vec4(vec3({last}), 1.0);
}
",
        ..C_LIKE
    };
    function.shader(&language, evaluations)
}

/// What HLSL and GLSL share. No user's function reads a texture. Locals have a prefix, because the text may define names of its
/// own.
const C_LIKE: ChainLanguage = ChainLanguage {
    spelling: &HLSL.spelling,
    member: "",
    block: "",
    argument: "fg_arguments[{i}].{name}.{parts}",
    texture: "",
    cube: "",
    texture_argument: "",
    local: "{type} {name} = {value};",
    input: "{value}",
    prefix: "fg_",
    shader: "",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::ir::{Param, Ty};

    #[test]
    fn evaluations_are_chained_and_have_arguments_of_their_own() {
        let param = |name: &str, ty| Param {
            name: name.to_owned(),
            ty,
        };
        let params = [
            param("cos_theta", Ty::Scalar),
            param("a0", Ty::Vec3),
            param("a1", Ty::Scalar),
        ];
        let function = |text, params| MeasuredFunction {
            text,
            params,
            is_scalar: false,
        };
        let text = hlsl(function("", &params), 2);
        assert!(text.contains("fg_measured(fg_c1, fg_arguments[1].a0.xyz, fg_arguments[1].a1.x)"));
        assert!(text.contains("fg_c1 = fg_r0.x * fg_r0.y - fg_r0.z + fg_w.z;"));
        assert!(!glsl(function(EMPTY_GLSL, &params[..1]), 2).contains("FgArguments"));
        let scalar = MeasuredFunction {
            is_scalar: true,
            ..function(EMPTY_SCALAR, &params[..1])
        };
        assert!(hlsl(scalar, 2).contains("float fg_r1 = fg_measured(fg_c1);"));
    }
}
