//! `time` as a user runs it: what a row says, bad input, what is missing, what takes too long. How long anything takes is
//! asserted nowhere.

use serde_json::Value;

use super::Place;
use super::Ran;
use crate::not_checked;

/// Small enough for a test.
const QUICK: &str = "--size 32 --rounds 29 --operations 1000";

/// The keys of a row.
const KEYS: [&str; 19] = [
    "method",
    "material",
    "form",
    "channels",
    "precision",
    "ns_per_pixel",
    "share",
    "spread",
    "low",
    "high",
    "net_ns_per_pixel",
    "empty_ns_per_pixel",
    "gpu_ns_per_pixel",
    "wall_ns_per_pixel",
    "clock",
    "draws",
    "evaluations",
    "rounds",
    "reason",
];

/// Runs the program, and says whether there is a device.
fn time(place: &Place, line: &str) -> Option<Ran> {
    let ran = place.run(&format!("time {QUICK} {line}"));
    if ran.code == Some(3) {
        assert!(std::env::var_os("CI").is_none(), "not checked: {ran:?}");
        not_checked(&format!("time {line}: {}", ran.err));
        return None;
    }
    // A busy machine may hide shaders this small in its noise, and the program says so.
    let noise = [
        "is not told apart from the empty shader",
        "the cost of the draw itself hides the function's",
    ];
    if ran.code == Some(1) && noise.iter().any(|why| ran.err.contains(why)) {
        not_checked(&format!("time {line}: {}", ran.err));
        return None;
    }
    Some(ran)
}

fn rows(report: &Value) -> Vec<Value> {
    report["rows"].as_array().unwrap().clone()
}

#[test]
fn rows_say_what_each_form_costs() {
    let place = Place::new();
    let line = "--method dielectric_exact,schlick,table --precision f32 --json -";
    let Some(ran) = time(&place, line) else {
        return;
    };
    let report = ran.ends(0).json();
    let command = "time --method dielectric_exact,schlick,table --precision f32 --size 32 --operations 1000 --rounds 29";
    assert_eq!(report["command"], command);
    assert!(report["device"].is_string() && report["driver"].is_string());
    for shader in ["heavy", "empty"] {
        assert!(report["noise"][shader]["spread"].is_number(), "{report}");
    }
    let rows = rows(&report);
    let heads: Vec<String> = rows.iter().map(head).collect();
    let expected = [
        "dielectric_exact null library 3",
        "dielectric_exact null scalar 1",
        "schlick null library 3",
        "schlick null scalar 1",
        "table null library 3",
        "schlick gold specialised 3",
        "table gold specialised 3",
        "dielectric_exact water specialised 3",
        "schlick water specialised 3",
        "table water specialised 3",
    ];
    assert_eq!(heads, expected);
    for row in &rows {
        assert!(KEYS.iter().all(|key| row.get(key).is_some()), "{row}");
        for key in ["ns_per_pixel", "share", "spread", "low", "high"] {
            assert!(row[key].is_number(), "{key} of {row}");
        }
        assert!(row["draws"].as_u64() > Some(0) && row["reason"].is_null());
    }
    // Everything is a share of it.
    assert_eq!(rows[0]["share"], 1.0);
}

fn head(row: &Value) -> String {
    let word = |key: &str| match &row[key] {
        Value::String(word) => word.clone(),
        other => other.to_string(),
    };
    ["method", "material", "form", "channels"]
        .map(word)
        .join(" ")
}

#[test]
fn the_table_tells_device_noise_and_clock() {
    let place = Place::new();
    let line = "--method schlick --material none --clock wall";
    let Some(ran) = time(&place, line) else {
        return;
    };
    let ran = ran.ends(0);
    for says in [
        "1024 pixels, chains of about 500 and 1000 operations",
        "wall time",
        "noise",
        "the empty shader",
        "95 % interval",
        "schlick",
    ] {
        assert!(ran.out.contains(says), "{says} is not in {ran:?}");
    }
}

#[test]
fn half_precision_is_measured_or_said_to_be_missing() {
    let place = Place::new();
    let line = "--method schlick,table --material none --precision f16 --json -";
    let Some(ran) = time(&place, line) else {
        return;
    };
    let ran = ran.ends(0);
    assert!(ran.err.contains("left out: table in f16"), "{ran:?}");
    let rows = rows(&ran.json());
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert_eq!(row["precision"], "f16");
        assert!(
            row["share"].is_number() || row["reason"].is_string(),
            "{row}"
        );
    }
}

#[test]
fn what_takes_longer_than_its_limit_is_a_finding() {
    let place = Place::new();
    let line =
        "--method schlick --material none --precision f32 --limit 0.000001 --json report.json";
    let Some(ran) = time(&place, line) else {
        return;
    };
    let ran = ran.ends(1);
    assert!(ran.err.contains("--limit allows 0.000001 s"), "{ran:?}");
    let report: Value = serde_json::from_str(&place.read("report.json")).unwrap();
    for row in rows(&report) {
        assert!(
            row["share"].is_null() && row["ns_per_pixel"].is_null(),
            "{row}"
        );
        assert!(row["reason"].as_str().unwrap().contains("--limit"), "{row}");
    }
}

#[test]
fn what_is_missing_is_named_with_what_there_is() {
    let place = Place::new();
    let ran = place
        .run("time --method schlick --adapter nosuchcard")
        .ends(3);
    assert!(ran.err.contains("no graphics adapter"), "{ran:?}");
    assert!(
        ran.err.contains("there is ") || ran.err.contains("install"),
        "{ran:?}"
    );
    // Where there is software only, a card is missing; where there is nothing, that is.
    let ran = place
        .run("time --method schlick --hardware --adapter llvmpipe")
        .ends(3);
    assert!(ran.err.contains("adapter"), "{ran:?}");
    if ran.err.contains("no hardware adapter") {
        let names = ran.err.contains("llvmpipe") && ran.err.contains("what --adapter names");
        assert!(names, "{ran:?}");
    }
}

#[test]
fn a_place_that_cannot_be_written_is_told_before_the_work() {
    let place = Place::new();
    for command in [
        "time",
        "cost",
        "stability",
        "verify",
        "bake --material gold",
    ] {
        place.refused(&format!("{command} --json ."), &["."]);
    }
}

#[test]
fn bad_input_is_told_with_what_is_allowed() {
    let place = Place::new();
    for (line, says) in [
        ("--method schlik", "schlick"),
        ("--material golt", "gold"),
        ("--precision f61", "f16"),
        ("--backend vulcan", "vulkan"),
        ("--backend gles", "vulkan, metal, dx12, gl"),
        ("--clock sun", "gpu, cpu, wall"),
        ("--size 8", "16 to 8192"),
        ("--rounds 0", "1 to 1000"),
        ("--operations 99", "100 to 20000"),
        ("--limit 0", "0.000001 to 3600"),
        ("--limit nan", "0.000001 to 3600"),
        (
            "--method table --precision f16 --material none",
            "nothing to measure",
        ),
    ] {
        place.refused(&format!("time {line}"), &[says]);
    }
}
