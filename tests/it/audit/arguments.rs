//! What a function takes: the cosine, what is bound, what the material has.

use super::audit;
use super::rows;
use crate::cli::Place;

const SCHLICK: &str = "vec3 f(float c, vec3 f0, float sharp) {\n    return f0 + (1.0 - f0) * pow(clamp(1.0 - c, 0.0, 1.0), sharp);\n}\n";

#[test]
fn a_wrong_argument_is_named_with_the_nearest_right_one() {
    let place = Place::new();
    place.put("f.glsl", SCHLICK);
    for (flags, says) in [
        (
            "--arg shrp=5",
            "there is no argument `shrp` (did you mean sharp",
        ),
        (
            "--arg sharp=1,2,3",
            "one number in a function that gives three",
        ),
        ("--arg sharp=1,2", "it has 2 numbers"),
        ("--arg sharp=1,5", "a point, not a comma: 1.5, not 1,5"),
        ("--arg sharp=high", "there is no quantity `high`"),
        ("--arg sharp=nan", "`nan` is not a number"),
        ("--arg sharp", "it has no `=`"),
        (
            "--arg sharp=5 --arg c=1",
            "no argument is left for the cosine",
        ),
        ("", "no value for `sharp`"),
        (
            "--arg sharp=5 --function g",
            "there is no function `g`; there are f",
        ),
        ("--arg sharp=5 --function F", "(did you mean f"),
        ("--arg sharp=5 --gpu rdna", "(did you mean rdna"),
        ("--arg sharp=5 --language glls", "(did you mean glsl"),
        ("--arg sharp=5 --limit 0", "--limit is 0"),
    ] {
        place.refused(&format!("audit f.glsl --material gold {flags}"), &[says]);
    }
    place.refused(
        "audit f.glsl --material golt --arg sharp=5",
        &["(did you mean gold"],
    );
    place.refused(
        "audit f.glsl --material none --arg sharp=5",
        &["against a material"],
    );
}

#[test]
fn a_function_that_cannot_be_one_of_reflectance_is_refused_with_its_place() {
    let place = Place::new();
    place.put(
        "f.hlsl",
        "float4 a(float c) { return c; }\nfloat b(float2 c) { return c.x; }\nvoid d(out float c) { c = 1; }\nfloat e(float3 c) { return c.x; }\n",
    );
    for (function, says) in [
        ("a", "f.hlsl:1:8: `a`: it gives `float4`"),
        ("b", "f.hlsl:2:7: `b`: its argument `c` is `float2`"),
        ("d", "f.hlsl:3:6: `d`"),
        ("e", "it takes no single number"),
    ] {
        place.refused(
            &format!("audit f.hlsl --function {function} --material gold"),
            &[says],
        );
    }
    place.refused(
        "audit f.hlsl --material gold",
        &["holds no function from a cosine"],
    );
    place.put(
        "two.wgsl",
        "fn a(c: f32) -> f32 { return c; } fn b(c: f32) -> f32 { return c; }",
    );
    place.refused("audit two.wgsl --material gold", &["--function: a, b"]);
    place.put("none.wgsl", "");
    place.refused(
        "audit none.wgsl --function a --material gold",
        &["it holds no function"],
    );
    place.put("f.txt", "");
    place.refused("audit f.txt --material gold", &["--language"]);
}

#[test]
fn values_are_bound_and_filled_and_told() {
    let place = Place::new();
    place.put("f.glsl", SCHLICK);
    let line = "f.glsl --material gold --gpu none --arg sharp=5 --json -";
    let Some(ran) = audit(&place, line) else {
        return;
    };
    let row = rows(&ran.ends(0)).remove(0);
    assert_eq!(row["arguments"]["sharp"]["from"], "--arg");
    assert_eq!(row["arguments"]["f0"]["from"], "material");
    assert!(row["filled"][0].as_str().unwrap().starts_with("f0 = "));
    let exact = row["model_error"]["max_abs"].as_f64().unwrap();
    let Some(ran) = audit(
        &place,
        "f.glsl --material gold --gpu none --arg sharp=5 --arg f0=1.03,.73,.36 --json -",
    ) else {
        return;
    };
    // A colour above 1 is taken as it is.
    let row = rows(&ran.ends(0)).remove(0);
    assert!(row["model_error"]["max_abs"].as_f64().unwrap() > exact);
}

