//! `materials compare`: materials beside each other in a table, whose figures are those of other commands.

use serde_json::Value;

use super::Place;

fn rows(place: &Place, line: &str) -> Vec<Value> {
    let json = place
        .done(&format!("materials compare {line} --json -"))
        .json();
    json["rows"].as_array().expect("it has rows").clone()
}

#[test]
fn the_table_has_the_figures_of_params() {
    let place = Place::new();
    for flags in [
        "",
        " --space p3 --illuminant A",
        " --medium 1.5",
        " --film 1.38:100nm",
    ] {
        let compared = rows(&place, &format!("silver gold{flags}"));
        for (row, name) in compared.iter().zip(["silver", "gold"]) {
            let params = place.done(&format!("materials params {name}{flags} --json -"));
            let params = params.json();
            assert_eq!(row["material"], params["name"]);
            for key in ["f0", "f82"] {
                for i in 0..3 {
                    let [own, other] =
                        [&row[key][i], &params[key][i]].map(|it| it.as_f64().unwrap());
                    assert!((own - other).abs() < 1e-12, "{name}{flags}: {row} {params}");
                }
            }
        }
    }
}

#[test]
fn the_largest_difference_is_that_of_the_curves() {
    let place = Place::new();
    let compared = rows(&place, "silver silver_babar");
    assert!(compared[0]["from_first"].is_null());
    assert_eq!([&compared[0]["year"], &compared[1]["year"]], [1972, 2015]);
    let apart = &compared[1]["from_first"];
    let curves =
        place.done("materials reflectance silver silver_babar --angles 0..90:0.25 --json -");
    let curves = curves.json();
    let curves = curves["rows"].as_array().unwrap();
    let (one, other) = curves.split_at(curves.len() / 2);
    let channel = apart["channel"].as_str().unwrap();
    let differences = one.iter().zip(other).map(|(one, other)| {
        let [one, other] = [one, other].map(|row| row[channel].as_f64().unwrap());
        (one - other).abs()
    });
    let largest = differences.fold(0.0, f64::max);
    assert_eq!(apart["max_abs"].as_f64(), Some(largest));
    assert!(largest > 0.0 && largest < 0.05, "{largest}");
    assert!(apart["delta_e2000"].as_f64().unwrap() < 3.0);
}

#[test]
fn text_and_csv_are_the_report() {
    let place = Place::new();
    let ran = place.done("materials compare silver gold_thesis --csv table.csv");
    assert!(
        ran.out.contains("reflectance at 685, 535 and 475 nm"),
        "{ran:?}"
    );
    assert!(
        ran.out.contains("none here: one wavelength a channel"),
        "{ran:?}"
    );
    assert!(
        ran.out
            .contains("P. B. Johnson and R. W. Christy. Optical constants"),
        "{ran:?}"
    );
    let text = place.read("table.csv");
    let head = "material,year,f0_red,f0_green,f0_blue,f82_red,f82_green,f82_blue,max_abs,angle_deg,channel,delta_e2000,source";
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines[0], lines.len()), (head, 3));
    assert!(
        lines[1].starts_with("silver,1972,0.9") && lines[1].contains(",,,,,\"P. B."),
        "{text}"
    );
    // The same material twice is one.
    assert_eq!(rows(&place, "silver gold silver").len(), 2);
}

#[test]
fn bad_input_says_what_is_allowed() {
    let place = Place::new();
    place.put("mine.png", "mine");
    for (line, says) in [
        ("gold", "2"),
        ("gold slver", "did you mean silver or"),
        ("gold silver --polarised", "add --png FILE or --svg FILE"),
        (
            "gold silver --wavelengths 550",
            "add --png FILE or --svg FILE",
        ),
        (
            "gold silver --wavelengths 400..700:10 --svg a.svg",
            "--wavelengths has 31; at most 12 are drawn",
        ),
        ("gold silver --svg - --json -", "`-` is named twice"),
        (
            "gold silver --svg a --png a",
            "two outputs of this run would be written there",
        ),
        (
            "gold silver --wavelengths 90000 --svg a.svg",
            "90000 nm is wanted",
        ),
    ] {
        place.refused(&format!("materials compare {line}"), &[says]);
    }
}
