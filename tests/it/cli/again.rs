//! The command that makes a file or a report again: a shell runs it as it stands in a header, and the same bytes come out, whatever the
//! file of a material is called. Commas in paths. Files whose materials come out with one name.

use std::fs;
use std::process::Command;

use super::MY_METAL;
use super::OUT;
use super::Place;
use super::Ran;
use super::contents;
use super::pipelines::path_with_program;

const TABLE: &str = "nm,n,k\n360,1,2\n830,1.5,2.5\n";

/// Names of files that a shell, a comment, a list or a shader's language might take for something else.
const NAMES: [&str; 22] = [
    "m.csv",
    "Gl\u{e4}ser.csv",
    "\u{91d1}.csv",
    "\u{1f947}.csv",
    "a b.csv",
    " a  b .csv",
    "it's.csv",
    "\"q\".csv",
    "$HOME.csv",
    "$(id).csv",
    "`id`.csv",
    "back\\slash.csv",
    "\\n.csv",
    "-dash.csv",
    "--material.csv",
    "~x.csv",
    "a,b.csv",
    "a\nb.csv",
    "%d%%.csv",
    "*?[x].csv",
    "a;b&c|d>e#f!.csv",
    "*/ ??/.csv",
];

fn sh(place: &Place, command: &str) -> Ran {
    let output = Command::new("sh")
        .args(["-c", command])
        .current_dir(place.path(""))
        .env("PATH", path_with_program())
        .output()
        .expect("a shell");
    Ran::new(command.to_owned(), output)
}

#[cfg(unix)]
#[test]
fn a_shell_runs_the_command_of_a_header() {
    for name in NAMES {
        for folder in ["", "sub/", "a, b/"] {
            let place = Place::new();
            let path = format!("{folder}{name}");
            place.put(&path, TABLE);
            let typed = if path.starts_with('-') {
                format!("./{path}")
            } else {
                path
            };
            let flags = [
                "--material",
                &typed,
                "--method",
                "conductor_exact",
                "--target",
                "gles",
            ];
            place.run_with(&flags).ends(0);
            let manifest = place.manifest();
            let mut files = manifest["files"].as_array().unwrap().iter();
            let entry = files
                .find(|entry| entry["material"].is_string())
                .expect("it is listed");
            let command = entry["command"].as_str().unwrap();
            assert!(command.is_ascii() && !command.contains('\n'), "{command}");
            let file = format!("{OUT}/{}", entry["file"].as_str().unwrap());
            assert!(place.read(&file).contains(command), "{command}");
            let first = contents(&place.path(OUT));
            fs::rename(place.path(OUT), place.path("before")).unwrap();
            sh(&place, command).ends(0);
            assert!(contents(&place.path(OUT)) == first, "{command}");
            let report = place
                .run_with(&["fit", "--material", &typed, "--json", "-"])
                .ends(0);
            let command = report.json()["command"].as_str().unwrap().to_owned();
            let again = sh(&place, &format!("fresnel-gen {command} --json -")).ends(0);
            assert_eq!(again.out, report.out);
        }
    }
}

#[test]
fn no_folder_of_the_machine_is_said() {
    let place = Place::new();
    place.put("sub/m.csv", TABLE);
    place.put("s.toml", "size = [16, 16]\n[camera]\northographic = 2.0\neye = [0, 0, 3]\nat = [0, 0, 0]\n[light]\nuniform = [1, 1, 1]\n[[object]]\nbody = \"sphere\"\nmaterial = \"gold\"\n");
    let whole = |file: &str| place.path(file).display().to_string();
    let folder = whole("");
    let material = whole("sub/m.csv");
    let scene = whole("s.toml");
    for words in [
        vec![
            "--material",
            &material,
            "--target",
            "gles",
            "--method",
            "conductor_exact",
            "-o",
            "-",
        ],
        vec!["fit", "--material", &material, "--json", "-"],
        vec!["bake", "--material", &material, "--json", "-"],
        vec!["chart", "--material", &material, "--json", "-"],
        vec!["stability", "--material", &material, "--json", "-"],
        vec!["materials", "params", &material, "--json", "-"],
        vec!["materials", "show", &material, "--svg", "-"],
        vec!["plan", &scene, "--json", "-"],
    ] {
        let ran = place.run_with(&words).ends(0);
        assert!(!ran.out.contains(&folder), "{words:?}: {}", ran.out);
    }
    // What was typed below here is said so.
    let ran = place.done("fit --material sub/m.csv --json -");
    assert_eq!(ran.json()["command"], "fit --material sub/m.csv");
}

