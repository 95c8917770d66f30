//! The CMake build of `docs/builds.md`, by both generators: a second build does nothing, and a changed material is seen.

use std::env;
use std::path::Path;
use std::process::Command;

use super::{PROGRAM, Place};
use crate::compilers::Tool;

const TOOLS: [Tool; 3] = [
    Tool {
        command: "cmake",
        package: "cmake",
    },
    Tool {
        command: "ninja",
        package: "ninja-build",
    },
    Tool {
        command: "make",
        package: "make",
    },
];

/// What a build prints.
fn build(place: &Place, arguments: &[&str]) -> String {
    let program = Path::new(PROGRAM).parent().expect("a folder").to_owned();
    let path = env::var_os("PATH").unwrap_or_default();
    let places = [program].into_iter().chain(env::split_paths(&path));
    let output = Command::new("cmake")
        .args(arguments)
        .current_dir(place.path(""))
        .env("PATH", env::join_paths(places).expect("plain names"))
        .output()
        .expect("cmake is here");
    assert!(output.status.success(), "{output:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn the_documents_build_runs_once() {
    if !TOOLS
        .iter()
        .all(|tool| tool.is_here("the CMake build of docs/builds.md"))
    {
        return;
    }
    let page = include_str!("../../../docs/builds.md");
    let example = page.split("```cmake\n").nth(1).expect("an example");
    let (example, _) = example.split_once("```").expect("it ends");
    for generator in ["Ninja", "Unix Makefiles"] {
        let place = Place::new();
        place.put("gold.csv", "nm,n,k\n380,1.4,1.7\n580,.3,2.8\n780,.2,3.9\n");
        let import = "materials import gold.csv --name my_gold -o my_gold.toml";
        place.done(import);
        let head = "cmake_minimum_required(VERSION 3.20)\nproject(example NONE)\n";
        place.put("CMakeLists.txt", &(head.to_owned() + example));
        build(&place, &["-G", generator, "-S", ".", "-B", "b"]);
        let generates = || build(&place, &["--build", "b"]).contains("Generating");
        assert!(generates(), "{generator}: the first build");
        assert!(!generates(), "{generator}: a second build");
        let first = place.read("b/my_gold.glsl");
        place.put("gold.csv", "nm,n,k\n380,1.4,1.7\n580,.4,2.8\n780,.2,3.9\n");
        place.done(import);
        assert!(generates(), "{generator}: the material is another");
        assert_ne!(place.read("b/my_gold.glsl"), first);
        assert!(!generates(), "{generator}: a build after that");
    }
}
