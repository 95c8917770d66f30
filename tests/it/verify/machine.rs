//! What the machine lacks is not checked, ends with 3, and is told with what to install or to set.

use std::process::Command;

use super::command::rows;
use super::tools::put_compiler;
use crate::cli::{PROGRAM, Place, Ran};
use crate::not_checked;

/// Runs the program with these variables.
fn run(place: &Place, line: &str, variables: &[(&str, &str)]) -> Ran {
    let words: Vec<&str> = line.split_whitespace().collect();
    let output = place
        .command(&words)
        .envs(variables.iter().copied())
        .output();
    Ran::new(line.to_owned(), output.unwrap())
}

const NO_VULKAN: [(&str, &str); 2] = [
    ("VK_DRIVER_FILES", "/nothing"),
    ("VK_ICD_FILENAMES", "/nothing"),
];

#[test]
fn without_a_vulkan_driver_nothing_else_stands_in() {
    let place = Place::new();
    for target in ["spirv", "hlsl", "wgsl"] {
        let line = format!(
            "verify --target {target} --method schlick --material none --points 500 --json -"
        );
        let ran = run(&place, &line, &NO_VULKAN).ends(3);
        for says in ["not checked", "mesa-vulkan-drivers", "VK_DRIVER_FILES"] {
            assert!(ran.err.contains(says), "{says} is not in {}", ran.err);
        }
        assert!(!ran.err.contains("passthrough"), "{}", ran.err);
        for row in rows(&ran) {
            assert_eq!(row["status"], "not_checked", "{row}");
        }
    }
    place.put("f.wgsl", "fn f(c: f32) -> f32 { return c; }");
    let ran = run(
        &place,
        "audit f.wgsl --material gold --gpu none",
        &NO_VULKAN,
    )
    .ends(3);
    assert!(ran.err.contains("mesa-vulkan-drivers"), "{}", ran.err);
}

#[test]
fn opengl_that_is_asked_for_runs_wgsl_and_no_spirv() {
    let place = Place::new();
    let line = "verify --backend gl --target wgsl,spirv --method schlick --material none --points 500 --json -";
    let ran = run(&place, line, &[]).ends(3);
    let rows = rows(&ran);
    let of = |target: &str| {
        rows.iter()
            .filter(|row| row["target"] == target)
            .collect::<Vec<_>>()
    };
    for row in of("spirv") {
        assert_eq!(row["status"], "not_checked", "{row}");
    }
    if of("wgsl").iter().all(|row| row["status"] == "not_checked") {
        return not_checked(&format!("WGSL on OpenGL: {}", ran.err));
    }
    for row in of("wgsl") {
        assert_eq!(row["status"], "pass", "{row}");
    }
}

const ALL: [&str; 4] = [
    "verify --target glsl --method schlick --material none",
    "cost --gpu rdna2 --method schlick --material none",
    "time --method schlick --material none --rounds 1",
    "audit f.glsl --material gold --gpu none",
];

fn place() -> Place {
    let place = Place::new();
    place.put("f.glsl", "float f(float c) { return c; }\n");
    place
}

#[test]
fn a_temporary_folder_that_is_not_there_is_named() {
    let place = place();
    let before = place.files();
    for line in ALL {
        let variables = ["TMPDIR", "TMP", "TEMP"].map(|name| (name, "/no/such/folder"));
        let ran = run(&place, line, &variables).ends(3);
        for says in ["not checked", "TMP", "/no/such/folder"] {
            assert!(ran.err.contains(says), "{says} is not in {}", ran.err);
        }
        assert!(before == place.files());
    }
}

/// A program that may write files of so many blocks only; else it is as on a disk that is full.
fn run_within(place: &Place, blocks: usize, line: &str) -> Ran {
    let script = format!("trap '' XFSZ; ulimit -f {blocks} && exec '{PROGRAM}' {line}");
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(place.path(""))
        .output();
    Ran::new(script, output.unwrap())
}

#[test]
fn a_temporary_folder_without_room_is_named() {
    let place = place();
    for line in ALL {
        let ran = run_within(&place, 0, line).ends(3);
        for says in ["not checked", "TMPDIR", "make room"] {
            assert!(ran.err.contains(says), "{says} is not in {}", ran.err);
        }
    }
}

/// The room ends in the midst of a run: a compiler that is here is not said to be missing, nor to refuse anything.
#[test]
fn a_compiler_whose_files_find_no_room_was_not_asked() {
    let place = place();
    put_compiler(&place, "bin/glslangValidator", "exit 0");
    let line = "verify --target glsl --method conductor_exact --material none --points 100";
    let path = format!("PATH='{}':$PATH; ", place.path("bin").display());
    let script = format!("{path} trap '' XFSZ; ulimit -f 1 && exec '{PROGRAM}' {line}");
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(place.path(""))
        .output();
    let ran = Ran::new(script, output.unwrap()).ends(3);
    assert!(ran.err.contains("glslang was not asked"), "{}", ran.err);
    assert!(ran.err.contains("TMPDIR"), "{}", ran.err);
    assert!(!ran.err.contains("not here"), "{}", ran.err);
}
