//! Files that somebody changed: wrong beyond [0, 1], with a declaration added, with a false number in a header or in the
//! manifest. Each must fail. What differs and is right is a remark.

use std::fs;

use serde_json::Value;

use super::command::verify;
use crate::cli::{OUT, Place, Ran};
use fresnel_gen::physics::digest::sha256;

const LIBRARY: &str = "--method schlick --material none";
const GOLD: &str = "--material gold --method conductor_exact,fitted";

/// A language, the ending of its files, and how it says the bits of a number.
const LANGUAGES: [(&str, &str, &str); 3] = [
    ("wgsl", "wgsl", "bitcast<u32>(cos_theta)"),
    ("gles", "glsl", "floatBitsToUint(cos_theta)"),
    ("hlsl", "hlsl", "asuint(cos_theta)"),
];

/// Generates, edits a file of the folder, and verifies the same.
#[track_caller]
fn edited(flags: &str, file: &str, edit: impl Fn(&str) -> String) -> Option<Ran> {
    let place = Place::new();
    place.done(flags);
    let path = place.path(&format!("{OUT}/{file}"));
    let text = fs::read_to_string(&path).unwrap();
    let changed = edit(&text);
    assert_ne!(text, changed, "{file}: the edit changes nothing");
    fs::write(&path, changed).unwrap();
    verify(&place, &format!("{flags} --points 500 --json -"))
}

/// The run fails, and says all of this.
#[track_caller]
fn fails(ran: Option<Ran>, says: &[&str]) {
    let Some(ran) = ran else { return };
    let ran = ran.ends(1);
    for words in says {
        assert!(ran.err.contains(words), "{words} is not in {}", ran.err);
    }
}

/// The run passes, and says this of every row of a file.
#[track_caller]
fn passes(ran: Option<Ran>, file: &str, remark: Option<&str>) {
    let Some(ran) = ran else { return };
    let ran = ran.ends(0);
    let report = ran.json();
    let rows = report["rows"].as_array().unwrap();
    let rows: Vec<&Value> = rows.iter().filter(|row| row["file"] == file).collect();
    assert!(!rows.is_empty(), "{file} has no row");
    for row in rows {
        assert_eq!(row["status"], "pass", "{row}");
        match remark {
            None => assert!(row["remark"].is_null(), "{row}"),
            Some(words) => {
                let said = row["remark"].as_str().unwrap_or_default();
                assert!(said.contains(words), "{words} is not in {row}");
                assert!(ran.err.contains(words), "{words} is not in {}", ran.err);
            }
        }
    }
}

/// Methods, and for which cosines each is made to return something else. BITS are those of the cosine.
const WRONG: [(&str, &str, &str); 6] = [
    ("empirical", "cos_theta > 2.0", "0.5"),
    (
        "hoffman_f82",
        "cos_theta > 1.0e20 && cos_theta < 1.0e21",
        "0.5",
    ),
    (
        "schlick",
        "cos_theta < -1.0e-21 && cos_theta > -1.0e-20",
        "0.5",
    ),
    ("schlick_f90", "BITS == 0x7F800000u", "0.5"),
    ("schlick_ior", "BITS == 0xFF800000u", "0.5"),
    (
        "schlick_rescaled",
        "(BITS & 0x7FFFFFFFu) > 0x7F800000u",
        "cos_theta",
    ),
];

/// The text of a method's file whose function is wrong where a condition holds.
fn wrong(text: &str, target: &str, condition: &str, result: &str) -> String {
    let result = match target {
        "wgsl" => format!("vec3<f32>({result})"),
        "gles" => format!("vec3({result})"),
        _ => format!("({result}).xxx"),
    };
    let line = format!("    if ({condition}) {{ return {result}; }}\n");
    let first = text.find("c = ").unwrap();
    let begin = text[..first].rfind('\n').unwrap() + 1;
    format!("{}{line}{}", &text[..begin], &text[begin..])
}

