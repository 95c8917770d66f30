//! `stability` as a user runs it.

use super::Place;

/// The keys of a row.
const KEYS: [&str; 10] = [
    "method",
    "material",
    "channel",
    "precision",
    "failure",
    "fault_of",
    "points",
    "region",
    "share",
    "worst",
];

#[test]
fn rows_say_what_fails_where() {
    let place = Place::new();
    let report = place
        .done("stability --method schlick,dielectric_textbook --json -")
        .json();
    assert_eq!(
        report["command"],
        "stability --method schlick,dielectric_textbook"
    );
    let rows = report["rows"].as_array().unwrap();
    for row in rows {
        assert!(KEYS.iter().all(|key| row.get(key).is_some()), "{row}");
        assert_eq!(row["precision"], "f32");
    }
    let find = |method: &str, failure: &str| {
        let is_it = |row: &&serde_json::Value| row["method"] == method && row["failure"] == failure;
        rows.iter()
            .find(is_it)
            .unwrap_or_else(|| panic!("{method}: no {failure}"))
    };
    // 0.211 at eta = 1.1, as everybody finds who looks.
    let bad = find("schlick", "error above 0.2");
    assert!(bad["region"].as_str().unwrap().contains("eta <"), "{bad}");
    assert_eq!(bad["fault_of"], "formula");
    assert!(bad["worst"]["amount"].as_f64().unwrap() > 0.2);
    let lost = find("dielectric_textbook", "NaN");
    assert_eq!(
        (&lost["fault_of"], &lost["points"]),
        (&"rounding".into(), &"media".into())
    );
    assert!(
        lost["region"].as_str().unwrap().contains("eta <="),
        "{lost}"
    );
}

#[test]
fn a_material_has_its_own_curve() {
    let place = Place::new();
    let report = place
        .done("stability --method schlick,conductor_exact --material platinum --json -")
        .json();
    let rows = report["rows"].as_array().unwrap();
    let of = |method: &str, failure: &str| {
        rows.iter()
            .filter(|row| row["method"] == method && row["failure"] == failure)
            .count()
    };
    // The dip that Schlick has not, in all three channels; the exact law has it.
    assert_eq!(of("schlick", "missed minimum"), 3);
    assert_eq!(of("conductor_exact", "missed minimum"), 0);
    assert!(rows.iter().all(|row| row["material"] == "platinum"));
}

#[test]
fn a_page_shows_all_maps_and_needs_nothing_else() {
    let place = Place::new();
    place.done("stability --method schlick_ior,f82_tint --out-dir maps");
    let names: Vec<String> = std::fs::read_dir(place.path("maps"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    for name in [
        "index.html",
        "schlick_ior_eta.png",
        "f82_tint_eta.png",
        "f82_tint_k.png",
    ] {
        assert!(names.contains(&name.to_owned()), "{name} of {names:?}");
    }
    assert_eq!(names.len(), 4);
    let page = place.read("maps/index.html");
    assert_eq!(page.matches("<img").count(), 3);
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3);
    assert!(!page.contains("http"), "the page asks for something");
    assert!(page.contains("error above 0.2") && page.contains("<h2 id=\"f82_tint\">"));
}

#[test]
fn half_precision_has_maps_and_a_page_of_its_own() {
    let place = Place::new();
    place.done("stability --method schlick,schlick --precision f16 --out-dir maps");
    let page = place.read("maps/index_f16.html");
    assert!(page.contains("run in f16") && page.matches("<img").count() == 2);
    assert!(place.path("maps/schlick_eta_f16.png").is_file());
}

#[test]
fn bad_input_is_told_with_what_is_near() {
    let place = Place::new();
    place.refused("stability --method schlik", &["`schlik`", "schlick"]);
    place.refused("stability --method table", &["`table` reads a texture"]);
    place.refused("stability --material golt", &["`golt`", "gold"]);
    place.refused("stability --material gold --out-dir maps", &["--out-dir"]);
}
