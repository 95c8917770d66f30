//! What is handed out: the package of the crate, and the archives of `tests/release`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[track_caller]
fn run(command: &mut Command) -> String {
    let output: Output = command.current_dir(root()).output().expect("it runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(
        output.status.success(),
        "{command:?}: {}",
        text(&output.stderr)
    );
    text(&output.stdout)
}

fn release(arguments: &[&str]) -> String {
    run(Command::new("bash").arg("tests/release").args(arguments))
}

/// The files of the package.
fn packaged() -> BTreeSet<String> {
    let list = [
        "package",
        "--list",
        "--allow-dirty",
        "--locked",
        "--offline",
    ];
    let list = run(Command::new(env!("CARGO")).args(list));
    list.lines().map(|line| line.replace('\\', "/")).collect()
}

/// The files outside of it that a source file embeds, by their path in the repository.
fn embedded(file: &str, text: &str) -> Vec<String> {
    let folder = Path::new(file).parent().expect("a folder");
    let mut found = Vec::new();
    for macro_name in ["include_str!(", "include_bytes!(", "include_dir!("] {
        for rest in text.split(macro_name).skip(1) {
            let Some(path) = rest.trim_start().strip_prefix('"') else {
                continue;
            };
            let path = path.split('"').next().unwrap_or_default();
            let path = match path.strip_prefix("$CARGO_MANIFEST_DIR/") {
                Some(path) => PathBuf::from(path),
                None => folder.join(path),
            };
            found.push(without_dots(&path));
        }
    }
    found
}

