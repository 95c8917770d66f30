//! Files as people have them: conditions, inputs from outside, entry points, types of 16 bits, compilers that are broken.

use serde_json::Value;

use super::audit;
use super::rows;
use crate::cli::{Place, Ran};
use crate::compilers::Tool;
use crate::verify::tools::{copied, put_compiler};

/// The largest error of Schlick's formula for gold.
const SCHLICK: f64 = 0.022306;

fn place() -> Place {
    let place = Place::new();
    for (file, text) in [
        ("two_branches.glsl", include_str!("cases/two_branches.glsl")),
        ("param_if.glsl", include_str!("cases/param_if.glsl")),
        (
            "same_signature.hlsl",
            include_str!("cases/same_signature.hlsl"),
        ),
        ("uniform.glsl", include_str!("cases/uniform.glsl")),
        ("uniform.hlsl", include_str!("cases/uniform.hlsl")),
        ("uniform.wgsl", include_str!("cases/uniform.wgsl")),
        (
            "global_default.hlsl",
            include_str!("cases/global_default.hlsl"),
        ),
        ("half.hlsl", include_str!("cases/half.hlsl")),
        ("min16.hlsl", include_str!("cases/min16.hlsl")),
        ("mediump.glsl", include_str!("cases/mediump.glsl")),
        ("shadergraph.hlsl", include_str!("cases/shadergraph.hlsl")),
    ] {
        place.put(file, text);
    }
    place
}

/// The row of a run that ends with this code; none where the machine lacks something.
#[track_caller]
fn row(place: &Place, line: &str, code: i32) -> Option<Value> {
    let ran = audit(place, &format!("{line} --gpu none --json -"))?;
    Some(rows(&ran.ends(code)).remove(0))
}

#[track_caller]
fn error(place: &Place, line: &str, expected: f64) {
    if let Some(row) = row(place, line, 0) {
        let error = row["model_error"]["max_abs"].as_f64().unwrap();
        assert!((error - expected).abs() < 2e-6, "{line}: {error}");
    }
}

#[test]
fn the_text_behind_the_preprocessor_is_audited() {
    let place = place();
    error(&place, "two_branches.glsl --material gold", SCHLICK);
    error(&place, "same_signature.hlsl --material gold", SCHLICK);
    let film = "param_if.glsl --function engine_fresnel --material gold";
    error(&place, film, SCHLICK);
    place.refused(
        &format!("audit {film} -D WITH_FILM"),
        &["no value for `filmColor`"],
    );
    let mobile = "two_branches.glsl --material gold -D MOBILE";
    if let Some(row) = row(&place, mobile, 0) {
        assert_eq!(
            (&row["line"], &row["channels"]),
            (&3.into(), &1.into()),
            "{row}"
        );
        assert_eq!(row["conditions"][0]["is_taken"], true, "{row}");
    }
    if let Some(ran) = audit(&place, "two_branches.glsl --material gold --gpu none") {
        let ran = ran.ends(0);
        for says in [
            "mediumFresnel in two_branches.glsl (line 8), gold",
            "cosine       `VoH`",
            "line 2 `#ifdef MOBILE`: not taken",
        ] {
            assert!(ran.out.contains(says), "{says}: {ran:?}");
        }
    }
}

