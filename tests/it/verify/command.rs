//! The command `verify` as users run it: what passes, what is found, what is missing, what never ends.

use std::fs;

use serde_json::Value;

use crate::cli::{OUT, PROGRAM, Place, Ran};
use crate::not_checked;

/// Runs the program, and says whether all that it takes is here.
pub fn verify(place: &Place, line: &str) -> Option<Ran> {
    let ran = place.run(&format!("verify {line}"));
    if ran.code == Some(3) {
        assert!(std::env::var_os("CI").is_none(), "not checked: {ran:?}");
        not_checked(&format!("verify {line}: {}", ran.err));
        return None;
    }
    Some(ran)
}

pub fn rows(ran: &Ran) -> Vec<Value> {
    ran.json()["rows"].as_array().unwrap().clone()
}

#[test]
fn a_material_passes_on_every_target_with_both_errors() {
    let place = Place::new();
    place.done("--material gold");
    let Some(ran) = verify(
        &place,
        "--material gold --points 1000 --json - --junit report.xml",
    ) else {
        return;
    };
    let ran = ran.ends(0);
    let rows = rows(&ran);
    for target in ["wgsl", "spirv", "gles", "hlsl"] {
        let own: Vec<&Value> = rows.iter().filter(|row| row["target"] == target).collect();
        let form = |form| own.iter().filter(|row| row["form"] == form).count();
        assert!(form("library") > 15 && form("specialised") == 5, "{target}");
        for row in own {
            assert_eq!(row["status"], "pass", "{row}");
            assert!(row["shipped"] == true && row["current"] == true, "{row}");
            assert!(row["code_error"]["max_abs"].is_number(), "{row}");
            let films = ["anodised_titanium_purple", "oil_on_water"];
            let material = row["material"].as_str().unwrap_or_default();
            let has_truth = (material == "gold" || films.contains(&material))
                && ["library", "specialised"].contains(&row["form"].as_str().unwrap());
            assert_eq!(
                row["model_error"]["max_abs"].is_number(),
                has_truth,
                "{row}"
            );
            assert!(row["points"].as_u64() > Some(800), "{row}");
        }
    }
    let xml = place.read("report.xml");
    assert_eq!(xml.matches("<testcase ").count(), rows.len());
    assert!(!xml.contains("<failure"), "{xml}");
}

#[test]
fn one_changed_constant_is_found_in_every_text() {
    for (target, extension) in [("wgsl", "wgsl"), ("gles", "glsl"), ("hlsl", "hlsl")] {
        let place = Place::new();
        place.done(&format!("--target {target} --material gold"));
        let file = format!("{target}/materials/gold.{extension}");
        let path = place.path(&format!("{OUT}/{file}"));
        let text = fs::read_to_string(&path).unwrap();
        // The last digit but one of the first long number in code.
        let code = text.find("return ").unwrap();
        let start = code - text[..code].rfind("0.").map_or(0, |at| code - at);
        let digit = text[start..]
            .char_indices()
            .nth(3)
            .map(|(i, _)| start + i)
            .unwrap();
        let other = if &text[digit..=digit] == "5" {
            "6"
        } else {
            "5"
        };
        let edited = format!("{}{other}{}", &text[..digit], &text[digit + 1..]);
        fs::write(&path, edited).unwrap();
        let Some(ran) = verify(
            &place,
            &format!("--target {target} --material gold --points 500"),
        ) else {
            return;
        };
        let ran = ran.ends(1);
        for says in [
            file.as_str(),
            "fresnel_gold",
            "at cos_theta = ",
            "expected",
            "ulp off",
            "is not what would be written",
        ] {
            assert!(
                ran.err.contains(says),
                "{target}: {says} is not in {}",
                ran.err
            );
        }
    }
}

#[test]
fn a_changed_module_is_found() {
    let place = Place::new();
    place.done("--target spirv --method schlick_rescaled --material gold");
    let file = place.path(&format!("{OUT}/spirv/materials/gold.comp.spv"));
    let mut bytes = fs::read(&file).unwrap();
    // The first OpConstant of a float that is neither 0 nor 1: (4 words, opcode 43), its value is the fourth word.
    let words: Vec<u32> = bytes
        .chunks(4)
        .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
        .collect();
    let place_of = |words: &[u32]| {
        let value = |at: usize| f32::from_bits(words[at + 3]);
        (5..words.len() - 3)
            .find(|at| words[*at] == (4 << 16 | 43) && value(*at) > 1e-3 && value(*at) < 0.99)
    };
    let at = place_of(&words).unwrap() + 3;
    let changed = f32::from_bits(words[at]) * 1.01;
    bytes[4 * at..4 * at + 4].copy_from_slice(&changed.to_le_bytes());
    fs::write(&file, bytes).unwrap();
    let line = "--target spirv --method schlick_rescaled --material gold --points 500";
    if let Some(ran) = verify(&place, line) {
        let ran = ran.ends(1);
        assert!(
            ran.err.contains("spirv/materials/gold.comp.spv"),
            "{}",
            ran.err
        );
    }
}