fn without_dots(path: &Path) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.to_str().expect("UTF-8").split('/') {
        match part {
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// All that the program is built from and no more: sources, what they embed, and pages for people.
#[test]
fn the_package_holds_what_it_is_built_from() {
    let files = packaged();
    let sources = files.iter().filter(|file| file.ends_with(".rs"));
    let read = |file: &String| embedded(file, &fs::read_to_string(root().join(file)).unwrap());
    let embedded: BTreeSet<String> = sources.flat_map(read).collect();
    assert!(embedded.len() > 30, "{embedded:?}");
    for path in &embedded {
        let below = format!("{path}/");
        let is_there = |file: &String| file == path || file.starts_with(&below);
        assert!(files.iter().any(is_there), "the package lacks {path}");
    }
    for file in &files {
        let is_embedded = embedded.iter().any(|path| {
            let below = format!("{path}/");
            file == path || file.starts_with(&below)
        });
        let is_source = file.starts_with("src/");
        // Licences of data stand beside them.
        let is_beside = file.starts_with("data/fonts/") || file.starts_with("data/spectra/");
        let is_page =
            file.starts_with("docs/") && (file.ends_with(".md") || file.ends_with(".svg"));
        let is_of_crate = [
            ".cargo_vcs_info.json",
            "ARCHITECTURE.md",
            "CHANGELOG.md",
            "Cargo.lock",
            "Cargo.toml",
            "Cargo.toml.orig",
            "LICENSE-APACHE",
            "LICENSE-MIT",
            "README.md",
        ]
        .contains(&file.as_str());
        assert!(
            is_embedded || is_source || is_beside || is_page || is_of_crate,
            "the package need not hold {file}: see `include` in Cargo.toml"
        );
    }
    let size = |file: &String| fs::metadata(root().join(file)).map_or(0, |found| found.len());
    let whole: u64 = files.iter().map(size).sum();
    assert!(whole < 8_000_000, "{whole} bytes");
}

/// What a program on this machine is linked from, by cargo's metadata: name and version.
fn linked() -> BTreeSet<String> {
    let host = run(Command::new("rustc").arg("-vV"));
    let host = host
        .lines()
        .find_map(|line| line.strip_prefix("host: "))
        .expect("a host");
    let arguments = [
        "metadata",
        "--locked",
        "--format-version",
        "1",
        "--filter-platform",
        host,
    ];
    let metadata: serde_json::Value =
        serde_json::from_str(&run(Command::new(env!("CARGO")).args(arguments))).unwrap();
    let nodes = metadata["resolve"]["nodes"].as_array().unwrap();
    let mut waiting = vec![&metadata["resolve"]["root"]];
    let mut reached = BTreeSet::new();
    while let Some(id) = waiting.pop() {
        if !reached.insert(id.as_str().unwrap()) {
            continue;
        }
        let node = nodes.iter().find(|node| &node["id"] == id).unwrap();
        for dependency in node["deps"].as_array().unwrap() {
            let kinds = dependency["dep_kinds"].as_array().unwrap();
            if kinds.iter().any(|kind| kind["kind"].is_null()) {
                waiting.push(&dependency["pkg"]);
            }
        }
    }
    let packages = metadata["packages"].as_array().unwrap().iter();
    let packages = packages.filter(|one| reached.contains(one["id"].as_str().unwrap()));
    let named = packages.map(|one| {
        let text = |key: &str| one[key].as_str().unwrap();
        format!("{}-{}", text("name"), text("version"))
    });
    named
        .filter(|name| !name.starts_with("fresnel-gen-"))
        .collect()
}

/// The licence of each dependency stands in the archive, and so do those of the data.
#[test]
fn every_dependency_brings_its_licence_text() {
    let folder = TempDir::new().unwrap();
    let to = folder.path().join("licences");
    release(&["licences", to.to_str().unwrap()]);
    let linked = linked();
    assert!(linked.len() > 100, "{} packages", linked.len());
    let others = ["rust", "spectra", "fonts"].map(str::to_owned);
    let expected: BTreeSet<String> = linked.into_iter().chain(others).collect();
    let found = fs::read_dir(&to).unwrap().flatten();
    let found: BTreeSet<String> = found
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    // Cargo's metadata unites features with those that only tests' dependencies ask for, so that it may name more.
    let lacking: Vec<&String> = expected.difference(&found).collect();
    let tree = run(Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--edges", "normal", "--prefix", "none"]));
    for name in lacking {
        let (package, version) = name.rsplit_once('-').unwrap();
        assert!(
            !tree.contains(&format!("{package} v{version}")),
            "{name} has no licence in the archive"
        );
    }
    assert!(found.is_subset(&expected), "{found:?}");
    for name in &found {
        let files = fs::read_dir(to.join(name)).unwrap().flatten();
        let texts = files.filter(|file| file.file_name() != "SPDX");
        let longest = texts.map(|file| file.metadata().unwrap().len()).max();
        assert!(longest > Some(400), "{name} has no text of its licence");
    }
}

#[test]
fn one_program_gives_one_archive() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    fs::write(at("program"), "a program").unwrap();
    for to in ["one", "other"] {
        release(&["pack", &at("program"), "fresnel-gen-0-here", &at(to)]);
    }
    let archive = |to: &str| fs::read(format!("{}/fresnel-gen-0-here.tar.gz", at(to))).unwrap();
    assert!(archive("one") == archive("other"), "the archives differ");
    let list =
        run(Command::new("tar")
            .args(["-tvzf", &format!("{}/fresnel-gen-0-here.tar.gz", at("one"))]));
    for name in [
        "fresnel-gen",
        "README.md",
        "CHANGELOG.md",
        "LICENSE-MIT",
        "LICENSE-APACHE",
        "licences/clap-",
    ] {
        assert!(
            list.contains(&format!(" fresnel-gen-0-here/{name}")),
            "{name}: {list}"
        );
    }
    let program = list
        .lines()
        .find(|line| line.ends_with("/fresnel-gen"))
        .expect("it is there");
    assert!(program.starts_with("-rwxr-xr-x 0/0 "), "{program}");
    assert!(
        list.lines().all(|line| line.contains(" 1970-01-01 ")),
        "{list}"
    );
}
