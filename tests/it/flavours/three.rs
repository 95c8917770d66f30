//! The flavour `three` in three.js: F against the CPU, the white furnace, what stays as it was, what is refused.

use serde_json::{Value, json};

use super::host::{Host, at_most, flags, link, number, packages, shows_a_gold_sphere};
use super::{FILMS, subject, two_interfaces};
use crate::browser;
use crate::cli::Place;

const THREE: Host = Host {
    flavour: "three",
    folder: "three",
    package: "three",
    stands_for: None,
    version: "0.187.0",
    page: include_str!("three/proof.html"),
    scripts: &[
        ("expected.js", include_str!("three/expected.js")),
        ("proof.js", include_str!("three/proof.js")),
        ("proof_webgpu.js", include_str!("three/proof_webgpu.js")),
    ],
    hands: "</html>",
    bundled: None,
    materials: "copper,gold,platinum,silver,diamond,water,anodised_titanium_purple,oil_on_water",
};

/// The oldest versions that it says it knows, for either renderer.
const OLDEST: Host = Host {
    package: "three-oldest",
    stands_for: Some("three"),
    version: "0.182.0",
    ..THREE
};
const OLDEST_OF_WEBGPU: Host = Host {
    package: "three-r186",
    version: "0.186.0",
    ..OLDEST
};

#[test]
fn the_page_of_the_readme_shows_a_gold_sphere() {
    if let Some(picture) = THREE.readme_page() {
        shows_a_gold_sphere(&picture);
    }
}

#[test]
fn lamps_images_and_nodes_take_our_reflectance() {
    let Some(told) = THREE.proof("") else { return };
    assert_eq!(told["heard"], json!([]), "{}", told["heard"]);
    lamps_and_images(&told["webgl"], "r187", 3);
    for renderer in ["webgpu", "webgl2"] {
        nodes(renderer, &told["webgpu"][renderer]);
    }
}

#[test]
fn the_oldest_versions_take_it_too() {
    if let Some(told) = OLDEST.proof("?parts=webgl") {
        assert_eq!(told["heard"], json!([]), "{}", told["heard"]);
        lamps_and_images(&told["webgl"], "r182", 1);
    }
    if let Some(told) = OLDEST_OF_WEBGPU.proof("?parts=webgpu") {
        assert_eq!(told["heard"], json!([]), "{}", told["heard"]);
        for renderer in ["webgpu", "webgl2"] {
            nodes(renderer, &told["webgpu"][renderer]);
        }
    }
}

#[track_caller]
fn lamps_and_images(webgl: &Value, revision: &str, foreign_ways: usize) {
    assert_eq!(webgl["shader_faults"], json!([]));
    // cos θ from .2 on, at four roughnesses.
    at_most(&webgl["lamps"]["worst"], 1e-6);
    films(&webgl["lamps"]["seen"]);
    furnace(&webgl["furnace"]);
    coats(&webgl["coats"]);
    assert!(number(&webgl["rectangles"]) < 1e-6);
    spheres(&webgl["spheres"]);
    for (feature, drawn) in webgl["features"].as_object().unwrap() {
        assert_eq!(drawn, "drawn", "{feature}");
    }
    for (scene, off) in webgl["painted"].as_object().unwrap() {
        for what in ["metal", "paint", "mixture"] {
            assert!(number(&off[what]) < 0.001, "{scene}, {what}: {off}");
        }
        assert!(number(&off["apart"]) > 0.05, "{scene}: {off}");
    }
    let refused = &webgl["refusals"];
    says(
        &refused["name"],
        &[
            "glod",
            "\"gold\"",
            "copper, gold, platinum, silver, diamond, water",
        ],
    );
    says(&refused["material"], &["MeshBasicMaterial"]);
    says(&refused["method"], &["fited", "fitted"]);
    says(&refused["coefficients"], &["4 arrays of 3"]);
    says(
        &refused["coefficients_of_film"],
        &["fitted_film", "6 arrays of 3"],
    );
    says(
        &refused["coat_of_water"],
        &["water", "metals and semiconductors"],
    );
    says(&refused["coat_of_another_index"], &["1.5, not 1.6"]);
    says(
        &refused["coat_of_a_standard_material"],
        &["MeshPhysicalMaterial"],
    );
    says(&refused["iridescence"], &["iridescence"]);
    // three's shaders were changed under it: nothing is patched in silence.
    let foreign = refused
        .as_object()
        .unwrap()
        .iter()
        .filter(|(name, _)| name.starts_with("foreign"));
    assert_eq!(
        foreign
            .map(|(_, why)| says(why, &[revision, "Nothing is patched"]))
            .count(),
        foreign_ways
    );
}

/// F of lamps is near the law of layers over the spectrum.
#[track_caller]
fn films(told: &Value) {
    for name in FILMS {
        let subject = subject(name);
        let (mut worst, mut sum) = (0.0, 0.0);
        let seen = told[name].as_array().unwrap();
        for one in seen {
            let channel = number(&one[1]) as usize;
            let off = (number(&one[2]) - subject.reference.at(number(&one[0]))[channel]).abs();
            worst = f64::max(worst, off);
            sum += off;
        }
        let mean = sum / seen.len() as f64;
        assert!(
            mean < 0.0008 && worst < 0.0012,
            "{name} is off by {mean} in the mean, by {worst} at most"
        );
    }
}

