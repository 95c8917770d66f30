//! `materials reflectance`: numbers for a user's own plots, which physicists know in other ways.

use serde_json::Value;

use super::Place;

/// The rows of a report.
fn rows(place: &Place, line: &str) -> Vec<Value> {
    let json = place
        .done(&format!("materials reflectance {line} --json -"))
        .json();
    json["rows"].as_array().expect("it has rows").clone()
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("{key}: {row}"))
}

#[test]
fn at_normal_incidence_n_and_k_give_reflectance() {
    let place = Place::new();
    let found = rows(&place, "gold --angles 0 --wavelengths 700");
    let shown = place.done("materials show gold --json -").json();
    let data = shown["data"].as_array().expect("it has data");
    let at = |row: &Value, i: usize| row[i].as_f64().expect("a number");
    let after = data.iter().position(|row| at(row, 0) >= 700.0);
    let after = after.expect("gold is known beyond 700 nm");
    let (a, b) = (&data[after - 1], &data[after]);
    let share = (700.0 - at(a, 0)) / (at(b, 0) - at(a, 0));
    let [n, k] = [1, 2].map(|i| at(a, i) + share * (at(b, i) - at(a, i)));
    let wanted = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
    for key in ["r", "r_s", "r_p"] {
        let r = number(&found[0], key);
        assert!((r - wanted).abs() < 1e-12, "{key}: {r} is not {wanted}");
    }
}

#[test]
fn glass_has_brewsters_angle_and_a_film_of_half_a_wave_is_not_there() {
    let place = Place::new();
    // tan θ = n: 56.3099 degrees for 1.5.
    place.put("glass.csv", "nm,n\n300,1.5\n900,1.5\n");
    let glass = rows(
        &place,
        "glass.csv --angles 56.30993247402022 --wavelengths 550",
    );
    assert!(number(&glass[0], "r_p") < 1e-15 && number(&glass[0], "r_s") > 0.14);
    let line = "glass.csv --angles 0 --wavelengths 550,400 --film 1.38:199.2753623188406nm";
    let filmed = rows(&place, line);
    assert!((number(&filmed[0], "r") - 0.04).abs() < 1e-9, "{filmed:?}");
    assert!(number(&filmed[1], "r") < 0.035, "{filmed:?}");
    // Beyond 41.8 degrees from glass into air all is reflected.
    place.put("air.csv", "nm,n\n300,1\n900,1\n");
    let inside = rows(
        &place,
        "air.csv --medium 1.5 --angles 42..90:6 --wavelengths 550",
    );
    assert!(inside.iter().all(|row| number(row, "r") > 1.0 - 1e-12));
}

#[test]
fn a_constant_spectrum_is_grey_and_a_mirror_white_at_grazing_angles() {
    let place = Place::new();
    place.put("grey.csv", "nm,n,k\n300,0.1,5\n900,0.1,5\n");
    for light in ["D65", "A", "F11"] {
        for space in ["srgb", "acescg"] {
            let line =
                format!("grey.csv gold --space {space} --illuminant {light} --angles 0,60,90");
            let found = rows(&place, &line);
            for row in &found[..3] {
                let [red, green, blue] = ["red", "green", "blue"].map(|key| number(row, key));
                assert!(red > 0.9, "{row}");
                assert!(
                    (red - green).abs() < 1e-12 && (red - blue).abs() < 1e-12,
                    "{row}"
                );
            }
            assert!(number(&found[3], "red") > number(&found[3], "blue") + 0.2);
            assert!((number(&found[5], "blue") - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn csv_has_the_rows_of_the_report() {
    let place = Place::new();
    let ran =
        place.done("materials reflectance silver gold --angles 0,60 --wavelengths 450,650 --csv -");
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines[0], "material,angle_deg,wavelength_nm,r_s,r_p,r");
    assert_eq!(lines.len(), 1 + 2 * 2 * 2);
    assert!(lines[1].starts_with("silver,0.0,450.0,0."), "{}", lines[1]);
    let found = rows(&place, "silver gold --angles 0,60 --wavelengths 450,650");
    for (line, row) in lines[1..].iter().zip(&found) {
        let last: f64 = line.rsplit(',').next().unwrap().parse().unwrap();
        assert_eq!(last, number(row, "r"), "{line}");
    }
    place.done("materials reflectance silver --csv rgb.csv --json rgb.json");
    let text = place.read("rgb.csv");
    assert!(
        text.starts_with("material,angle_deg,red,green,blue\nsilver,0.0,0.9"),
        "{text}"
    );
    assert_eq!(text.lines().count(), 1 + 91);
    let table = place.done("materials reflectance silver --angles 90").out;
    assert!(
        table.contains("silver       90  1.000000  1.000000  1.000000"),
        "{table}"
    );
}

#[test]
fn what_is_held_is_said() {
    let place = Place::new();
    place.put("short.csv", "nm,n,k\n400,1,2\n700,1,2\n");
    for line in ["", " --wavelengths 350,500"] {
        let line = format!("materials reflectance short.csv{line}");
        place.refused(
            &line,
            &["n is known from 400 to 700 nm", "--extrapolate hold"],
        );
        let ran = place.done(&format!("{line} --extrapolate hold"));
        assert!(ran.err.contains("short: below 400 nm"), "{ran:?}");
    }
}

#[test]
fn bad_input_says_what_is_allowed() {
    let place = Place::new();
    place.put("a/gold.csv", "nm,n\n300,1\n900,1\n");
    place.put("b/gold.csv", "nm,n\n300,2\n900,2\n");
    #[rustfmt::skip]
    let cases = [
        ("", "<NAME>"),
        ("glod", "did you mean gold or"),
        ("gold --angles 0..91:1", "it has 91; angles are in degrees, between 0 and 90, such as 0..90:5 or 0,30,60"),
        ("gold --angles -5", "it has -5; angles are in degrees"),
        ("gold --angles x", "`x` is not a number; angles are in degrees"),
        ("gold --wavelengths 700..400:10", "holds nothing"),
        ("gold --angles 0,30..90:10", "is a list and a range; one of them is wanted"),
        ("gold --wavelengths 400..500:50,600", "is a list and a range"),
        ("gold --angles 0...90:10", "two dots stand between its ends"),
        ("gold --wavelengths 0", "wavelengths are in nm, between 1 and 1000000, such as 400..700:10 or 450,550"),
        ("gold --wavelengths 550 --space p3", "cannot be used with"),
        ("gold --csv - --json -", "`-` is named twice"),
        ("gold --csv x --json x", "two outputs of this run would be written there"),
        ("a/gold.csv --csv a/gold.csv", "this run reads that file"),
        ("a/gold.csv b/gold.csv", "two different materials are named `gold`"),
        ("gold silver --angles 0..90:0.01 --wavelengths 400..700:1", "5418602 rows are wanted; at most 1000000"),
        ("gold_thesis --wavelengths 600", "known at 685, 535 and 475 nm only, and 600 nm is wanted"),
    ];
    for (line, says) in cases {
        place.refused(&format!("materials reflectance {line}"), &[says]);
    }
}
