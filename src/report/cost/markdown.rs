//! The document: what methods cost on every family that was recorded.

use std::fmt::Write;

use super::{Row, short};

/// The library functions of each family in single precision, three channels: what an evaluation costs, and its share.
pub fn markdown(families: &[Vec<Row>]) -> String {
    let mut page = String::new();
    for rows in families {
        let wanted =
            |row: &&Row| row.figures.is_ok() && row.precision == "f32" && row.channels == 3;
        let shown: Vec<&Row> = rows.iter().filter(wanted).collect();
        let Some(first) = shown.first() else { continue };
        let family = first.family;
        let compiler = first.compiler.as_deref().unwrap_or("counted in the graph");
        // Writing to a String cannot fail.
        let _ = write!(
            page,
            "\n## {}\n\n{}. {compiler}.\n\n| function | {} | share | fetches |\n|---|---:|---:|---:|\n",
            family.name, family.gpu, family.columns.measure
        );
        for row in shown {
            let cost = row.figures.as_ref().ok().map(|figures| figures.cost());
            let share = row.share.map(|share| format!("{share:.0} %"));
            let _ = writeln!(
                page,
                "| {} | {} | {} | {} |",
                row.label(),
                short(cost),
                share.unwrap_or_default(),
                row.fetches
            );
        }
    }
    page
}
