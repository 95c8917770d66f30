//! The job files in `docs/examples`: their YAML and their shell parse, and their commands are those that the program takes. The steps
//! of GitHub's are run, with fewer materials.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use clap::Parser;
use serde_json::Value;

use crate::cli::pipelines::path_with_program;
use crate::cli::{Place, Ran};
use crate::not_checked;
use fresnel_gen::cli::{Cli, Command as Subcommand};

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("docs")
        .join(name)
}

fn text(name: &str) -> String {
    fs::read_to_string(path(name)).unwrap_or_else(|why| panic!("{name}: {why}"))
}

/// The documents of a YAML file.
fn documents(name: &str) -> Vec<Value> {
    let text = text(name);
    let documents = text.split("\n---\n");
    let parsed = documents
        .map(|one| serde_saphyr::from_str(one).unwrap_or_else(|why| panic!("{name}: {why}")));
    parsed.collect()
}

/// The commands of the program in a text, with numbers in place of what a shell or a scheduler puts there.
fn commands(text: &str) -> Vec<Vec<String>> {
    let text = text
        .replace("\\\n", " ")
        .replace("${{ matrix.shard }}", "0");
    let mut found = Vec::new();
    for line in text
        .lines()
        .map(|line| line.trim_start_matches(['#', ' ', '-']))
    {
        let line = line.trim_start_matches("run: ");
        let Some(rest) = line.strip_prefix("fresnel-gen ") else {
            continue;
        };
        let rest = rest.split(" || ").next().unwrap();
        let words = rest
            .split_whitespace()
            .map(|word| match word.split_once('$') {
                Some((before, _)) => format!("{}0.json", before.trim_matches('"')),
                None => word.replace('*', "0"),
            });
        found.push(words.collect());
    }
    found
}

/// The files, and how many shards each has.
const FILES: [(&str, usize); 4] = [
    ("examples/slurm.sh", 61),
    ("examples/kubernetes.yaml", 61),
    ("examples/github-actions.yaml", 8),
    ("clusters.md", 4),
];

#[test]
fn their_commands_are_taken() {
    for (name, shards) in FILES {
        let (mut verified, mut merged) = (0, 0);
        for words in commands(&text(name)) {
            let line = ["fresnel-gen".to_owned()].into_iter().chain(words.clone());
            let cli =
                Cli::try_parse_from(line).unwrap_or_else(|why| panic!("{name}: {words:?}: {why}"));
            match cli.command {
                Some(Subcommand::Verify(flags)) => {
                    assert_eq!(flags.shards, Some(shards), "{name}");
                    assert!(flags.report.report.json().is_some(), "{name}");
                    verified += 1;
                }
                Some(Subcommand::Merge(flags)) => {
                    assert!(flags.json.is_some(), "{name}");
                    merged += 1;
                }
                _ => panic!("{name}: {words:?}"),
            }
        }
        assert!(verified > 0 && merged > 0, "{name}: {verified}, {merged}");
    }
}

#[test]
fn an_array_has_as_many_tasks_as_there_are_shards() {
    let slurm = text("examples/slurm.sh");
    assert!(slurm.contains("#SBATCH --array=0-60\n"));
    let [shards, merge] = documents("examples/kubernetes.yaml").try_into().unwrap();
    assert_eq!(shards["kind"], "Job");
    assert_eq!(shards["spec"]["completionMode"], "Indexed");
    assert_eq!(shards["spec"]["completions"], 61);
    assert_eq!(merge["spec"]["suspend"], true);
    let [actions] = documents("examples/github-actions.yaml")
        .try_into()
        .unwrap();
    let matrix = &actions["jobs"]["shard"]["strategy"]["matrix"]["shard"];
    let numbers: Vec<u64> = matrix
        .as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_u64().unwrap())
        .collect();
    assert_eq!(numbers, (0..8).collect::<Vec<u64>>());
    assert_eq!(actions["jobs"]["merge"]["needs"], "shard");
}

/// The scripts in a value: what stands under `run`, and the last of `args`.
fn scripts(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(all) => {
            for (key, one) in all {
                match (key.as_str(), one) {
                    ("run", Value::String(script)) => found.push(script.clone()),
                    ("args", Value::Array(words)) => {
                        found.extend(words.last().and_then(Value::as_str).map(str::to_owned));
                    }
                    _ => scripts(one, found),
                }
            }
        }
        Value::Array(all) => all.iter().for_each(|one| scripts(one, found)),
        _ => {}
    }
}