/// What stands before the real definition in dropped lines is not taken.
#[test]
fn dropped_lines_hold_no_function_in_any_language() {
    let place = Place::new();
    let c = |scalar: &str, rgb: &str| {
        format!(
            "#if 0\n{rgb} f({scalar} c, {rgb} f0) {{ return f0 * 0.0; }}\n#elif LOW == 2\n{rgb} f({scalar} c, {rgb} f0) {{ return f0; }}\n#else\n{rgb} f({scalar} c, {rgb} f0) {{\n#ifdef NEVER\n return nothing;\n#endif\n {scalar} m = 1.0 - c; return f0 + (1.0 - f0) * (m*m*m*m*m); }}\n#endif\n"
        )
    };
    place.put("f.glsl", c("float", "vec3"));
    place.put("f.hlsl", c("float", "float3"));
    place.put(
        "f.wgsl",
        "#define_import_path mine::fresnel\n#import bevy_pbr::utils::{\n  PI,\n}\n#ifdef LOW\nfn f(c: f32, f0: vec3f) -> vec3f { return f0; }\n#else\nfn f(c: f32, f0: vec3f) -> vec3f { let m = 1.0 - c; return f0 + (1.0 - f0) * (m*m*m*m*m); }\n#endif\n",
    );
    for file in ["f.glsl", "f.hlsl", "f.wgsl"] {
        error(&place, &format!("{file} --material gold"), SCHLICK);
        let low = format!("{file} --material gold -D LOW=2");
        if let Some(row) = row(&place, &low, 0) {
            // A constant is as far from 1 as F0 is.
            assert!(
                row["model_error"]["max_abs"].as_f64().unwrap() > 0.6,
                "{row}"
            );
        }
    }
    for (flag, says) in [
        ("-D 3=4", "-D 3=4: it is NAME=VALUE"),
        ("-D fg_x=4", "-D fg_x=4"),
        ("-D A=\"b", "-D A"),
    ] {
        place.refused(&format!("audit f.glsl --material gold {flag}"), &[says]);
    }
    place.put("open.glsl", "#if 1\nfloat f(float c) { return c; }\n");
    place.refused(
        "audit open.glsl --material gold",
        &["open.glsl:1:1: this condition has no"],
    );
    place.put(
        "wrong.glsl",
        "#if (1\n#endif\nfloat f(float c) { return c; }\n",
    );
    place.refused(
        "audit wrong.glsl --material gold",
        &["wrong.glsl:1:1: the condition cannot be decided"],
    );
    place.put(
        "no.glsl",
        "#ifndef QUALITY\n#error define QUALITY\n#endif\nfloat f(float c) { return c; }\n",
    );
    place.refused(
        "audit no.glsl --material gold",
        &["no.glsl:2:1: #error define QUALITY"],
    );
    place.put(
        "macro.hlsl",
        "real3 f(real3 f0, real c) { return lerp(f0, 1, POW5(1 - c)); }\n",
    );
    place.refused(
        "audit macro.hlsl --function f --material gold",
        &["`real3`"],
    );
}

#[test]
fn macros_of_the_command_line_are_in_the_text() {
    let place = Place::new();
    place.put(
        "f.hlsl",
        "real3 f(real3 f0, real c) { real m = saturate(1 - c); return f0 + (1 - f0) * pow(m, SHARP); }\n",
    );
    error(
        &place,
        "f.hlsl -D real=float -D real3=float3 -D SHARP=5 --material gold",
        SCHLICK,
    );
}

/// The same formula in three languages, with its numbers outside of it.
#[test]
fn inputs_from_outside_need_values() {
    let place = place();
    for (file, [bias, power]) in [
        ("uniform.glsl", ["fresnelBias", "fresnelPower"]),
        ("uniform.hlsl", ["fresnelBias", "fresnelPower"]),
        ("uniform.wgsl", ["water.bias", "water.power"]),
    ] {
        let line = format!("{file} --material water");
        place.refused(
            &format!("audit {line}"),
            &[
                &format!("no value for `{bias}`, which it reads from outside (line"),
                power,
            ],
        );
        place.refused(
            &format!("audit {line} --arg {bias}=.02"),
            &[&format!("`{power}`")],
        );
        let given = format!("{line} --arg {bias}=f0 --arg {power}=5");
        if let Some(row) = row(&place, &given, 0) {
            let error = row["model_error"]["max_abs"].as_f64().unwrap();
            assert!((error - 0.059593).abs() < 2e-6, "{error}");
            assert_eq!(row["arguments"][bias]["quantity"], "f0", "{row}");
        }
        // A number for each channel is set before each call.
        let each = format!("{file} --material gold --arg {bias}=f0 --arg {power}=5");
        error(&place, &each, SCHLICK);
    }
    place.refused(
        "audit uniform.wgsl --material water --arg water.bais=1",
        &["there is no argument `water.bais` (did you mean water.bias"],
    );
}

