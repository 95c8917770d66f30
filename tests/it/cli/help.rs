//! What the program says of itself: help with examples, help where nothing is asked for, completion scripts.

use std::process::Command;

use clap::{CommandFactory, Parser};

use super::OUT;
use super::Place;
use fresnel_gen::cli::{Cli, completions};

/// Lines of a help that are commands, without redirections and without what is said of them.
fn commands(help: &str) -> Vec<&str> {
    let lines = help.lines().filter_map(|line| line.strip_prefix("  "));
    let commands = lines.filter(|line| line.starts_with("fresnel-gen "));
    commands
        .map(|line| line.split("  ").next().unwrap_or(line))
        .map(|line| line.split(" > ").next().unwrap_or(line).trim())
        .collect()
}

#[track_caller]
fn is_known(line: &str) {
    let words = line.split_whitespace();
    if let Err(fault) = Cli::try_parse_from(words) {
        panic!("{line}: {fault}");
    }
}

/// Every command, and those below it, with its path.
fn all_commands() -> Vec<(String, clap::Command)> {
    let mut found = Vec::new();
    let mut waiting = vec![(String::new(), Cli::command())];
    while let Some((path, command)) = waiting.pop() {
        for below in command.get_subcommands() {
            waiting.push((format!("{path} {}", below.get_name()), below.clone()));
        }
        found.push((path, command));
    }
    found
}

#[test]
fn every_command_ends_its_help_with_an_example() {
    for (path, command) in all_commands() {
        let help = command.get_after_help().map(ToString::to_string);
        // What lies below a command has its examples there.
        if path.split_whitespace().count() > 1 {
            continue;
        }
        let help = help.unwrap_or_else(|| panic!("{path}: no example"));
        let examples = commands(&help);
        assert!(!examples.is_empty(), "{path}: {help}");
        for example in examples {
            // Flags of generation need no `generate`.
            let is_of_it =
                path == " generate" || example.starts_with(&format!("fresnel-gen{path}"));
            assert!(is_of_it, "{path}: {example}");
            is_known(example);
        }
    }
}

#[test]
fn help_stands_in_groups() {
    let place = Place::new();
    for line in ["--help", "generate --help"] {
        let out = place.done(line).out;
        let at = |heading: &str| out.find(&format!("\n{heading}:\n")).expect(heading);
        let places = ["Everyday", "Colour", "Precision", "Output"].map(at);
        assert!(places.is_sorted(), "{line}: {places:?}");
        let flag = |flag: &str| out.find(&format!("      {flag}")).expect(flag);
        assert!(
            flag("--target") < places[1] && flag("--gamut") < places[2],
            "{out}"
        );
        assert!(
            flag("--budget") < places[3] && flag("--depfile") > places[3],
            "{out}"
        );
    }
    let verify = place.done("verify --help").out;
    assert!(
        verify.contains("\nColour:\n") && verify.contains("\nOptions:\n"),
        "{verify}"
    );
}

#[test]
fn alone_it_helps_where_nothing_is_written_yet() {
    let place = Place::new();
    let ran = place.run("").ends(2);
    assert!(ran.out.is_empty() && place.files().is_empty(), "{ran:?}");
    let commands = commands(&ran.err);
    assert_eq!(commands.len(), 5, "{ran:?}");
    commands.into_iter().for_each(is_known);
    assert!(
        ran.err.contains("no shaders-generated/manifest.json here"),
        "{ran:?}"
    );
    assert!(ran.err.contains("fresnel-gen --help"), "{ran:?}");
    // Any flag writes, or lists.
    assert!(
        place
            .done("--list")
            .out
            .contains("gles/fresnel_schlick.glsl")
    );
}

#[test]
fn alone_it_writes_where_a_tree_is() {
    let place = Place::new();
    place.done("generate --target gles --method schlick --material none");
    place.done("");
    assert!(
        place
            .listed()
            .contains(&"wgsl/fresnel_fitted.wgsl".to_owned())
    );
    let other = Place::new();
    other.put(&format!("{OUT}/manifest.json"), "{\"tool\": \"mine\"}");
    other.refused("", &["manifest.json:1", "mine"]);
}