/// Both interfaces reflect as the law has it, with all reflections between them: ours is nearer than three's own in each material.
#[track_caller]
fn coats(told: &Value) {
    for (name, rows) in told.as_object().unwrap() {
        let rows = rows.as_array().unwrap();
        let mean_of = |place: usize| {
            let off = rows.iter().map(|row| {
                let truth = two_interfaces(name, number(&row[0]))[number(&row[1]) as usize];
                (number(&row[place]) - truth).abs()
            });
            off.sum::<f64>() / rows.len() as f64
        };
        let (stock, ours) = (mean_of(2), mean_of(3));
        println!("{name} under a coat: three's own is off by {stock:.4}, ours by {ours:.4}");
        assert!(ours < 0.008 && stock > 4.0 * ours, "{name}: {stock} {ours}");
    }
}

#[track_caller]
fn says(told: &Value, words: &[&str]) {
    let text = told.as_str().unwrap_or_default();
    for word in words {
        assert!(text.contains(word), "{word} is not in: {text}");
    }
}

fn furnace(told: &Value) {
    for name in [
        "white",
        "white_dielectric",
        "white_film",
        "gold",
        "silver",
        "titanium",
        "water",
        "diamond",
        "water_on_white",
        "oil_on_white",
    ] {
        let one = &told[name];
        assert!(number(&one["image"][1]) <= 1.0005, "{name}: {one}");
        for (roughness, apart) in one["apart"].as_object().unwrap() {
            assert!(
                number(apart) <= 0.002,
                "{name} at {roughness}: lamps and image differ by {apart}"
            );
        }
    }
    for white in [
        "white",
        "white_dielectric",
        "white_film",
        "water_on_white",
        "oil_on_white",
    ] {
        let least = number(&told[white]["image"][0]);
        assert!(least >= 0.998, "{white} reflects {least}");
    }
    // The furnace sees faults: three's own white metal loses a tenth by lamps, its glass on white gives too much, and its
    // distribution loses digits at roughness .05.
    assert!(number(&told["three_white"]["apart"]["0.05"]) > 0.01);
    let [metal, glass] =
        ["three_white", "three_dielectric_on_white"].map(|name| &told[name]["lamps"]);
    assert!(number(&metal[0]) < 0.9 && number(&glass[1]) > 1.5);
}

fn spheres(told: &Value) {
    let hooks = ["hooked_later", "hooked_and_patched"];
    for same in hooks
        .into_iter()
        .chain(["unpatched", "twice", "more_programs"])
    {
        assert_eq!(told[same], 0, "{same}");
    }
    assert_eq!(told["back"], 0);
    let patched = &told["patched"];
    assert!(
        number(&patched["grazing"]) > 10.0 * number(&patched["steep"]),
        "{patched}"
    );
    let [gold, silver, water] = [0, 1, 2].map(|i| number(&told["blue_of_gold_silver_water"][i]));
    assert!(water < gold && gold < silver);
}

fn nodes(renderer: &str, told: &Value) {
    assert_eq!(told["is_webgpu"], renderer == "webgpu");
    at_most(&told["nodes"], 1e-6);
    let lighting = &told["lighting"];
    for part in ["lamps", "image", "rectangle"] {
        at_most(&lighting[part], 1e-5);
    }
    assert!(number(&lighting["lobe"]) < 0.002);
    at_most(&lighting["painted"], 0.001);
    assert!(number(&lighting["white_diffuse"]) < 1e-4);
    assert_eq!(lighting["opaque_diffuse"], 0);
    assert_eq!(lighting["unpatched_changed"], 0);
    assert_eq!(lighting["physical_drawn"], true);
    let refused = &told["refusals"];
    says(&refused["webgl_patch"], &["fresnel.tsl.js"]);
    says(&refused["sheen"], &["sheen"]);
    says(&refused["name"], &["glod", "\"gold\""]);
    says(&refused["material"], &["MeshStandardMaterial"]);
}

/// An artist's way to a coated metal without our adapter: the asset's material in a file with a mesh, read by the loader that viewers use.
/// What is drawn is what glTF computes. That is right but near grazing angles, where its base goes to white, as the asset states.
#[test]
fn a_viewer_of_gltf_draws_a_coated_metal_as_its_file_says() {
    let what = "glTF of a coated metal in a viewer";
    let Some(packages) = packages(what, THREE.folder, THREE.package, THREE.version) else {
        return;
    };
    let place = Place::new();
    link(&packages, &place.path("node_modules"));
    let asset = place.done("materials params gold --as gltf --coat 1.5").out;
    let page = include_str!("three/gltf.html").replace("ASSET", &asset);
    let told = browser::told(&place, &page, "</html>", "", &flags());
    assert_eq!(told["heard"], json!([]));
    assert_eq!(told["type"], "MeshPhysicalMaterial");
    let asset: Value = serde_json::from_str(&asset).unwrap();
    let base = &asset["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
    let schlick = |f0: f64, cos: f64| f0 + (1.0 - f0) * (1.0 - cos).powi(5);
    let rows = told["drawn"].as_array().unwrap();
    assert!(rows.len() > 25);
    for row in rows {
        let cos = number(&row[0]);
        let truth = two_interfaces("gold", cos);
        for channel in 0..3 {
            let drawn = number(&row[channel + 1]);
            let coat = schlick(0.04, cos);
            let law = coat + (1.0 - coat) * schlick(number(&base[channel]), cos);
            let row = format!("{cos:.3}, channel {channel}: {drawn:.4}, glTF {law:.4}");
            assert!(cos < 0.3 || (drawn - law).abs() < 0.004, "{row}");
            assert!(
                cos < 0.55 || (drawn - truth[channel]).abs() < 0.005,
                "{row}"
            );
        }
    }
}