#[test]
fn a_value_that_the_file_gives_is_taken_and_told() {
    let place = place();
    let line = "global_default.hlsl --material water";
    if let Some(row) = row(&place, line, 0) {
        assert_eq!(row["initialised"][0], "_F0 = 0.02 (line 1)", "{row}");
        let error = row["model_error"]["max_abs"].as_f64().unwrap();
        assert!((error - 0.0596).abs() < 5e-4, "{error}");
    }
    if let Some(row) = row(&place, &format!("{line} --arg _F0=0.5"), 0) {
        assert_eq!(row["initialised"].as_array().unwrap().len(), 0, "{row}");
        assert!(
            row["model_error"]["max_abs"].as_f64().unwrap() > 0.4,
            "{row}"
        );
    }
    place.put(
        "list.hlsl",
        "float weights[2] = { 0.02, 5.0 };\nfloat f(float c) { return weights[0] + (1.0 - weights[0]) * pow(saturate(1.0 - c), weights[1]); }\n",
    );
    if let Some(row) = row(&place, "list.hlsl --material water", 0) {
        let error = row["model_error"]["max_abs"].as_f64().unwrap();
        assert!((error - 0.0596).abs() < 5e-4, "{row}");
    }
    place.put(
        "o.wgsl", "override f0 = 0.02;\nfn f(c: f32) -> f32 { let m = 1.0 - c; return f0 + (1.0 - f0) * m*m*m*m*m; }\n");
    place.put("u.glsl", "uniform float f0 = 0.02;\nfloat f(float c) { float m = 1.0 - c; return f0 + (1.0 - f0) * m*m*m*m*m; }\n");
    for file in ["o.wgsl", "u.glsl"] {
        if let Some(row) = row(&place, &format!("{file} --material water"), 0) {
            assert_eq!(row["initialised"][0], "f0 = 0.02 (line 1)", "{row}");
        }
    }
}

/// Each kind of input: what a number stands for is asked for by its name, and the rest is named and refused.
#[test]
fn every_kind_of_input_is_named() {
    let schlick = "float m = 1.0 - c; return f + (1.0 - f) * m*m*m*m*m; }\n";
    let c =
        |before: &str, f: &str| format!("{before}\nfloat g(float c) {{ float f = {f}; {schlick}");
    let wgsl = |before: &str, f: &str| {
        format!(
            "{before}\nfn g(c: f32) -> f32 {{ let f = {f}; let m = 1.0 - c; return f + (1.0 - f) * m*m*m*m*m; }}\n"
        )
    };
    let asked: [(&str, String, &str); 14] = [
        ("a.glsl", c("in float bias;", "bias"), "bias"),
        ("b.glsl", c("uniform vec4 params;", "params.y"), "params.y"),
        (
            "c.glsl",
            c(
                "layout(std140) uniform Block { vec3 a; float bias; } block;",
                "block.bias",
            ),
            "block.bias",
        ),
        (
            "d.glsl",
            c(
                "layout(std140) uniform Block { vec3 a; float bias; };",
                "bias",
            ),
            "bias",
        ),
        ("e.glsl", c("float bias;", "bias"), "bias"),
        (
            "f.glsl",
            c("uniform int percent;", "float(percent) * 0.01"),
            "percent",
        ),
        (
            "g.glsl",
            c(
                "struct W { float bias; vec2 k; }; uniform W w;\n#define BIAS (w.k.x)",
                "BIAS",
            ),
            "w.k.x",
        ),
        (
            "a.hlsl",
            c(
                "struct W { float bias; }; ConstantBuffer<W> w : register(b0);",
                "w.bias",
            ),
            "w.bias",
        ),
        (
            "b.hlsl",
            c(
                "CBUFFER_START(UnityPerMaterial)\nhalf4 _P; float bias;\nCBUFFER_END",
                "bias",
            ),
            "bias",
        ),
        ("c.hlsl", c("static float bias;", "bias"), "bias"),
        (
            "d.hlsl",
            c("cbuffer A { float4 p : packoffset(c0); };", "p.w"),
            "p.w",
        ),
        ("a.wgsl", wgsl("var<private> bias: f32;", "bias"), "bias"),
        (
            "b.wgsl",
            wgsl(
                "@group(1) @binding(3) var<storage, read> p: vec4<f32>;",
                "p.z",
            ),
            "p.z",
        ),
        ("c.wgsl", wgsl("override bias: f32;", "bias"), "bias"),
    ];
    let place = Place::new();
    for (file, text, name) in asked {
        place.put(file, text);
        let line = format!("{file} --function g --material water");
        place.refused(
            &format!("audit {line}"),
            &[&format!("`{name}`, which it reads from outside")],
        );
        let value = if name == "percent" { "2" } else { "0.02" };
        if let Some(row) = row(&place, &format!("{line} --arg {name}={value}"), 0) {
            let error = row["model_error"]["max_abs"].as_f64().unwrap();
            assert!((error - 0.0596).abs() < 5e-4, "{file}: {error}");
        }
    }
    for (file, text, says) in [
        (
            "t.glsl",
            c("uniform sampler2D map;", "texture(map, vec2(0.5)).r"),
            "`map` (line 1), sampler2D",
        ),
        (
            "t.hlsl",
            c(
                "Texture2D<float4> map; SamplerState s;",
                "map.SampleLevel(s, float2(0, 0), 0).r",
            ),
            "`map` (line 1)",
        ),
        (
            "t.wgsl",
            wgsl(
                "@group(0) @binding(1) var map: texture_2d<f32>;",
                "textureLoad(map, vec2i(0), 0).r",
            ),
            "`map` (line 1)",
        ),
        (
            "u.glsl",
            c("uniform float bias[4];", "bias[1]"),
            "an array of float",
        ),
        ("v.glsl", c("", "gl_FragCoord.x"), "`gl_FragCoord`"),
        ("w.glsl", c("", "fwidth(c)"), "`fwidth`"),
        (
            "x.hlsl",
            c("float b; static const float d = 2 * b;", "d"),
            "`d` is computed from `b`",
        ),
    ] {
        place.put(file, text);
        place.refused(
            &format!("audit {file} --function g --material water"),
            &[says],
        );
    }
}

