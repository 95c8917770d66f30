//! The claims in the thesis's text, each tested by numbers.

mod gold;
mod minimum;
mod schlick;
mod speed;

use super::ThesisSection;
use super::comparison::{ComparisonRow, Figure};
use super::rendered::Meter;

/// The number of angles that the claims evaluate, for progress.
pub fn work(angles: usize) -> usize {
    schlick::work(angles)
}

/// All claims.
pub fn section(angles: usize, meter: &mut Meter) -> ThesisSection {
    let rows = [
        schlick::schlick_claims(angles, meter),
        minimum::minimum_claims(),
        gold::gold_claims(),
        speed::instruction_claims(),
        speed::speed_claims(),
    ];
    ThesisSection {
        title: "Claims of the text".to_owned(),
        rows: rows.concat(),
    }
}

/// A claim in words, beside our finding.
fn statement(name: &str, section: &str, thesis: &str, ours: String) -> ComparisonRow {
    ComparisonRow::new("claims", name, section)
        .thesis(Figure::Words(thesis.to_owned()))
        .ours(Figure::Words(ours))
}

/// A figure behind a claim.
fn measured(name: &str, column: &str, ours: Figure) -> ComparisonRow {
    ComparisonRow::new("claims", name, column).ours(ours)
}
