//! The examples of `tests/pipelines`, by the build systems that they are for: a second build does nothing, a file that was
//! touched takes its own output alone, and a table of light takes all. `tests/run` builds the one for Cargo.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use super::PROGRAM;
use super::Place;
use super::Ran;
use crate::compilers::Tool;
use crate::tree::Snapshot;

const CMAKE: Tool = Tool {
    command: "cmake",
    package: "cmake",
};
const MAKE: Tool = Tool {
    command: "make",
    package: "make",
};
const NINJA: Tool = Tool {
    command: "ninja",
    package: "ninja-build",
};
const NPM: Tool = Tool {
    command: "npm",
    package: "npm",
};

/// The materials of the examples.
const MATERIALS: [&str; 2] = ["my_gold", "my_silver"];

/// An example in a temporary folder, beside its materials.
struct Pipeline {
    place: Place,
    folder: &'static str,
}

impl Pipeline {
    /// A copy of the example, where the tools are there.
    #[track_caller]
    fn new(folder: &'static str, tools: &[Tool]) -> Option<Pipeline> {
        let what = format!("the build of tests/pipelines/{folder}");
        if !tools.iter().all(|tool| tool.is_here(&what)) {
            return None;
        }
        let place = Place::new();
        for part in ["materials", folder] {
            for file in files_of(&examples().join(part)) {
                let name = file.file_name().expect("a file").to_string_lossy();
                place.put(&format!("{part}/{name}"), fs::read(&file).unwrap());
            }
        }
        Some(Pipeline { place, folder })
    }

    /// Runs a command in the example's folder, with this program on PATH; the line's words are its arguments.
    #[track_caller]
    fn run(&self, line: &str) -> Ran {
        self.run_with(&line.split(' ').collect::<Vec<_>>())
    }

    #[track_caller]
    fn run_with(&self, words: &[&str]) -> Ran {
        let output = Command::new(words[0])
            .args(&words[1..])
            .current_dir(self.place.path(self.folder))
            .env("PATH", path_with_program())
            .output()
            .expect("the tool is here");
        Ran::new(words.join(" "), output).ends(0)
    }

    /// The materials that a build generates from: its commands name them.
    #[track_caller]
    fn generated(&self, build: &str) -> BTreeSet<&'static str> {
        let ran = self.run(build);
        let commands = ran.out.lines().filter(|line| line.contains("--material "));
        let named = |line: &str| {
            MATERIALS
                .into_iter()
                .filter(|name| line.contains(*name))
                .collect::<Vec<_>>()
        };
        commands.flat_map(named).collect()
    }

    /// Writes a file anew, with the same text.
    fn touch(&self, file: &str) {
        let text = self.place.read(file);
        self.place.put(file, text);
    }

    /// Puts another number into a file.
    fn change(&self, file: &str, old: &str, new: &str) {
        let text = self.place.read(file);
        assert!(text.contains(old), "{text}");
        self.place.put(file, text.replace(old, new));
    }

    /// What was generated, with times.
    fn shaders(&self) -> Snapshot {
        let is_shader = |path: &str| {
            [".glsl", ".hlsl", ".wgsl"]
                .iter()
                .any(|end| path.ends_with(end))
        };
        let files = self.place.files().into_iter();
        files.filter(|(path, _)| is_shader(path)).collect()
    }
}

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pipelines")
}

/// The files of a folder, without those of folders in it.
fn files_of(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let entries = fs::read_dir(folder)
        .expect("a folder of the repository")
        .flatten();
    entries
        .map(|entry| entry.path())
        .filter(|path| path.is_file())
}

pub fn path_with_program() -> OsString {
    let program = Path::new(PROGRAM).parent().expect("a folder").to_owned();
    let path = env::var_os("PATH").unwrap_or_default();
    let places = [program].into_iter().chain(env::split_paths(&path));
    env::join_paths(places).expect("plain names")
}

/// A build with a file for each material: what runs after which change.
#[track_caller]
fn check(pipeline: &Pipeline, build: &str, is_idle: &dyn Fn(&Pipeline) -> bool) {
    let (all, none) = (BTreeSet::from(MATERIALS), BTreeSet::new());
    let gold = BTreeSet::from(["my_gold"]);
    let builds = |expected: &BTreeSet<&str>, when: &str| {
        assert_eq!(&pipeline.generated(build), expected, "{build}: {when}");
        let before = pipeline.shaders();
        assert_eq!(
            pipeline.generated(build),
            none,
            "{build}: {when}, and nothing after that"
        );
        assert!(
            pipeline.shaders() == before,
            "{build}: {when}, and times stay after that"
        );
        assert!(is_idle(pipeline), "{build}: {when}, and it is done");
    };
    builds(&all, "the first build");
    pipeline.touch("materials/my_gold.toml");
    builds(&gold, "a material was touched");
    let text = |name: &str| {
        pipeline
            .place
            .read(&format!("{}/build/{name}.glsl", pipeline.folder))
    };
    let before = MATERIALS.map(text);
    pipeline.change("materials/my_gold.toml", "0.3", "0.4");
    builds(&gold, "a material is another");
    let after = MATERIALS.map(text);
    assert_ne!(after[0], before[0], "{build}");
    assert_eq!(after[1], before[1], "{build}");
    pipeline.touch("materials/lamp.csv");
    builds(&all, "the lamp was touched, which the depfile alone names");
}