#[test]
fn wrong_results_beyond_0_to_1_are_seen() {
    let methods = WRONG.map(|(method, ..)| method).join(",");
    for (target, ending, bits) in LANGUAGES {
        let place = Place::new();
        let flags = format!("--target {target} --method {methods} --material none");
        place.done(&flags);
        for (method, condition, result) in WRONG {
            let path = place.path(&format!("{OUT}/{target}/fresnel_{method}.{ending}"));
            let text = fs::read_to_string(&path).unwrap();
            let changed = wrong(&text, target, &condition.replace("BITS", bits), result);
            fs::write(&path, changed).unwrap();
        }
        let Some(ran) = verify(&place, &format!("{flags} --points 500 --json -")) else {
            return;
        };
        let report = ran.ends(1).json();
        for (method, condition, _) in WRONG {
            let is_it = |row: &&Value| row["method"] == method && row["status"] == "fail";
            let rows = report["rows"].as_array().unwrap();
            let row = rows.iter().find(is_it);
            let row =
                row.unwrap_or_else(|| panic!("{target}: {method} passes, wrong where {condition}"));
            assert!(
                row["reason"].as_str().unwrap().contains("at cos_theta = "),
                "{row}"
            );
        }
    }
}

/// What is added to a file, and the word by which a finding names it.
const ADDED: [(&str, &str, &[&str]); 3] = [
    (
        "wgsl",
        "wgsl",
        &[
            "fn evil1(x: f32) -> f32 { return x; }",
            "@group(3) @binding(7) var<uniform> evil2: vec4<f32>;",
            "var<private> evil3: f32;",
            "// a comment\u{2028}override evil4: f32 = 1.0;",
        ],
    ),
    (
        "gles",
        "glsl",
        &[
            "highp float evil1(highp float x) { return x; }",
            "uniform highp float evil2;",
            "#define evil3 1",
            "const highp float evil4 = 1.0;",
        ],
    ),
    (
        "hlsl",
        "hlsl",
        &[
            "float evil1(float x) { return x; }",
            "cbuffer evil2 { float inner; }",
            "static float evil3;",
            "Texture2D<float4> evil4 : register(t7);",
        ],
    ),
];

#[test]
fn functions_and_resources_that_were_added_are_seen() {
    for (target, ending, added) in ADDED {
        let file = format!("{target}/fresnel_schlick.{ending}");
        let edit = |text: &str| format!("{text}\n{}\n", added.join("\n"));
        let ran = edited(&format!("--target {target} {LIBRARY}"), &file, edit);
        fails(ran, &[file.as_str(), "evil1", "evil2", "evil3", "evil4"]);
    }
}

/// All of these edits, each of which changes something.
#[track_caller]
fn all_of(text: &str, edits: &[(&str, &str, &str)]) -> String {
    edits.iter().fold(text.to_owned(), |text, (from, to, _)| {
        assert!(text.contains(from), "{from} is not there");
        text.replacen(from, to, 1)
    })
}

/// Each of these edits of gold's file is seen, which was made with these flags; `verify` is not told the form of its headers.
#[track_caller]
fn all_are_seen(flags: &str, file: &str, edits: &[(&str, &str, &str)]) {
    let place = Place::new();
    place.done(flags);
    let path = place.path(&format!("{OUT}/{file}"));
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, all_of(&text, edits)).unwrap();
    let untold = flags.replace(" --header full", "");
    let ran = verify(&place, &format!("{untold} --points 500 --json -"));
    let says: Vec<&str> = edits.iter().map(|(_, _, says)| *says).collect();
    fails(ran, &[&says[..], &[&format!("{file}:")]].concat());
}

/// False numbers in what both forms of a header say.
const IN_BOTH_FORMS: [(&str, &str, &str); 4] = [
    (
        "Model error: at most 0.00445",
        "Model error: at most 0.00045",
        "0.00045",
    ),
    (
        "Model error: at most 0.00193",
        "Model error: none, it is the exact law",
        "exact law",
    ),
    ("Cost: 64 scalar", "Cost: 16 scalar", "Cost: 16"),
    (
        "Truth: reflectance integrated over 380",
        "Truth: reflectance integrated over 360",
        "360",
    ),
];

