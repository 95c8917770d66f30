//! How materials are seen: spectra and three wavelengths, spaces, gamut, media, extrapolation, parameters.

use super::OUT;
use super::Place;

/// A number of a report, by a path such as `/f0/0`.
#[track_caller]
fn number(json: &serde_json::Value, path: &str) -> f64 {
    let found = json.pointer(path).and_then(serde_json::Value::as_f64);
    found.unwrap_or_else(|| panic!("no number {path} in {json}"))
}

#[track_caller]
fn near(got: f64, want: f64, within: f64) {
    assert!((got - want).abs() <= within, "{got} is not {want}");
}

#[test]
fn parameters_have_their_shape_and_are_unclipped() {
    let place = Place::new();
    let ran = place.done("materials params gold_johnson --step 1nm --json -");
    let json = ran.json();
    for (key, value) in [
        ("name", "gold_johnson"),
        ("class", "metal"),
        ("space", "srgb"),
        ("illuminant", "D65"),
        ("observer", "cie1931"),
        ("medium", "air"),
    ] {
        assert_eq!(json[key], value, "{key}");
    }
    for key in [
        "f0",
        "f82",
        "f82_tint",
        "f90",
        "n",
        "k",
        "average",
        "reflectivity",
        "edge_tint",
    ] {
        assert_eq!(json[key].as_array().map(Vec::len), Some(3), "{key}");
    }
    for (i, want) in [1.03758, 0.72834, 0.36460].into_iter().enumerate() {
        near(number(&json, &format!("/f0/{i}")), want, 2e-4);
    }
    assert!(json["abbe"].is_null() && json["ior_d"].is_number() && ran.err.is_empty());
    near(
        number(&json, "/colour_error/rows/0/delta_e2000/0"),
        8.605,
        0.01,
    );
    assert!(number(&json, "/spread/f0_min/1") < 0.71 && number(&json, "/spread/f0_max/1") > 0.78);
    assert_eq!(
        place
            .done("materials params gold_johnson --step 1nm --json -")
            .out,
        ran.out
    );
}

#[test]
fn glass_has_its_makers_index_and_abbe_number() {
    let json = Place::new().done("materials params bk7 --json -").json();
    near(number(&json, "/ior_d"), 1.5168, 5e-6);
    near(number(&json, "/abbe"), 64.17, 0.01);
    assert_eq!(json["class"], "dielectric");
    assert_eq!(json["k"], serde_json::json!([0.0, 0.0, 0.0]));
}

#[test]
fn three_wavelengths_are_the_thesis_way() {
    let place = Place::new();
    let json = place
        .done("materials params gold_hagemann_2 --wavelengths 685,535,475 --json -")
        .json();
    for (i, want) in [0.9451, 0.6863, 0.3600].into_iter().enumerate() {
        near(number(&json, &format!("/f0/{i}")), want, 5e-5);
    }
    assert!(
        json["colour_error"].is_null() && json["space"].is_null() && json["reason"].is_string()
    );
    place.done("--material gold_hagemann_2 --wavelengths 650,550,450 --target gles");
    let text = place.read(&format!("{OUT}/gles/materials/gold_hagemann_2.glsl"));
    assert!(
        text.contains("reflectance at 650, 550 and 450 nm for red, green and blue"),
        "{text}"
    );
    assert!(text.contains("--wavelengths 650,550,450"), "{text}");
}

#[test]
fn spaces_lights_and_gamut_are_told_in_the_head() {
    let place = Place::new();
    let flags = "--space acescg --illuminant a --observer cie2015 --adaptation bradford --step 1nm --gamut scale";
    let text = place
        .done(&format!(
            "--material copper_babar {flags} --target wgsl --header full -o -"
        ))
        .out;
    let joined = text.replace("\n//    ", "");
    assert!(
        joined
            .contains("steps of 1 nm, CIE 2015 2 degree observer, A, adapted by Bradford, ACEScg"),
        "{text}"
    );
    assert!(joined.contains("scaled into [0, 1]"), "{text}");
    let again = "--space acescg --gamut scale --illuminant A --observer cie2015 --adaptation bradford --step 1nm";
    assert!(joined.contains(again), "{text}");
    // Gold's red lies above 1 in sRGB, and inside 0 and 1 in the wide spaces.
    for (space, above) in [("srgb", true), ("rec2020", false), ("acescg", false)] {
        let json = place
            .done(&format!("materials params gold --space {space} --json -"))
            .json();
        assert_eq!(number(&json, "/f0/0") > 1.0, above, "{space}");
    }
}

