//! Published formulas in the forms that engines write them in: each is bound by its arguments' names, accepted, recognised, and has the
//! error that is known of it.

use serde_json::Value;

use super::audit;
use super::rows;
use crate::cli::Place;

/// The formulas, by file.
const FILES: [(&str, &str); 11] = [
    ("schlick.glsl", include_str!("functions/schlick.glsl")),
    ("schlick.hlsl", include_str!("functions/schlick.hlsl")),
    (
        "schlick_gaussian.glsl",
        include_str!("functions/schlick_gaussian.glsl"),
    ),
    ("f82_tint.glsl", include_str!("functions/f82_tint.glsl")),
    ("f82_tint.hlsl", include_str!("functions/f82_tint.hlsl")),
    ("dielectric.glsl", include_str!("functions/dielectric.glsl")),
    ("dielectric.hlsl", include_str!("functions/dielectric.hlsl")),
    (
        "dielectric.slang",
        include_str!("functions/dielectric.slang"),
    ),
    ("conductor.glsl", include_str!("functions/conductor.glsl")),
    ("conductor.hlsl", include_str!("functions/conductor.hlsl")),
    ("tinted.glsl", include_str!("functions/tinted.glsl")),
];

const ALL: &str = "gold,silver,copper,aluminium,platinum,silicon,water,bk7,diamond";
const METALS: &str = "gold,silver,copper,aluminium,platinum,silicon";
const CLEAR: &str = "water,bk7,diamond";

/// The largest errors of these formulas against spectra (CIE 1931, D65, linear sRGB, clipped), measured by a program that shares nothing
/// with this one.
const SCHLICK: &[f64] = &[
    0.0223, 0.0069, 0.0432, 0.1092, 0.1731, 0.2468, 0.0596, 0.0348, 0.0775,
];
const GAUSSIAN: &[f64] = &[
    0.0243, 0.0069, 0.0429, 0.1093, 0.1734, 0.2482, 0.0619, 0.0379, 0.0798,
];
const F82_TINT: &[f64] = &[
    0.0212, 0.0020, 0.0111, 0.0099, 0.0127, 0.0553, 0.0203, 0.0285, 0.0298,
];
const CONDUCTOR: &[f64] = &[0.0044, 0.0001, 0.0040, 0.0008, 0.0006, 0.0001];
const DIELECTRIC: &[f64] = &[0.0, 0.0, 0.0];

/// A formula: its file, its function, the materials, their errors, the method of ours that it is.
type Formula = (
    &'static str,
    &'static str,
    &'static str,
    &'static [f64],
    &'static str,
);

const FORMULAS: [Formula; 17] = [
    ("schlick.glsl", "schlick", ALL, SCHLICK, "schlick"),
    ("schlick.glsl", "schlick_power", ALL, SCHLICK, "schlick"),
    ("schlick.glsl", "schlick_f90", ALL, SCHLICK, "schlick"),
    ("schlick.glsl", "schlick_scalar", ALL, SCHLICK, "schlick"),
    ("schlick.hlsl", "schlick", ALL, SCHLICK, "schlick"),
    ("schlick.hlsl", "schlick_f90", ALL, SCHLICK, "schlick"),
    ("schlick.hlsl", "schlick_scalar", ALL, SCHLICK, "schlick"),
    (
        "schlick_gaussian.glsl",
        "schlick_gaussian",
        ALL,
        GAUSSIAN,
        "schlick_spherical_gaussian",
    ),
    (
        "f82_tint.glsl",
        "f82_tint_folded",
        ALL,
        F82_TINT,
        "f82_tint",
    ),
    (
        "f82_tint.glsl",
        "f82_tint_by_schlick",
        ALL,
        F82_TINT,
        "f82_tint",
    ),
    (
        "f82_tint.hlsl",
        "f82_tint_folded",
        ALL,
        F82_TINT,
        "f82_tint",
    ),
    (
        "dielectric.glsl",
        "dielectric_branch",
        CLEAR,
        DIELECTRIC,
        "dielectric_exact",
    ),
    (
        "dielectric.glsl",
        "dielectric_choice",
        CLEAR,
        DIELECTRIC,
        "dielectric_exact",
    ),
    (
        "dielectric.glsl",
        "dielectric_rgb",
        CLEAR,
        DIELECTRIC,
        "dielectric_exact",
    ),
    (
        "dielectric.hlsl",
        "dielectric",
        CLEAR,
        DIELECTRIC,
        "dielectric_exact",
    ),
    (
        "conductor.glsl",
        "conductor",
        METALS,
        CONDUCTOR,
        "conductor_exact",
    ),
    (
        "conductor.hlsl",
        "conductor",
        METALS,
        CONDUCTOR,
        "conductor_exact",
    ),
];

/// A place with all formulas.
pub fn place() -> Place {
    let place = Place::new();
    for (file, text) in FILES {
        place.put(file, text);
    }
    place
}

#[test]
fn published_formulas_are_bound_accepted_and_measured_by_their_names() {
    let place = place();
    for (file, function, materials, errors, method) in FORMULAS {
        let line =
            format!("{file} --function {function} --material {materials} --gpu none --json -");
        let Some(ran) = audit(&place, &line) else {
            continue;
        };
        let rows = rows(&ran.ends(0));
        assert_eq!(rows.len(), errors.len(), "{line}");
        for (material, error) in materials.split(',').zip(errors) {
            let is_of = |row: &&Value| row["material"] == material;
            let row = rows.iter().find(is_of).expect("a row for each");
            let got = row["model_error"]["max_abs"].as_f64().unwrap();
            // As the figures are rounded.
            assert!((got - error).abs() < 1e-4, "{got}, known {error}: {row}");
            assert_eq!(row["computes"], method, "{row}");
            assert!(row["fits_exactly_with"].is_null(), "{row}");
            assert_eq!(row["checked"]["accepted"], true, "{row}");
            assert_eq!(row["checked"]["within_range"], true, "{row}");
        }
    }
}

