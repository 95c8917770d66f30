//! Is the house in order? Headers, rooms, lists, lengths, names, tables in README. Compares; `BLESS=1` rewrites lists.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use fresnel_gen::language::methods;
use fresnel_gen::language::targets;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All Rust files below a folder, with their text, sorted.
fn sources(folder: &str) -> BTreeMap<PathBuf, String> {
    fn visit(folder: &Path, found: &mut BTreeMap<PathBuf, String>) {
        for entry in fs::read_dir(folder).expect("a folder of the repository") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                visit(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.insert(path.clone(), fs::read_to_string(&path).expect("UTF-8"));
            }
        }
    }
    let mut found = BTreeMap::new();
    visit(&root().join(folder), &mut found);
    found
}

fn before_tests(text: &str) -> &str {
    text.split("\n#[cfg(test)]\nmod tests")
        .next()
        .unwrap_or(text)
}

#[test]
fn every_file_says_what_it_holds() {
    for folder in ["src", "tests", "benches"] {
        for (path, text) in sources(folder) {
            assert!(
                text.starts_with("//! "),
                "{} begins without a `//!` header",
                path.display()
            );
        }
    }
}

#[test]
fn files_are_short_and_named_by_an_idea() {
    for (path, text) in sources("src") {
        let lines = before_tests(&text).lines().count();
        assert!(
            lines <= 800,
            "{} has {lines} lines before its tests: split it by what it does",
            path.display()
        );
        let stem = path
            .file_stem()
            .and_then(|stem| stem.to_str())
            .unwrap_or("");
        for nothing in [
            "util", "utils", "helper", "helpers", "common", "misc", "manager",
        ] {
            assert_ne!(stem, nothing, "{}: named after nothing", path.display());
        }
    }
}

/// `display()` gives a path as it is, with the controls and line breaks of its name: `foreign::path` puts it into a message.
#[test]
fn a_path_is_put_into_a_message_by_one_function() {
    for (path, text) in sources("src") {
        let text = before_tests(&text).replace(char::is_whitespace, "");
        for (at, _) in text.match_indices(".display()") {
            let after = &text[at + ".display()".len()..];
            assert!(
                after.starts_with(".to_string()"),
                "{}: a path is put into a message by foreign::path",
                path.display()
            );
        }
    }
}

/// The length of each function in lines, by a count of braces at the indentation of `fn`.
fn function_lengths(text: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = before_tests(text).lines().collect();
    let mut lengths = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let bare = line.trim_start();
        let is_function = [
            "fn ",
            "pub fn ",
            "pub(super) fn ",
            "pub(crate) fn ",
            "const fn ",
            "pub const fn ",
        ]
        .iter()
        .any(|head| bare.starts_with(head));
        let indent = line.len() - bare.len();
        let closes = |line: &&str| **line == format!("{}}}", " ".repeat(indent));
        // A function of a shader, in a text that is filled in.
        let is_text = bare.starts_with("fn {");
        if is_function && !is_text && !line.ends_with(';') {
            let length = lines[start..]
                .iter()
                .position(closes)
                .map_or(1, |end| end + 1);
            lengths.push((bare.to_owned(), length));
        }
    }
    lengths
}

#[test]
fn functions_are_short() {
    let mut lengths = Vec::new();
    for (path, text) in sources("src") {
        for (head, length) in function_lengths(&text) {
            assert!(
                length <= 120,
                "{}: `{head}` has {length} lines",
                path.display()
            );
            lengths.push(length);
        }
    }
    lengths.sort_unstable();
    let median = lengths[lengths.len() / 2];
    assert!(median <= 20, "the median function has {median} lines");
}

/// The wings in the order of imports, as `lib.rs` has them.
fn wings() -> Vec<String> {
    let text = fs::read_to_string(root().join("src/lib.rs")).expect("it is there");
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("// Wings: "));
    let line = line.expect("src/lib.rs says the order of wings");
    line.split(" < ").map(str::to_owned).collect()
}

/// The rooms of a wing in the order of imports, as its `mod.rs` says: groups that do not import each other. The commands are one
/// room, whose files have no order.
fn rooms(wing: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(root().join(format!("src/{wing}/mod.rs"))).expect("a wing");
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("// Rooms: "));
    let Some(line) = line else {
        assert_eq!(wing, "cli", "src/{wing}/mod.rs says the order of its rooms");
        return Vec::new();
    };
    let group = |group: &str| {
        group
            .split(',')
            .map(|room| room.trim().to_owned())
            .collect()
    };
    line.split('<').map(group).collect()
}

/// What a text imports, as wing and room: every `crate::wing::room`, in groups over several lines too, comments left out.
fn imports(text: &str) -> Vec<(String, String)> {
    let code: String = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""))
        .collect::<Vec<_>>()
        .join(" ");
    let word = |text: &str| -> String {
        let letters = text.trim_start().chars();
        letters
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect()
    };
    let mut found = Vec::new();
    for rest in code.split("crate::").skip(1) {
        let wing = word(rest);
        let Some(inside) = rest.trim_start()[wing.len()..].strip_prefix("::") else {
            continue;
        };
        let group = inside
            .strip_prefix('{')
            .and_then(|inside| inside.split('}').next());
        let named = group.map_or_else(|| vec![inside], |group| group.split(',').collect());
        found.extend(named.into_iter().map(|name| (wing.clone(), word(name))));
    }
    found
}

