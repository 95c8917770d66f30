//! What `--check` prints: what a run would write or remove. It changes nothing. A file that a run leaves alone is no
//! difference.

use std::collections::BTreeMap;

use similar::TextDiff;

use crate::physics::foreign::{Foreign, line_of_file};

use crate::generator::output::artifact::sha256;
use crate::generator::output::tree::{Planned, State, TreePlan};

const CONTEXT_LINES: usize = 3;

/// The report, sorted by path, and whether there is anything in it.
pub fn report(plan: &TreePlan) -> (String, bool) {
    let mut parts = BTreeMap::new();
    for file in plan.all() {
        parts.insert(&file.path, report_file(file));
    }
    for orphan in &plan.orphans {
        parts.insert(&orphan.file, format!("orphan: {}\n", Foreign(&orphan.file)));
    }
    let text: String = parts.into_values().collect();
    let drift = !text.is_empty();
    (text, drift)
}

fn report_file(file: &Planned) -> String {
    match &file.old {
        None => format!("missing: {}\n", file.path),
        Some(_) if file.state() == State::Unchanged => String::new(),
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
    let text = TextDiff::from_lines(old, new)
        .unified_diff()
        .context_radius(CONTEXT_LINES)
        .header(&format!("a/{path}"), &format!("b/{path}"))
        .to_string();
    text.split_terminator('\n').map(difference_line).collect()
}

/// A line of a difference: its mark, and what a file holds there.
fn difference_line(line: &str) -> String {
    let (mark, held) = line.split_at(line.len().min(1));
    format!("{mark}{}\n", line_of_file(held))
}
