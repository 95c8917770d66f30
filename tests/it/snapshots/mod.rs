//! Interfaces that users build on, as committed lists: generated signatures, JSON keys, the library for build scripts.
//! BLESS=1 rewrites the lists. A changed list has another hash, which CHANGELOG.md must name under *Generated code*: so
//! nobody changes an interface without an entry there.

mod api;
mod json;
mod signatures;

use std::fs;
use std::path::{Path, PathBuf};

use fresnel_gen::physics::digest::sha256;

/// Digits of a hash that are written in CHANGELOG.md.
const DIGITS: usize = 12;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn file(name: &str) -> PathBuf {
    root().join(format!("tests/it/snapshots/{name}.txt"))
}

/// Compares a list with the committed one, and the changelog with its hash.
#[track_caller]
fn check(name: &str, lines: &[String]) {
    let text = lines.join("\n") + "\n";
    crate::bless::check(&file(name), text.as_bytes());
    let changelog = fs::read_to_string(root().join("CHANGELOG.md")).unwrap();
    if let Err(why) = is_named(&changelog, name, &sha256(text.as_bytes())[..DIGITS]) {
        panic!("{why}");
    }
}

/// Whether a changelog names the hash of a list, under *Generated code*, before any older hash of it.
fn is_named(changelog: &str, name: &str, hash: &str) -> Result<(), String> {
    let mark = format!("{name} `");
    let mut section = "";
    for line in changelog.lines() {
        if let Some(heading) = line.strip_prefix("### ") {
            section = heading;
        }
        if line.starts_with("## ") {
            section = "";
        }
        let named = line
            .split(&mark)
            .nth(1)
            .filter(|_| section == "Generated code");
        if let Some(found) = named.and_then(|rest| rest.split('`').next()) {
            return if found == hash {
                Ok(())
            } else {
                Err(format!(
                    "tests/it/snapshots/{name}.txt is {hash}, and CHANGELOG.md names {found}: say under *Generated code* what \
                     changed for users, and write the new hash there"
                ))
            };
        }
    }
    Err(format!(
        "CHANGELOG.md names no hash of {name} under *Generated code*: write {name} `{hash}` there"
    ))
}

#[test]
fn a_changed_list_needs_an_entry_in_the_changelog() {
    let log = "## Unreleased\n### Added\n- json `0`\n### Generated code\n- lists: json `2`, api `3`\n## 0.1.0\n### Generated code\n- json `1`\n";
    assert!(is_named(log, "json", "2").is_ok());
    assert!(is_named(log, "api", "3").is_ok());
    assert!(
        is_named(log, "json", "1").unwrap_err().contains("names 2"),
        "the old hash is no entry"
    );
    assert!(
        is_named(log, "json", "0").is_err(),
        "another section is no entry"
    );
    assert!(
        is_named(log, "signatures", "3")
            .unwrap_err()
            .contains("no hash")
    );
}