#[test]
fn their_shell_parses() {
    let mut all = vec![text("examples/slurm.sh")];
    for name in ["examples/kubernetes.yaml", "examples/github-actions.yaml"] {
        let before = all.len();
        documents(name)
            .iter()
            .for_each(|one| scripts(one, &mut all));
        assert!(all.len() > before, "{name}");
    }
    for script in all {
        let Ok(output) = Command::new("bash").args(["-n", "-c", &script]).output() else {
            return not_checked("job files: no bash here");
        };
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{script}\n{said}");
    }
}

const GITHUB: &str = "examples/github-actions.yaml";

/// The script of the step of this name in a job of GitHub's.
fn step(job: &str, name: &str) -> String {
    let [actions] = documents(GITHUB).try_into().unwrap();
    let steps = actions["jobs"][job]["steps"].as_array().unwrap().clone();
    let found = steps.into_iter().find(|step| step["name"] == name);
    let found = found.unwrap_or_else(|| panic!("{job} has no step `{name}`"));
    found["run"].as_str().unwrap().to_owned()
}

/// What a machine needs, by the documentation, is what the example installs.
#[test]
fn github_installs_what_the_documentation_names() {
    let page = text("verification.md");
    let installs = |text: &str| {
        let line = text
            .lines()
            .find_map(|line| Some(line.split_once("apt-get install ")?.1.to_owned()));
        let line = line.expect("a line that installs packages");
        let words = line
            .split_whitespace()
            .filter(|word| !word.starts_with('-'));
        let mut words: Vec<String> = words.map(str::to_owned).collect();
        words.sort();
        words
    };
    assert_eq!(
        installs(&step("shard", "Install the drivers and compilers")),
        installs(&page)
    );
    assert!(step("shard", "Install DXC").contains("tests/fetch-dxc"));
    assert!(page.contains("bash tests/fetch-dxc "), "{page}");
}

/// The steps in their order, with the program of these tests in the place of one that is installed, and with one material.
#[cfg(unix)]
#[test]
fn the_steps_of_github_run() {
    let place = Place::new();
    let tools = place.path("home/.cargo/bin/tools");
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    std::os::unix::fs::symlink(&root, place.path("fresnel-gen")).unwrap();
    let fetched = fs::read_dir(root.join("target/tools"))
        .into_iter()
        .flatten()
        .flatten();
    let library = fetched.map(|file| file.path()).find(|path| {
        path.file_name()
            .unwrap()
            .to_string_lossy()
            .starts_with("libdxcompiler")
    });
    let Some(library) = library else {
        return not_checked(
            "the steps of GitHub: DXC's library, which tests/run fetches, is not here",
        );
    };
    fs::create_dir_all(&tools).unwrap();
    std::os::unix::fs::symlink(&library, tools.join(library.file_name().unwrap())).unwrap();
    let run = |script: &str| {
        let output = Command::new("bash")
            .args([
                "--noprofile",
                "--norc",
                "-e",
                "-o",
                "pipefail",
                "-c",
                script,
            ])
            .current_dir(place.path(""))
            .env("HOME", place.path("home"))
            .env("PATH", path_with_program())
            .output()
            .expect("bash runs");
        Ran::new(script.to_owned(), output)
    };
    run(&step("shard", "Install DXC")).ends(0);
    assert!(tools.join("dxc").exists());
    let verify = step("shard", "Verify");
    let few = verify.replace(
        "--material all",
        "--material gold --method schlick --points 200",
    );
    assert_ne!(few, verify);
    let few = few.replace(
        "fresnel-gen verify",
        &format!("fresnel-gen verify --tools '{}'", tools.display()),
    );
    for shard in 0..8 {
        let ran = run(&few.replace("${{ matrix.shard }}", &shard.to_string()));
        if ran.err.contains("not checked") && ran.code == Some(1) {
            return not_checked(&format!("the steps of GitHub: {}", ran.err));
        }
        ran.ends(0);
    }
    run(&step("merge", "Merge")).ends(0);
    let report: Value = serde_json::from_str(&place.read("report.json")).unwrap();
    let rows = report["rows"].as_array().unwrap();
    for target in ["wgsl", "gles", "hlsl", "spirv"] {
        let mut own = rows.iter().filter(|row| row["target"] == target);
        assert!(own.clone().count() > 0, "{target}");
        assert!(
            own.all(|row| row["status"] == "pass"),
            "{target}: {rows:#?}"
        );
    }
    assert!(place.path("report.xml").exists());
}
