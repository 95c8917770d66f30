//! Dependencies: their licences and where they come from, by the lists in deny.toml. `cargo deny` says the same of them
//! and needs to be installed; this test needs cargo only.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// What cargo says of the workspace's packages and of how they depend on each other.
fn metadata() -> Value {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--locked",
            "--all-features",
            "--format-version",
            "1",
        ])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The root package and all that it depends on, on any system. The fuzzer's own runtime belongs to another member, and nobody ships it.
fn packages() -> Vec<Value> {
    let metadata = metadata();
    let nodes: BTreeMap<&str, &Value> = metadata["resolve"]["nodes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|node| (node["id"].as_str().unwrap(), &node["dependencies"]))
        .collect();
    let mut pending = vec![metadata["resolve"]["root"].as_str().unwrap()];
    let mut reached = BTreeSet::new();
    while let Some(id) = pending.pop() {
        if reached.insert(id) {
            let dependencies = nodes[id].as_array().unwrap().iter();
            pending.extend(dependencies.map(|one| one.as_str().unwrap()));
        }
    }
    let all = metadata["packages"].as_array().unwrap().iter();
    all.filter(|package| reached.contains(package["id"].as_str().unwrap()))
        .cloned()
        .collect()
}

/// A list of deny.toml.
fn list(table: &str, key: &str) -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("deny.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let parsed: toml::Table = text.parse().unwrap();
    let all = parsed[table][key].as_array().unwrap();
    all.iter()
        .map(|one| one.as_str().unwrap().to_owned())
        .collect()
}

/// Whether an expression of SPDX can be met with these licences: AND binds closer than OR, `/` is an old OR, and an
/// exception only adds permissions.
fn is_met(expression: &str, allowed: &BTreeSet<String>) -> bool {
    let spaced = expression
        .replace('/', " OR ")
        .replace('(', " ( ")
        .replace(')', " ) ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut at = 0;
    let met = either(&words, &mut at, allowed);
    assert_eq!(at, words.len(), "{expression} is no expression of SPDX");
    met
}

fn either(words: &[&str], at: &mut usize, allowed: &BTreeSet<String>) -> bool {
    let mut met = both(words, at, allowed);
    while words.get(*at) == Some(&"OR") {
        *at += 1;
        met |= both(words, at, allowed);
    }
    met
}

fn both(words: &[&str], at: &mut usize, allowed: &BTreeSet<String>) -> bool {
    let mut met = one(words, at, allowed);
    while words.get(*at) == Some(&"AND") {
        *at += 1;
        met &= one(words, at, allowed);
    }
    met
}

fn one(words: &[&str], at: &mut usize, allowed: &BTreeSet<String>) -> bool {
    let word = words[*at];
    *at += 1;
    if word == "(" {
        let met = either(words, at, allowed);
        *at += 1;
        return met;
    }
    if words.get(*at) == Some(&"WITH") {
        *at += 2;
    }
    allowed.contains(word)
}

#[test]
fn every_licence_is_allowed_and_every_source_is_known() {
    let (licences, sources) = (list("licenses", "allow"), list("sources", "allow-registry"));
    let copyleft = |name: &String| {
        ["GPL", "MPL", "EUPL", "CDDL", "EPL"]
            .iter()
            .any(|kind| name.contains(kind))
    };
    assert!(!licences.iter().any(copyleft), "{licences:?}");
    let packages = packages();
    assert!(packages.len() > 100, "{} packages", packages.len());
    let mut used = BTreeSet::new();
    for package in &packages {
        let name = &package["name"];
        let licence = package["license"].as_str().unwrap_or_default();
        assert!(
            is_met(licence, &licences),
            "{name}: {licence} is not met by deny.toml"
        );
        used.extend(
            licences
                .iter()
                .filter(|one| licence.contains(one.as_str()))
                .cloned(),
        );
        if let Some(source) = package["source"].as_str() {
            let known = sources
                .iter()
                .any(|one| source == format!("registry+{one}"));
            assert!(known, "{name} comes from {source}");
        }
    }
    assert_eq!(
        used, licences,
        "a licence that nothing needs is no longer allowed"
    );
}

#[test]
fn expressions_are_understood() {
    let allowed = BTreeSet::from(["MIT".to_owned(), "BSD-3-Clause".to_owned()]);
    for (expression, met) in [
        ("MIT", true),
        ("GPL-3.0-only", false),
        ("MIT OR LGPL-2.1-or-later", true),
        ("MIT/Apache-2.0", true),
        ("(Apache-2.0 OR MIT) AND BSD-3-Clause", true),
        ("MIT AND GPL-3.0-only", false),
        ("Apache-2.0 OR MIT AND GPL-3.0-only", false),
        ("MIT WITH LLVM-exception", true),
    ] {
        assert_eq!(is_met(expression, &allowed), met, "{expression}");
    }
}