#[test]
fn a_path_that_is_there_is_a_path_whatever_commas_it_holds() {
    let place = Place::new();
    let named = |name: &str| MY_METAL.replace("my_metal", name);
    place.put("a, b/c,d.toml", named("one"));
    place.put("other.toml", named("two"));
    for words in [
        vec![
            "fit",
            "--json",
            "-",
            "--material",
            "gold,a, b/c,d.toml,other.toml",
        ],
        vec![
            "fit",
            "--json",
            "-",
            "--material",
            "a, b/c,d.toml",
            "--material",
            "gold,other.toml",
        ],
    ] {
        let ran = place.run_with(&words).ends(0);
        for name in ["\"gold\"", "\"a, b/c,d.toml\"", "\"other.toml\""] {
            assert!(ran.out.contains(name), "{name}: {ran:?}");
        }
    }
    place.refused_with(
        &["fit", "--material", "a, b/none.toml"],
        &["there is no material `a`"],
    );
    place.put("x,y.exr", "no picture");
    place.put("ids.toml", "[[material]]\nid = 1\nmaterial = \"gold\"\n");
    let ran = place
        .run_with(&["plan", "--gbuffer", "x,y.exr", "--materials", "ids.toml"])
        .ends(2);
    assert!(
        ran.err.contains("x,y.exr") || ran.err.contains("ids.toml"),
        "{ran:?}"
    );
    assert!(!ran.err.contains("cannot read x:"), "{ran:?}");
}

#[test]
fn files_that_come_out_with_one_name_are_told_apart() {
    let place = Place::new();
    let table = |n: f64| TABLE.replace(",1,", &format!(",{n},"));
    let flags = |file: &'static str| {
        [
            "--material",
            file,
            "--target",
            "gles",
            "--method",
            "conductor_exact",
        ]
    };
    // Two that had one name before have two.
    place.put("\u{91d1}.csv", table(1.1));
    place.put("\u{94f6}.csv", table(1.2));
    for file in ["\u{91d1}.csv", "\u{94f6}.csv"] {
        place.run_with(&flags(file)).ends(0);
    }
    let files = place.files();
    for name in ["jin", "yin"] {
        assert!(
            files
                .keys()
                .any(|path| path.ends_with(&format!("materials/{name}.glsl"))),
            "{name}"
        );
    }
    // Two that still have one are refused, beside each other and after each other.
    place.put("Gl\u{e4}ser.csv", table(1.3));
    place.put("Glaser.csv", table(1.4));
    place.run_with(&flags("Gl\u{e4}ser.csv")).ends(0);
    place.refused_with(
        &flags("Glaser.csv"),
        &["glaser", "Glaser.csv", "303", "--name"],
    );
    place.refused_with(
        &["fit", "--material", "Glaser.csv,Gl\u{e4}ser.csv"],
        &["`glaser`", "`Glaser.csv`", "`Gl\u{e4}ser.csv`", "--name"],
    );
    place
        .run_with(&["bake", "--material", "Gl\u{e4}ser.csv"])
        .ends(0);
    place.refused_with(
        &["bake", "--material", "Glaser.csv"],
        &["Glaser.csv", "--name"],
    );
    // In another language, another format and an adapter too, and whatever stands in a name.
    place.refused_with(
        &["--target", "gles", "--material", "Glaser.csv"],
        &["glaser", "Glaser.csv", "--name"],
    );
    place.refused_with(
        &["bake", "--format", "ktx2", "--material", "Glaser.csv"],
        &["glaser", "Glaser.csv", "--name"],
    );
    place.refused_with(
        &["--flavour", "godot", "--material", "Glaser.csv"],
        &["glaser", "Glaser.csv", "--name"],
    );
    place.put("a --b.csv", table(1.3));
    place.put("a __b.csv", table(1.4));
    place.run_with(&flags("a --b.csv")).ends(0);
    place.refused_with(&flags("a __b.csv"), &["a_b", "a __b.csv", "--name"]);
    place.put("gold.csv", table(1.3));
    place.run_with(&flags("gold")).ends(0);
    place.refused_with(&flags("gold.csv"), &["gold.csv", "--name"]);
    // A newer measurement in the same file is none of another's.
    place.put("Gl\u{e4}ser.csv", table(1.5));
    place.run_with(&flags("Gl\u{e4}ser.csv")).ends(0);
    // The same data under another name neither.
    place.put("moved/Glaser.csv", table(1.5));
    place.run_with(&flags("moved/Glaser.csv")).ends(0);
}
