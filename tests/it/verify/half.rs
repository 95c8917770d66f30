//! Half precision as it runs: within its bound of f64, and how far from the emulation that rounds after every operation.

use serde_json::Value;

use super::command::verify;
use crate::cli::Place;
use fresnel_gen::lab::verify::{halves, halves_beyond};

/// How far a device may be from the emulation: it may fuse, divide in two steps, and take numbers below the smallest
/// normal one for 0.
const NEAR: f64 = 0.002;
/// A method whose numbers of up to 70 cancel, and how far a device may be there. It promises .0045.
const CANCELS: (&str, f64) = ("fitted_f82_metal", 0.0035);

#[test]
fn it_passes_on_every_target_and_comes_near_the_emulation() {
    let place = Place::new();
    let line = "--precision f16 --material gold,water --json -";
    let Some(ran) = verify(&place, line) else {
        return;
    };
    let ran = ran.ends(0);
    let points = halves().len() + halves_beyond().len();
    let rows = ran.json()["rows"].as_array().unwrap().clone();
    for target in ["wgsl", "spirv", "gles", "hlsl"] {
        let own: Vec<&Value> = rows.iter().filter(|row| row["target"] == target).collect();
        assert!(own.len() > 25, "{target}");
        for row in own {
            assert_eq!(row["status"], "pass", "{row}");
            assert_eq!(row["precision"], "f16", "{row}");
            assert_eq!(row["points"], points, "{row}");
            let is_single = row["emulation"]["device_computes_in"] == "f32";
            let apart = row["emulation"]["max_abs"].as_f64().unwrap();
            let near = if row["method"] == CANCELS.0 {
                CANCELS.1
            } else {
                NEAR
            };
            assert!(is_single || apart < near, "{row}");
        }
    }
}
