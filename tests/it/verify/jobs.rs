//! The job files in `docs/examples`: their YAML and their shell parse, and their commands are those that the program takes.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use clap::Parser;
use fresnel_gen::app::args::{Cli, Command as Subcommand};
use serde_json::Value;

use crate::not_checked;

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
    ("examples/slurm.sh", 64),
    ("examples/kubernetes.yaml", 64),
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
    assert!(slurm.contains("#SBATCH --array=0-63\n"));
    let [shards, merge] = documents("examples/kubernetes.yaml").try_into().unwrap();
    assert_eq!(shards["kind"], "Job");
    assert_eq!(shards["spec"]["completionMode"], "Indexed");
    assert_eq!(shards["spec"]["completions"], 64);
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
