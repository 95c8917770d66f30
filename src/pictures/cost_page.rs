//! The HTML page of costs: a bar for each function on each GPU family. Self-contained, for any browser.

use serde::Serialize;
use tera::Context;

use crate::lab::cost::CostRow;
use crate::pictures::html;

static TEMPLATE: &str = include_str!("../../templates/cost.html.tera");

/// A GPU family on the page.
#[derive(Serialize)]
struct FamilySection {
    name: &'static str,
    gpu: &'static str,
    vendor: &'static str,
    measure: &'static str,
    compiler: String,
    /// Why no cost is known, where none is.
    reason: Option<String>,
    lines: Vec<Line>,
}

/// A function on a family.
#[derive(Serialize)]
struct Line {
    label: String,
    cost: String,
    share: String,
    /// The length of its bar, as a percentage of the longest.
    length: String,
    fetches: usize,
    registers: String,
    reason: String,
}

/// The page of these rows, or why it cannot be made.
///
/// # Errors
/// The page's template cannot be filled.
pub fn cost_page(families: &[Vec<CostRow>], command: &str) -> Result<String, String> {
    let sections: Vec<FamilySection> = families.iter().filter_map(|rows| section(rows)).collect();
    let mut context = Context::new();
    context.insert("sections", &sections);
    context.insert("command", command);
    html::fill(TEMPLATE, &context)
}

fn section(rows: &[CostRow]) -> Option<FamilySection> {
    let family = rows.first()?.family;
    let known = rows.iter().find(|row| row.figures.is_ok());
    let longest = rows.iter().filter_map(|row| row.share).fold(0.0, f64::max);
    let (lines, reason) = match known {
        Some(_) => (rows.iter().map(|row| line(row, longest)).collect(), None),
        None => (Vec::new(), rows[0].figures.clone().err()),
    };
    Some(FamilySection {
        name: family.name,
        gpu: family.gpu,
        vendor: family.vendor,
        measure: family.columns.measure,
        compiler: known
            .and_then(|row| row.compiler.clone())
            .unwrap_or_default(),
        lines,
        reason,
    })
}

fn line(row: &CostRow, longest: f64) -> Line {
    let figures = row.figures.as_ref().ok();
    let share = row.share.unwrap_or(0.0);
    let per_cent = row.share.map(|share| format!("{:.0}", 100.0 * share));
    Line {
        label: row.id.label(),
        cost: short(figures.map(|figures| figures.cost())),
        share: per_cent.unwrap_or_default(),
        length: format!("{:.1}", (100.0 * share / longest.max(1e-9)).max(0.0)),
        fetches: row.fetches,
        registers: short(figures.and_then(|figures| figures.registers)),
        reason: row.figures.clone().err().unwrap_or_default(),
    }
}

/// A cost with at most two decimals.
pub fn short(value: Option<f64>) -> String {
    let rounded = value.map(|value| (100.0 * value).round() / 100.0);
    rounded.map_or_else(String::new, |value| value.to_string())
}

/// The share of the exact law's cost in per cent, with a `+` for each fetch.
pub fn percent(row: &CostRow) -> String {
    match row.share {
        Some(share) => format!("{:.0}{}", 100.0 * share, "+".repeat(row.fetches)),
        None => "?".to_owned(),
    }
}
