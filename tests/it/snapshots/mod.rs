//! Interfaces that users build on, as committed lists: generated signatures, JSON keys, the library for build scripts.

mod api;
mod json;
mod signatures;

use std::fs;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Compares a list with the committed one.
#[track_caller]
fn check(name: &str, lines: &[String]) {
    let path = root().join(format!("tests/it/snapshots/{name}.txt"));
    let text = lines.join("\n") + "\n";
    assert!(
        crate::bless::is_on() || fs::read_to_string(&path).is_ok_and(|committed| committed == text),
        "{name} is an interface, and it has changed: say what it means for users under *Generated code* in CHANGELOG.md, and \
         let BLESS=1 cargo test rewrite {}",
        path.display()
    );
    crate::bless::check(&path, text.as_bytes());
}
