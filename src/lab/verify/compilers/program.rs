//! Programs around files that hold functions only: each function is called with arguments known at run time only, so that no
//! compiler drops it as dead code.

use std::collections::BTreeSet;
use std::str::Utf8Error;

use super::call::CompilerInput;
use crate::lab::verify::function_head::{FunctionHead, function_head};
use crate::lab::verify::shader_words::{Hidden, behind, code_alone, tokens};
use crate::language::targets::{Frame, filled};

/// The programs of a file, one for each beginning.
pub fn framed(frame: &Frame, bytes: &[u8]) -> Result<Vec<Vec<u8>>, Utf8Error> {
    if frame.ending.is_empty() {
        return Ok(vec![bytes.to_vec()]);
    }
    let text = std::str::from_utf8(bytes)?;
    // Only WGSL has this word.
    let is_wgsl = frame.ending.contains("fn ");
    let ending = filled(frame.ending, &[("calls", &calls(text, is_wgsl))]);
    let program = |beginning: &&str| format!("{beginning}{text}{ending}").into_bytes();
    Ok(frame.beginnings.iter().map(program).collect())
}

/// The programs as files. Their names are the file's own, with a number where there are several.
pub fn named(name: &str, programs: Vec<Vec<u8>>) -> Vec<CompilerInput> {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let several = programs.len() > 1;
    let file = |(index, bytes)| CompilerInput {
        name: if several {
            format!("{index}-{name}")
        } else {
            name.to_owned()
        },
        bytes,
    };
    programs.into_iter().enumerate().map(file).collect()
}

/// The statements of a program that calls every function of a text.
pub fn calls(text: &str, is_wgsl: bool) -> String {
    let mut calls: Vec<String> = heads(text, is_wgsl).iter().map(call).collect();
    // A file that is included twice has its heads twice.
    let mut seen = BTreeSet::new();
    calls.retain(|call| seen.insert(call.clone()));
    calls.concat()
}

/// The heads of the functions of a text, in all our languages.
fn heads(text: &str, is_wgsl: bool) -> Vec<FunctionHead> {
    let code = code_alone(
        text,
        Hidden {
            directives: true,
            nests: is_wgsl,
        },
    );
    let tokens = tokens(&code);
    let (mut heads, mut start) = (Vec::new(), 0);
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        match token.text {
            "{" => {
                heads.extend(function_head(&tokens[start..at], is_wgsl));
                at = behind(&tokens, at);
                start = at;
            }
            ";" => {
                at += 1;
                start = at;
            }
            _ => at += 1,
        }
    }
    heads
}

/// The call of a function.
fn call(head: &FunctionHead) -> String {
    let arguments: Vec<String> = head
        .params
        .iter()
        .map(|param| argument(&param.ty))
        .collect();
    format!("    sum += {}({});\n", head.name, arguments.join(", "))
}

/// An argument of this type.
fn argument(ty: &str) -> String {
    let lower = ty.to_lowercase();
    // GLSL combines texture and sampler.
    let known = if lower.contains("cube") {
        "a_cube"
    } else if lower.contains("sampler2d") || lower.contains("texture") {
        "a_texture"
    } else if lower.contains("sampler") {
        "a_sampler"
    } else if lower.contains("4x4") || lower == "mat4" {
        return format!("{ty}(at.xyzx, at.xyzx, at.xyzx, at.xyzx)");
    } else {
        match ty.find(['2', '3', '4']).map(|place| &ty[place..=place]) {
            Some("4") if is_vector(ty) => "at.xyzx",
            Some("3") if is_vector(ty) => "at",
            Some("2") if is_vector(ty) => "at.xy",
            _ => "at.x",
        }
    };
    known.to_owned()
}

/// Whether a type has several numbers, by its name: `vec3<f32>`, `vec3`, `float3`, `half3`; `f32` has one.
fn is_vector(ty: &str) -> bool {
    ["vec", "float", "half"]
        .iter()
        .any(|start| ty.starts_with(start))
}

#[cfg(test)]
mod tests {
    use super::calls;

    #[track_caller]
    fn check(text: &str, expected: &str) {
        assert_eq!(calls(text, text.starts_with("fn ")), expected, "{text}");
    }

    #[test]
    fn functions_are_called_in_every_language() {
        check(
            "// f(x) {\n#ifndef A // {\nfloat3 f(float c, float3 f0)\n{\n    g(c);\n}\n#endif\n",
            "    sum += f(at.x, at);\n",
        );
        check(
            "highp float f(highp float c, highp vec3 f0) {}\nhighp vec3 g(highp sampler2D t) {}\n",
            "    sum += f(at.x, at);\n    sum += g(a_texture);\n",
        );
        check(
            "fn f(\n    c: f32, // the cosine\n    f0: vec3<f32>,\n    t: texture_2d<f32>,\n    t_sampler: sampler\n) -> f32 {\n  if c { }\n}\n",
            "    sum += f(at.x, at, a_texture, a_sampler);\n",
        );
        check(
            "inline metal::float3 f(metal::float3 a, float b = 1.0) {}\n",
            "    sum += f(at.x, at.x);\n",
        );
        check(
            "cbuffer B : register(b0) {}\nfloat f(float c : TEXCOORD0) {}\n",
            "    sum += f(at.x);\n",
        );
        check(
            "float f(Texture2D<float4> t, SamplerState t_sampler)\n{}\n",
            "    sum += f(a_texture, a_sampler);\n",
        );
        check(
            "fn f(a: vec2<f32>, b: vec4<f32>, c: texture_cube<f32>, c_sampler: sampler) -> f32 {}\n",
            "    sum += f(at.xy, at.xyzx, a_cube, a_sampler);\n",
        );
        check(
            "mediump vec3 f(mediump float c, mediump vec3 f0) {}\n",
            "    sum += f(at.x, at);\n",
        );
        check(
            "highp float f(highp mat4 m, highp samplerCube c, highp vec2 v) {}\n",
            "    sum += f(mat4(at.xyzx, at.xyzx, at.xyzx, at.xyzx), a_cube, at.xy);\n",
        );
        check(
            "float f(float4x4 m, TextureCube<float4> c, SamplerState c_sampler) {}\n",
            "    sum += f(float4x4(at.xyzx, at.xyzx, at.xyzx, at.xyzx), a_cube, a_sampler);\n",
        );
    }

    #[test]
    fn a_function_that_stands_twice_is_called_once() {
        check(
            "float f(float c) {}\nfloat f(float c) {}\n",
            "    sum += f(at.x);\n",
        );
    }

    #[test]
    fn what_is_no_function_is_not_called() {
        assert_eq!(calls("/* /* */ fn g() {} */\n", true), "");
        check(
            "/* float h(float c) {} */ // float g(float c) {\nfloat f(float c) { return c / 2.0; }\n",
            "    sum += f(at.x);\n",
        );
        check("struct A { float x; };\nfloat b = 1.0;\n", "");
    }
}
