//! A report says what share of all numbers was tried.

use super::command::rows;
use super::command::verify;
use crate::cli::Place;

#[test]
fn how_many_numbers_were_tried_is_told_as_a_share_of_all() {
    let place = Place::new();
    let line = "--target gles --method schlick --material gold --points 1000";
    let Some(ran) = verify(&place, line) else {
        return;
    };
    let text = ran.ends(0).out;
    assert!(text.contains("of the 1065353217 f32"), "{text}");
    assert!(text.contains("--exhaustive"), "{text}");
    let ran = verify(&place, &format!("{line} --json -")).unwrap().ends(0);
    for row in rows(&ran) {
        let tried = row["share"].as_f64().unwrap() * 1_065_353_217.0;
        let points = row["points"].as_f64().unwrap();
        // Those beyond [0, 1] are points too.
        assert!((tried - tried.round()).abs() < 1e-3, "{row}");
        assert!(tried.round() < points && tried > 800.0, "{row}");
    }
    let line = "--target gles --method schlick --material gold --precision f16";
    if let Some(ran) = verify(&place, line) {
        assert!(ran.out.contains("every f16 from 0 to 1"), "{}", ran.out);
    }
}
