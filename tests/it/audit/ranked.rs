//! Our functions cost no more than published ones of the same error, by AMD's compilers; beside the cheapest published one on every
//! family. Formulas are transcribed by us, in the shapes in which engines have them.

use super::audit;
use super::published::place;
use super::rows;
use crate::bless;
use crate::published_costs::{families, own, path, recorded};
use fresnel_gen::physics::optics;

/// A published function, a material, how many channels it has, and ours with no more error.
const PAIRS: [(&str, &str, &str, usize, &str); 18] = [
    ("schlick.glsl", "schlick", METAL, 3, "schlick"),
    ("schlick.glsl", "schlick_power", METAL, 3, "schlick"),
    ("schlick.glsl", "schlick_f90", METAL, 3, "schlick"),
    ("schlick.hlsl", "schlick", METAL, 3, "schlick"),
    ("schlick.hlsl", "schlick_f90", METAL, 3, "schlick"),
    ("schlick.glsl", "schlick_scalar", METAL, 1, "schlick"),
    (
        "schlick_gaussian.glsl",
        "schlick_gaussian",
        METAL,
        3,
        "schlick_spherical_gaussian",
    ),
    ("f82_tint.glsl", "f82_tint_folded", METAL, 3, "f82_tint"),
    ("f82_tint.glsl", "f82_tint_by_schlick", METAL, 3, "f82_tint"),
    ("f82_tint.hlsl", "f82_tint_folded", METAL, 3, "f82_tint"),
    ("f82_tint.glsl", "f82_colour", METAL, 3, "hoffman_f82"),
    (
        "dielectric.glsl",
        "dielectric_rgb",
        GLASS,
        3,
        "dielectric_exact",
    ),
    (
        "dielectric.glsl",
        "dielectric_choice",
        GLASS,
        1,
        "dielectric_exact",
    ),
    (
        "dielectric.hlsl",
        "dielectric",
        GLASS,
        1,
        "dielectric_exact",
    ),
    (
        "conductor.glsl",
        "conductor",
        METAL,
        3,
        "conductor_exact_metal",
    ),
    (
        "conductor.hlsl",
        "conductor",
        METAL,
        3,
        "conductor_exact_metal",
    ),
    (
        "tinted.glsl",
        "dielectric_rescaled",
        GLASS,
        3,
        "dielectric_tinted",
    ),
    (
        "tinted.glsl",
        "hoffman_schlick",
        METAL,
        3,
        "schlick_f82_f90",
    ),
];

const METAL: &str = "platinum";
const GLASS: &str = "water";

/// Dearer than a published function, which errs more: it has no digits next to an index of 1.
const LESS_ACCURATE: [(&str, &str); 1] = [("dielectric.hlsl", "dielectric")];

/// The families that every machine can ask.
const AMD: [&str; 3] = ["gcn4", "rdna2", "rdna3"];

#[test]
fn ours_cost_no_more_at_the_same_error() {
    let place = place();
    let gpus = if bless::is_on() {
        families().collect::<Vec<_>>()
    } else {
        AMD.to_vec()
    };
    let mut faults = String::new();
    let mut found = Vec::new();
    for (file, function, material, channels, ours) in PAIRS {
        let gpus = gpus.join(",");
        let one_index = if ours == "dielectric_tinted" {
            "--arg ior=ior "
        } else {
            ""
        };
        let line = format!(
            "{file} --function {function} --material {material} {one_index}--gpu {gpus} --json -"
        );
        let Some(ran) = audit(&place, &line) else {
            continue;
        };
        for cost in rows(&ran.ends(0)).remove(0)["cost"].as_array().unwrap() {
            let gpu = cost["gpu"].as_str().unwrap();
            let Some(theirs) = cost["net"].as_f64() else {
                crate::not_checked(&format!("a cost on {gpu}: {}", cost["reason"]));
                continue;
            };
            let is_rival = !LESS_ACCURATE.contains(&(file, function));
            if is_rival && AMD.contains(&gpu) && own(gpu, ours, channels) > theirs {
                faults += &format!(
                    "{gpu}: {ours} {}, {file} {function} {theirs}\n",
                    own(gpu, ours, channels)
                );
            }
            found.push(
                [
                    gpu,
                    ours,
                    &channels.to_string(),
                    &format!("{file}: {function}"),
                    &theirs.to_string(),
                ]
                .map(str::to_owned),
            );
        }
    }
    assert!(faults.is_empty(), "{faults}");
    let head = ["gpu", "ours", "channels", "function", "cost"];
    if bless::is_on() {
        bless::check(&path(), crate::records::text(head, &found).as_bytes());
    }
    let known = recorded();
    for [gpu, .., function, cost] in &found {
        let row = known
            .iter()
            .find(|row| row.gpu == *gpu && row.function == *function);
        let row = row.unwrap_or_else(|| panic!("{function} on {gpu} is not recorded"));
        assert_eq!(row.cost.to_string(), *cost, "{function} on {gpu}");
    }
}

/// The published form in f32 at an index next to 1: its own relative error, and that of ours.
#[test]
fn the_cheaper_dielectric_has_no_digits_next_to_an_index_of_1() {
    let published = |eta: f32, u: f32| {
        let g = (eta * eta - 1.0 + u * u).max(0.0).sqrt();
        let a = (g - u) / (g + u);
        let b = ((g + u) * u - 1.0) / ((g - u) * u + 1.0);
        0.5 * a * a * (1.0 + b * b)
    };
    let method = fresnel_gen::language::methods::find("dielectric_exact").expect("it is a method");
    let function = method.function(true).expect("it is built");
    let (eta, u) = (1.001_f32, 0.7_f32);
    let values = [u, eta].map(|x| fresnel_gen::language::ir::Value::<f32>::scalar(f64::from(x)));
    let ours = fresnel_gen::language::ir::evaluate(&function, &values).at(0)[0];
    let law = optics::dielectric(f64::from(eta), f64::from(u)).unpolarised();
    let error = |given: f32| (f64::from(given) / law - 1.0).abs();
    assert!(
        error(published(eta, u)) > 1e-5,
        "{}",
        error(published(eta, u))
    );
    assert!(error(ours) < 1e-6, "{}", error(ours));
}
