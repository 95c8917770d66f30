//! `chart` as users run it: what it shows, what it writes, and names that are not there.

use serde_json::Value;

use super::Place;

const FOUR: &str = "chart --material gold,platinum,water,diamond";

fn rows(place: &Place, line: &str) -> Vec<Value> {
    let ran = place.done(&format!("{line} --json -"));
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    report["rows"].as_array().unwrap().clone()
}

/// The methods that the thesis compares, of which it says what they cost and how they err.
const OF_THE_THESIS: [&str; 9] = [
    "conductor_exact",
    "conductor_textbook",
    "dielectric_exact",
    "dielectric_textbook",
    "schlick",
    "schlick_rescaled",
    "schlick_corrected",
    "empirical",
    "table",
];

#[test]
fn every_method_of_the_thesis_is_there_twice() {
    let place = Place::new();
    let rows = rows(&place, &format!("{FOUR} --show water"));
    for method in OF_THE_THESIS {
        let own: Vec<&str> = rows
            .iter()
            .filter(|row| row["method"] == method)
            .map(|row| row["inputs"].as_str().unwrap())
            .collect();
        assert!(own.contains(&"intended"), "{method}: {own:?}");
        assert_eq!(
            own.contains(&"best"),
            method != "table",
            "{method}: {own:?}"
        );
    }
}

#[test]
fn the_best_inputs_are_no_worse_and_the_fitted_methods_far_better() {
    let place = Place::new();
    let rows = rows(&place, &format!("{FOUR} --show gold"));
    let value = |method: &str, inputs: &str| {
        let of = |row: &&Value| row["method"] == method && row["inputs"] == inputs;
        rows.iter().find(of).unwrap()["value"].as_f64().unwrap()
    };
    for row in rows.iter().filter(|row| row["inputs"] == "best") {
        let method = row["method"].as_str().unwrap();
        let (best, own) = (value(method, "best"), value(method, "intended"));
        assert!(best <= own * (1.0 + 1e-3), "{method}: {best} and {own}");
    }
    assert!(10.0 * value("fitted", "fitted") < value("schlick", "best"));
}

/// Schlick's gold has a luminance of .0015 too much: red has too much, blue too, and green too little.
#[test]
fn an_error_of_luminance_is_of_the_colour() {
    let place = Place::new();
    let rows = rows(&place, "chart --material gold --error luminance");
    let is_schlick = |row: &&Value| row["method"] == "schlick" && row["inputs"] == "intended";
    let value = rows.iter().find(is_schlick).unwrap()["value"]
        .as_f64()
        .unwrap();
    assert!((0.001_45..0.001_50).contains(&value), "{value}");
}

/// Schlick's form with F90 for platinum: .0866 is possible, and .0880 was once called the least.
#[test]
fn the_best_f90_of_platinum_is_the_best() {
    let place = Place::new();
    let rows = rows(&place, "chart --material platinum");
    let is_best = |row: &&Value| row["method"] == "schlick_f90" && row["inputs"] == "best";
    let value = rows.iter().find(is_best).unwrap()["value"]
        .as_f64()
        .unwrap();
    assert!(value < 0.086_56, "{value}");
}

/// What has no point is named, with the reason.
#[test]
fn what_is_left_out_is_named() {
    let place = Place::new();
    for (line, says) in [
        (
            "gold,zinc_querry --show metals",
            "conductor_exact_metal: only for metals (k of n / 4 and more), and 1 of these 2 are none.",
        ),
        (
            "gold,silver --show metals",
            ": only for dielectrics (k = 0), and none of these is one.",
        ),
        (
            "silicon,germanium --show semiconductors",
            "conductor_exact_metal: only for metals (k of n / 4 and more), and none of these is one.",
        ),
        (
            "water",
            "conductor_exact_metal: only for metals (k of n / 4 and more), and this is none.",
        ),
        (
            "gold",
            "constant_f0: costs nothing or is not recorded on rdna2.",
        ),
        (
            "gold --error luminance",
            "table: this error is not measured of what reads a texture.",
        ),
    ] {
        let ran = place.done(&format!("chart --material {line}"));
        let (_, left_out) = ran.out.split_once("Left out:").unwrap();
        assert!(left_out.contains(says), "{line}: {left_out}");
    }
}

#[test]
fn the_picture_and_the_page_are_the_same_in_every_run() {
    let place = Place::new();
    for folder in ["one", "two"] {
        place.done(&format!(
            "{FOUR} --gpu malig72 --of worst --out-dir {folder}"
        ));
    }
    for name in ["chart.svg", "chart.html"] {
        let [one, two] = ["one", "two"].map(|folder| place.read(&format!("{folder}/{name}")));
        assert_eq!(one, two, "{name}");
        assert!(
            one.contains("chart --material gold,platinum,water,diamond --of worst --gpu malig72")
        );
    }
}

#[test]
fn names_that_are_not_there_are_refused_with_those_that_are() {
    let place = Place::new();
    for (line, says) in [
        ("--gpu rdna", "rdna2"),
        ("--error maximum", "mean-rel"),
        ("--of mean", "median"),
        ("--material golt", "gold"),
        ("--material gold --show metals", "two metals"),
        ("--material gold --show platinum", "gold"),
        ("--material none", "nothing to show"),
        ("--material gold --json .", "."),
    ] {
        place.refused(&format!("chart {line}"), &[says]);
    }
    assert!(place.files().is_empty());
}