#[test]
fn gamut_policies_differ_where_a_colour_lies_outside() {
    let place = Place::new();
    let f0 = |gamut: &str| {
        place.done(&format!(
            "--material gold --method schlick --gamut {gamut} --target gles --out-dir {gamut}"
        ));
        let manifest: serde_json::Value =
            serde_json::from_str(&place.read(&format!("{gamut}/manifest.json"))).unwrap();
        let files = manifest["files"].as_array().unwrap().clone();
        let gold = files
            .iter()
            .find(|file| file["material"] == "gold")
            .unwrap()
            .clone();
        [0, 1, 2].map(|i| number(&gold, &format!("/functions/0/parameters/f0/{i}")))
    };
    let [keep, clip, scale] = ["keep", "clip", "scale"].map(f0);
    assert!(keep[0] > 1.03 && clip[0] == 1.0 && scale[0] == 1.0);
    assert!(keep[1] == clip[1]);
    near(scale[1], keep[1] / keep[0], 1e-12);
}

#[test]
fn a_user_can_bring_a_light() {
    let place = Place::new();
    place.put("lamp.csv", "nm,power\n300,1\n800,1\n");
    let json = |light: &str| {
        place
            .done(&format!(
                "materials params silver --illuminant {light} --json -"
            ))
            .json()
    };
    let (own, equal) = (json("lamp.csv"), json("E"));
    assert_eq!(own["f0"], equal["f0"]);
    assert_eq!(own["illuminant"], "lamp.csv");
    place.done("--material silver --illuminant lamp.csv --target gles --depfile d");
    assert!(place.read("d").contains("lamp.csv"));
    // Lines between the steps of the sum, as a spectrometer writes them every half nanometre: they hold most of the light. Right values
    // were computed apart, over the file's own steps.
    let line = |nm: f64| match nm {
        435.5 | 546.5 => 1500,
        611.5 => 2000,
        _ => 1,
    };
    let rows: String = (0..=800)
        .map(|i| 380.0 + f64::from(i) / 2.0)
        .map(|nm| format!("{nm},{}\n", line(nm)))
        .collect();
    place.put("lines.csv", &rows);
    for step in ["5nm", "1nm"] {
        let ran = place.done(&format!(
            "materials params gold --illuminant lines.csv --step {step} --json -"
        ));
        let f0 = ran.json()["f0"].clone();
        for (found, right) in f0.as_array().unwrap().iter().zip([0.9102, 0.8846, 0.3221]) {
            near(found.as_f64().unwrap(), right, 2e-3);
        }
    }
    place.put("short.csv", "nm,power\n400,1\n700,1\n");
    place.refused(
        "--material silver --illuminant short.csv",
        &["short.csv:2:1: ", "must cover 380 to 780 nm"],
    );
    place.refused(
        "--material silver --illuminant D6",
        &["no illuminant `D6` (did you mean D65"],
    );
    place.refused(
        "--material silver --illuminant none.csv",
        &["cannot read none.csv"],
    );
}

