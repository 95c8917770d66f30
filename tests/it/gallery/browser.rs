//! The page in a real browser without a window, by WebGL 2 and by WebGPU.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use glam::DVec3;
use serde_json::{Value, json};

use super::page;
use super::pixels::Held;
use crate::browser::{self, CHROMIUM};
use crate::cli::Place;
use fresnel_gen::generator::emit::validate_wgsl;
use fresnel_gen::pictures::gallery::{own_subject, rows};

const HANDS: &str = include_str!("hands.js");

/// What the hands saw in the page.
fn told(backend: &str) -> Value {
    let hands = format!("<script>{HANDS}</script></html>");
    let query = format!("?backend={backend}");
    browser::told(&Place::new(), page(), &hands, &query, &browser::SOFTWARE)
}

fn pixels(picture: &Value) -> Vec<DVec3> {
    let bytes = BASE64_STANDARD.decode(picture.as_str().unwrap()).unwrap();
    let numbers = bytes
        .chunks_exact(4)
        .map(|four| f32::from_le_bytes(four.try_into().unwrap()));
    let numbers: Vec<f64> = numbers.map(f64::from).collect();
    numbers.chunks_exact(3).map(DVec3::from_slice).collect()
}

/// What a browser drew, by the backend's name.
#[track_caller]
fn every_row_is_drawn(told: &Value, backend: &str) {
    assert_eq!(told["faults"], json!([]), "{}", told["faults"]);
    assert_eq!(told["asked"], json!([]));
    assert_eq!(told["drawn_by"], backend);
    let mut held = Held::new();
    let mut faults = String::new();
    for row in rows() {
        let seen = &told["rows"][row.name];
        let status = seen["status"].as_str().expect("the row was shown");
        let (name, material, method) = (row.name, own_subject(row).name, row.method);
        let begins = format!("{name}, {material} by {method}, drawn by {backend}.");
        assert!(status.starts_with(&begins), "{status}");
        let is_exact = method.ends_with("_exact") || method == "film_spectral_six";
        assert_eq!(status.ends_with("mean 0, largest 0."), is_exact, "{status}");
        if let Some(fault) = held.fault(row, &pixels(&seen["picture"])) {
            faults += &format!("{backend}: {name}: {fault}\n");
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

#[test]
fn webgpu_draws_every_row() {
    if CHROMIUM.is_here("the gallery by WebGPU") {
        every_row_is_drawn(&told("webgpu"), "WebGPU");
    }
}

#[test]
fn webgl_draws_every_row_and_follows_the_reader() {
    if !CHROMIUM.is_here("the gallery by WebGL 2") {
        return;
    }
    let told = told("webgl2");
    every_row_is_drawn(&told, "WebGL 2");
    changes_are_seen(&told["changes"]);
    figures_are_recorded(&told);
    everything_is_reached(&told);
    materials_are_picked(&told["picks"]);
}

/// A material is found by words, shown by an effect that can, and copied; the address says it.
#[track_caller]
fn materials_are_picked(picks: &Value) {
    assert_eq!(picks["found"], json!(["silver"]), "{picks}");
    assert_eq!(picks["shows"], "silver");
    assert_eq!(picks["copied"], true);
    assert_eq!(picks["water"][1], "water");
    assert_eq!(picks["water"][2], "water");
    let address = picks["address"].as_str().unwrap();
    for said in ["material=silver", "effect=", "method=", "lines=filament"] {
        assert!(address.contains(said), "{address} lacks {said}");
    }
    let line = |choice: &str| picks["lines"][choice].as_str().unwrap();
    assert!(line("three").contains("patch(material, \"silver\");"));
    assert!(line("gltf").starts_with("fresnel-gen materials params silver --as gltf"));
    let numbers = picks["numbers"][0].as_str().unwrap();
    assert!(numbers.contains('#'), "{numbers}");
    // What is copied is a whole function: naga takes it, and it gives silver's F0.
    let wgsl = line("wgsl");
    validate_wgsl(wgsl).unwrap_or_else(|fault| panic!("{fault}: {wgsl}"));
    for (language, head) in [
        ("wgsl", "fn silver_reflectance(cos_theta: f32) -> vec3<f32>"),
        ("gles", "vec3 silver_reflectance(float cos_theta)"),
        ("hlsl", "float3 silver_reflectance(float cos_theta)"),
    ] {
        assert!(line(language).contains(head), "{}", line(language));
        assert!(line(language).contains("return fresnel_fitted(cos_theta, "));
    }
}

/// Each step of the reader changes pixels and what is said.
#[track_caller]
fn changes_are_seen(changes: &Value) {
    let steps = [
        "gold_schlick",
        "gold_exact",
        "silver_exact",
        "own_exact",
        "own_k",
        "turned",
        "raised",
        "rough",
        "rougher",
        "film",
        "thinner",
        "by_khr",
        "by_materialx",
    ];
    for pair in steps.windows(2) {
        let [one, other] = [pair[0], pair[1]].map(|name| &changes[name]);
        assert_ne!(one["picture"], other["picture"], "{pair:?}");
    }
    let status = |name: &str| changes[name]["status"].as_str().unwrap().to_owned();
    assert!(!status("gold_schlick").ends_with("largest 0."));
    assert!(status("gold_exact").ends_with("mean 0, largest 0."));
    assert!(status("silver_exact").contains("silver by conductor_exact"));
    assert!(status("own_exact").contains("an index of your own"));
}

/// Errors and costs are those of the chart.
#[track_caller]
fn figures_are_recorded(told: &Value) {
    let place = Place::new();
    let ran = place.done("chart --material gold --show gold --gpu rdna2 --json -");
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    let mut rows = report["rows"].as_array().unwrap().iter();
    let recorded = rows.find(|row| row["method"] == "schlick" && row["inputs"] == "intended");
    let recorded = recorded.expect("the chart has it");
    let number = |cell: &Value| cell.as_str().unwrap().parse::<f64>().unwrap();
    let (error, cost) = (number(&told["errors"][0]), number(&told["costs"][0]));
    let want = recorded["value"].as_f64().unwrap();
    assert!((error / want - 1.0).abs() < 0.005, "{error} {want}");
    assert_eq!(cost, recorded["cost"].as_f64().unwrap());
}

/// The page is used by keyboard and read by voice.
#[track_caller]
fn everything_is_reached(told: &Value) {
    assert!(told["controls"].as_u64().unwrap() > 15, "{told}");
    assert_eq!(told["unlabelled"], json!([]));
    assert_eq!(told["unreached"], json!([]));
    assert_eq!(told["live"], json!(["copied-lines", "status", "copied"]));
    assert_eq!(told["own"], "index of the sliders");
    assert_ne!(told["before"], told["after"]);
    for way in ["copied", "selected"] {
        assert_eq!(told[way][0], true, "{way}");
        assert!(
            told[way][1].as_str().unwrap().ends_with("is copied."),
            "{}",
            told[way]
        );
    }
    let head = format!(" {}(", told["gles"][0].as_str().unwrap());
    let text = told["gles"][1].as_str().unwrap();
    assert!(text.contains(&head) && text.contains("highp"), "{text}");
    let label = told["rows"]["complex_f0"]["label"].as_str().unwrap();
    assert!(label.contains("Three panels: by schlick; by the exact law, conductor_exact"));
}
