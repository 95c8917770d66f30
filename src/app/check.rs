//! What `--check` prints: the difference between the folder and what would be generated. It changes nothing.

use std::collections::BTreeMap;

use similar::TextDiff;

use super::artifact::sha256;
use super::tree::{Plan, Planned};

const CONTEXT_LINES: usize = 3;

/// The report, sorted by path, and whether there is anything in it.
pub fn report(plan: &Plan) -> (String, bool) {
    let mut parts = BTreeMap::new();
    for file in plan.all() {
        parts.insert(&file.path, report_file(file));
    }
    for path in &plan.orphans {
        parts.insert(path, format!("orphan: {path}\n"));
    }
    for path in &plan.foreign {
        let remark = "not written by fresnel-gen, which will not remove it";
        parts.insert(path, format!("orphan: {path} ({remark})\n"));
    }
    let text: String = parts.into_values().collect();
    let drift = !text.is_empty();
    (text, drift)
}

fn report_file(file: &Planned) -> String {
    match &file.old {
        None => format!("missing: {}\n", file.path),
        Some(old) if *old == file.new => String::new(),
        Some(old) => difference(&file.path, old, &file.new),
    }
}

fn difference(path: &str, old: &[u8], new: &[u8]) -> String {
    match (std::str::from_utf8(old), std::str::from_utf8(new)) {
        (Ok(old), Ok(new)) if !path.ends_with(".spv") => text_difference(path, old, new),
        _ => format!(
            "binary file {path} differs (sha256 {} → {})\n",
            sha256(old),
            sha256(new)
        ),
    }
}

fn text_difference(path: &str, old: &str, new: &str) -> String {
    TextDiff::from_lines(old, new)
        .unified_diff()
        .context_radius(CONTEXT_LINES)
        .header(&format!("a/{path}"), &format!("b/{path}"))
        .to_string()
}
