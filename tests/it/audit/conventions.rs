//! What people's functions take and where they stand: an angle for a cosine, arguments with values of their own, namespaces, GLSL of
//! the desktop, variables that are read before they are set.

use serde_json::Value;

use super::{audit, rows};
use crate::cli::Place;

/// The largest error of Schlick's formula for gold.
const SCHLICK: f64 = 0.022306;

/// The exact law with a relative index, of an angle in a name of its own.
fn exact(name: &str, cosine: &str) -> String {
    format!(
        "float fresnel(float {name}, float rel_index) {{
    float c = {cosine};
    float g = sqrt(rel_index * rel_index - 1.0 + c * c);
    float a = (g - c) / (g + c);
    float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}}\n"
    )
}

#[track_caller]
fn row(place: &Place, line: &str) -> Option<Value> {
    let ran = audit(place, &format!("{line} --gpu none --json -"))?;
    Some(rows(&ran.ends(0)).remove(0))
}

#[track_caller]
fn error(place: &Place, line: &str, expected: f64) {
    if let Some(row) = row(place, line) {
        let error = row["model_error"]["max_abs"].as_f64().unwrap();
        assert!((error - expected).abs() < 3e-6, "{line}: {error}");
    }
}

/// A name says that it is the angle, a sine, a square or a rest, and the report says what it was taken as.
#[test]
fn what_is_no_cosine_gets_what_its_name_says() {
    let place = Place::new();
    for (name, cosine, is) in [
        ("theta", "cos(theta)", "angle"),
        ("incidence", "cos(incidence)", "angle"),
        ("angle", "cos(angle)", "angle"),
        ("x", "cos(x)", "angle"),
        ("angle_deg", "cos(radians(angle_deg))", "degrees"),
        ("theta", "theta; c = min(c, 1.0 - (1.0 - theta))", "cos"),
        ("sinTheta", "sqrt(1.0 - sinTheta * sinTheta)", "sin"),
        ("sin_theta", "sqrt(1.0 - sin_theta * sin_theta)", "sin"),
        ("sin2", "sqrt(1.0 - sin2)", "sin^2"),
        ("cos2", "sqrt(cos2)", "cos^2"),
        ("cosSquared", "sqrt(cosSquared)", "cos^2"),
        ("oneMinusVoH", "1.0 - oneMinusVoH", "1-cos"),
        ("oneMinusCosTheta", "1.0 - oneMinusCosTheta", "1-cos"),
        ("omc", "1.0 - omc", "1-cos"),
    ] {
        place.put("f.glsl", exact(name, cosine));
        let Some(row) = row(&place, "f.glsl --material water") else {
            return;
        };
        assert_eq!(
            (&row["cosine"], &row["cosine_is"]),
            (&name.into(), &is.into())
        );
        let error = row["model_error"]["max_abs"].as_f64().unwrap();
        // A sine in single precision has few digits of a small cosine.
        let most = if is.starts_with("sin") { 2e-3 } else { 1e-4 };
        assert!(error < most, "{name}: {error}");
    }
    place.put("f.glsl", exact("theta", "cos(theta)"));
    let ran = audit(&place, "f.glsl --material water --gpu none").unwrap();
    let says = "`theta`, taken as the angle in radians, acos of the cosine";
    assert!(ran.out.contains(says), "{ran:?}");
}

/// Where neither the name nor the text tells, the argument is asked for, and `--arg` answers.
#[test]
fn what_is_not_clear_is_asked_for() {
    let place = Place::new();
    let helped = format!(
        "float c_of(float t) {{ return cos(t); }}\n{}",
        exact("theta", "c_of(theta)")
    );
    place.put("f.glsl", helped);
    let line = "f.glsl --function fresnel --material water";
    place.refused(
        &format!("audit {line}"),
        &[
            "whether `theta` is the cosine or the angle is not clear",
            "--arg theta=angle",
        ],
    );
    error(&place, &format!("{line} --arg theta=angle"), 0.000001);
    place.put("g.glsl", exact("ct", "cos(ct)"));
    place.refused(
        "audit g.glsl --material water",
        &["--arg ct=cos or --arg ct=angle"],
    );
    error(&place, "g.glsl --material water --arg ct=angle", 0.000001);
    // Two numbers are left, and none is named.
    place.put("h.glsl", "float f(float a, float b) { return b; }\n");
    place.refused(
        "audit h.glsl --material water",
        &["say so with --arg a=cos"],
    );
    error(
        &place,
        "h.glsl --material water --arg a=cos --arg b=1",
        0.979803,
    );
    place.put(
        "w.glsl",
        "vec3 f(vec3 N, vec3 V, float ior) { return N * V * ior; }\n",
    );
    place.refused(
        "audit w.glsl --material water --function f",
        &[
            "no value for `N`, `V`",
            "write a function of the cosine that calls it",
        ],
    );
    place.put(
        "i.glsl",
        "vec3 f(vec3 f0, float ior) { return f0 * ior; }\n",
    );
    place.refused(
        "audit i.glsl --material water",
        &["no value for `ior` (eta)"],
    );
    place.put("v.glsl", "float f(vec3 a, float b) { return b; }\n");
    place.refused(
        "audit v.glsl --material water --arg a=cos",
        &["no argument of one number"],
    );
}