#[test]
fn generate_takes_the_flags_of_the_program() {
    let place = Place::new();
    for line in [
        "--method schlick --target hlsl -o",
        "--list",
        "--effect coat --target gles -o",
    ] {
        let line = if line.ends_with("-o") {
            format!("{line} -")
        } else {
            line.to_owned()
        };
        assert_eq!(
            place.done(&line).out,
            place.done(&format!("generate {line}")).out
        );
    }
    place.refused("generate --target gles -o x.hlsl", &["--target is gles"]);
    place.refused("--quiet generate", &["generate"]);
    let ids = |command: &clap::Command| -> Vec<String> {
        let all = command.get_arguments();
        all.map(|arg| arg.get_id().to_string()).collect()
    };
    let command = Cli::command();
    let generate = command.find_subcommand("generate").expect("it is there");
    assert_eq!(ids(generate), ids(&command));
}

#[test]
fn completions_know_names() {
    let place = Place::new();
    let flags = ["audit", "depfile-target"];
    let names = ["schlick_corrected", "gold_johnson", "acescg", "adreno330"];
    // What clap writes for the others holds no names.
    for (shell, has_names) in [
        ("bash", true),
        ("fish", true),
        ("zsh", true),
        ("elvish", false),
        ("powershell", false),
    ] {
        let script = place.done(&format!("completions {shell}")).out;
        for word in flags
            .into_iter()
            .chain(names.into_iter().filter(|_| has_names))
        {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    place.refused("completions tcsh", &["tcsh", "bash"]);
}

/// Asks bash what it offers for the last of its arguments.
const OFFERED: &str = r#"
source ./script
complete=$(complete -p fresnel-gen | sed 's/.* -F \([^ ]*\).*/\1/')
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
"$complete" fresnel-gen "${COMP_WORDS[-1]}" "${COMP_WORDS[-2]}"
echo "${COMPREPLY[@]}"
"#;

fn offered(place: &Place, words: &str) -> String {
    let output = Command::new("bash")
        .args(["--norc", "-c", OFFERED, "bash"])
        .args(words.split(' '))
        .current_dir(place.path(""))
        .output()
        .expect("bash runs");
    assert!(output.status.success(), "{words}: {output:?}");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}

#[test]
fn bash_completes_names_and_flags() {
    let place = Place::new();
    let shell = "bash".parse().expect("it is a shell");
    place.put("script", completions(shell));
    let syntax = Command::new("bash")
        .arg("-n")
        .arg(place.path("script"))
        .output();
    let syntax = syntax.expect("bash runs");
    assert!(
        syntax.status.success() && syntax.stderr.is_empty(),
        "{syntax:?}"
    );
    for (words, expected) in [
        ("fresnel-gen --method schlick_c", "schlick_corrected"),
        ("fresnel-gen --depfile-t", "--depfile-target"),
        ("fresnel-gen methods show schlick_c", "schlick_corrected"),
        ("fresnel-gen verify --material gold_j", "gold_johnson"),
        ("fresnel-gen repr", "reproduce"),
    ] {
        assert_eq!(offered(&place, words), expected, "{words}");
    }
}

/// Lines in which each flag that a command offers does its work. Those of a graphics stack or of minutes are parsed only; tests of
/// their own run them.
const USED: [(&str, bool); 61] = [
    (
        "--target gles --method schlick_ior --effect interior --material none --out-dir a --overwrite --quiet",
        true,
    ),
    (
        "--material gold --film 1.38:100nm --method fitted --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --gamut keep --precision f32 --header full --prefix my_ -o - ",
        true,
    ),
    (
        "--material gold --method fitted --wavelengths 600,550,450 -o a.wgsl --depfile d --depfile-target x",
        true,
    ),
    (
        "--material gold --method schlick_corrected --matching-angle 80 --target gles --list",
        true,
    ),
    (
        "--material gold --precision f16 --force --target gles --out-dir h",
        true,
    ),
    ("--material gold --budget 0.01 --gpu rdna2 -o -", true),
    ("--flavour godot --material gold --out-dir g", true),
    ("--plan plan.json --allow . --target gles --out-dir p", true),
    (
        "--plan plan.json --allow . --target gles --out-dir p --check",
        true,
    ),
    ("methods --json methods.json", true),
    ("methods list --json -", true),
    ("methods show schlick --json -", true),
    ("targets --json targets.json", true),
    ("targets list --json -", true),
    ("targets show gles --json -", true),
    ("effects --json effects.json", true),
    ("effects list --json -", true),
    ("effects show coat --json -", true),
    ("materials --json materials.json", true),
    (
        "materials list --class metal --substance gold --search Johnson --full --json -",
        true,
    ),
    (
        "materials show gold --film 1.38:100nm --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --svg a.svg --png a.png --json a.json",
        true,
    ),
    (
        "materials show gold --wavelengths 600,550,450 --json -",
        true,
    ),
    (
        "materials params gold --film 1.38:100nm --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --json -",
        true,
    ),
    (
        "materials compare gold m.csv --film 1.38:100nm --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --wavelengths 450,550 --polarised --svg c.svg --png c.png --csv c.csv --json c.json",
        true,
    ),
    (
        "materials reflectance gold m.csv --film 1.38:100nm --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --angles 0..90:30 --csv r.csv --json -",
        true,
    ),
    (
        "materials reflectance gold --wavelengths 400..700:100",
        true,
    ),
    ("materials params gold --as usd -o a.usda --overwrite", true),
    ("materials params gold --wavelengths 600,550,450", true),
    ("materials params gold --as gltf --coat 1.5", true),
    (
        "--material gold --catalogue --target wgsl --out-dir numbered",
        true,
    ),
    ("clean --list --out-dir numbered", true),
    (
        "materials coat --f0 1,.71,.29 --f82 .98,.91,.66 --index 1.4 --json -",
        true,
    ),
    (
        "materials import m.csv --name mine --class metal -o mine.toml --json -",
        true,
    ),
    ("materials import m.csv --json m.json", true),
    (
        "materials survey m.yml --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --json -",
        true,
    ),
    ("materials survey m.yml --wavelengths 600,550,450", true),
    (
        "bake --material gold --film 1.38:100nm --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --gamut clip --size 8 --axis cos --format png8 --atlas --target gles --prefix my_ --out-dir b --overwrite --quiet --json b.json",
        true,
    ),
    (
        "bake --material gold --budget 0.01 --wavelengths 600,550,450 --out-dir c",
        true,
    ),
    (
        "bake --material gold --film 1.38:100nm --film-thickness 1..100nm --size 8 --out-dir c",
        true,
    ),
    ("bake --dfg --method fitted --size 8 --out-dir c", true),
    ("bake --dfg --layout unreal --out-dir c", true),
    ("fit --f0 1,.71,.29 --f82 .98,.91,.66 --json -", true),
    (
        "scene-error cube --frames 1 --size 16x16 --fov 40 --method schlick --material gold --medium 1.5 --space p3 --json - --out-dir s --overwrite",
        true,
    ),
    (
        "stability --method schlick --out-dir t --overwrite --json t.json",
        false,
    ),
    ("plan s.toml --json plan.json", true),
    (
        "verify --target gles --method schlick --gpu all --effect coat --material gold --film 1.38:100nm --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --gamut clip --prefix my_ --matching-angle 80 --precision f16 --force --points 500 --out-dir o --adapter a --backend vulkan --tools t --limit 9 --shards 3 --shard 1 --require-all --json v.json --junit v.xml",
        false,
    ),
    (
        "verify --exhaustive --target wgsl --method schlick --material gold --wavelengths 600,550,450",
        false,
    ),
    (
        "cost --gpu rdna2 --precision f16 --method schlick --material gold --film 1.38:100nm --out-dir o --overwrite --tools t --limit 9 --require-all --json c.json",
        false,
    ),
    ("cost --effect coat --check", false),
    (
        "time --method schlick --material gold --film 1.38:100nm --precision f16 --adapter a --backend vulkan --clock gpu --size 64 --operations 200 --rounds 3 --limit 9 --require-all --json t.json",
        false,
    ),
    ("time --hardware", false),
    (
        "audit m.glsl --function f -D A=1 --define B=2 --language glsl --arg f0=.5 --max-error .1 --max-inputs 3 --tools t --limit 9 --material gold --film 1.38:100nm --medium 1.5 --space p3 --illuminant A --observer cie2015 --adaptation scale --step 5nm --extrapolate hold --gamut clip --gpu rdna2 --out-dir o --overwrite --json a.json --junit a.xml",
        false,
    ),
    (
        "audit m.glsl --material gold --wavelengths 600,550,450",
        false,
    ),
    (
        "render thin_film --material silicon --film fused_silica:300nm --size 64",
        false,
    ),
    (
        "compare gold:coat platinum --film 1.38:100nm --engine babylon --environment white --extrapolate hold --size 64 -o c.png --json c.json",
        true,
    ),
    (
        "render caustics --material gold --size 64 --exposure 1 --tone-curve aces --environment e.hdr --ldr -o r.png --json r.json",
        false,
    ),
    (
        "chart --show metals --of worst --error de2000 --gpu rdna2 --out-dir o --overwrite --json c.json",
        false,
    ),
    ("chart --material gold --film 1.38:100nm", false),
    ("merge a.json b.json --json m.json --junit m.xml", false),
    (
        "gallery --material gold --film 1.38:100nm --out-dir o --overwrite",
        false,
    ),
    ("reproduce --out-dir o --overwrite --json r.json", false),
];

/// Every command that offers a flag of these groups takes it somewhere: no group brings along what always fails.
#[test]
fn flags_that_a_command_offers_do_their_work() {
    let place = Place::new();
    place.put("m.csv", "nm,n,k\n360,1,2\n830,1.5,2.5\n");
    place.put(
        "m.yml",
        "DATA:\n- type: tabulated nk\n  data: |\n    0.36 1 2\n    0.83 1 2\n",
    );
    place.put("s.toml", "size = [16, 16]\n[camera]\northographic = 2.0\neye = [0, 0, 3]\nat = [0, 0, 0]\n[light]\nuniform = [1, 1, 1]\n[[object]]\nbody = \"sphere\"\nmaterial = \"gold\"\n");
    place.done("plan s.toml --json plan.json");
    let mut used: std::collections::BTreeMap<String, Vec<&str>> = Default::default();
    for (line, is_run) in USED {
        let words: Vec<&str> = line.split_whitespace().collect();
        if is_run {
            drop(place.done(line))
        } else {
            is_known(&format!("fresnel-gen {line}"))
        }
        let path: String = words
            .iter()
            .take_while(|word| {
                all_commands()
                    .iter()
                    .any(|(path, _)| path.split(' ').any(|part| part == **word))
            })
            .map(|word| format!(" {word}"))
            .collect();
        used.entry(path).or_default().extend(words);
    }
    for (path, command) in all_commands() {
        let Some(words) = used.get(&path) else {
            continue;
        };
        for flag in command.get_arguments().filter(|flag| !flag.is_hide_set()) {
            let Some(name) = flag
                .get_long()
                .filter(|name| !["help", "version"].contains(name))
            else {
                continue;
            };
            // Fits and scenes have tests of each of their flags.
            let is_elsewhere =
                [" fit", " plan", " stability", " scene-error"].contains(&path.as_str());
            assert!(
                is_elsewhere || words.contains(&format!("--{name}").as_str()),
                "{path}: --{name} is in no line"
            );
        }
    }
}
