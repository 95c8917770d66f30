//! `--precision f16` as users run it: beside single precision, refused by name, forced.

use super::OUT;
use super::Place;

#[test]
fn both_precisions_stand_in_one_tree_whichever_was_first() {
    let (one, other) = (Place::new(), Place::new());
    let single = "--target wgsl --method schlick --material gold";
    let half = format!("{single} --precision f16");
    one.done(single);
    one.done(&half);
    other.done(&half);
    other.done(single);
    let listed = [
        "wgsl/fresnel_schlick.wgsl",
        "wgsl/fresnel_schlick_f16.wgsl",
        "wgsl/materials/gold.wgsl",
        "wgsl/materials/gold_f16.wgsl",
    ];
    assert_eq!(one.listed(), listed);
    assert_eq!(one.manifest(), other.manifest());
    for line in [single, half.as_str()] {
        one.done(&format!("{line} --check"));
    }
    // A run without flags removes what nobody asks for any more, and half precision is not its own.
    one.done("--target wgsl");
    one.done(&format!("{half} --check"));
}

#[test]
fn what_was_written_says_how_to_write_it_again() {
    let place = Place::new();
    place.done("--target gles --precision f16 --material water --method dielectric_exact");
    let path = format!("{OUT}/gles/materials/water_f16.glsl");
    let text = place.read(&path);
    let (_, command) = text.split_once("Regenerate: fresnel-gen ").unwrap();
    let command = command.lines().next().unwrap().to_owned();
    place.done(&command);
    assert_eq!(place.read(&path), text);
    assert!(text.contains("mediump vec3 fresnel_water_f16(mediump float cos_theta) {"));
    assert!(!text.contains("highp") && !text.contains("precision mediump"));
}

#[test]
fn what_cannot_be_saved_is_refused_unless_forced() {
    let place = Place::new();
    let line = "--precision f16 --method conductor_textbook --target hlsl";
    place.refused(line, &["conductor_textbook", "overflow", "--force"]);
    place.refused(
        "--precision f16 --method conductor_artistic --target hlsl",
        &["conductor_artistic", "--material"],
    );
    place.refused(
        "--precision f64",
        &["no precision `f64`", "did you mean f32", "f32, f16"],
    );
    place.done(&format!("{line} --force"));
    let text = place.read(&format!("{OUT}/hlsl/fresnel_conductor_textbook_f16.hlsl"));
    assert!(text.contains("--precision f16 --force\n") && text.contains("nothing is promised"));
}

#[test]
fn what_nobody_named_is_left_out_with_a_remark() {
    let place = Place::new();
    let ran = place.done("--precision f16 --target wgsl --material none");
    assert!(
        ran.err.contains("left out: conductor_textbook in f16: "),
        "{}",
        ran.err
    );
    assert!(!place.listed().iter().any(|file| file.contains("textbook")));
}
