//! What a scan found, as rows: for people, for scripts, and as the table of the documents.

mod heat;
mod markdown;
#[cfg(feature = "cli")]
mod page;

use super::table;
use crate::lab::stability::{Failure, Finding, StabilityRow, short};

pub use heat::heat_map;
pub use markdown::stability_document;
#[cfg(feature = "cli")]
pub use page::stability_page;

fn cells(row: &StabilityRow) -> Vec<String> {
    let about = match &row.material {
        None => String::new(),
        Some((name, channel)) => format!("{name}, {channel}"),
    };
    let mut cells = vec![row.method.to_owned(), about];
    match &row.finding {
        None => cells.extend([
            "none".to_owned(),
            String::new(),
            String::new(),
            String::new(),
        ]),
        Some(finding) => cells.extend([
            finding.failure.words(),
            region(finding),
            percent(finding.share),
            worst(finding),
        ]),
    }
    cells
}

/// The region; of arguments that no medium has, with that said.
fn region(finding: &Finding) -> String {
    if finding.is_media {
        finding.region.clone()
    } else {
        format!("arguments {}", finding.region)
    }
}

fn percent(share: f64) -> String {
    let percent = (100.0 * share).round();
    if share >= 1.0 {
        "all".to_owned()
    } else {
        format!("{} %", percent.clamp(1.0, 99.0))
    }
}

/// Where it is worst, and what comes there.
fn worst(finding: &Finding) -> String {
    let at = finding
        .worst
        .iter()
        .map(|(name, value)| format!("{name} {}", short(*value)));
    let at = at.collect::<Vec<_>>().join(", ");
    let what = match (finding.failure, finding.point) {
        (Failure::Digits(_), _) => format!("{} ulp", rounded(finding.amount)),
        (Failure::Error(_), Some(shown)) => {
            let law = shown.law.map_or_else(String::new, number);
            format!("{}, the law {law}", number(shown.want))
        }
        (Failure::Monotony | Failure::Minimum, _) => format!("by {:.3}", finding.amount),
        (_, Some(shown)) => number(shown.got),
        (_, None) => String::new(),
    };
    if at.is_empty() {
        what
    } else {
        format!("{at}: {what}")
    }
}

/// A reflectance in four digits.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 || size >= 1e4 && size.is_finite() => format!("{x:.1e}"),
        size if size.is_finite() => format!("{x:.4}"),
        _ => x.to_string(),
    }
}

/// Two digits.
fn rounded(x: f64) -> String {
    if x >= 1e4 {
        format!("{x:.1e}")
    } else {
        format!("{x:.0}")
    }
}

/// All rows for people.
pub fn stability_text(rows: &[StabilityRow]) -> String {
    let head = ["method", "material", "failure", "where", "of it", "worst"];
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let has_material = rows.iter().any(|row| row.material.is_some());
    let wanted = |(i, _): &(usize, String)| *i != 1 || has_material;
    let only = |cells: Vec<String>| -> Vec<String> {
        cells
            .into_iter()
            .enumerate()
            .filter(wanted)
            .map(|(_, cell)| cell)
            .collect()
    };
    let head = only(head.iter().map(|cell| (*cell).to_owned()).collect());
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    table::text_table(&head, &cells.into_iter().map(only).collect::<Vec<_>>())
}