#[test]
fn bad_choices_are_answered_with_what_is_allowed() {
    let place = Place::new();
    for (line, says) in [
        ("--space sgrb", "no space `sgrb` (did you mean srgb"),
        (
            "--gamut clamp",
            "(did you mean clip?); there are keep, clip, scale",
        ),
        (
            "--observer 1931",
            "(did you mean cie1931?); there are cie1931, cie2015",
        ),
        ("--adaptation cat02", "there are scale, bradford"),
        ("--step 2nm", "there are 5nm, 1nm"),
        ("--extrapolate linear", "there are refuse, hold"),
        (
            "--wavelengths 685,535",
            "2 numbers; it wants red, green and blue",
        ),
        ("--wavelengths 685,535,0", "between 1 and 1000000"),
        ("--wavelengths 685,535,nan", "between 1 and 1000000"),
        (
            "--wavelengths 685,535,475 --space p3",
            "cannot be used with",
        ),
    ] {
        place.refused(&format!("--material gold {line}"), &[says]);
    }
}

#[test]
fn what_is_not_known_is_refused_or_held_and_said() {
    let place = Place::new();
    let says = "material `pmma`: n is known from 404.7 to 1083 nm, and 380 nm is wanted";
    place.refused(
        "--material pmma",
        &[says, "--extrapolate hold", "--wavelengths"],
    );
    place.refused("materials params pmma", &[says]);
    place.refused(
        "materials params gold --wavelengths 2000,535,475",
        &["and 2000 nm is wanted"],
    );
    place.done("--material pmma --extrapolate hold --target gles,spirv");
    let text = place.read(&format!("{OUT}/gles/materials/pmma.glsl"));
    assert!(
        text.contains("Extrapolated: below 404.7 nm the last measured index is held"),
        "{text}"
    );
    assert!(text.contains("--extrapolate hold"));
    let manifest = place.manifest();
    let files = manifest["files"].as_array().unwrap();
    let own: Vec<_> = files
        .iter()
        .filter(|file| file["material"] == "pmma")
        .collect();
    assert_eq!(own.len(), 3);
    assert!(
        own.iter()
            .all(|file| file["seen"]["extrapolated"].is_string())
    );
    let json = place
        .done("materials params pmma --extrapolate hold --json -")
        .json();
    assert!(json["extrapolated"].is_string());
    // `all` brings along what is known, and names what is not.
    let ran = place.done("--material all --target gles");
    assert!(ran.err.contains("left out: material `pmma`"), "{}", ran.err);
    assert!(!ran.out.contains("pmma"));
}

/// Diamond under water, by the law for the quotient of both indices at each wavelength.
#[test]
fn media_are_divided_by_wavelength_by_wavelength() {
    let place = Place::new();
    let json = |line: &str| {
        place
            .done(&format!("materials params {line} --json -"))
            .json()
    };
    let wet = json("diamond --medium water");
    assert_eq!(wet["medium"], "water");
    let (n, water) = (
        number(&json("diamond"), "/n/1"),
        number(&json("water"), "/n/1"),
    );
    let r = (n - water) / (n + water);
    near(number(&wet, "/f0/1"), r * r, 2e-4);
    let nothing = json("water --medium water");
    assert_eq!(nothing["f0"], serde_json::json!([0.0, 0.0, 0.0]));
    place.refused(
        "materials params gold --medium silver",
        &["a medium must be transparent"],
    );
    place.done("--material gold --medium water --target gles");
    let text = place.read(&format!("{OUT}/gles/materials/gold_in_water.glsl"));
    assert!(text.contains("relative to water"), "{text}");
}

#[test]
fn lists_can_be_filtered() {
    let place = Place::new();
    let names = |line: &str| -> Vec<String> {
        let json = place
            .done(&format!("materials list {line} --json -"))
            .json();
        let rows = json["rows"].as_array().unwrap();
        rows.iter()
            .map(|row| row["name"].as_str().unwrap().to_owned())
            .collect()
    };
    assert!(names("").len() >= 80 + 4);
    assert_eq!(names("--substance gold").len(), 10);
    assert_eq!(
        names("--class metal --search inagaki"),
        ["mercury", "sodium"]
    );
    assert!(!names("--full").contains(&"pmma".to_owned()));
    place.refused("materials list --class metall", &["did you mean metal"]);
    place.refused("materials list --substance glod", &["did you mean gold"]);
}
