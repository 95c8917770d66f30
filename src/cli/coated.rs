//! `materials coat`: the colours of a surface under a clear coat.

use crate::cli::error::Error;
use crate::cli::materials::CoatFlags;
use crate::cli::output::{Output, report};
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Report;
use crate::generator::fit::CoatedRow;
use crate::pictures::table;
use std::path::Path;

/// `fresnel-gen materials coat --f0 R,G,B --f82 R,G,B`.
pub fn run(flags: &CoatFlags, json: Option<&Path>) -> Result<Output, Error> {
    let row = CoatedRow::new(flags.f0, flags.f82, flags.index.value());
    let command = CommandLine::new("materials coat")
        .list("f0", flags.f0)
        .list("f82", flags.f82)
        .list("index", [flags.index]);
    let text = coated_text(&row);
    report(text, &Report::new(command, vec![row]), json)
}

/// The numbers of each channel, and where no index gives the colours.
pub fn coated_text(row: &CoatedRow) -> String {
    let cells = |name: &str, values: [f64; 3], what: &str| {
        let numbers = values.map(|value| format!("{value:.5}"));
        let cells = [name.to_owned()].into_iter().chain(numbers);
        cells.chain([what.to_owned()]).collect::<Vec<String>>()
    };
    // An index that gives neither colour is no material's: JSON has it.
    let index_cells = |name: &str, values: [f64; 3]| {
        let mut shown = cells(name, values, "in air");
        for (cell, exact) in shown[1..].iter_mut().zip(row.exact) {
            if !exact {
                *cell = "none".to_owned();
            }
        }
        shown
    };
    let rows = [
        cells("F0", row.f0, "in air"),
        cells("F82", row.f82, "in air"),
        cells("F0 in coat", row.f0_in_coat, "relative to the coat"),
        cells(
            "F82 in coat",
            row.f82_in_coat,
            "at 81.79 degrees within the coat",
        ),
        index_cells("n", row.n),
        index_cells("k", row.k),
    ];
    let mut lines = vec![
        format!("under a coat of index {}", row.index),
        String::new(),
        table::text_table(&["", "red", "green", "blue", ""], &rows),
    ];
    let channels = ["red", "green", "blue"].into_iter().zip(row.exact);
    let nearest: Vec<&str> = channels
        .filter(|(_, exact)| !exact)
        .map(|(name, _)| name)
        .collect();
    if !nearest.is_empty() {
        lines.push(format!(
            "No index gives F0 and F82 of {}: what is shown in the coat follows from the nearest F82 that an index gives with an F0 of at most .999999.",
            nearest.join(" and ")
        ));
    }
    lines.join("\n").trim_end().to_owned() + "\n"
}
