//! A search of shapes for people.

use crate::generator::fit::ErrorQuantiles;
use crate::lab::cost::{ChoiceRow, SearchResult, ShapeRow};

use crate::pictures::table::{self, short_number};

/// The report for a terminal; a star where nothing with fewer operations comes as near.
pub fn search_text(results: &[SearchResult], gpu: &str) -> String {
    let one = |result: &SearchResult| {
        let choices = result.choices.iter();
        let choices = choices.map(|(terms, choice)| match choice {
            Some(choice) => choice_text(choice),
            None => {
                format!("\n{terms} coefficients: a choice is judged by two substances or more\n")
            }
        });
        format!(
            "{}\n\n{}{}",
            headline(result),
            shapes_text(&result.shapes, gpu),
            choices.collect::<String>()
        )
    };
    let texts: Vec<String> = results.iter().map(one).collect();
    format!("{}\n{STAR}\n", texts.join("\n"))
}

/// What the first column means.
const STAR: &str =
    "A star marks the frontier: no shape with as few operations has as small a 90th percentile.";

fn shapes_text(shapes: &[ShapeRow], gpu: &str) -> String {
    let head = [
        "",
        "method",
        "terms",
        "operations",
        "median",
        "90 % within",
        "worst",
        "median by substance",
        "90 % by substance",
        gpu,
        "shape",
    ];
    let cells = |row: &ShapeRow| {
        let mut cells = vec![
            if row.is_on_frontier { "*" } else { "" }.to_owned(),
            row.method.unwrap_or_default().to_owned(),
            row.terms.to_string(),
            row.operations.to_string(),
        ];
        cells.extend(quantile_cells(&row.errors));
        cells.push(row.cost.map_or_else(String::new, short_number));
        cells.push(row.shape.clone());
        cells
    };
    let rows: Vec<_> = shapes.iter().map(cells).collect();
    table::text_table(&head, &rows)
}

fn quantile_cells(errors: &ErrorQuantiles) -> [String; 5] {
    let ErrorQuantiles {
        median,
        p90,
        worst,
        median_by_substance,
        p90_by_substance,
    } = *errors;
    [median, p90, worst, median_by_substance, p90_by_substance].map(short_number)
}

/// Leaving out one substance after the other.
fn choice_text(choice: &ChoiceRow) -> String {
    let head = [
        "errors of",
        "median",
        "90 % within",
        "worst",
        "median by substance",
        "90 % by substance",
    ];
    let row = |title: &str, errors: &ErrorQuantiles| {
        let mut cells = vec![title.to_owned()];
        cells.extend(quantile_cells(errors));
        cells
    };
    let rows = [
        row("those who chose", &choice.errors),
        row("the substance left out", &choice.errors_left_out),
    ];
    let chosen = choice.chosen.iter();
    let chosen = chosen.map(|chosen| format!("  {} times {}\n", chosen.substances, chosen.shape));
    format!(
        "\n{} coefficients, the shape with the least 90th percentile over all others, for each substance:\n{}{}",
        choice.terms,
        table::text_table(&head, &rows),
        chosen.collect::<String>()
    )
}

fn headline(result: &SearchResult) -> String {
    format!(
        "{}: {} shapes for {} measurements of {} substances",
        result.class.title, result.tried, result.materials, result.substances
    )
}
