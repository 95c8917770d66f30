//! The GitHub action and the hooks of pre-commit: files that other people's machines read. What they run is run here on a small tree.

use std::fs;
use std::path::Path;
use std::process::Command;

use clap::Parser;
use serde_json::Value;

use super::OUT;
use super::Place;
use super::Ran;
use super::pipelines::path_with_program;
use fresnel_gen::cli::Cli;

const FLAGS: &str = "--target wgsl --method schlick --material gold_thesis";

fn yaml(file: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = fs::read_to_string(path).expect("it is there");
    serde_saphyr::from_str(&text).unwrap_or_else(|fault| panic!("{file}: {fault}"))
}

/// A folder with a small tree in it.
fn small_tree() -> Place {
    let place = Place::new();
    place.done(FLAGS);
    place
}

/// The words behind the program's name are a command line of today.
#[track_caller]
fn is_known(line: &str) {
    if let Err(fault) = Cli::try_parse_from(line.split_whitespace()) {
        panic!("{line}: {fault}");
    }
}

/// A script in the place, with this program on PATH.
fn bash(place: &Place, script: &str, environment: &[(&str, &str)]) -> Ran {
    let output = Command::new("bash")
        .args(["-e", "-o", "pipefail", "-c", script])
        .current_dir(place.path(""))
        .env("PATH", path_with_program())
        .envs(environment.iter().copied())
        .output()
        .expect("bash runs");
    Ran::new(script.to_owned(), output)
}

#[test]
fn hooks_of_pre_commit_run() {
    let hooks = yaml(".pre-commit-hooks.yaml");
    let ids: Vec<&Value> = hooks
        .as_array()
        .unwrap()
        .iter()
        .map(|hook| &hook["id"])
        .collect();
    assert_eq!(ids, ["fresnel-gen-check", "fresnel-gen-verify"]);
    for hook in hooks.as_array().unwrap() {
        // pre-commit builds with `cargo install`, and names no files.
        assert_eq!(
            (&hook["language"], &hook["pass_filenames"]),
            (&"rust".into(), &false.into())
        );
        let entry = hook["entry"].as_str().unwrap();
        is_known(entry);
        is_known(&format!("{entry} {FLAGS}"));
    }
    let place = small_tree();
    let check = format!("{} {FLAGS}", hooks[0]["entry"].as_str().unwrap());
    bash(&place, &check, &[]).ends(0);
    let file = format!("{OUT}/wgsl/fresnel_schlick.wgsl");
    place.put(&file, place.read(&file).replace("clamp", "mix"));
    bash(&place, &check, &[]).ends(1);
}

/// The machine may lack a graphics stack, which ends with 3.
#[test]
fn the_hook_that_verifies_runs() {
    let hooks = yaml(".pre-commit-hooks.yaml");
    let entry = hooks[1]["entry"].as_str().unwrap();
    let ran = bash(&small_tree(), &format!("{entry} {FLAGS} --points 100"), &[]);
    assert!(matches!(ran.code, Some(0 | 3)), "{ran:?}");
}

#[test]
fn the_action_runs_its_command() {
    let action = yaml("action.yml");
    let command = action["inputs"]["command"]["default"].as_str().unwrap();
    is_known(&format!("fresnel-gen {command}"));
    let steps = action["runs"]["steps"].as_array().unwrap();
    let script = |step: usize| steps[step]["run"].as_str().unwrap();
    let (sources, build, run) = (script(0), script(2), script(3));
    for flag in build.split(' ').filter(|word| word.starts_with("--")) {
        let help = Command::new(env!("CARGO"))
            .args(["install", "--help"])
            .output()
            .unwrap();
        assert!(
            String::from_utf8_lossy(&help.stdout).contains(flag),
            "{build}"
        );
    }
    // A user's words stand in no script: they come by the environment.
    assert!(
        steps
            .iter()
            .all(|step| !step["run"].to_string().contains("${{"))
    );
    let place = small_tree();
    place.put("temp/keep", "");
    let acts = |command: &str| {
        let environment = [("COMMAND", command), ("RUNNER_TEMP", "temp")];
        bash(&place, run, &environment)
    };
    acts(&format!("{command} {FLAGS}")).ends(0);
    acts(&format!("{command}\n  {}\n", FLAGS.replace(" --", "\n --"))).ends(0);
    // A pattern is a word, a quoted word is one, and nothing is run.
    place.put("my metals/my metal.toml", super::MY_METAL);
    place.put("a.toml", super::MY_METAL);
    acts("--material 'my metals/my metal.toml' --method schlick -o \"my file.wgsl\"").ends(0);
    assert!(place.path("my file.wgsl").is_file());
    assert!(
        acts("--material *.toml -o b.wgsl")
            .ends(2)
            .err
            .contains("*.toml")
    );
    let attack = "--material $(touch$IFS./run) `touch run` ; touch run";
    acts(attack).ends(2);
    assert!(!place.path("run").exists());
    assert_ne!(acts("--material 'gold").code, Some(0));
    let environment = [
        ("ImageOS", ""),
        ("GITHUB_ACTION_PATH", env!("CARGO_MANIFEST_DIR")),
        ("GITHUB_OUTPUT", &place.path("output").display().to_string()),
        ("GITHUB_PATH", &place.path("path").display().to_string()),
        ("RUNNER_TEMP", "temp"),
    ];
    bash(&place, sources, &environment).ends(0);
    let output = place.read("output");
    let value = |key: &str| {
        let line = output.lines().find_map(|line| line.strip_prefix(key));
        line.unwrap_or_else(|| panic!("{key} is not in {output}"))
    };
    // What the program was built against is part of the key: images of one `runner.os` have several C libraries.
    let (hash, system) = (value("hash="), value("system="));
    assert!(
        system.starts_with("none-") && system.len() > 5 && !system.contains(' '),
        "{system}"
    );
    let key = steps[1]["with"]["key"].as_str().unwrap();
    for part in ["hash", "system"] {
        assert!(
            key.contains(&format!("steps.sources.outputs.{part}")),
            "{key}"
        );
    }
    assert!(
        hash.len() == 64 && hash.chars().all(|c| c.is_ascii_hexdigit()),
        "{hash}"
    );
    assert_eq!(place.read("path"), "temp/fresnel-gen/bin\n");
}