#[test]
fn make_builds_what_changed() {
    if let Some(pipeline) = Pipeline::new("make", &[MAKE]) {
        check(&pipeline, "make", &|it| it.run("make -q").out.is_empty());
    }
}

#[test]
fn ninja_builds_what_changed() {
    let Some(pipeline) = Pipeline::new("ninja", &[NINJA]) else {
        return;
    };
    let of_materials = "ninja -v build/my_gold.glsl build/my_silver.glsl";
    let is_idle = |line: &'static str| {
        move |it: &Pipeline| {
            let ran = it.run(&format!("{line} -d explain"));
            ran.out.contains("no work to do") && !ran.err.contains("explain: ")
        }
    };
    check(&pipeline, of_materials, &is_idle(of_materials));
    let folder = "ninja -v build/all.stamp";
    let is_idle = is_idle(folder);
    for file in [None, Some("materials/my_silver.toml")] {
        file.into_iter().for_each(|file| pipeline.touch(file));
        let generated = pipeline.generated(folder);
        assert_eq!(generated, BTreeSet::from(MATERIALS), "{file:?}");
        assert!(is_idle(&pipeline), "{file:?}");
    }
    // A run over a whole folder writes only what differs.
    let file = |name: &str| format!("ninja/build/all/hlsl/materials/{name}.hlsl");
    let shaders = || MATERIALS.map(|name| pipeline.shaders()[&file(name)].clone());
    let before = shaders();
    pipeline.change("materials/my_silver.toml", "0.13", "0.14");
    pipeline.run(folder);
    let after = shaders();
    assert!(after[0] == before[0], "the other material's file stays");
    assert!(after[1] != before[1]);
    assert!(is_idle(&pipeline));
}

#[test]
fn cmake_builds_what_changed() {
    for (generator, tool) in [("Ninja", NINJA), ("Unix Makefiles", MAKE)] {
        let Some(pipeline) = Pipeline::new("cmake", &[CMAKE, tool]) else {
            continue;
        };
        pipeline.run_with(&["cmake", "-G", generator, "-S", ".", "-B", "build"]);
        check(&pipeline, "cmake --build build --verbose", &|_| true);
    }
}

/// The recipe below a folder whose name a list of materials might split, and a shell.
#[test]
fn cmake_builds_below_a_folder_with_a_comma() {
    const FOLDER: &str = "a, b";
    let Some(pipeline) = Pipeline::new("cmake", &[CMAKE, NINJA]) else {
        return;
    };
    let place = Place::new();
    for (path, (bytes, _)) in pipeline.place.files() {
        place.put(&format!("{FOLDER}/{path}"), bytes);
    }
    let moved = Pipeline {
        place,
        folder: "a, b/cmake",
    };
    moved.run_with(&["cmake", "-G", "Ninja", "-S", ".", "-B", "build"]);
    moved.run("cmake --build build");
    assert_eq!(moved.shaders().len(), MATERIALS.len());
}

/// Its scripts always run, and write only what differs.
#[test]
fn npm_writes_what_changed() {
    let Some(pipeline) = Pipeline::new("npm", &[NPM]) else {
        return;
    };
    pipeline.run("npm run build");
    let first = pipeline.shaders();
    assert!(first.len() > MATERIALS.len());
    pipeline.run("npm test");
    pipeline.touch("materials/my_gold.toml");
    pipeline.run("npm run build");
    assert!(pipeline.shaders() == first, "nothing changed");
    pipeline.change("materials/my_gold.toml", "0.3", "0.4");
    pipeline.run("npm run build");
    let second = pipeline.shaders();
    let changed = first
        .iter()
        .zip(&second)
        .filter(|(one, other)| one != other);
    let changed: Vec<&str> = changed.map(|((path, _), _)| path.as_str()).collect();
    assert_eq!(changed, ["npm/build/shaders/wgsl/materials/my_gold.wgsl"]);
    let bundle = pipeline.place.read("npm/build/shaders.js");
    assert!(bundle.contains("fn fresnel_my_silver_fitted("), "{bundle}");
}
