//! Our functions cost no more than published ones of the same error, by AMD's compilers.

use fresnel_gen::cost::{FunctionKey, records};
use fresnel_gen::emit::FunctionForm;
use fresnel_gen::num::Precision;

use super::published::place;
use super::{audit, rows};

/// A published function, a material, how many channels it has, and ours with no more error.
const PAIRS: [(&str, &str, &str, usize, &str); 11] = [
    ("schlick.glsl", "schlick", "platinum", 3, "schlick"),
    ("schlick.glsl", "schlick_power", "platinum", 3, "schlick"),
    ("schlick.glsl", "schlick_f90", "platinum", 3, "schlick"),
    ("schlick.hlsl", "schlick", "platinum", 3, "schlick"),
    ("schlick.hlsl", "schlick_f90", "platinum", 3, "schlick"),
    ("schlick.glsl", "schlick_scalar", "platinum", 1, "schlick"),
    (
        "schlick_gaussian.glsl",
        "schlick_gaussian",
        "platinum",
        3,
        "schlick_spherical_gaussian",
    ),
    (
        "f82_tint.glsl",
        "f82_tint_folded",
        "platinum",
        3,
        "f82_tint",
    ),
    (
        "f82_tint.hlsl",
        "f82_tint_folded",
        "platinum",
        3,
        "f82_tint",
    ),
    (
        "dielectric.glsl",
        "dielectric_rgb",
        "water",
        3,
        "dielectric_exact",
    ),
    (
        "conductor.glsl",
        "conductor",
        "platinum",
        3,
        "conductor_exact_metal",
    ),
];

#[test]
fn ours_cost_no_more_at_the_same_error() {
    let place = place();
    let mut faults = String::new();
    for (file, function, material, channels, ours) in PAIRS {
        let line = format!(
            "{file} --function {function} --material {material} --gpu gcn4,rdna2,rdna3 --json -"
        );
        let Some(ran) = audit(&place, &line) else {
            continue;
        };
        let row = rows(&ran.ends(0)).remove(0);
        for cost in row["cost"].as_array().unwrap() {
            let gpu = cost["gpu"].as_str().unwrap();
            let Some(theirs) = cost["net"].as_f64() else {
                crate::not_checked(&format!("a cost: {}", cost["reason"]));
                continue;
            };
            let form = if channels == 3 {
                FunctionForm::Library
            } else {
                FunctionForm::Scalar
            };
            let key = FunctionKey::library(ours, form, Precision::F32);
            let own = records(gpu).of(&key).unwrap().cost();
            if own > theirs {
                faults += &format!("{gpu}: {ours} {own}, {file} {function} {theirs}\n");
            }
        }
    }
    assert!(faults.is_empty(), "{faults}");
}
