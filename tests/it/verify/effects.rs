//! Functions of effects as `verify` runs them: on every target, in every form, and with one thing wrong.

use super::command::rows;
use super::command::verify;
use crate::cli::{OUT, Place};

#[test]
fn every_function_runs_on_every_target() {
    let place = Place::new();
    place.done("--effect all");
    let Some(ran) = verify(&place, "--effect all --json -") else {
        return;
    };
    let rows = rows(&ran.ends(0));
    let functions = fresnel_gen::language::effects::ALL
        .iter()
        .map(|one| one.functions.len());
    let functions: usize = functions.sum();
    for target in ["wgsl", "spirv", "gles", "hlsl"] {
        let own: Vec<_> = rows.iter().filter(|row| row["target"] == target).collect();
        let library = own.iter().filter(|row| row["form"] == "library");
        assert_eq!(library.count(), functions, "{target}");
        for row in own {
            assert_eq!(row["status"], "pass", "{row}");
            assert!(row["code_error"]["max_abs"].is_number(), "{row}");
            assert!(row["effect"].is_string() && row["shipped"] == true, "{row}");
        }
    }
}

#[test]
fn other_methods_and_materials_run_too() {
    let place = Place::new();
    for line in [
        "--effect all --method schlick",
        "--effect interface,ggx_specular --method fitted",
        "--effect interface --method fitted --material gold",
        "--effect interface,interior --method dielectric_textbook",
        "--effect dispersion,interface --material air",
        "--effect interface,complex_f0 --material gold",
        "--effect dispersion,interior --material diamond",
    ] {
        let Some(ran) = verify(&place, &format!("{line} --json -")) else {
            return;
        };
        let rows = rows(&ran.ends(0));
        assert!(rows.len() >= 4, "{line}: {rows:?}");
    }
}

/// Edits that only points of the right kind tell: the effect, flags, what stands in the text, and what in its place.
const EDITS: [[&str; 4]; 9] = [
    ["interior", "", "2.0 * facing", "2.01 * facing"],
    ["interior", "", "uv_scale_bias.w", "uv_scale_bias.z"],
    ["interior", "", "abs(distance)", "max(distance, 0.0)"],
    ["parallax", "", "_sampler, reached", "_sampler, -reached"],
    ["parallax", "", "_sampler, reached", "_sampler, reached.zyx"],
    ["water", "", "(position, 1.0)).x", "(position, 0.0)).x"],
    ["interface", "", "max(cos2_t, 0.0)", "max(cos2_t, 0.001)"],
    ["ggx_specular", "", "0.001)", "0.0009)"],
    [
        "interface",
        " --method dielectric_textbook",
        "return ",
        "return 1.3 * ",
    ],
];

/// An edited function fails, with the arguments at which it is wrong.
#[test]
fn an_edited_function_fails() {
    for [effect, by, from, to] in EDITS {
        let place = Place::new();
        place.done(&format!("--effect {effect}{by} --target wgsl"));
        let method = by.split_whitespace().nth(1);
        let suffix = method.map_or(String::new(), |method| format!("_{method}"));
        let path = format!("{OUT}/wgsl/effects/{effect}{suffix}.wgsl");
        let text = place.read(&path);
        assert!(text.contains(from), "{from}: {text}");
        place.put(&path, text.replace(from, to));
        let ran = place.run(&format!("verify --effect {effect}{by} --target wgsl"));
        if ran.code == Some(3) {
            return crate::not_checked(&ran.err);
        }
        assert_eq!(ran.code, Some(1), "{from} -> {to}: {ran:?}");
        assert!(ran.err.contains(": at "), "{}", ran.err);
    }
}
