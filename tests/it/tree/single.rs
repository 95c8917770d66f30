//! Single outputs: one file, and the depfile.

use std::fs;
use std::path::Path;
use std::process::Command;

use fresnel_gen::app::Error;
use fresnel_gen::app::depfile::depfile;
use fresnel_gen::app::write::write_file;
use tempfile::TempDir;

use super::{put, snapshot};
use crate::compilers::Tool;

#[test]
fn a_single_file_is_written_if_it_differs() {
    let dir = TempDir::new().unwrap();
    let path = dir.path().join("new/gold.glsl");
    assert!(write_file(&path, b"one").unwrap());
    let before = snapshot(dir.path());
    assert!(!write_file(&path, b"one").unwrap());
    assert_eq!(snapshot(dir.path()), before);
    assert!(write_file(&path, b"two").unwrap());
    assert_eq!(fs::read(&path).unwrap(), b"two");
    assert!(matches!(
        write_file(dir.path(), b"one"),
        Err(Error::NotAFile { .. })
    ));
    assert!(matches!(
        write_file(&path.join("x/y"), b"one"),
        Err(Error::Stage { .. })
    ));
    assert_eq!(snapshot(dir.path()).len(), 1);
}

#[cfg(unix)]
#[test]
fn a_single_file_goes_through_links_and_into_devices() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let dir = TempDir::new().unwrap();
    put(dir.path(), "real", "old");
    let (real, link) = (dir.path().join("real"), dir.path().join("link"));
    symlink(&real, &link).unwrap();
    assert!(write_file(&link, b"new").unwrap());
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read(&real).unwrap(), b"new");
    let probe = dir.path().join("probe");
    fs::write(&probe, "").unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&real), mode(&probe), "permissions obey the umask");
    write_file(Path::new("/dev/null"), b"new").unwrap();
    let null = fs::metadata("/dev/null").unwrap().file_type();
    assert!(null.is_char_device());
}

#[test]
fn a_depfile_quotes_as_make_and_ninja_read() {
    let cases = [
        ("plain/x.glsl", "plain/x.glsl"),
        ("a b", "a\\ b"),
        ("a#b", "a\\#b"),
        ("a$b", "a$$b"),
        ("C:\\dir\\file", "C\\:\\dir\\file"),
        ("a\\ b", "a\\\\\\ b"),
        ("end\\", "end\\\\"),
        ("12:30", "12\\:30"),
        ("50%", "50%"),
    ];
    for (path, quoted) in cases {
        let text = depfile(&["out".to_string()], &[path.to_string()]).unwrap();
        assert_eq!(text, format!("out: {quoted}\n"));
    }
    let strings = |names: &[&str]| names.iter().map(|n| n.to_string()).collect::<Vec<_>>();
    let text = depfile(&strings(&["o2", "o1"]), &strings(&["i2", "i1", "i2"])).unwrap();
    // Ninja takes the first output for its own: their order is the caller's.
    assert_eq!(text, "o2 o1: i1 i2\n");
    assert_eq!(depfile(&strings(&["o1"]), &[]).unwrap(), "o1:\n");
    assert_eq!(depfile(&strings(&["50%"]), &[]).unwrap(), "50\\%:\n");
    for path in [
        "a;b", "a=b", "a|b", "a\tb", "a\nb", "a*b", "a?b", "a'b", "a\"b", "a&b",
    ] {
        for (outputs, inputs) in [([path], ["i"]), (["o"], [path])] {
            let fault = depfile(&strings(&outputs), &strings(&inputs)).expect_err(path);
            assert!(fault.to_string().contains("--depfile: the path"), "{fault}");
        }
    }
}

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
    for sign in "!#$%()+,-./@[]_{}~ :".chars() {
        let name = format!("a{sign}b").replace('/', "_");
        if has_make {
            reads_as_make(&name);
        }
        if has_ninja {
            reads_as_ninja(&name);
        }
    }
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
