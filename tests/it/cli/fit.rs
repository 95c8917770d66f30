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
        ("--weight relativ", "did you mean relative"),
        ("--weight deltae", "did you mean delta-e"),
        ("--exact 45", "there are 0, 90"),
        ("--exact 0,nan", "no end of the right angle `nan`"),
        ("--f0 0.5,0.5,0.5 --f82 0.5,0.5,0.5 --search", "--search"),
        (
            "--f0 0.5,0.5,0.5 --f82 0.5,0.5,0.5 --weight luminance",
            "wants a space",
        ),
        ("--search --terms 6", "4 or 5"),
        ("--search --material air", "no material to search"),
        ("--search --material none", "nothing to fit"),
        ("--json .", "."),
    ] {
        place.refused(&format!("fit {line}"), &[says]);
    }
}

/// The largest error relative to water's law, of green, over even steps of the cosine.
fn largest_relative(row: &Value) -> f64 {
    let own = channel(row, 1);
    let at = |i: i32| f64::from(i) / 500.0;
    let law = |c: f64| fresnel_gen::physics::optics::conductor(1.3345, 0.0, c).unpolarised();
    let off = |c: f64| (powers(&own, c) / law(c) - 1.0).abs();
    (0..=500).map(|i| off(at(i))).fold(0.0, f64::max)
}

/// The form of dielectrics, as anyone would write it down.
fn powers(c: &[f64], cos_theta: f64) -> f64 {
    let b = 1.0 - cos_theta;
    c[0] + b.powi(3) * (c[1] + b.powi(4) * (c[2] + b.powi(7) * c[3]))
}

fn only(rows: Vec<Value>, method: &str) -> Value {
    let mut own = rows.into_iter().filter(|row| row["method"] == method);
    own.next().unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn a_weight_changes_what_is_least() {
    let place = Place::new();
    let by = |weight: &str| {
        let line = format!("fit --material water --weight {weight}");
        only(rows(&place, &line), "fitted_dielectric")
    };
    let (absolute, relative) = (by("absolute"), by("relative"));
    assert!(number(&relative["max_abs"]) > number(&absolute["max_abs"]));
    assert!(largest_relative(&relative) < 0.8 * largest_relative(&absolute));
    assert_eq!(relative["weight"], "relative");
    for weight in ["luminance", "delta-e"] {
        let error = number(&by(weight)["error"]);
        assert!(error > 0.0 && error < 3.0, "{weight}: {error}");
    }
}

#[test]
fn ends_are_met_and_their_price_is_told() {
    let place = Place::new();
    let law = |c: f64| fresnel_gen::physics::optics::conductor(1.5, 0.0, c).unpolarised();
    place.put(
        "plain.toml",
        super::MY_METAL
            .replace("\"metal\"", "\"dielectric\"")
            .replace("1.39, 1.72", "1.5, 0")
            .replace("0.23, 3.94", "1.5, 0"),
    );
    for (exact, ends) in [("0", &[1.0][..]), ("90", &[0.0]), ("0,90", &[1.0, 0.0])] {
        let line = format!("fit --material plain.toml --exact {exact}");
        let row = only(rows(&place, &line), "fitted_dielectric");
        for end in ends {
            let off = powers(&channel(&row, 1), *end) - law(*end);
            assert!(off.abs() < 1e-7, "{exact} at {end}: {off:e}");
        }
        let (error, free) = (number(&row["error"]), number(&row["error_without_exact"]));
        assert!(free < error && error < 4.0 * free, "{row}");
    }
    let text = place.done("fit --material plain.toml --exact 90").out;
    assert!(text.contains("the same, not exact at an end"), "{text}");
}

#[test]
fn a_form_keeps_to_what_a_surface_can_reflect_and_its_price_is_told() {
    let place = Place::new();
    let of = |gamut: &str| {
        let line = format!("fit --material gold --terms 4{gamut}");
        only(rows(&place, &line), "fitted")
    };
    let (kept, free) = (of(""), of(" --gamut keep"));
    let red = |row: &serde_json::Value| channel(row, 0)[0];
    assert!(red(&kept) <= 1.0 && red(&free) > 1.03, "{kept} {free}");
    let price = (
        number(&kept["max_abs"]),
        number(&kept["max_abs_without_gamut"]),
    );
    assert!(price.1 < price.0 && price.0 < 0.0033, "{price:?}");
    assert!(free["max_abs_without_gamut"].is_null(), "{free}");
    let text = place.done("fit --material gold").out;
    assert!(text.contains("the same, not kept to [0, 1]"), "{text}");
    // Two colours have no gamut, and no empty column for it.
    let two = place.done("fit --f0 1,.71,.29 --f82 .98,.91,.66").out;
    assert!(!two.contains("kept to [0, 1]"), "{two}");
    for table in [text, two] {
        assert!(table.contains("A star marks the frontier"), "{table}");
    }
    let refused = place.run("fit --search --gamut clip");
    assert_eq!(refused.code, Some(2), "{}", refused.err);
}

#[test]
fn a_search_finds_what_is_shipped_and_says_the_same_twice() {
    let place = Place::new();
    let line = "fit --search --terms 4 --material gold,silver,gold_johnson,iron --json -";
    let (one, other) = (place.done(line).out, place.done(line).out);
    assert!(one == other, "two runs differ");
    let report: Value = serde_json::from_str(&one).unwrap();
    let rows = report["rows"].as_array().unwrap();
    let shapes: Vec<&Value> = rows.iter().filter(|row| row["row"] == "shape").collect();
    for name in ["fitted", "fitted_rational", "fitted_dielectric"] {
        assert!(shapes.iter().any(|row| row["method"] == name), "{name}");
    }
    let best: Vec<&&Value> = shapes
        .iter()
        .filter(|row| row["is_on_frontier"] == true)
        .collect();
    let errors = best.iter().map(|row| number(&row["errors"]["p90"]));
    assert!(errors.collect::<Vec<f64>>().is_sorted_by(|a, b| a > b));
    assert!(
        best.iter()
            .map(|row| row["operations"].as_u64())
            .is_sorted()
    );
    let choice = rows.iter().find(|row| row["row"] == "choice").unwrap();
    let times = choice["chosen"].as_array().unwrap().iter();
    let times: u64 = times.map(|one| one["substances"].as_u64().unwrap()).sum();
    assert_eq!(times, 3, "gold votes once: {choice}");
}