/// An argument that alone is left is taken as the cosine, and said to be something else where that fits.
#[test]
fn another_meaning_of_the_cosine_that_fits_is_told() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "vec3 f(vec3 f0, float x) { return f0 + (1.0 - f0) * x * x * x * x * x; }\n",
    );
    let Some(row) = row(&place, "f.glsl --material gold") else {
        return;
    };
    let fit = &row["fits_exactly_with"];
    assert_eq!(
        (&fit["argument"], &fit["quantity"]),
        (&"x".into(), &"1-cos".into())
    );
    error(&place, "f.glsl --material gold --arg x=1-cos", SCHLICK);
}

/// A value that the text gives an argument is taken before the material's, and `--arg` before both.
#[test]
fn defaults_of_arguments_are_taken_and_told() {
    let place = Place::new();
    let body = "{ return F0 + (F90 - F0) * pow(1.0 - saturate(VoH), Power); }\n";
    for (file, before, params) in [
        (
            "f.hlsl",
            "",
            "float3 F0, float VoH, float F90 = 1.0, float Power = 5.0",
        ),
        (
            "g.hlsl",
            "#define FIVE 5.0\nstatic const float ONE = 1.0;\n",
            "float3 F0, float VoH = 1.0, float3 F90 = float3(1, 1, 1) * ONE, float Power = FIVE",
        ),
        (
            "h.hlsl",
            "float3 F(float3 F0, float VoH, float F90 = 1.0, float Power = 5.0);\n",
            "float3 F0, float VoH, float F90, float Power",
        ),
    ] {
        place.put(file, format!("{before}float3 F({params}) {body}"));
        let line = format!("{file} --material gold");
        error(&place, &line, SCHLICK);
        if let Some(row) = row(&place, &line) {
            let told = row["initialised"].as_array().unwrap();
            assert_eq!(told.len(), 2, "{row}");
            assert!(told[1].as_str().unwrap().starts_with("Power = "), "{row}");
        }
        error(&place, &format!("{line} --arg Power=4"), 0.069536);
    }
}

/// A version of the desktop is run as such: an integer may stand for a number there.
#[test]
fn glsl_of_the_desktop_runs_as_it_is() {
    let place = Place::new();
    let body = "vec3 f(float c, vec3 F0) { mediump float m = 1 - min(c, 1); return F0 + (1 - F0) * m * m * m * m * m; }\n";
    for version in ["330 core", "400", "120", "450", "150 compatibility"] {
        place.put(
            "f.glsl",
            format!("#version {version}\n#ifdef GL_ES\nprecision mediump float;\n#endif\nvarying vec3 n;\nuniform sampler2D t;\n{body}void main() {{ gl_FragColor = texture2D(t, n.xy); }}\n"),
        );
        let Some(row) = row(&place, "f.glsl --material gold") else {
            return;
        };
        assert_eq!(
            (&row["target"], &row["precision"]),
            (&"glsl".into(), &"f32".into()),
            "{row}"
        );
        assert_eq!(row["language_remark"], Value::Null);
        error(&place, "f.glsl --material gold", SCHLICK);
    }
    place.put(
        "v.glsl",
        format!("#version 330\n#if __VERSION__ == 330\n{body}#endif\n"),
    );
    error(&place, "v.glsl --material gold", SCHLICK);
    // Without a version GLSL ES is asked first, and the desktop where that refuses.
    place.put("n.glsl", body);
    if let Some(row) = row(&place, "n.glsl --material gold") {
        let remark = row["language_remark"].as_str().unwrap();
        assert!(remark.starts_with("GLSL 4.50"), "{row}");
    }
    // What neither takes is a finding, and so is what the stated version does not take.
    for (version, says) in [
        ("", "wrong operand"),
        ("#version 330\n", "undeclared"),
        ("#version 300 es\n", "wrong operand"),
    ] {
        let name = if version.contains("es") {
            "1"
        } else {
            "nothing"
        };
        let text =
            format!("{version}vec3 f(float c, vec3 F0) {{ return F0 + (1 - F0) * {name}; }}\n");
        place.put("w.glsl", text);
        if let Some(ran) = audit(&place, "w.glsl --material gold --gpu none") {
            let ran = ran.ends(1);
            assert!(
                ran.err.contains("w.glsl:") && ran.err.contains(says),
                "{ran:?}"
            );
            assert!(!ran.err.contains("shader.comp"), "{ran:?}");
        }
    }
    place.put(
        "u.glsl",
        format!(
            "#version 330\nuniform float bias;\n{}",
            body.replace("1 - min", "bias - min")
        ),
    );
    place.refused("audit u.glsl --material gold", &["no value for `bias`"]);
    error(&place, "u.glsl --material gold --arg bias=1", SCHLICK);
}

