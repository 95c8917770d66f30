//! Compilers are found in the folder that the user names, by PATH, and beside the program; never below the current folder.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::cli::{PROGRAM, Place, Ran};

/// Puts a compiler that accepts all there is, and leaves a word that it was asked.
pub fn put_compiler(place: &Place, name: &str, script: &str) {
    place.put(name, format!("#!/bin/sh\n{script}\n"));
    fs::set_permissions(place.path(name), fs::Permissions::from_mode(0o755)).unwrap();
}

/// A compiler whose word stands in the file of this name.
fn put(place: &Place, folder: &str, word: &Path) {
    for name in ["glslangValidator", "dxc"] {
        put_compiler(
            place,
            &format!("{folder}/{name}"),
            &format!("echo asked > '{}'", word.display()),
        );
    }
}

/// The program elsewhere: a link would lead back to where it was built.
pub fn copied(place: &Place) -> PathBuf {
    fs::create_dir_all(place.path("elsewhere")).unwrap();
    let copy = place.path("elsewhere/fresnel-gen");
    fs::copy(PROGRAM, &copy).unwrap();
    copy
}

const LINE: [&str; 8] = [
    "verify",
    "--target",
    "glsl,hlsl",
    "--method",
    "schlick",
    "--material",
    "none",
    "--points=100",
];

fn run(place: &Place, program: &Path, path: &str, more: &[&str]) -> Ran {
    let output = Command::new(program)
        .args(LINE)
        .args(more)
        .env("PATH", path)
        .current_dir(place.path(""))
        .output();
    Ran::new(format!("{} {more:?}", program.display()), output.unwrap())
}

#[test]
fn a_copy_of_the_program_runs_nothing_of_the_build_tree_nor_of_the_current_folder() {
    let place = Place::new();
    let word = place.path("word");
    for folder in ["", "tools", "target/tools", "bin"] {
        put(&place, &format!("./{folder}"), &word);
    }
    let copy = copied(&place);
    let ran = run(&place, &copy, ".::bin:tools:/nothing", &[]).ends(3);
    assert!(!word.exists(), "{ran:?}");
    for name in ["glslang", "dxc"] {
        assert!(
            ran.err.contains(&format!("no {name} here")),
            "{name}: {ran:?}"
        );
    }
    let built = concat!(env!("CARGO_MANIFEST_DIR"), "/target/tools");
    let bytes = fs::read(PROGRAM).unwrap();
    let holds = |text: &str| {
        bytes
            .windows(text.len())
            .any(|some| some == text.as_bytes())
    };
    assert!(holds("glslangValidator") && !holds(built), "{built}");
}

#[test]
fn the_folder_that_is_named_comes_before_the_path_and_that_beside_the_program_after_it() {
    let place = Place::new();
    let copy = copied(&place);
    let words = ["named", "path", "beside"].map(|word| place.path(&format!("{word}.word")));
    put(&place, "mine", &words[0]);
    put(&place, "bin", &words[1]);
    put(&place, "elsewhere/tools", &words[2]);
    let path = place.path("bin").display().to_string();
    let asked = |path: &str, more: &[&str]| {
        // These compilers make nothing that could be run: who was asked is all that counts.
        run(&place, &copy, path, more);
        words.each_ref().map(|word| fs::remove_file(word).is_ok())
    };
    assert_eq!(asked("/nothing", &[]), [false, false, true]);
    assert_eq!(asked(&path, &[]), [false, true, false]);
    assert_eq!(asked(&path, &["--tools", "mine"]), [true, false, false]);
    let ran = run(&place, &copy, &path, &["--tools", "yours"]).ends(2);
    assert!(
        ran.err.contains("--tools yours: this is no folder"),
        "{ran:?}"
    );
}
