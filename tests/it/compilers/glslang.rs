//! GLSL ES, GLSL and HLSL under glslang, each function called with run-time arguments so that nothing is dead code.

use fresnel_gen::app::Artifact;
use tempfile::TempDir;

use super::{Tool, accepted, files, joined, signatures, text, tree};

const GLSLANG: Tool = Tool {
    command: "glslangValidator",
    package: "glslang-tools",
};

/// A language as glslang is asked to read it.
struct Language {
    target: &'static str,
    /// Beginnings of a shader, one each for the ways to include a file.
    beginnings: &'static [&'static str],
    options: &'static [&'static str],
    /// How many shaders one process takes: with `-V` it would link them.
    at_once: usize,
    /// A fragment shader's main, with `CALLS` where the functions are called.
    main: &'static str,
}

const GLES: Language = Language {
    target: "gles",
    beginnings: &[
        "#version 300 es\nprecision highp float;\n",
        "#version 300 es\nprecision mediump float;\n",
        // All is declared highp, so that a shader without a default precision can include it.
        "#version 300 es\n",
    ],
    options: &["-S", "frag"],
    at_once: 40,
    main: GLSL_MAIN,
};

const GLSL: Language = Language {
    target: "glsl",
    beginnings: &["#version 450\n"],
    options: &["-S", "frag"],
    at_once: 40,
    main: GLSL_MAIN,
};

const HLSL: Language = Language {
    target: "hlsl",
    beginnings: &[""],
    options: &["-S", "frag", "-D", "-V", "-e", "main"],
    at_once: 1,
    main: "Texture2D<float4> a_table;\nSamplerState a_table_sampler;\nfloat4 main(float3 at : TEXCOORD0) : SV_Target\n{\n    float3 sum = 0.0;\nCALLS    return float4(sum, 1.0);\n}\n",
};

const GLSL_MAIN: &str = "uniform highp sampler2D a_table;\nin highp vec3 at;\nout highp vec4 colour;\nvoid main() {\n    highp vec3 sum = vec3(0.0);\nCALLS    colour = vec4(sum, 1.0);\n}\n";

#[test]
fn gles_is_accepted() {
    check(&GLES);
}

#[test]
fn glsl_is_accepted() {
    check(&GLSL);
}

#[test]
fn hlsl_is_accepted() {
    check(&HLSL);
}

#[test]
fn broken_files_are_refused() {
    if !GLSLANG.is_here("that broken GLES, GLSL and HLSL is refused") {
        return;
    }
    // What to spoil in the tree: (language, text, its replacement).
    let faults = [
        (&GLES, "sqrt(", "root("),
        (&GLES, "highp ", ""),
        (&GLES, "#ifndef", "#undef"),
        (&GLSL, "vec3", "float3"),
        (&GLSL, "return", "retrun"),
        (&HLSL, "float3", "vec3"),
        (&HLSL, ";", ""),
        (&HLSL, "#endif", ""),
    ];
    for (language, good, bad) in faults {
        let calls = calls(tree(language.target).into_iter());
        let body = joined(&tree(language.target)).repeat(2);
        // The last beginning declares no precision, which is what `highp` is for.
        let beginning = language.beginnings.last().unwrap();
        let judge = |body: &str| {
            let shader = shader(language, beginning, body, &calls);
            compile(language, &[(String::new(), shader)])
        };
        assert!(body.contains(good), "{}: no {good}", language.target);
        judge(&body).unwrap();
        let complaint = judge(&body.replace(good, bad)).expect_err(bad);
        assert!(complaint.contains("ERROR"), "{complaint}");
    }
}

#[track_caller]
fn check(language: &Language) {
    if !GLSLANG.is_here(language.target) {
        return;
    }
    let shaders = shaders(language);
    let parts: Vec<_> = shaders.chunks(language.at_once).collect();
    accepted(&parts, |shaders| compile(language, shaders));
}

/// Each file included once and twice, and the whole tree in one unit, after each beginning.
fn shaders(language: &Language) -> Vec<(String, String)> {
    let mut shaders = Vec::new();
    let mut add = |name: &str, body: &str, calls: &str| {
        for beginning in language.beginnings {
            let name = format!("{name} after {beginning:?}");
            shaders.push((name, shader(language, beginning, body, calls)));
        }
    };
    for file in files(language.target) {
        let calls = calls([file].into_iter());
        add(&file.path, text(file), &calls);
        add(
            &format!("{} twice", file.path),
            &text(file).repeat(2),
            &calls,
        );
    }
    let tree = tree(language.target);
    let calls = calls(tree.iter().copied());
    add("the tree", &joined(&tree), &calls);
    add("the tree twice", &joined(&tree).repeat(2), &calls);
    shaders
}

fn shader(language: &Language, beginning: &str, body: &str, calls: &str) -> String {
    format!("{beginning}{body}{}", language.main.replace("CALLS", calls))
}

fn calls<'a>(files: impl Iterator<Item = &'a Artifact>) -> String {
    files.flat_map(signatures).map(call).collect()
}

/// A statement that calls a function of this signature, `type name(type argument, …)`.
fn call(signature: &str) -> String {
    let (head, parameters) = signature.trim_end_matches(')').split_once('(').unwrap();
    let name = head.rsplit(' ').next().unwrap();
    let arguments: Vec<String> = parameters.split(", ").map(argument).collect();
    format!("    sum += {name}({});\n", arguments.join(", "))
}

/// The fragment's place, or a texture or sampler of the parameter's name.
fn argument(parameter: &str) -> String {
    let (ty, name) = parameter.rsplit_once(' ').unwrap();
    let is_resource = ["sampler2D", "Texture2D<float4>", "SamplerState"]
        .iter()
        .any(|resource| ty.ends_with(resource));
    match ty {
        // Without a prefix a function bears the name `table` itself.
        _ if is_resource => format!("a_{name}"),
        _ if ty.ends_with('3') => "at".to_owned(),
        _ => "at.x".to_owned(),
    }
}

/// Compiles these; complaints bear the index of the shader, and its name and beginning come after them.
fn compile(language: &Language, shaders: &[(String, String)]) -> super::Judgement {
    let folder = TempDir::new().unwrap();
    let mut arguments: Vec<_> = language.options.iter().map(Into::into).collect();
    if language.options.contains(&"-V") {
        arguments.extend(["-o".into(), folder.path().join("a.spv")]);
    }
    for (index, (_, shader)) in shaders.iter().enumerate() {
        let source = folder.path().join(format!("{index}.frag"));
        std::fs::write(&source, shader).unwrap();
        arguments.push(source);
    }
    let names = || {
        shaders
            .iter()
            .enumerate()
            .map(|(index, (name, _))| format!("{index}.frag: {name}\n"))
    };
    GLSLANG
        .run(arguments)
        .map_err(|complaint| complaint + &names().collect::<String>())
}