/// A shader with a loop in it, in each language.
#[test]
fn a_loop_is_found_and_not_run() {
    for (target, extension, from, to) in [
        (
            "wgsl",
            "wgsl",
            "let c =",
            "loop { if cos_theta > 9.0 { break; } }\n    let c =",
        ),
        (
            "gles",
            "glsl",
            "highp float c =",
            "while (cos_theta < 9.0) {}\n    highp float c =",
        ),
        ("hlsl", "hlsl", "float c =", "for (;;) {}\n    float c ="),
    ] {
        let place = Place::new();
        place.done(&format!(
            "--target {target} --method schlick,schlick_f90 --material none"
        ));
        let file = place.path(&format!("{OUT}/{target}/fresnel_schlick.{extension}"));
        let text = fs::read_to_string(&file).unwrap();
        let broken = text.replacen(from, to, 1);
        assert_ne!(text, broken);
        fs::write(&file, broken).unwrap();
        let line = format!("--target {target} --method schlick,schlick_f90 --points 500 --json -");
        let Some(ran) = verify(&place, &line) else {
            return;
        };
        let ran = ran.ends(1);
        assert!(ran.err.contains("it holds a loop"), "{}", ran.err);
        // The others are run all the same, where their compilers are here.
        let others = rows(&ran)
            .into_iter()
            .filter(|row| row["method"] == "schlick_f90");
        let statuses: Vec<Value> = others.map(|row| row["status"].clone()).collect();
        assert!(
            !statuses.is_empty() && statuses.iter().all(|status| status != "fail"),
            "{statuses:?}"
        );
    }
}

#[test]
fn what_takes_too_long_is_ended() {
    let place = Place::new();
    let line = "--target wgsl --method conductor_exact --material none --points 10000000 --limit 1";
    if let Some(ran) = verify(&place, line) {
        let ran = ran.ends(1);
        assert!(ran.err.contains("did not end within 1 s"), "{}", ran.err);
    }
}

#[test]
fn text_that_does_not_compile_is_told_with_its_compilers_words() {
    let place = Place::new();
    place.done("--target gles --method schlick --material none");
    let file = place.path(&format!("{OUT}/gles/fresnel_schlick.glsl"));
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("m2 * m2", "m2 ** m2")).unwrap();
    if let Some(ran) = verify(&place, "--target gles --method schlick --points 500") {
        let ran = ran.ends(1);
        assert!(ran.err.contains("gles/fresnel_schlick.glsl"), "{}", ran.err);
        assert!(ran.err.contains("syntax error"), "{}", ran.err);
    }
}

#[test]
fn where_nothing_can_be_run_the_exit_code_is_3_and_the_packages_are_named() {
    let place = Place::new();
    let line = [
        "verify",
        "--target",
        "wgsl,gles",
        "--method",
        "schlick",
        "--points",
        "500",
    ];
    let output = place
        .command(&line)
        .env("VK_DRIVER_FILES", "/nothing")
        .env("VK_ICD_FILENAMES", "/nothing")
        .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nothing")
        .output()
        .unwrap();
    let ran = Ran::new("verify without drivers".to_owned(), output).ends(3);
    for says in ["not checked", "mesa-vulkan-drivers", "libegl"] {
        assert!(ran.err.contains(says), "{says} is not in {}", ran.err);
    }
    let ran = place
        .run("verify --target wgsl --method schlick --points 500 --adapter warp-drive")
        .ends(3);
    assert!(ran.err.contains("warp-drive"), "{}", ran.err);
}

#[test]
fn findings_are_annotations_where_github_reads_them() {
    let place = Place::new();
    place.done("--target gles --method schlick --material none");
    let file = place.path(&format!("{OUT}/gles/fresnel_schlick.glsl"));
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("m2 * m2 * m", "m2 * m2")).unwrap();
    let line = [
        "verify", "--target", "gles", "--method", "schlick", "--points", "500",
    ];
    let output = place
        .command(&line)
        .env("GITHUB_ACTIONS", "true")
        .output()
        .unwrap();
    let ran = Ran::new(PROGRAM.to_owned(), output);
    if ran.code != Some(3) {
        let ran = ran.ends(1);
        assert!(
            ran.err.contains("::error file=gles/fresnel_schlick.glsl"),
            "{}",
            ran.err
        );
    }
}

#[test]
fn a_bound_is_not_applied_outside_the_media_that_it_is_stated_over() {
    let place = Place::new();
    let line = "--target gles --method conductor_artistic,conductor_textbook --material air,gold_rakic --points 5000";
    if let Some(ran) = verify(&place, line) {
        ran.ends(0);
    }
}

#[test]
fn bad_input_is_refused() {
    let place = Place::new();
    place.refused("verify --points 3", &["--points", "100 to 10000000"]);
    place.refused("verify --backend metal", &["vulkan, gl"]);
    place.refused("verify --target gless", &["gles"]);
    place.refused("verify --method schlik", &["schlick"]);
    place.refused("verify --material gould", &["gold"]);
    place.refused(
        "verify --exhaustive --method schlick --material none",
        &["material"],
    );
}