#[test]
fn false_numbers_in_a_short_header_are_seen() {
    let short = [("Stiefel, 1959", "Stiefel, 1859", "1859")];
    let edits = [&IN_BOTH_FORMS[..], &short].concat();
    all_are_seen(
        &format!("--target wgsl {GOLD}"),
        "wgsl/materials/gold.wgsl",
        &edits,
    );
}

#[test]
fn false_numbers_in_a_full_header_are_seen() {
    let full = [
        (
            "Code error: at most 4.5 ulp",
            "Code error: at most 1.5 ulp",
            "1.5 ulp",
        ),
        ("by cosine: (0.999366,", "by cosine: (0.899366,", "0.899366"),
    ];
    let edits = [&IN_BOTH_FORMS[..], &full].concat();
    let flags = format!("--target wgsl {GOLD} --header full");
    all_are_seen(&flags, "wgsl/materials/gold.wgsl", &edits);
}

/// A folder with files of both forms is as it should be, and so is each file for the run that writes it.
#[test]
fn files_of_both_forms_stand_beside_each_other() {
    let place = Place::new();
    let lines = [
        format!("--target wgsl {GOLD}"),
        format!("--target gles {GOLD} --header full"),
    ];
    for line in &lines {
        place.done(line);
        place.done(&format!("{line} --check"));
    }
    let both = format!("--target wgsl,gles {GOLD} --points 500 --json -");
    for file in ["wgsl/materials/gold.wgsl", "gles/materials/gold.glsl"] {
        passes(verify(&place, &both), file, None);
    }
}

#[test]
fn false_numbers_in_the_manifest_are_seen() {
    let edits = [
        ("\"max_ulp\": 4.5", "\"max_ulp\": 0.5", "`code_error`"),
        ("\"operations\": 64", "\"operations\": 16", "`operations`"),
        ("\"max_abs\": 0.004", "\"max_abs\": 0.001", "`model_error`"),
        ("0.9993", "0.8993", "`average`"),
        ("b = 2^(-6.5 c)", "b = 2^(-5.5 c)", "`formula`"),
        ("algorithm of the fit", "algorithm by luck", "`source`"),
        ("R. L. Olmon", "R. L. Nobody", "`data`"),
    ];
    let edit = |text: &str| all_of(text, &edits);
    let ran = edited(&format!("--target wgsl {GOLD}"), "manifest.json", edit);
    let says: Vec<&str> = edits.iter().map(|(_, _, says)| *says).collect();
    fails(
        ran,
        &[&says[..], &["manifest.json:", "fresnel_gold"]].concat(),
    );
}

#[test]
fn a_function_that_the_manifest_lists_and_the_file_lacks_is_seen() {
    let edit = |text: &str| text[..text.find("// fresnel_gold_fitted").unwrap()].to_owned();
    let ran = edited(
        &format!("--target wgsl {GOLD}"),
        "wgsl/materials/gold.wgsl",
        edit,
    );
    fails(ran, &["wgsl/materials/gold.wgsl", "fresnel_gold_fitted"]);
}

#[test]
fn a_file_that_no_manifest_lists_is_run_all_the_same() {
    let place = Place::new();
    place.done(&format!("--target wgsl {LIBRARY}"));
    let path = place.path(&format!("{OUT}/wgsl/fresnel_schlick.wgsl"));
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("m2 * m2 * m", "m2 * m2")).unwrap();
    fs::write(
        place.path(&format!("{OUT}/manifest.json")),
        place
            .manifest()
            .to_string()
            .replace("fresnel_schlick.wgsl", "another.wgsl"),
    )
    .unwrap();
    let ran = verify(&place, &format!("--target wgsl {LIBRARY} --points 500"));
    fails(ran, &["wgsl/fresnel_schlick.wgsl", "at cos_theta = "]);
}

