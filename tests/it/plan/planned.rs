//! What is chosen for the scenes in `data/scenes/`, and the errors of the functions among which the choice falls.
//!
//! The figures are of an independent prototype.

use std::process::Command;

use serde_json::Value;

use crate::cli::PROGRAM;

/// A scene, its chosen method, and errors of `constant_f0`, `schlick_spherical_gaussian`, `schlick` and the fitted method, with half a
/// unit of their last digits.
struct Case {
    scene: &'static str,
    chosen: &'static str,
    errors: [(f64, f64); 4],
}

const METHODS: [&str; 4] = [
    "constant_f0",
    "schlick_spherical_gaussian",
    "schlick",
    "fitted",
];

const CASES: [Case; 8] = [
    Case {
        scene: "gold_white",
        chosen: "fitted",
        errors: [(17.4, 0.05), (1.82, 0.005), (1.78, 0.005), (0.14, 0.005)],
    },
    Case {
        scene: "gold_dim",
        chosen: "schlick_spherical_gaussian",
        errors: [(6.1, 0.05), (0.61, 0.005), (0.61, 0.005), (0.06, 0.005)],
    },
    Case {
        scene: "platinum_sky",
        chosen: "fitted",
        errors: [(7.8, 0.05), (4.45, 0.005), (4.45, 0.005), (0.05, 0.005)],
    },
    Case {
        scene: "silver",
        chosen: "constant_f0",
        errors: [(0.51, 0.005), (0.29, 0.005), (0.29, 0.005), (0.03, 0.005)],
    },
    Case {
        scene: "gold_cube",
        chosen: "constant_f0",
        errors: [
            (0.010, 0.0005),
            (0.006, 0.0005),
            (0.010, 0.0005),
            (0.09, 0.005),
        ],
    },
    Case {
        scene: "bk7",
        chosen: "fitted_dielectric_tinted",
        errors: [(37.0, 0.5), (1.59, 0.005), (1.78, 0.005), (0.39, 0.005)],
    },
    Case {
        scene: "water_grazing",
        chosen: "fitted_dielectric_tinted",
        errors: [(55.0, 0.5), (2.54, 0.005), (2.60, 0.005), (0.24, 0.005)],
    },
    Case {
        scene: "water_above",
        chosen: "schlick_spherical_gaussian",
        errors: [(7.8, 0.05), (0.63, 0.005), (0.96, 0.005), (0.35, 0.005)],
    },
];

/// The row of a scene's only material, planned with these flags.
fn row(scene: &str, flags: &[&str]) -> Value {
    let file = format!("data/scenes/{scene}.toml");
    let ran = Command::new(PROGRAM)
        .args(["plan", &file, "--json", "-"])
        .args(flags)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let report: Value = serde_json::from_slice(&ran.stdout).unwrap();
    report["rows"][0].clone()
}

#[test]
fn every_scene_gets_the_function_that_it_needs() {
    for case in CASES {
        let row = row(case.scene, &[]);
        assert_eq!(row["method"], case.chosen, "{}", case.scene);
        assert!(row["is_within"].as_bool().unwrap());
        // Its error, and those of what costs less.
        let errors = row["cheaper"].as_array().unwrap().iter().chain([&row]);
        for one in errors.filter(|one| one["form"] == "specialised") {
            let place = METHODS.iter().position(|name| one["method"] == *name);
            let Some(place) = place else { continue };
            let (want, half) = case.errors[place];
            let error = one["error"].as_f64().unwrap();
            let allowed = 0.05 * want + half;
            assert!(
                (error - want).abs() <= allowed,
                "{}: {one}: {want}",
                case.scene
            );
        }
    }
}

/// The fitted method where it is not chosen, and Schlick's where it costs more than what is.
#[test]
fn functions_that_are_not_needed_have_the_known_errors_too() {
    for case in CASES {
        for (method, (want, half)) in METHODS.iter().zip(case.errors) {
            if *method == case.chosen {
                continue;
            }
            let row = row(case.scene, &["--method", method]);
            let error = row["error"].as_f64().unwrap();
            let allowed = 0.05 * want + half;
            assert!(
                (error - want).abs() <= allowed,
                "{}, {method}: {error}, {want}",
                case.scene
            );
        }
    }
}