#[test]
fn imports_run_one_way() {
    let wings = wings();
    let wing_rank = |name: &str| wings.iter().position(|wing| wing == name);
    for wing in &wings {
        let rooms = rooms(wing);
        let rank = |room: &str| {
            rooms
                .iter()
                .position(|group| group.iter().any(|other| other == room))
        };
        let folder = root().join("src").join(wing);
        for room in rooms.iter().flatten() {
            assert!(
                folder.join(room).is_dir() || folder.join(format!("{room}.rs")).is_file(),
                "src/{wing}/mod.rs names a room `{room}`, which is not there"
            );
        }
        for (path, text) in sources(&format!("src/{wing}")) {
            let inside = path.strip_prefix(&folder).expect("it lies there");
            let first = inside.components().next().expect("a path has parts");
            let room = first.as_os_str().to_string_lossy();
            let room = room.trim_end_matches(".rs");
            let own = rank(room);
            assert!(
                own.is_some() || rooms.is_empty() || room == "mod",
                "src/{wing}/mod.rs does not name `{room}`"
            );
            for (other_wing, other_room) in imports(&text) {
                let Some(other) = wing_rank(&other_wing) else {
                    continue;
                };
                let is_before = if other_wing == *wing {
                    let other = rank(&other_room);
                    own.is_none() || other.is_none() || other_room == room || other < own
                } else {
                    Some(other) < wing_rank(wing)
                };
                assert!(
                    is_before,
                    "{}: `{wing}::{room}` imports `{other_wing}::{other_room}`, which does not stand before it",
                    path.display()
                );
            }
        }
    }
}

#[test]
fn the_test_of_imports_sees_groups_and_skips_comments() {
    let pair = |wing: &str, room: &str| (wing.to_owned(), room.to_owned());
    assert_eq!(
        imports(
            "use crate::\n    physics::num;\nuse crate::generator::{\n    emit::File, lut};\nuse crate::\n;"
        ),
        [
            pair("physics", "num"),
            pair("generator", "emit"),
            pair("generator", "lut")
        ]
    );
    assert_eq!(
        imports("// use crate::generator::emit\nlet x = crate::physics::num::Half;"),
        [pair("physics", "num")]
    );
}

#[test]
fn the_truth_is_written_without_the_graph() {
    for (path, text) in sources("src/physics") {
        assert!(!text.contains("crate::language"), "{}", path.display());
    }
}

#[test]
fn only_the_writer_and_the_program_touch_the_machine() {
    let named = [
        "main.rs",
        "generator/output/write.rs",
        // Files that wait beside their places.
        "generator/output/stage.rs",
        "generator/output/folder.rs",
        // What is removed, what stays.
        "generator/output/ownership.rs",
        // It names this program, an input of what it writes.
        "generator/output/depfile.rs",
        // The lock on an output folder, and its waits.
        "generator/output/lock.rs",
        "generator/request/source.rs",
        "generator/output/tree.rs",
        "build.rs",
        "lab/verify/machine.rs",
        // Workers: processes of this program, with a time limit.
        "lab/process/worker.rs",
        // The folder for their temporary files.
        "lab/process/surroundings.rs",
        // The clock of what is measured.
        "lab/overdraw/clock.rs",
        "lab/verify/compilers/call.rs",
        // It asks whether a library would complain of the environment.
        "lab/gpu/quiet.rs",
        // It opens a device's node.
        "lab/gpu/gles_compiler.rs",
    ];
    for (path, text) in sources("src") {
        let inside = path
            .strip_prefix(root().join("src"))
            .expect("it lies there")
            .display()
            .to_string();
        if named.contains(&inside.as_str()) {
            continue;
        }
        for touch in [
            "std::fs",
            "std::env",
            "std::process",
            "std::time",
            "std::net",
            "println!",
            "eprintln!",
        ] {
            // The example of a build script in the crate's documentation does not run.
            let code = before_tests(&text).lines();
            let uses = code
                .filter(|line| !line.starts_with("//!"))
                .any(|line| line.contains(touch));
            assert!(!uses, "{inside} uses {touch}");
        }
    }
}

#[test]
fn only_leaves_are_unsafe_and_say_why() {
    let leaves = [
        "egl",
        "gles",
        "gles_compiler",
        "quiet",
        "spirv",
        "vulkan_compiler",
    ]
    .map(|leaf| format!("lab/gpu/{leaf}.rs"));
    // It looks at stdout before Rust's runtime starts.
    let mut named = leaves.to_vec();
    named.push("main/stdout.rs".to_owned());
    for (path, text) in sources("src") {
        let inside = path.strip_prefix(root().join("src")).unwrap();
        let inside = inside.display().to_string();
        assert_eq!(
            named.contains(&inside),
            text.contains("allow(unsafe_code)"),
            "{inside} is unsafe, or is named and is not"
        );
        let lines: Vec<&str> = text.lines().collect();
        for (at, line) in lines.iter().enumerate() {
            // A reason stands above the statement, which may begin a few lines before the block.
            let above = &lines[at.saturating_sub(4)..at];
            let says_why = above.iter().any(|line| line.contains("// SAFETY:"));
            assert!(
                !line.contains("unsafe {") || says_why,
                "{inside}:{}: an unsafe block without `// SAFETY:`",
                at + 1
            );
        }
    }
}

