//! Table 1: the indices of refraction, compared with those of our material files.

use super::comparison::{self, CHANNELS, ComparisonRow, ComparisonVerdict, Figure, ThesisSection};
use super::specialised;

/// The materials in the order of the thesis.
const MATERIALS: [&str; 4] = ["gold", "platinum", "water", "diamond"];
/// The pages that Table 1 was taken from, found by comparison with all pages of the database.
const PAGES: [(&str, &str); 4] = [
    ("gold", "gold_hagemann_2"),
    ("platinum", "platinum"),
    ("water", "water"),
    ("diamond", "diamond"),
];
/// How far rounding or truncation to the thesis's two digits moves an index.
const ROUNDED: f64 = 0.0065;

/// Table 1 beside our files.
pub fn section() -> ThesisSection {
    ThesisSection {
        title: "Table 1: indices of refraction at 685, 535 and 475 nm, from data/materials/*_thesis.toml"
            .to_owned(),
        rows: MATERIALS
            .into_iter()
            .flat_map(channel_rows)
            .chain(PAGES.into_iter().flat_map(unrounded))
            .collect(),
    }
}

/// The index as measured, beside the thesis's.
fn unrounded(
    (material, page): (&'static str, &'static str),
) -> impl Iterator<Item = ComparisonRow> {
    let ours = specialised::unrounded(page);
    let source = specialised::material(page).page;
    CHANNELS.into_iter().enumerate().map(move |(i, channel)| {
        let printed = comparison::numbers(&["table1_index", material, channel]);
        let apart = (ours.n[i] - printed[0])
            .abs()
            .max((ours.k[i] - printed[1]).abs());
        let digits = |value: f64| (value * 1e4).round() / 1e4;
        ComparisonRow::new("table1", page, channel)
            .thesis(Figure::Index([printed[0], printed[1]]))
            .ours(Figure::Index([digits(ours.n[i]), digits(ours.k[i])]))
            .verdict(ComparisonVerdict::of_agreement(apart <= ROUNDED))
            .remark(format!(
                "refractiveindex.info's page {source}, linearly interpolated; the thesis rounds or cuts it"
            ))
    })
}

fn channel_rows(material: &'static str) -> impl Iterator<Item = ComparisonRow> {
    let ours = specialised::channels(material);
    CHANNELS.into_iter().enumerate().map(move |(i, channel)| {
        let printed = comparison::numbers(&["table1_index", material, channel]);
        let printed = [printed[0], printed[1]];
        let ours = [ours.n[i], ours.k[i]];
        ComparisonRow::new("table1", material, channel)
            .thesis(Figure::Index(printed))
            .ours(Figure::Index(ours))
            .verdict(ComparisonVerdict::of_agreement(printed == ours))
    })
}