/// The largest error of a function for a material, and what it fits with.
#[track_caller]
fn fit(line: &str, argument: &str, quantity: &str, method: &str) -> Option<()> {
    let place = place();
    let ran = audit(&place, &format!("{line} --gpu none --json -"))?;
    let row = rows(&ran).remove(0);
    assert!(row["computes"].is_null(), "{row}");
    let fit = &row["fits_exactly_with"];
    assert_eq!(fit["argument"], argument, "{row}");
    assert_eq!(fit["quantity"], quantity, "{row}");
    assert_eq!(fit["method"], method, "{row}");
    let (bound, then) = (
        row["model_error"]["max_abs"].as_f64(),
        fit["max_abs"].as_f64(),
    );
    assert!(bound.unwrap() > 2.0 * then.unwrap(), "{row}");
    // Bound as it says, it has that error.
    let line = format!("{line} --arg {argument}={quantity}");
    let ran = audit(&place, &format!("{line} --gpu none --json -"))?.ends(0);
    let row = rows(&ran).remove(0);
    let got = row["model_error"]["max_abs"].as_f64();
    assert_eq!(got, then, "{row}");
    assert_eq!(row["computes"], method, "{row}");
    assert_eq!(row["arguments"][argument]["quantity"], quantity, "{row}");
    let text = audit(&place, &format!("{line} --gpu none"))?.ends(0);
    assert!(
        text.out
            .contains(&format!("computes     {method}, as it is bound")),
        "{text:?}"
    );
    Some(())
}

#[test]
fn an_inverse_index_and_a_tint_are_found_where_they_fit_exactly() {
    fit(
        "dielectric.glsl --function dielectric_inverse --material water",
        "eta",
        "1/eta",
        "dielectric_exact",
    );
    fit(
        "f82_tint.glsl --function f82_tint_named_f82 --material platinum",
        "F82",
        "f82_tint",
        "f82_tint",
    );
}

/// The other way round: the colour under the name of the tint.
#[test]
fn a_colour_at_82_degrees_under_the_name_of_a_tint_is_found() {
    let place = place();
    let ran = audit(
        &place,
        "f82_tint.glsl --function f82_colour --material platinum --gpu none --arg color82=f82_tint --json -",
    );
    // What a user binds is not tried otherwise.
    if let Some(ran) = ran {
        let row = rows(&ran).remove(0);
        assert!(
            row["computes"].is_null() && row["fits_exactly_with"].is_null(),
            "{row}"
        );
    }
    let colour = include_str!("functions/f82_tint.glsl").replace("color82", "tint");
    place.put("colour.glsl", colour);
    let line = "colour.glsl --function f82_colour --material platinum --gpu none";
    if let Some(ran) = audit(&place, line) {
        let says = "fits exactly with f82 for `tint`: it is hoffman_f82 then";
        assert!(ran.out.contains(says), "{ran:?}");
    }
    let line = "f82_tint.glsl --function f82_colour --material platinum --gpu none";
    if let Some(ran) = audit(&place, line) {
        assert!(ran.ends(0).out.contains("computes     hoffman_f82"));
    }
}

/// What is no method of ours is not said to be one.
#[test]
fn what_fits_nothing_is_said_to_fit_nothing() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "float f(float c, float eta) { float r = (eta - 1.0) / (eta + 1.0); return mix(r * r, 1.0, pow(1.0 - c, 4.0)); }",
    );
    if let Some(ran) = audit(&place, "f.glsl --material water --gpu none --json -") {
        let row = rows(&ran.ends(0)).remove(0);
        assert!(
            row["computes"].is_null() && row["fits_exactly_with"].is_null(),
            "{row}"
        );
    }
}

#[test]
fn the_square_of_an_extinction_is_known_by_its_name() {
    let place = place();
    let line =
        "conductor.hlsl --function conductor_squared --material platinum --gpu none --json -";
    if let Some(ran) = audit(&place, line) {
        let row = rows(&ran.ends(0)).remove(0);
        assert_eq!(row["arguments"]["etak2"]["quantity"], "k^2", "{row}");
        assert!(
            row["model_error"]["max_abs"].as_f64().unwrap() < 0.001,
            "{row}"
        );
    }
}

/// Slang's compiler is seldom there: without it the file is not checked, and says what to get.
#[test]
fn slang_is_checked_by_its_compiler_or_not_at_all() {
    let place = place();
    let line = "dielectric.slang --material water --gpu none";
    let ran = place.run(&format!("audit {line}"));
    if ran.code == Some(3) {
        assert!(ran.err.contains("slangc"), "{ran:?}");
        assert!(ran.out.contains("not checked"), "{ran:?}");
        crate::not_checked(&format!("audit {line}: {}", ran.err));
        return;
    }
    assert!(ran.out.contains("slangc: yes"), "{ran:?}");
    assert!(ran.out.contains("fits exactly with 1/eta"), "{ran:?}");
    let ran = place.done(&format!("audit {line} --arg eta=1/eta --max-error 0.0001"));
    assert!(ran.out.contains("computes     dielectric_exact"), "{ran:?}");
}