#[test]
fn a_match_over_all_operations_stands_in_two_places() {
    // The third place, lowering, is naga's: SPIR-V goes through WGSL.
    let is_whole = |text: &str| {
        ["Op::Exp2", "Op::Log2", "Op::Sin", "Op::InverseSqrt"]
            .iter()
            .all(|op| text.contains(&format!("{op} =>")) || text.contains(&format!("({op}, _) =>")))
    };
    let places: Vec<String> = sources("src")
        .into_iter()
        .filter(|(_, text)| is_whole(before_tests(text)))
        .map(|(path, _)| {
            path.file_name()
                .expect("a file")
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    assert_eq!(places, ["evaluate.rs", "spelling.rs"]);
}

#[test]
fn a_method_has_one_name_and_its_formula_first() {
    for method in methods::ALL {
        let path = root().join(format!("src/language/methods/formulas/{}.rs", method.name));
        let text =
            fs::read_to_string(&path).unwrap_or_else(|_| panic!("{} is missing", path.display()));
        let header: String = text
            .lines()
            .take_while(|line| line.starts_with("//!"))
            .collect();
        assert!(
            header.starts_with("//! `F")
                || header.starts_with("//! `R")
                || header.contains("exact law")
                || header.starts_with("//! `n"),
            "{}: the header begins with the formula",
            method.name
        );
        assert!(
            header.contains("http"),
            "{}: the header has a link",
            method.name
        );
        assert!(
            header.contains("19") || header.contains("20"),
            "{}: the header has a year",
            method.name
        );
        assert!(
            text.contains("#[cfg(test)]"),
            "{}: it has limit tests",
            method.name
        );
        assert!(
            method.source.link.starts_with("https://"),
            "{}",
            method.name
        );
        assert!(
            (1800..2100).contains(&method.source.year),
            "{}",
            method.name
        );
        assert!(
            method
                .formula
                .iter()
                .chain([&method.summary, &method.domain])
                .all(|line| line.is_ascii()),
            "{}",
            method.name
        );
    }
}

/// With BLESS=1 the script writes them.
#[test]
fn lists_are_complete() {
    let check = (!super::bless::is_on()).then_some("--check");
    let script = root().join("tests/lists");
    let output = Command::new("bash").arg(script).args(check).output();
    let output = output.expect("bash runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let names: BTreeSet<&str> = targets::ALL.iter().map(|target| target.name).collect();
    assert_eq!(names.len(), targets::ALL.len());
}

/// A name in backquotes is a word of the code, and a path is the end of a path of a file or a folder.
#[test]
fn what_architecture_names_is_there() {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("it is there");
    let code: String = ["src", "tests"]
        .iter()
        .flat_map(|folder| sources(folder).into_values())
        .collect();
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let words: BTreeSet<&str> = code.split(|c| !is_part(c)).collect();
    let mut paths = Vec::new();
    for folder in ["src", "tests", "data", "docs", "templates", "benches"] {
        visit_all(&root().join(folder), &mut paths);
    }
    let named = text.split('`').skip(1).step_by(2);
    let names = named.filter(|name| {
        !name.contains("NAME") && name.chars().all(|c| is_part(c) || "/.:-".contains(c))
    });
    for name in names {
        let is_there = if name.contains('/') || name.contains('.') {
            root().join(name).exists() || paths.iter().any(|path| path.ends_with(name))
        } else {
            let last = name.rsplit("::").next().unwrap_or(name);
            words.contains(last) || last.contains('-')
        };
        assert!(
            is_there,
            "ARCHITECTURE.md names `{name}`, which is not there"
        );
    }
}

fn visit_all(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            visit_all(&path, found);
        }
        found.push(path);
    }
}

#[test]
fn the_manifest_names_the_pinned_naga() {
    let text = fs::read_to_string(root().join("Cargo.toml")).expect("it is there");
    let pinned = format!(
        "naga = {{ version = \"={}\"",
        fresnel_gen::generator::emit::NAGA_VERSION
    );
    assert!(
        text.contains(&pinned),
        "Cargo.toml pins another naga than the manifest names"
    );
}

#[test]
fn no_name_in_generated_code_is_a_reserved_word() {
    for method in methods::ALL {
        let function = method.function(false).expect("it is well formed");
        let labels = function
            .nodes
            .iter()
            .filter_map(|node| node.label.as_ref())
            .map(|label| label.name.clone());
        let names: Vec<String> = labels
            .chain(function.params.iter().map(|param| param.name.clone()))
            .collect();
        for (name, target) in names
            .iter()
            .flat_map(|name| targets::ALL.iter().map(move |target| (name, target)))
        {
            assert_eq!(target.name_fault(name), None, "{}", method.name);
        }
    }
}
