//! The catalogue of coefficients in the output folder: who writes it, who leaves it, what becomes of it.

use super::OUT;
use super::Place;

#[test]
fn a_run_of_one_language_writes_its_part() {
    let place = Place::new();
    place.done("--target gles");
    let files = place.listed();
    assert!(files.contains(&"gles/catalogue.glsl".to_owned()));
    assert!(!files.iter().any(|file| file == "catalogue.json"));
    // Other runs keep it.
    place.done("--target gles --material silver");
    place.done("--target gles --method schlick");
    assert!(place.listed().contains(&"gles/catalogue.glsl".to_owned()));
    assert_eq!(place.done("--target gles --check").out, "");
    place.put(&format!("{OUT}/gles/catalogue.glsl"), "spoilt");
    let drift = place.run("--target gles --check").ends(1).out;
    assert!(drift.starts_with("--- a/gles/catalogue.glsl"), "{drift}");
}

#[test]
fn a_run_that_names_methods_or_materials_writes_none() {
    for line in [
        "--target wgsl --material none",
        "--target wgsl --method schlick",
        "--target wgsl --precision f16",
        "--target spirv",
    ] {
        let listed = Place::new().done(&format!("{line} --list")).out;
        assert!(!listed.contains("catalogue"), "{line}");
    }
}

#[test]
fn its_names_have_the_prefix_and_its_numbers_the_space() {
    let place = Place::new();
    place.done("--target hlsl --prefix my_ --space acescg");
    let text = place.read(&format!("{OUT}/hlsl/catalogue.hlsl"));
    assert!(text.contains("#define MY_GOLD "), "{text}");
    assert!(text.contains("Regenerate: fresnel-gen --target hlsl --prefix my_ --space acescg\n"));
    assert!(
        text.contains("linear ACEScg") || text.contains("acescg"),
        "{text}"
    );
}

/// A file for no language: nothing in the buffer says who wrote it, so that the manifest alone proves it; textures and JSON bear a mark.
#[test]
fn files_of_others_stay_where_the_buffer_and_the_textures_go() {
    for name in ["catalogue.std430.bin", "catalogue.f16.ktx2"] {
        let place = Place::new();
        place.put(&format!("{OUT}/{name}"), "mine");
        place.refused("generate", &[name, "did not write", "nothing was written"]);
        assert_eq!(place.read(&format!("{OUT}/{name}")), "mine");
        // A run of one language has nothing to do with it.
        place.done("--target gles");
        assert_eq!(place.read(&format!("{OUT}/{name}")), "mine");
    }
    let place = Place::new();
    place.done("generate");
    assert_eq!(place.done("--check").out, "");
    let buffer = place.path(&format!("{OUT}/catalogue.std430.bin"));
    let whole = std::fs::read(&buffer).unwrap();
    // Carriage returns count in a binary file.
    let mut edited = whole.clone();
    edited.extend(b"\r\n");
    std::fs::write(&buffer, edited).unwrap();
    let drift = place.run("--check").ends(1).out;
    assert!(
        drift.starts_with("binary file catalogue.std430.bin differs"),
        "{drift}"
    );
    place.refused("generate", &["catalogue.std430.bin", "did not write"]);
    place.done("--overwrite");
    assert_eq!(std::fs::read(&buffer).unwrap(), whole);
    // A run with other names replaces what the manifest lists.
    place.done("--space acescg");
    assert_ne!(std::fs::read(&buffer).unwrap(), whole);
}

/// A user's own folder of such a name is none of ours.
#[test]
fn a_folder_called_ktx2_is_not_looked_at() {
    let place = Place::new();
    place.put(&format!("{OUT}/ktx2/wood.ktx2"), "mine");
    let ran = place.done("generate");
    assert!(!ran.err.contains("wood"), "{}", ran.err);
    place.put(&format!("{OUT}/gles/wood.glsl"), "mine");
    let ran = place.done("generate");
    assert!(ran.err.contains("gles/wood.glsl"), "{}", ran.err);
}
