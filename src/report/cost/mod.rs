//! What functions cost on GPUs, as rows: for people, for scripts, as a document and as a page.

mod markdown;
#[cfg(feature = "cli")]
mod page;
mod text;

use crate::lab::cost::CostRow;

pub use markdown::cost_document;
#[cfg(feature = "cli")]
pub use page::cost_page;
pub use text::cost_text;

/// A figure with at most two decimals.
fn short(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| {
        let rounded = (100.0 * value).round() / 100.0;
        format!("{rounded}")
    })
}

/// The share, with a mark for each fetch.
fn percent(row: &CostRow) -> String {
    let fetches = "+".repeat(row.fetches);
    row.share.map_or_else(
        || "?".to_owned(),
        |share| format!("{:.0}{fetches}", 100.0 * share),
    )
}
