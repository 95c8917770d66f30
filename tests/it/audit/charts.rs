//! A user's function on the chart beside ours.

use serde_json::Value;

use super::audit;
use super::rows;
use super::thesis;
use crate::cli::Place;

/// What the script of a page reads.
fn data(place: &Place, page: &str) -> Value {
    let page = place.read(page);
    let data = page.split("const data = ").nth(1).unwrap();
    serde_json::from_str(data.split(";\n").next().unwrap()).unwrap()
}

#[test]
fn it_is_one_more_point_with_the_errors_of_our_own() {
    let place = thesis::place();
    place.done("chart --material gold,platinum --out-dir ours");
    let line = "thesis.wgsl --function schlick --material gold,platinum --gpu rdna2 --json -";
    let Some(ran) = audit(&place, &format!("{line} --out-dir charts")) else {
        return;
    };
    let (ran, page) = (ran.ends(0), data(&place, "charts/chart.html"));
    let entries = page["entries"].as_array().unwrap();
    let ours = data(&place, "ours/chart.html");
    assert_eq!(entries.len(), ours["entries"].as_array().unwrap().len() + 1);
    let own = entries.len() - 1;
    assert_eq!(entries[own]["label"], "schlick (yours)");
    let same = entries.iter().position(|entry| entry["label"] == "schlick");
    for set in page["sets"].as_array().unwrap() {
        for axis in 0..4 {
            let [own, same] =
                [own, same.unwrap()].map(|entry| set["errors"][entry][axis].as_f64().unwrap());
            assert!((own - same).abs() < 1e-3 * same, "{set}: {own} and {same}");
        }
    }
    let net = &rows(&ran)[0]["cost"][0]["net"];
    for axis in page["costs"].as_array().unwrap() {
        let is_asked = axis["name"] == "rdna2";
        assert_eq!(
            axis["costs"][own],
            if is_asked { net.clone() } else { Value::Null }
        );
    }
    let picture = place.read("charts/chart.svg");
    assert!(picture.contains("fresnel-gen audit thesis.wgsl --function schlick"));
    assert_eq!(picture.contains(">schlick (yours)<"), net.is_number());
    assert_ne!(
        picture.contains("has no point here"),
        net.is_number(),
        "{ran:?}"
    );
}

#[test]
fn what_gives_no_number_has_no_point() {
    let place = Place::new();
    place.put(
        "f.wgsl",
        "fn f(c: f32, f0: vec3f) -> vec3f { return f0 * d; }",
    );
    let line = "f.wgsl --material gold --gpu none --out-dir .";
    let Some(ran) = audit(&place, line) else {
        return;
    };
    let ran = ran.ends(1);
    let says = "f has no point here: its error is not known.";
    assert!(ran.err.contains(says), "{ran:?}");
    assert!(place.read("chart.svg").contains(says));
    let page = data(&place, "chart.html");
    let errors = page["sets"][0]["errors"].as_array().unwrap();
    assert_eq!(
        errors.last().unwrap(),
        &serde_json::json!([null, null, null, null])
    );
}

#[test]
fn places_that_cannot_be_written_or_are_one_are_refused() {
    let place = thesis::place();
    for (flags, says) in [
        ("--out-dir thesis.glsl", "thesis.glsl"),
        ("--out-dir c --json c/chart.svg", "two outputs"),
        ("--out-dir . --junit chart.html", "two outputs"),
        ("--json a.xml --junit ./a.xml", "two outputs"),
        ("--json - --junit -", "--junit takes a file"),
    ] {
        let line = format!("audit thesis.wgsl --function schlick --material gold {flags}");
        place.refused(&line, &[says]);
    }
    place.refused(
        "chart --material gold --out-dir c --json c/chart.html",
        &["two outputs"],
    );
}
