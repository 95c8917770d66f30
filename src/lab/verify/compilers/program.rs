//! Programs around files that hold functions only: each function is called with arguments known at run time only, so that no
//! compiler drops it as dead code.

use std::collections::BTreeSet;
use std::str::Utf8Error;

use super::call::CompilerInput;
use crate::generator::emit::shader_words::{Hidden, code_alone};
use crate::language::targets::Frame;

/// The programs of a file, one for each beginning.
pub fn framed(frame: &Frame, bytes: &[u8]) -> Result<Vec<Vec<u8>>, Utf8Error> {
    if frame.ending.is_empty() {
        return Ok(vec![bytes.to_vec()]);
    }
    let text = std::str::from_utf8(bytes)?;
    // Only WGSL has this word, and nested comments.
    let nests = frame.ending.contains("fn ");
    let ending = frame.ending.replace("CALLS\n", &calls(text, nests));
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

/// The statements of a program that calls every function of a text. `nests`: whether comments nest.
pub fn calls(text: &str, nests: bool) -> String {
    let mut calls: Vec<String> = heads(text, nests)
        .iter()
        .filter_map(|head| call(head))
        .collect();
    // A file that is included twice has its heads twice.
    let mut seen = BTreeSet::new();
    calls.retain(|call| seen.insert(call.clone()));
    calls.concat()
}

/// The text before each outermost brace, one line each: the heads of functions, in all our languages.
fn heads(text: &str, nests: bool) -> Vec<String> {
    let directives = true;
    let code = code_alone(text, Hidden { directives, nests });
    let (mut heads, mut depth, mut head) = (Vec::new(), 0, String::new());
    for character in code.lines().flat_map(|line| line.chars().chain([' '])) {
        match character {
            '{' if depth == 0 => heads.push(std::mem::take(&mut head)),
            ';' if depth == 0 => head.clear(),
            _ if depth == 0 && character != '}' => head.push(character),
            _ => {}
        }
        depth += match character {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
    }
    heads
}

/// The call of a function of this head: `type name(type argument, …)` or `fn name(argument: type, …) -> type`.
fn call(head: &str) -> Option<String> {
    let (before, rest) = head.split_once('(')?;
    let (parameters, _) = rest.split_once(')')?;
    let name = before.split_whitespace().last()?;
    let arguments: Vec<String> = parameters
        .split(',')
        .map(str::trim)
        .filter(|parameter| !parameter.is_empty())
        .map(argument)
        .collect();
    Some(format!("    sum += {name}({});\n", arguments.join(", ")))
}

fn argument(parameter: &str) -> String {
    let is_wgsl = parameter.split_once(": ").map(|(_, ty)| ty);
    let is_c = || parameter.rsplit_once(' ').map(|(ty, _)| ty);
    let ty = is_wgsl.or_else(is_c).unwrap_or(parameter);
    // Without a precision before it.
    let ty = ty.split_whitespace().last().unwrap_or(ty);
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
        assert_eq!(calls(text, false), expected, "{text}");
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