#[test]
fn what_differs_and_is_right_is_a_remark() {
    let file = "wgsl/materials/gold.wgsl";
    let edit = |text: &str| {
        text.replace("// sin^2 theta\n", "// the sine squared\n")
            .replace("m2", "square")
    };
    let ran = edited(
        &format!("--target wgsl {GOLD},schlick_rescaled"),
        file,
        edit,
    );
    passes(
        ran,
        file,
        Some("is not what would be written today: its code differs, first in line "),
    );
}

#[test]
fn line_ends_of_windows_are_no_difference() {
    let file = "wgsl/materials/gold.wgsl";
    let ran = edited(&format!("--target wgsl {GOLD}"), file, |text| {
        text.replace('\n', "\r\n")
    });
    passes(ran, file, None);
}

#[test]
fn what_earlier_runs_put_into_a_file_belongs_to_it() {
    let place = Place::new();
    place.done("--target wgsl --material gold");
    place.done("--target wgsl --material gold --method schlick");
    for flags in ["--material gold", "--material gold --method schlick"] {
        let ran = verify(
            &place,
            &format!("--target wgsl {flags} --points 500 --json -"),
        );
        passes(ran, "wgsl/materials/gold.wgsl", None);
    }
}

#[test]
fn a_changed_interface_of_a_module_is_seen() {
    let place = Place::new();
    place.done(&format!("--target spirv {LIBRARY}"));
    let file = place.path(&format!("{OUT}/spirv/fresnel_schlick.comp.spv"));
    let bytes = fs::read(&file).unwrap();
    let mut words: Vec<u32> = bytes
        .chunks(4)
        .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
        .collect();
    // OpDecorate (71) of a Binding (33): 4 words, the last is its number.
    let at = (5..words.len()).find(|at| words[*at] == (4 << 16 | 71) && words[at + 2] == 33);
    words[at.unwrap() + 3] += 5;
    let changed: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    fs::write(&file, changed).unwrap();
    let ran = verify(&place, &format!("--target spirv {LIBRARY} --points 500"));
    fails(ran, &["spirv/fresnel_schlick.comp.spv", "binding"]);
}

/// Of modules only those of compute shaders are run: a fragment module that is not today's fails, also one that the manifest lists.
#[test]
fn a_swapped_fragment_module_is_seen() {
    let place = Place::new();
    let line = "--target spirv --material gold,platinum --method conductor_exact";
    place.done(line);
    let file = |name: &str| place.path(&format!("{OUT}/spirv/materials/{name}.frag.spv"));
    let hash = |name: &str| sha256(&fs::read(file(name)).unwrap());
    let [gold, platinum] = ["gold", "platinum"].map(hash);
    fs::copy(file("platinum"), file("gold")).unwrap();
    let manifest = format!("{OUT}/manifest.json");
    let listed = place.read(&manifest).replace(&gold, &platinum);
    for is_listed in [false, true] {
        if is_listed {
            place.put(&manifest, &listed);
        }
        let ran = verify(&place, &format!("{line} --points 500 --json -"));
        fails(
            ran,
            &["spirv/materials/gold.frag.spv: it is not what would be written today"],
        );
    }
}

/// Words that state something false: terms, labels, a bound that nobody gives, fewer bits.
#[test]
fn false_words_are_seen() {
    let both = [
        ("Licence CC0-1.0", "Licence GPL-3.0", "GPL-3.0"),
        ("clamped to [0, 1]", "not clamped", "not clamped"),
        ("gold: Gold,", "gold: Silver,", "gold: Silver"),
        (
            "fresnel_gold: the exact law",
            "fresnel_gold: Schlick's law",
            "fresnel_gold: Schlick's law",
        ),
        ("// n^2 - k^2 - 1", "// n^2 + k^2 - 1", "n^2 + k^2"),
        (
            "\n// gold",
            "\n// Max error 1e-9\n// gold",
            "Max error 1e-9",
        ),
        ("highp float c = ", "mediump float c = ", "`mediump`"),
    ];
    let short = [("Source: Glassner", "Source: Nobody", "Nobody")];
    let full = [("red as its curve", "blue as its curve", "blue as its curve")];
    let line = format!("--target gles {GOLD}");
    for (flags, own) in [
        (line.clone(), short),
        (format!("{line} --header full"), full),
    ] {
        all_are_seen(
            &flags,
            "gles/materials/gold.glsl",
            &[&both[..], &own].concat(),
        );
    }
}

