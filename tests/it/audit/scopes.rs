//! Names that mean one thing outside of a function and another in a part of it, values that other code can set, and functions that
//! macros stand for.

use serde_json::Value;

use super::audit;
use super::rows;
use crate::cli::Place;

/// The largest error of Schlick's formula for gold.
const SCHLICK: f64 = 0.022306;

/// The row of a text that ends with 0; none where the machine lacks something.
#[track_caller]
fn row(file: &str, text: &str, more: &str) -> Option<Value> {
    let place = Place::new();
    place.put(file, text);
    let line = format!("{file} --function F --material gold --gpu none --json - {more}");
    let ran = audit(&place, &line)?;
    Some(rows(&ran.ends(0)).remove(0))
}

#[track_caller]
fn is_schlick(file: &str, text: &str) {
    if let Some(row) = row(file, text, "") {
        let error = row["model_error"]["max_abs"].as_f64().unwrap();
        assert!((error - SCHLICK).abs() < 2e-6, "{text}: {error}");
    }
}

/// The name of a constant or a function that a part of the body uses otherwise.
#[test]
fn a_local_name_hides_another_only_in_its_block() {
    let glsl = |body: &str| {
        format!(
            "const float expo = 5.0;\nfloat q(float x) {{ return x * x * x * x * x; }}\nvec3 F(float c, vec3 f0) {{ c = clamp(c, 0.0, 1.0); {body} }}\n"
        )
    };
    for body in [
        "vec3 r; { float expo = 2.0; r = vec3(expo); } return f0 + (1.0 - f0) * pow(1.0 - c, expo) + r * 0.0;",
        "float expo = expo + 0.0; return f0 + (1.0 - f0) * pow(1.0 - c, expo);",
        "float r = 0.0; for (int expo = 0; expo < 2; expo++) r += 1.0; return f0 + (1.0 - f0) * pow(1.0 - c, expo) + r * 0.0;",
        "float r = 0.0; for (int expo = 0, q = 1; expo < 2; expo++) { r += 1.0; } return f0 + (1.0 - f0) * q(1.0 - c) + r * 0.0;",
        "float q = q(1.0 - c); return f0 + (1.0 - f0) * q;",
    ] {
        is_schlick("s.glsl", &glsl(body));
    }
    is_schlick(
        "s.hlsl",
        "static const float expo = 5.0;\nfloat3 F(float c, float3 f0) { c = saturate(c); float3 r; { float expo = 2.0; r = expo; } return f0 + (1.0 - f0) * pow(1.0 - c, expo) + r * 0.0; }\n",
    );
    is_schlick(
        "s.wgsl",
        "const expo = 5.0;\nfn F(cosine: f32, f0: vec3f) -> vec3f { let c = clamp(cosine, 0.0, 1.0); let expo = expo + 0.0; return f0 + (1.0 - f0) * pow(1.0 - c, expo); }\n",
    );
}

/// A type and a constant of it may stand in one declaration, and an enumeration is refused in words.
#[test]
fn constants_in_the_declaration_of_a_type_are_taken_along() {
    let hlsl = |before: &str, power: &str| {
        format!(
            "{before}\nfloat3 F(float c, float3 f0) {{ c = saturate(c); return f0 + (1.0 - f0) * pow(1.0 - c, {power}); }}\n"
        )
    };
    is_schlick(
        "s.glsl",
        "const struct T { float e; } K = T(5.0);\nvec3 F(float c, vec3 f0) { c = clamp(c, 0.0, 1.0); return f0 + (1.0 - f0) * pow(1.0 - c, K.e); }\n",
    );
    is_schlick(
        "s.hlsl",
        &hlsl("static const struct { float e; } K = { 5.0 };", "K.e"),
    );
    // DXC's SPIR-V has 7e-45 for this 5.
    for (before, name) in [
        ("enum K { A = 1, E = 5 };", "E"),
        ("enum class K { E = 5 };", "float(K::E)"),
    ] {
        let place = Place::new();
        place.put("s.hlsl", hlsl(before, name));
        let ran = place.run("audit s.hlsl --function F --material gold");
        assert!(
            ran.code != Some(0) && ran.err.contains("it needs an `enum`"),
            "{ran:?}"
        );
    }
}

/// What the file gives a value that other code may change: it is taken, told, and can be given.
#[test]
fn a_value_that_other_code_can_set_is_told() {
    let initialised = |row: &Value| row["initialised"].to_string();
    for (file, text, value) in [
        (
            "g.glsl",
            "float expo = 1.0;\nvec3 F(float c, vec3 f0) { c = clamp(c, 0.0, 1.0); return f0 + (1.0 - f0) * pow(1.0 - c, expo); }\nvoid main() { expo = 5.0; }\n",
            "expo = 1.0 (line 1)",
        ),
        (
            "g.wgsl",
            "var<private> expo: f32 = 1.0;\nfn F(cosine: f32, f0: vec3f) -> vec3f { let c = clamp(cosine, 0.0, 1.0); return f0 + (1.0 - f0) * pow(1.0 - c, expo); }\n@fragment fn main() { expo = 5.0; }\n",
            "expo = 1.0 (line 1)",
        ),
        (
            "g.hlsl",
            "cbuffer P : register(b0) { float expo = 1.0; float3 other; };\nfloat3 F(float c, float3 f0) { c = saturate(c); return f0 + (1.0 - f0) * pow(1.0 - c, expo); }\n",
            "expo = 1.0 (line 1)",
        ),
    ] {
        let Some(taken) = row(file, text, "") else {
            continue;
        };
        assert!(initialised(&taken).contains(value), "{file}: {taken}");
        let given = row(file, text, "--arg expo=5").expect("it ran before");
        assert_eq!(given["initialised"], serde_json::json!([]), "{file}");
        let error = given["model_error"]["max_abs"].as_f64().unwrap();
        assert!((error - SCHLICK).abs() < 2e-6, "{file}: {error}");
    }
    // One that nobody can set, and one that the function sets itself, are no inputs.
    let own = "const float one = 1.0;\nfloat x = 9.0;\nvec3 F(float c, vec3 f0) { x = one - clamp(c, 0.0, 1.0); return f0 + (1.0 - f0) * pow(x, 5.0); }\n";
    if let Some(row) = row("own.glsl", own, "") {
        assert_eq!(row["initialised"], serde_json::json!([]), "{row}");
    }
}

/// A function that stands there as the call of a macro, with a `;` behind it or none.
#[test]
fn what_a_macro_stands_for_is_found() {
    for call in ["DEF(p5)", "DEF(p5);"] {
        let c = "#define DEF(name) float name(float x) { return x * x * x * x * x; }\n";
        let glsl = format!(
            "{c}{call}\nvec3 F(float c, vec3 f0) {{ c = clamp(c, 0.0, 1.0); return f0 + (1.0 - f0) * p5(1.0 - c); }}\n"
        );
        // GLSL ES has no empty declaration.
        if !call.ends_with(';') {
            is_schlick("m.glsl", &glsl);
        }
        let hlsl = glsl
            .replace("vec3", "float3")
            .replace("clamp(c, 0.0, 1.0)", "saturate(c)");
        is_schlick("m.hlsl", &hlsl);
    }
}

/// A text for one version of HLSL is right in it.
#[test]
fn a_text_for_one_version_of_hlsl_is_no_fault() {
    is_schlick(
        "v.hlsl",
        "template<typename T> T lerp1(T a, float t) { return a + (1 - a) * t; }\nfloat3 F(float c, float3 f0) { return lerp1(f0, pow(1 - saturate(c), 5)); }\n",
    );
}
