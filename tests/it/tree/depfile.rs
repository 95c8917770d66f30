//! Make and Ninja read the depfile as it is meant.

use std::fs;
use std::process::Command;

use tempfile::TempDir;

use crate::compilers::Tool;
use fresnel_gen::generator::output::depfile::depfile;

/// A path with each sign that the depfile lets pass, as an output and as an input, read by both programs.
#[test]
fn make_and_ninja_read_what_the_depfile_spells() {
    let make = Tool {
        command: "make",
        package: "make",
    };
    let ninja = Tool {
        command: "ninja",
        package: "ninja-build",
    };
    let (has_make, has_ninja) = (make.is_here("the depfile"), ninja.is_here("the depfile"));
    for sign in "!#$()+,-./@[]_{}~ :".chars() {
        let name = format!("a{sign}b").replace('/', "_");
        if has_make {
            reads_as_make(&name);
        }
        if has_ninja {
            reads_as_ninja(&name);
        }
    }
}

/// An input that was renamed, or removed, is a reason to run again and no reason to end.
#[test]
fn make_and_ninja_go_on_after_an_input_was_renamed() {
    let dir = TempDir::new().unwrap();
    let put = |file: &str, text: &str| fs::write(dir.path().join(file), text).unwrap();
    let strings = |names: &[&str]| names.iter().map(|n| n.to_string()).collect::<Vec<_>>();
    let text = depfile(&strings(&["out"]), &strings(&["gone lamp.csv", "there"])).unwrap();
    put("there", "");
    put("out", "");
    put("out.d", &text);
    put("kept.d", &text);
    put("Makefile", "out: there\n\techo made >out\n-include out.d\n");
    put(
        "build.ninja",
        "rule make\n  command = echo made >out && cp kept.d out.d\n  depfile = out.d\nbuild out: make there\n",
    );
    for (command, package) in [("make", "make"), ("ninja", "ninja-build")] {
        if !(Tool { command, package }).is_here("the depfile") {
            continue;
        }
        put("out", "");
        let folder = dir.path().to_str().unwrap();
        let ran = Command::new(command).args(["-C", folder]).output().unwrap();
        assert!(ran.status.success(), "{command}: {ran:?}");
        assert_eq!(
            fs::read_to_string(dir.path().join("out")).unwrap(),
            "made\n",
            "{command}"
        );
    }
}

/// `a[1].toml` means `a1.toml` to Make, where that is there, and `a\[1].toml` is another file to Ninja: no spelling serves both.
#[test]
fn what_make_and_ninja_cannot_both_read_is_refused() {
    let make = Tool {
        command: "make",
        package: "make",
    };
    for name in ["a[1].toml", "~/a.toml", "a(1)", "a%b"] {
        for (outputs, inputs) in [(name, "input"), ("output", name)] {
            let strings = |name: &str| [name.to_string()];
            let refused = depfile(&strings(outputs), &strings(inputs)).unwrap_err();
            assert!(refused.to_string().contains("Make and Ninja"), "{refused}");
        }
    }
    // A bracket that nothing closes, or one that only closes, is a letter.
    for name in ["a[1.toml", "a1].toml", "a~/b", "a(1).toml"] {
        assert!(
            depfile(&[name.to_string()], &[name.to_string()]).is_ok(),
            "{name}"
        );
    }
    if !make.is_here("the depfile") {
        return;
    }
    let dir = TempDir::new().unwrap();
    let put = |file: &str, text: &str| fs::write(dir.path().join(file), text).unwrap();
    put("a[1].toml", "");
    put("a1.toml", "");
    put("Makefile", "out: a[1].toml\n\t@echo $^\n");
    let folder = dir.path().to_str().unwrap();
    let ran = Command::new("make")
        .args(["-s", "-C", folder])
        .output()
        .unwrap();
    assert_eq!(String::from_utf8_lossy(&ran.stdout), "a1.toml\n");
}

/// Make knows the rule whose target is this name, and the one whose prerequisite is.
fn reads_as_make(name: &str) {
    let dir = TempDir::new().unwrap();
    let strings = |name: &str| [name.to_string()];
    let rules = depfile(&strings(name), &strings("input")).unwrap()
        + &depfile(&strings("output"), &strings(name)).unwrap();
    fs::write(dir.path().join("Makefile"), format!(".SUFFIXES:\n{rules}")).unwrap();
    fs::write(dir.path().join("input"), "").unwrap();
    fs::write(dir.path().join(name), "").unwrap();
    let folder = dir.path().to_str().unwrap();
    let database = make_database(folder);
    for rule in [format!("{name}: input"), format!("output: {name}")] {
        // A pattern would be no target: Make says so above it.
        let mut lines = database
            .lines()
            .skip_while(|line| !line.starts_with("# Files"));
        assert!(
            lines.any(|line| line == rule),
            "{rule} is not in {database}"
        );
    }
}

fn make_database(folder: &str) -> String {
    let arguments = ["-C", folder, "-rRpnq", "--no-print-directory"];
    let output = Command::new("make").args(arguments).output().unwrap();
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Ninja's log of dependencies holds the name, and builds an output of that name.
fn reads_as_ninja(name: &str) {
    let dir = TempDir::new().unwrap();
    let strings = |name: &str| [name.to_string()];
    let put = |file: &str, text: &str| fs::write(dir.path().join(file), text).unwrap();
    put(name, "");
    put("one", &depfile(&strings(name), &strings("input")).unwrap());
    put("two", &depfile(&strings("output"), &strings(name)).unwrap());
    put("input", "");
    let quoted = name
        .replace('$', "$$")
        .replace(' ', "$ ")
        .replace(':', "$:");
    put(
        "build.ninja",
        &format!(
            "rule one\n  command = cp one one.d\n  depfile = one.d\n  deps = gcc\nrule two\n  command = cp two two.d && touch output\n  depfile = two.d\n  deps = gcc\nbuild {quoted}: one\nbuild output: two\n"
        ),
    );
    let folder = dir.path().to_str().unwrap();
    let ninja = Command::new("ninja").args(["-C", folder]).output().unwrap();
    assert!(ninja.status.success(), "{name}: {ninja:?}");
    let log = Command::new("ninja")
        .args(["-C", folder, "-t", "deps"])
        .output()
        .unwrap();
    let log = String::from_utf8_lossy(&log.stdout).into_owned();
    let depends = |output: &str, input: &str| {
        let mut lines = log
            .lines()
            .skip_while(|line| !line.starts_with(&format!("{output}: #deps")));
        lines.next();
        lines.next() == Some(&format!("    {input}"))
    };
    assert!(
        depends(name, "input") && depends("output", name),
        "{name}: {log}"
    );
}