/// A file is held against what it should hold: one with fewer functions than the usual, by --method or a budget, with its
/// manifest and without.
#[test]
fn a_file_of_few_methods_is_held_against_these() {
    for made in [
        "--method schlick",
        "--method fitted_rational,schlick",
        "--budget 20",
    ] {
        let place = Place::new();
        place.done(&format!("--target gles,spirv --material gold {made}"));
        for manifest in [true, false] {
            if !manifest {
                fs::remove_file(place.path(&format!("{OUT}/manifest.json"))).unwrap();
            }
            let line = "--target gles,spirv --material gold --points 500 --json -";
            passes(verify(&place, line), "gles/materials/gold.glsl", None);
            passes(verify(&place, line), "spirv/materials/gold.comp.spv", None);
            let ran = verify(&place, &format!("{line} --method conductor_exact"));
            let lacks = "it lacks fresnel_gold, so that what would be written today was run";
            passes(ran, "gles/materials/gold.glsl", Some(lacks));
        }
    }
}

/// What a run was told beside its names is told to `verify` too; without it the numbers differ.
#[test]
fn another_matching_angle_is_told() {
    let place = Place::new();
    let flags = "--target gles --material gold --method schlick_corrected --matching-angle 80";
    place.done(flags);
    let ran = verify(&place, &format!("{flags} --points 500 --json -"));
    passes(ran, "gles/materials/gold.glsl", None);
}

#[test]
fn a_file_that_is_listed_twice_is_seen() {
    let place = Place::new();
    place.done(&format!("--target wgsl {LIBRARY}"));
    let mut manifest = place.manifest();
    let files = manifest["files"].as_array_mut().unwrap();
    files.push(files[0].clone());
    let path = place.path(&format!("{OUT}/manifest.json"));
    fs::write(path, manifest.to_string()).unwrap();
    let ran = verify(&place, &format!("--target wgsl {LIBRARY} --points 500"));
    fails(ran, &["it lists wgsl/fresnel_schlick.wgsl 2 times"]);
}

/// A method that nobody put into a file is no fault of the file; a listed file that is gone is one.
#[test]
fn what_was_not_asked_for_is_not_missing() {
    let place = Place::new();
    place.done("--target wgsl --material gold --method conductor_exact");
    let line = "--target wgsl --material gold --method schlick --points 500 --json -";
    let Some(ran) = verify(&place, line) else {
        return;
    };
    ran.ends(0);
    fs::remove_file(place.path(&format!("{OUT}/wgsl/materials/gold.wgsl"))).unwrap();
    fails(
        verify(&place, line),
        &["wgsl/materials/gold.wgsl: it is not there, and manifest.json lists it"],
    );
    let nowhere = format!("{line} --out-dir nowhere");
    let Some(ran) = verify(&place, &nowhere) else {
        return;
    };
    assert!(ran.ends(0).err.contains("there is no folder nowhere"));
}

/// A loop or a function in a comment is none; a report takes the place of no file of the tree.
#[test]
fn comments_are_no_code_and_reports_replace_no_shader() {
    let comment = |text: &str| format!("{text}/* for a fn fresnel_other() {{}} */\n// while\n");
    let file = "wgsl/fresnel_schlick.wgsl";
    let ran = edited(&format!("--target wgsl {LIBRARY}"), file, comment);
    passes(
        ran,
        file,
        Some("not what would be written today: its comments differ, first in line "),
    );
    let place = Place::new();
    place.done(&format!("--target wgsl {LIBRARY}"));
    for taken in [file, "manifest.json"] {
        place.refused(
            &format!("verify --target wgsl {LIBRARY} --points 100 --json {OUT}/{taken}"),
            &[taken, "a file of the generated tree lies there"],
        );
    }
}
