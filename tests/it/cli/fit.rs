//! `fit` as users run it: a material's coefficients, an artist's colours, the whole catalogue.

use serde_json::Value;

use super::Place;

fn rows(place: &Place, line: &str) -> Vec<Value> {
    let ran = place.done(&format!("{line} --json -"));
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    report["rows"].as_array().unwrap().clone()
}

/// The form as anyone would write it down, from the coefficients of a channel.
fn fitted(coefficients: &[f64], cos_theta: f64) -> f64 {
    let b = (-6.5 * cos_theta).exp2();
    let sum = coefficients.iter().rev().fold(0.0, |sum, c| c + b * sum);
    sum.clamp(0.0, 1.0)
}

fn channel(row: &Value, channel: usize) -> Vec<f64> {
    let numbers = row["coefficients"][channel].as_array().unwrap().iter();
    numbers.map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn an_artists_colours_are_met_within_the_error_told() {
    let place = Place::new();
    let rows = rows(&place, "fit --f0 0.95,0.71,0.99 --f82 0.97,0.8,0.98");
    let row = rows.iter().find(|row| row["method"] == "fitted").unwrap();
    let error = row["max_abs"].as_f64().unwrap();
    assert!(error < 0.02, "{row}");
    for (i, (f0, f82)) in [(0.95, 0.97), (0.71, 0.8), (0.99, 0.98)]
        .into_iter()
        .enumerate()
    {
        let own = channel(row, i);
        assert!((fitted(&own, 1.0) - f0).abs() <= error + 1e-6, "{row}");
        assert!(
            (fitted(&own, 1.0 / 7.0) - f82).abs() <= error + 1e-6,
            "{row}"
        );
    }
    // An F0 of .985 and more is not taken for an index.
    assert!(row["follows"][0]["law"]["k"].as_f64().unwrap() > 0.0);
    assert!(row["follows"][2]["f82_tint"]["tint"].as_f64().unwrap() < 1.0);
}

#[test]
fn every_material_has_a_row_for_every_form_that_describes_it() {
    let place = Place::new();
    let all = rows(&place, "fit --material all");
    let of = |class: &str, method: &str| {
        let is_it = |row: &&Value| row["class"] == class && row["method"] == method;
        all.iter().filter(is_it).count()
    };
    assert_eq!(of("metal", "fitted_dielectric"), 0);
    assert_eq!(of("metal", "fitted"), of("metal", "fitted_five"));
    assert!(of("dielectric", "fitted_dielectric") >= 35);
    let five = rows(&place, "fit --material gold --terms 5");
    assert_eq!(five.len(), 1);
    assert_eq!(channel(&five[0], 2).len(), 5);
    assert_eq!(five[0]["shared"], true);
}

#[test]
fn names_and_numbers_that_make_no_sense_are_refused() {
    let place = Place::new();
    for (line, says) in [
        ("--terms 3", "4 or 5"),
        ("--material golt", "gold"),
        ("--gpu rdna", "rdna2"),
        ("--f0 0.5,0.5,0.5", "--f82"),
        ("--f0 0.5,0.5 --f82 0.5,0.5,0.5", "three reflectances"),
        ("--f0 0.5,0.5,1.5 --f82 0.5,0.5,0.5", "0 to 1"),
        ("--f0 0.5,0.5,nan --f82 0.5,0.5,0.5", "0 to 1"),
        ("--f0 0.5,0.5,0.5 --f82 0.5,0.5,0.5 --space p3", "--space"),
        ("--material none", "nothing to fit"),
        ("--json .", "."),
    ] {
        place.refused(&format!("fit {line}"), &[says]);
    }
}