/// Namespaces and types around a function in HLSL.
#[test]
fn functions_in_namespaces_and_types_are_audited() {
    let place = Place::new();
    place.put(
        "f.hlsl",
        "static const float POWER = 5.0;
namespace other { float3 F(float3 F0, float VoH) { return F0; } }
namespace brdf
{
    static const float ONE = 1.0;
    float bias = 0.0;
    static float wet;
    float pow5(float x) { return pow(saturate(x), POWER); }
    namespace detail { float3 mixed(float3 a, float b) { return a + (ONE - a) * b; } }
    float3 F(float3 F0, float VoH) { return detail::mixed(F0, pow5(ONE - VoH + bias)); }
    float3 Wet(float3 F0, float VoH) { return wet * F(F0, VoH); }
}
struct BRDF
{
    float roughness;
    static float weight(float x) { return pow(saturate(1.0 - x), POWER); }
    static float3 F(float3 F0, float VoH) { return F0 + (1 - F0) * weight(VoH); }
    float3 G(float3 F0, float VoH) { return F0 * roughness * VoH; }
};
float4 main(float3 c : C) : SV_Target { return float4(brdf::F(c, c.x), 1); }
",
    );
    for function in ["brdf::F", "brdf::F:10", "BRDF::F"] {
        let line = format!("f.hlsl --material gold --function {function}");
        error(&place, &line, SCHLICK);
    }
    if let Some(row) = row(&place, "f.hlsl --material gold --function brdf::F") {
        assert_eq!(
            (&row["function"], &row["line"]),
            (&"brdf::F".into(), &10.into())
        );
    }
    place.refused(
        "audit f.hlsl --material gold --function F",
        &["other::F", "brdf::F", "BRDF::F"],
    );
    place.refused(
        "audit f.hlsl --material gold --function BRDF::G",
        &["f.hlsl:18:12", "a function of objects of `BRDF`"],
    );
    place.refused(
        "audit f.hlsl --material gold --function brdf::Wet",
        &["no value for `wet`"],
    );
    error(
        &place,
        "f.hlsl --material gold --function brdf::Wet --arg wet=1",
        SCHLICK,
    );
}

/// A variable that may be read before it is set has no value.
#[test]
fn a_variable_that_is_read_before_it_is_set_is_asked_for() {
    let place = Place::new();
    let f = |before: &str, body: &str| {
        format!(
            "float g;\n{before}vec3 f(float c, vec3 f0) {{ {body} float m = clamp(1.0 - c, 0.0, 1.0); return f0 + (1.0 - f0) * m * m * m * m * m * (1.0 - g); }}\n"
        )
    };
    for (before, body) in [
        ("", ""),
        ("", "if (c > 2.0) g = 1.0;"),
        ("", "g += 0.0;"),
        ("", "float h = g; g = 0.0;"),
        ("float h() { return g; }\n", "float k = h(); g = 0.0;"),
        ("void h() { g = 0.0; }\n", "if (c > 2.0) h();"),
    ] {
        place.put("f.glsl", f(before, body));
        place.refused(
            "audit f.glsl --function f --material gold",
            &["no value for `g`, which it reads from outside (line 1); bind"],
        );
        error(
            &place,
            "f.glsl --function f --material gold --arg g=0",
            SCHLICK,
        );
    }
    for (before, body) in [
        ("", "g = 0.0;"),
        ("float h() { return g; }\n", "g = 0.0; float k = h();"),
        (
            "float h() { g = 0.0; return g; }\n",
            "g = 0.0; float k = h();",
        ),
    ] {
        place.put("f.glsl", f(before, body));
        error(&place, "f.glsl --function f --material gold", SCHLICK);
    }
}

/// Gulbrandsen's inputs, as `materials params` prints them.
#[test]
fn the_artist_s_inputs_have_a_metal_s_values() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "vec3 f(float cosTheta, vec3 reflectivity, vec3 edgeTint) { return reflectivity + 0.0 * edgeTint * cosTheta; }\n",
    );
    if let Some(row) = row(&place, "f.glsl --material gold") {
        let green = |name: &str| row["arguments"][name]["value"][1].as_f64().unwrap();
        assert!((green("reflectivity") - 0.77271).abs() < 1e-5, "{row}");
        assert!((green("edgeTint") - 0.98195).abs() < 1e-5, "{row}");
    }
}