/// A name of a variable of the function's own hides one outside.
#[test]
fn what_a_function_does_not_read_needs_no_value() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "uniform vec3 f0; uniform float m, other; uniform sampler2D map;\nfloat unused(float x) { return texture(map, vec2(x)).r * other; }\nvec3 f(float c, vec3 f0) { float k = 1.0, m = 1.0 - c; return f0 + (1.0 - f0) * (m*m*m*m*m); }\n",
    );
    error(&place, "f.glsl --function f --material gold", SCHLICK);
    place.put(
        "f.wgsl",
        "@group(0) @binding(0) var<uniform> m: f32;\nfn f(c: f32, f0: vec3f) -> vec3f { let m = 1.0 - c; return f0 + (1.0 - f0) * (m*m*m*m*m); }\n",
    );
    error(&place, "f.wgsl --function f --material gold", SCHLICK);
}

/// Whole shaders of a stage: what the function does not need is not compiled.
#[test]
fn a_function_is_cut_out_of_a_whole_shader() {
    let place = Place::new();
    place.put("f.frag", include_str!("cases/whole.frag"));
    place.put("f.hlsl", include_str!("cases/whole.hlsl"));
    place.put("f.wgsl", include_str!("cases/whole.wgsl"));
    for file in ["f.frag", "f.hlsl", "f.wgsl"] {
        error(
            &place,
            &format!("{file} --function fresnel --material gold"),
            SCHLICK,
        );
    }
    // Lines keep their numbers.
    place.put(
        "g.frag",
        include_str!("cases/whole.frag").replace("return x2 * x2 * x;", "return y2 * x2 * x;"),
    );
    if let Some(ran) = audit(
        &place,
        "g.frag --function fresnel --material gold --gpu none",
    ) {
        let ran = ran.ends(1);
        assert!(ran.err.contains("FAIL g.frag:15:"), "{ran:?}");
    }
}

/// Types of 16 bits run in 16 bits: there the formula gives no number for gold.
#[test]
fn half_precision_is_half_precision_in_every_language() {
    let place = place();
    for file in ["half.hlsl", "min16.hlsl", "mediump.glsl"] {
        let Some(row) = row(&place, &format!("{file} --material gold"), 1) else {
            continue;
        };
        assert_eq!(row["precision"], "f16", "{row}");
        assert_eq!(row["checked"]["within_range"], false, "{row}");
        let reason = row["reason"].as_str().unwrap();
        assert!(
            reason.contains("it gives no number at 2169 cosines"),
            "{reason}"
        );
    }
}

#[test]
fn functions_of_one_name_are_told_apart_by_their_lines() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "float f(float c, float f0) { return f0; }\nvec3 f(float c, vec3 f0) { float m = 1.0 - c; return f0 + (1.0 - f0) * (m*m*m*m*m); }\n",
    );
    for line in [
        "audit f.glsl --material gold",
        "audit f.glsl --function f --material gold",
    ] {
        place.refused(
            line,
            &["--function: f:1 (float c, float f0), f:2 (float c, vec3 f0)"],
        );
    }
    error(&place, "f.glsl --function f:2 --material gold", SCHLICK);
    place.refused(
        "audit f.glsl --function f:7 --material gold",
        &["no function `f` in line `7`; there are f:1, f:2"],
    );
}

