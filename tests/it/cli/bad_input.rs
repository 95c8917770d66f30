//! Names that do not exist, and requests that cannot be met: exit 2, the nearest right name, nothing written.

use fresnel_gen::physics::materials;

use super::Place;

#[test]
fn an_unknown_name_is_answered_with_the_nearest() {
    let place = Place::new();
    let all = materials::known().len();
    let there_are =
        format!("there is no material `zzz`; there are {all} of them: see `fresnel-gen materials`");
    for (line, says) in [
        (
            "--target wgls",
            "there is no target `wgls` (did you mean wgsl",
        ),
        (
            "--target GLES",
            "there is no target `GLES` (did you mean gles",
        ),
        (
            "--target gles,hsls",
            "there is no target `hsls` (did you mean hlsl",
        ),
        (
            "--method shlick",
            "there is no method `shlick` (did you mean schlick",
        ),
        (
            "--method schlick --method exact_conductor",
            "(did you mean conductor_exact or conductor_artistic?); there are",
        ),
        (
            "--material gold_thesi",
            "there is no material `gold_thesi` (did you mean gold_thesis",
        ),
        (
            "--material gold_thesis,watr_thesis",
            "(did you mean water_thesis",
        ),
        (
            "--medium water_tesis --material gold_thesis",
            "(did you mean water_thesis",
        ),
        ("--material zzz", &there_are),
        ("methods show shlick", "(did you mean schlick"),
        ("materials show gold_tesis", "(did you mean gold_thesis"),
        ("targets show spirw", "(did you mean spirv?)"),
        ("method", "'methods'"),
        ("--targets gles", "'--target'"),
    ] {
        place.refused(line, &[says]);
    }
}

#[test]
fn an_empty_name_is_a_name_that_does_not_exist() {
    let place = Place::new();
    for (flag, says) in [
        ("--target", "there is no target ``; there are "),
        ("--method", "there is no method ``"),
        ("--material", "there is no material ``"),
        ("--medium", "there is no material ``"),
    ] {
        place.refused_with(&[flag, ""], &[says]);
    }
}

#[test]
fn a_prefix_must_make_good_names_in_every_language() {
    let place = Place::new();
    for prefix in [
        "1a", "a b", "a-b", "a__b", "a__", "_a", "__", "é", "gl_", "a\nb", "../", "a;", "*/",
        "\u{202e}",
    ] {
        let says = ["--prefix", prefix.trim()];
        place.refused_with(&["--prefix", prefix], &says[..1]);
    }
    let long = "a".repeat(250);
    place.refused_with(&["--prefix", &long], &["more than 200 characters"]);
    for prefix in ["brdf_", "f", ""] {
        place.run_with(&["--prefix", prefix, "--list"]).ends(0);
    }
}

#[test]
fn a_matching_angle_lies_between_0_and_90_degrees() {
    let place = Place::new();
    for angle in ["0", "90", "-1", "91", "nan", "inf", "1e400"] {
        place.refused(
            &format!("--matching-angle {angle} --target gles"),
            &["between 0 and 90"],
        );
    }
    place.refused(
        "--matching-angle 200 --method schlick",
        &["between 0 and 90"],
    );
    place.refused("--matching-angle steep", &["--matching-angle"]);
    let ran =
        place.done("--matching-angle 84.26 --material gold_thesis --method schlick_corrected -o -");
    assert!(ran.out.contains("--matching-angle 84.26"), "{ran:?}");
}

#[test]
fn choices_that_exclude_each_other_are_refused() {
    let place = Place::new();
    place.refused("--material gold_thesis,none", &["no other can be named"]);
    place.refused("--medium none", &["there is no material `none`"]);
    place.refused("--target gles --depfile -", &["--depfile takes a file"]);
}

#[test]
fn two_functions_of_one_name_are_refused() {
    let place = Place::new();
    let gold = fresnel_gen::physics::materials::source("gold_thesis").unwrap();
    let name = "gold_thesis_schlick_rescaled";
    std::fs::write(place.path("m.toml"), gold.replacen("gold_thesis", name, 1)).unwrap();
    place.refused(
        "--material gold_thesis,m.toml",
        &[
            "`fresnel_gold_thesis_schlick_rescaled` would stand in",
            "rename a material",
        ],
    );
    place.done("--material m.toml --target gles");
}

#[test]
fn a_method_that_cannot_describe_the_material_is_refused() {
    let place = Place::new();
    let says = "method `dielectric_exact` cannot be specialised to `gold_thesis`";
    place.refused("--method dielectric_exact --material gold_thesis", &[says]);
    place.refused(
        "--method dielectric_exact --material gold_thesis -o -",
        &[says],
    );
}

#[test]
fn a_medium_must_be_transparent() {
    let place = Place::new();
    let says = "the medium `gold_thesis` is a metal; a medium must be transparent";
    place.refused("--medium gold_thesis", &[says]);
    place.refused(
        "--medium gold_thesis --material none --target wgsl -o - --material water_thesis",
        &[],
    );
    place.done("--medium water_thesis --material gold_thesis,diamond_thesis --target wgsl");
    let text = place.read("shaders-generated/wgsl/materials/gold_thesis_in_water_thesis.wgsl");
    assert!(
        text.contains("fn fresnel_gold_thesis_in_water_thesis("),
        "{text}"
    );
    assert!(text.contains("--medium water_thesis"), "{text}");
}

/// A decimal comma where a point must stand.
#[test]
fn a_decimal_comma_is_named() {
    let place = Place::new();
    for line in [
        "materials coat --f0 0,9,0,8,0,7 --f82 1,1,1",
        "materials coat --f0 1,1,1 --f82 0,9",
        "materials coat --f0 1,1,1 --f82 1,1,1 --index 1,5",
        "fit --f0 1,5 --f82 1,1,1",
        "--method schlick --medium 1,33",
        "--material gold --wavelengths 685,5,535,5,475,5",
        "bake --material gold --budget 0,001",
        "scene-error cube --eye 0,5",
    ] {
        place.refused(
            line,
            &["decimals stand behind a point, not a comma: 1.5, not 1,5"],
        );
    }
    let ran = place.run("materials coat --f0 1,1 --f82 1,1,1,1").ends(2);
    assert!(
        ran.err.contains("not a comma"),
        "two numbers may be one: {ran:?}"
    );
    let ran = place.run("materials coat --f0 1,1,1 --f82 0.9,0.8").ends(2);
    assert!(!ran.err.contains("not a comma"), "{ran:?}");
}
