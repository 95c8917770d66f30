//! `bake` on the command line: files, report, bad input.

use super::{OUT, Place, contents};

#[test]
fn files_and_report_agree() {
    let place = Place::new();
    let ran = place.done(
        "bake --material gold --medium water --size 16 --axis cos --format all --atlas --json -",
    );
    let json = ran.json();
    assert_eq!(json["tool"], "fresnel-gen");
    let command = "bake --material gold --medium water --gamut keep --size 16 --axis cos --format \
                   exr-half,exr-float,png8,png16,ktx2,c,rust,js --atlas";
    assert_eq!(json["command"], command);
    let rows = json["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 16);
    for row in rows {
        let file = row["file"].as_str().unwrap();
        assert!(place.path(OUT).join(file).is_file(), "{file}");
        assert_eq!(
            (&row["material"], &row["medium"]),
            (&"gold".into(), &"water".into())
        );
        assert_eq!((&row["texels"], &row["axis"]), (&16.into(), &"cos".into()));
        assert!(
            row["max_abs"].as_f64().unwrap() < 0.05 && row["mean_rel"].is_number(),
            "{row}"
        );
        let is_integer = row["format"].as_str().unwrap().starts_with("png");
        assert_eq!(row["scale"].as_f64().unwrap() > 1.0, is_integer, "{row}");
    }
    // The same run again writes nothing; the description beside the files says the same.
    let again =
        place.done("bake --material gold --medium water --size 16 --axis cos --format all --atlas");
    assert!(again.err.contains("0 written, 18 unchanged"), "{again:?}");
    let beside = place.read(&format!("{OUT}/lut/gold_in_water.json"));
    let beside: serde_json::Value = serde_json::from_str(&beside).unwrap();
    assert_eq!(beside["rows"].as_array().unwrap()[..], rows[..8]);
}

#[test]
fn a_budget_is_met_by_the_smallest() {
    let place = Place::new();
    let ran = place.done("bake --budget 0.001 --json -");
    let json = ran.json();
    let rows = json["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for row in rows {
        assert!(row["max_abs"].as_f64().unwrap() <= 0.001, "{row}");
        assert!(row["texels"].as_u64().unwrap() <= 32, "{row}");
    }
    assert_eq!(contents(&place.path(OUT)).len(), 8);
    let coarse =
        place.done("bake --budget 0.02 --material water --axis cos --format png8,png16 --json -");
    let row = &coarse.json()["rows"][0];
    assert_eq!(
        (&row["format"], &row["axis"]),
        (&"png8".into(), &"cos".into())
    );
}

#[test]
fn bad_input_is_refused() {
    let place = Place::new();
    place.put("file", "");
    for size in ["0", "1", "16385", "-1", "1e3", "99999999999999999999999"] {
        assert_eq!(
            place.run(&format!("bake --size={size}")).code,
            Some(2),
            "{size}"
        );
    }
    place.refused("bake --size 1", &["2 to 16384"]);
    place.refused(
        "bake --axis sqr",
        &[
            "no axis `sqr`",
            "sqrt",
            "cos, square, sqrt, rational, steep, grazing",
        ],
    );
    place.refused("bake --format exr", &["no format `exr`", "exr-half", "all"]);
    place.refused("bake --material golld", &["no material `golld`", "gold"]);
    place.refused("bake --material none", &["nothing to bake"]);
    place.refused("bake --medium gold", &["transparent"]);
    place.refused("bake --gamut wide", &["keep, clip, scale"]);
    for budget in ["0", "-1", "nan", "inf"] {
        place.refused(&format!("bake --budget {budget}"), &["above 0"]);
    }
    place.refused(
        "bake --material gold --budget 1e-9",
        &["no table meets", "16384"],
    );
    place.refused(
        "bake --out-dir file",
        &["cannot write", "no file was changed"],
    );
    assert!(!place.path(OUT).exists());
}
