//! The catalogue of coefficients in the output folder: who writes it, who leaves it, what becomes of it.

use super::{OUT, Place};

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
