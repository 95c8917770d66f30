//! Stdout and stderr: what goes where, JSON, closed pipes, colour.

use std::io::Read;
use std::process::Stdio;

use super::MY_METAL;
use super::Place;
use super::Ran;
use fresnel_gen::language::{methods, targets};
use fresnel_gen::physics::materials;

#[test]
fn json_on_stdout_stands_there_alone() {
    let place = Place::new();
    for (command, named, count) in [
        ("methods", "methods", methods::ALL.len()),
        ("materials", "materials list", materials::known().len()),
        ("targets", "targets", targets::ALL.len()),
    ] {
        for line in [
            format!("{command} --json -"),
            format!("{command} list --json -"),
        ] {
            let ran = place.done(&line);
            let json = ran.json();
            assert_eq!(
                (&json["tool"], &json["command"]),
                (&"fresnel-gen".into(), &named.into())
            );
            let rows = json["rows"].as_array().unwrap();
            assert_eq!((rows.len(), ran.err.as_str()), (count, ""));
            for key in ["name", "summary", "source"] {
                assert!(rows.iter().all(|row| row[key].is_string()), "{line}: {key}");
            }
        }
        // In a file: the same, and the text on stdout.
        let text = place.done(&format!("{command} --json report.json")).out;
        assert_eq!(text, place.done(command).out);
        assert_eq!(
            place.read("report.json"),
            place.done(&format!("{command} --json -")).out
        );
    }
    assert!(
        place.files().keys().eq(["report.json"]),
        "other files were written"
    );
}

#[test]
fn each_method_material_and_target_can_be_shown() {
    let place = Place::new();
    place.put("my.toml", MY_METAL);
    let names = |names: Vec<&str>| names.into_iter().map(str::to_string).collect::<Vec<_>>();
    for (command, names) in [
        (
            "methods",
            names(methods::ALL.iter().map(|m| m.name).collect()),
        ),
        (
            "materials",
            names([materials::names(), vec!["my.toml"]].concat()),
        ),
        (
            "targets",
            names(targets::ALL.iter().map(|t| t.name).collect()),
        ),
    ] {
        for name in names {
            let shown = name.replace("my.toml", "my_metal");
            let ran = place.done(&format!("{command} show {name}"));
            assert!(ran.out.starts_with(&format!("{shown}: ")), "{ran:?}");
            let json = place
                .done(&format!("{command} show {name} --json -"))
                .json();
            assert_eq!(json["name"], shown.as_str());
        }
    }
}

#[test]
fn a_pipe_gets_no_escape_codes_and_no_progress_bar() {
    let place = Place::new();
    let lines = [
        "--target gles",
        "--check",
        "--target gls",
        "methods",
        "--help",
        "--version",
        "--wrong",
    ];
    for line in lines {
        for (name, value) in [("NO_COLOR", "1"), ("TERM", "xterm-256color")] {
            let words: Vec<&str> = line.split(' ').collect();
            let output = place.command(&words).env(name, value).output().unwrap();
            let ran = Ran::new(line.to_string(), output);
            for stream in [&ran.out, &ran.err] {
                assert!(!stream.contains(['\u{1b}', '\r']), "{ran:?}");
            }
        }
    }
}

#[test]
fn help_and_version_end_well_and_usage_errors_with_2() {
    let place = Place::new();
    for line in ["--help", "-h", "methods --help", "--version"] {
        let ran = place.done(line);
        assert!(!ran.out.is_empty() && ran.err.is_empty(), "{ran:?}");
    }
    assert_eq!(
        place.done("--version").out,
        format!("fresnel-gen {}\n", env!("CARGO_PKG_VERSION"))
    );
    for line in [
        "--wrong",
        "wrong",
        "methods show",
        "--target",
        "methods --target gles",
        "-o",
    ] {
        place.refused(line, &[]);
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let place = Place::new();
    for line in [
        "--check",
        "methods --json -",
        "--list",
        "--material none -o -",
    ] {
        let mut child = place
            .command(&line.split(' ').collect::<Vec<_>>())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // Closed before the program writes: it has to start first.
        drop(child.stdout.take());
        let mut errors = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut errors)
            .unwrap();
        let code = child.wait().unwrap().code();
        let expected = i32::from(line == "--check");
        assert_eq!(code, Some(expected), "{line}: {errors}");
        assert!(
            !errors.contains("panicked") && !errors.contains("error"),
            "{line}: {errors}"
        );
    }
}

/// Whoever asks for data on stdout is told where nothing takes it: a stream that is closed from the beginning, and a full one.
#[cfg(target_os = "linux")]
#[test]
fn a_stdout_that_takes_nothing_is_an_error() {
    let place = Place::new();
    for line in [
        "--material none --target wgsl --method schlick -o -",
        "methods --json -",
        "materials params gold --as usd",
        "completions bash",
        "--list",
        "--help",
    ] {
        for (to, why) in [(">&-", "it is closed"), (">/dev/full", "No space")] {
            let ran = shell(&place, &format!("\"$0\" {line} {to}"));
            let says = format!("error: cannot write to stdout: {why}");
            assert!(ran.code == Some(2) && ran.err.contains(&says), "{ran:?}");
        }
        // A device that takes all, as other programs open it too.
        for to in [">/dev/null", "1<>/dev/null"] {
            shell(&place, &format!("\"$0\" {line} {to}")).ends(0);
        }
    }
    // What prints nothing needs no stdout.
    shell(
        &place,
        "\"$0\" --target gles --method schlick --material none >&-",
    )
    .ends(0);
}

/// The first thread's stack is the shell's to choose.
#[cfg(target_os = "linux")]
#[test]
fn a_small_stack_is_enough() {
    let place = Place::new();
    for line in ["--help", "--target all --material gold --out-dir o"] {
        shell(&place, &format!("ulimit -s 64 && exec \"$0\" {line}")).ends(0);
    }
}

#[cfg(target_os = "linux")]
fn shell(place: &Place, line: &str) -> Ran {
    let output = std::process::Command::new("sh")
        .args(["-c", line, super::PROGRAM])
        .current_dir(place.path(""))
        .stdin(Stdio::null())
        .output()
        .unwrap();
    Ran::new(line.to_owned(), output)
}