#[test]
fn a_result_that_is_an_argument_is_measured() {
    let place = place();
    error(
        &place,
        "shadergraph.hlsl --function Rim_float --material gold",
        SCHLICK,
    );
    if let Some(row) = row(
        &place,
        "shadergraph.hlsl --function Rim_half --material gold",
        0,
    ) {
        let error = row["model_error"]["max_abs"].as_f64().unwrap();
        assert!((error - SCHLICK).abs() < 1e-3, "{row}");
        assert_eq!(
            (&row["cosine"], &row["precision"]),
            (&"NdotV".into(), &"f16".into())
        );
    }
    place.put(
        "f.glsl",
        "void f(in float c, out float o) { float m = 1.0 - c; o = k + (1.0 - k) * (m*m*m*m*m); }\n"
            .replace("k", "f0")
            .replace("in float c,", "in float c, float f0,"),
    );
    error(&place, "f.glsl --function f --material gold", SCHLICK);
}

/// A compiler that fails without a place in the text says nothing of the text.
#[test]
fn a_broken_compiler_is_not_blamed_on_the_text() {
    let place = Place::new();
    let text = "float f(float c) { return c; }\n";
    for (file, compiler) in [("f.hlsl", "dxc"), ("f.slang", "slangc")] {
        place.put(file, text);
        for (number, (script, says)) in [
            (
                "echo \"$0: error while loading shared libraries: libslang.so\" >&2; exit 1",
                "libslang.so",
            ),
            ("kill -SEGV $$", "signal"),
            ("exit 1", "no word"),
            ("exit 0", "wrote nothing"),
        ]
        .into_iter()
        .enumerate()
        {
            let tools = format!("tools{number}");
            put_compiler(&place, &format!("{tools}/{compiler}"), script);
            let ran = place.run(&format!(
                "audit {file} --material gold --gpu none --tools {tools}"
            ));
            let ran = ran.ends(3);
            assert!(ran.err.contains(says), "{file}: {ran:?}");
            assert!(
                ran.out.contains("not checked") && !ran.out.contains("refuses"),
                "{ran:?}"
            );
        }
    }
}

/// DXC is not on most machines, and glslang is. A copy of the program finds none of the compilers that a checkout has.
#[test]
fn hlsl_is_read_by_glslang_where_dxc_is_missing() {
    let glslang = Tool {
        command: "glslangValidator",
        package: "glslang-tools",
    };
    if !glslang.is_here("HLSL by glslang") {
        return;
    }
    let place = place();
    let program = copied(&place);
    let path = std::env::var("PATH").unwrap();
    let script = format!("PATH='{path}' exec glslangValidator \"$@\"");
    put_compiler(&place, "bin/glslangValidator", &script);
    let audit = |file: &str, path: &str, more: &[&str]| {
        let mut command = std::process::Command::new(&program);
        command.args(["audit", file, "--material", "gold", "--gpu", "none"]);
        command
            .args(more)
            .env("PATH", path)
            .current_dir(place.path(""));
        Ran::new(format!("audit {file}"), command.output().unwrap())
    };
    let bin = place.path("bin").display().to_string();
    let row = rows(&audit("same_signature.hlsl", &bin, &["--json", "-"]).ends(0)).remove(0);
    let accepts = row["accepts"].as_object().unwrap();
    assert_eq!(accepts["glslang (dxc is not here)"], "yes", "{row}");
    assert!(
        !accepts.keys().any(|name| name.starts_with("dxc ")),
        "{row}"
    );
    let error = row["model_error"]["max_abs"].as_f64().unwrap();
    assert!((error - SCHLICK).abs() < 2e-6, "{error}");
    // What glslang cannot judge is not checked, and so is everything where it is missing too.
    for (file, path) in [
        ("half.hlsl", bin.as_str()),
        ("min16.hlsl", &bin),
        ("same_signature.hlsl", "/nothing"),
    ] {
        let ran = audit(file, path, &[]).ends(3);
        assert!(ran.out.contains("dxc -HV 2018: not checked"), "{ran:?}");
        assert!(ran.err.contains("no dxc here"), "{ran:?}");
    }
    // DXC alone is asked where it is, though it be broken.
    put_compiler(&place, "bin/dxc", "exit 1");
    let ran = audit("same_signature.hlsl", &bin, &[]).ends(3);
    assert!(!ran.out.contains("glslang"), "{ran:?}");
}