/// Names that the program around a function has too.
#[test]
fn names_of_the_program_around_it_do_not_collide() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "#version 330 core\nin vec3 n;\nout vec4 colour;\nfloat reflectance(float cos_theta) { return cos_theta; }\nvec3 table(float cos_theta) { return vec3(reflectance(cos_theta)); }\nvoid main() { colour = vec4(table(n.x), 1.0); }\n",
    );
    place.put(
        "f.wgsl",
        "@group(0) @binding(1) var<uniform> camera: vec4f;\n@fragment fn fs() -> @location(0) vec4f { return camera; }\nfn w(c: f32) -> f32 { return c; }\nfn table(mu: f32) -> vec3f { return vec3f(w(mu)); }\n",
    );
    place.put(
        "f.hlsl",
        "cbuffer Camera : register(b0) { float4 camera; };\nfloat4 main() : SV_Target { return camera; }\nhalf table(half NdotV) { return NdotV; }\n",
    );
    for file in ["f.glsl", "f.wgsl", "f.hlsl"] {
        let line = format!("{file} --function table --material gold --gpu none --json -");
        if let Some(ran) = audit(&place, &line) {
            let row = rows(&ran.ends(0)).remove(0);
            // At 90 degrees it is 0, and the law 1.
            assert!(
                row["model_error"]["max_abs"].as_f64().unwrap() > 0.999,
                "{row}"
            );
        }
    }
    place.put("g.wgsl", "fn fg_main(c: f32) -> f32 { return c; }");
    place.refused(
        "audit g.wgsl --material gold",
        &["g.wgsl:1:4: the name `fg_main`"],
    );
}

/// Names of engines, quantities of ours, and what is neither.
#[test]
fn an_argument_is_bound_to_a_quantity_by_its_name() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "float f(float cosine, float strange) { return cosine * strange; }",
    );
    let line = "f.glsl --material water --gpu none --arg strange=1/eta --json -";
    place.refused("audit f.glsl --material water", &["no value for `strange`"]);
    if let Some(ran) = audit(&place, line) {
        let row = rows(&ran.ends(0)).remove(0);
        let strange = &row["arguments"]["strange"];
        assert_eq!(strange["quantity"], "1/eta", "{row}");
        assert_eq!(strange["from"], "material", "{row}");
        let value = strange["value"][0].as_f64().unwrap();
        assert!((value - 1.0 / 1.3313).abs() < 1e-4, "{row}");
        assert_eq!(
            row["filled"][0].as_str().unwrap().split(" = ").next(),
            Some("strange (1/eta)")
        );
    }
    for (flags, says) in [
        (
            "--arg strange=1/eto",
            "there is no quantity `1/eto` (did you mean 1/eta",
        ),
        ("--arg strange=f82_tin", "(did you mean f82_tint"),
        ("--arg strange=nan", "`nan` is not a number"),
        ("--arg strange=1/2", "`1/2` is not a number"),
        ("--arg strange=f82,f82,f82", "`f82` is not a number"),
        (
            "--arg strong=eta",
            "there is no argument `strong` (did you mean strange",
        ),
    ] {
        place.refused(&format!("audit f.glsl --material water {flags}"), &[says]);
    }
    place.refused(
        "audit f.glsl --material gold --arg strange=eta",
        &["gold has no value for `strange` (eta); bind"],
    );
    place.put(
        "three.glsl",
        "vec3 f(float cosine, float ior) { return vec3(cosine * ior); }",
    );
    place.refused(
        "audit three.glsl --material water",
        &["water has no value for `ior` (eta), which is one number here and differs between the channels; bind"],
    );
}

/// Macros that stand for types, as Unity's.
#[test]
fn macros_that_stand_for_types_are_read() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "#define real float\n#define real3 vec3\n#define CONST const in highp\nreal3 f(CONST real3 f0, real u) { return f0 * u; }\n",
    );
    place.put(
        "f.hlsl",
        "#if defined(SHADER_API_MOBILE)\n#define real half\n#define real3 half3\n#else\n#define real float\n#define real3 float3\n#endif\n#define TEMPLATE inline\nTEMPLATE real3 f(real3 f0, real u) { return f0 * u; }\n",
    );
    place.put(
        "typedef.hlsl",
        "typedef float3 Colour;\nColour f(Colour f0, float u) { return f0 * u; }\n",
    );
    place.put(
        "f.wgsl",
        "alias real = f32;\nfn f(f0: vec3f, u: real) -> vec3f { return f0 * u; }\n",
    );
    for file in ["f.glsl", "f.hlsl", "typedef.hlsl", "f.wgsl"] {
        let line = format!("{file} --material gold --gpu none --json -");
        if let Some(ran) = audit(&place, &line) {
            let row = rows(&ran.ends(0)).remove(0);
            assert_eq!(row["input_numbers"], 3, "{row}");
        }
    }
    place.put(
        "wide.hlsl",
        "#if WIDE\n#define real float3\n#else\n#define real float\n#endif\nreal f(real f0, float u) { return f0 * u; }\n",
    );
    for (flags, channels) in [("", 1), ("-D WIDE=1", 3)] {
        let line = format!("wide.hlsl --material gold --gpu none --json - {flags}");
        if let Some(ran) = audit(&place, &line) {
            assert_eq!(
                rows(&ran.ends(0)).remove(0)["channels"],
                channels,
                "{flags}"
            );
        }
    }
}
