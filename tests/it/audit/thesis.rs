//! The formulas of the thesis, written by hand in each language, have the errors that our methods have.

use super::audit;
use super::rows;
use crate::cli::Place;
use crate::subjects;
use fresnel_gen::generator::fit::{ModelError, model_error, values_for_material};
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::language::methods;

const LANGUAGES: [&str; 3] = ["wgsl", "glsl", "hlsl"];

/// The function written by hand, our method, and the materials that both are held against.
const FORMULAS: [(&str, &str, &[&str]); 5] = [
    ("dielectric", "dielectric_exact", &["water", "diamond"]),
    ("conductor", "conductor_exact", &["gold", "platinum"]),
    ("schlick", "schlick", &["gold", "platinum", "water"]),
    (
        "rescaled",
        "schlick_rescaled",
        &["gold", "platinum", "water"],
    ),
    ("corrected", "schlick_corrected", &["gold", "platinum"]),
];

/// A place with the formulas in every language.
pub fn place() -> Place {
    let place = Place::new();
    place.put("thesis.wgsl", include_str!("functions/thesis.wgsl"));
    place.put("thesis.glsl", include_str!("functions/thesis.glsl"));
    place.put("thesis.hlsl", include_str!("functions/thesis.hlsl"));
    place
}

fn ours(method: &str, subject: &MaterialInMedium) -> ModelError {
    let method = methods::find(method).unwrap();
    let function = method
        .specialise(&values_for_material(subject, method))
        .unwrap();
    model_error(&function, &subject.truth_for(method))
}

#[test]
fn formulas_written_by_hand_have_the_errors_of_our_methods() {
    let place = place();
    for (function, method, materials) in FORMULAS {
        let ours: Vec<ModelError> = subjects(materials)
            .iter()
            .map(|subject| ours(method, subject))
            .collect();
        for language in LANGUAGES {
            let list = materials.join(",");
            let line = format!(
                "thesis.{language} --function {function} --material {list} --gpu none --json -"
            );
            let Some(ran) = audit(&place, &line) else {
                continue;
            };
            let rows = rows(&ran);
            assert_eq!(rows.len(), materials.len(), "{ran:?}");
            for (row, ours) in rows.iter().zip(&ours) {
                // Single precision against f64; powers are a device's own.
                let near = |key: &str, want: f64, most: f64| {
                    let got = row["model_error"][key].as_f64().unwrap();
                    assert!(
                        (got - want).abs() < most,
                        "{key}: {got}, ours {want}: {row}"
                    );
                };
                near("max_abs", ours.max_abs, 1e-6);
                near("mean_abs", ours.mean_abs, 1e-6);
                near("mean_rel", ours.mean_rel.unwrap(), 2e-5);
                assert_eq!(row["model_error"]["undefined"], 0, "{row}");
            }
        }
    }
}

#[test]
fn what_a_careless_power_gives_beyond_one_is_found() {
    let place = place();
    let line = "thesis.hlsl --function corrected --material platinum --gpu none";
    if let Some(ran) = audit(&place, line) {
        let ran = ran.ends(1);
        let says = "thesis.hlsl: corrected: at cos_theta = 1 + 1 ulp it is NaN";
        assert!(ran.err.contains(says), "{ran:?}");
    }
}

#[test]
fn a_function_is_dominated_or_on_the_frontier() {
    let place = place();
    for language in LANGUAGES {
        let line = format!(
            "thesis.{language} --function conductor --material platinum --gpu rdna2 --json - --junit a.xml"
        );
        let Some(ran) = audit(&place, &line) else {
            continue;
        };
        let row = rows(&ran.ends(0)).remove(0);
        assert!(place.read("a.xml").contains("fresnel-gen audit"));
        let Some(net) = row["cost"][0]["net"].as_f64() else {
            crate::not_checked(&format!("audit {line}: {}", row["cost"][0]["reason"]));
            continue;
        };
        assert!(net > 20.0, "{row}");
        let says = row["says"]["rdna2"].as_str().unwrap();
        let dominated = row["dominated_by"].as_array().unwrap();
        assert_eq!(
            says.starts_with("dominated by "),
            !dominated.is_empty(),
            "{row}"
        );
    }
}

/// Platinum's minimum is missed by Schlick and not by four fitted coefficients, which cost no more, but take more numbers.
#[test]
fn a_fitted_method_is_better_than_schlick_with_more_inputs() {
    let place = place();
    let line = "thesis.wgsl --function schlick --material platinum --gpu rdna2,operations --json -";
    let Some(ran) = audit(&place, line) else {
        return;
    };
    let row = rows(&ran.ends(0)).remove(0);
    assert!(row["cost"][1]["reason"].is_string(), "{row}");
    if row["cost"][0]["net"].is_null() {
        crate::not_checked(&format!("audit {line}: {}", row["cost"][0]["reason"]));
        return;
    }
    let says = row["says"]["rdna2"].as_str().unwrap();
    assert!(
        says.contains("but fitted takes 12 inputs instead of 3"),
        "{says}"
    );
    let first = &row["better_with_more_inputs"][0];
    assert!(first["error_times"].as_f64().unwrap() > 5.0, "{row}");
}

#[test]
fn two_runs_say_the_same() {
    let place = place();
    let line = "thesis.glsl --function rescaled --material gold --gpu none --json -";
    if let (Some(one), Some(two)) = (audit(&place, line), audit(&place, line)) {
        assert_eq!(one.out, two.out);
        assert_eq!(
            one.json()["command"],
            "audit thesis.glsl --function rescaled --material gold --gpu none"
        );
    }
}
