//! The report for a terminal: one family with all its figures, or several side by side.

use crate::pictures::cost_page::{percent, short};
use crate::lab::cost::{CostRow, CostSource};
use crate::pictures::table;

/// The rows of each family, all of the same functions in the same order.
pub fn cost_text(families: &[Vec<CostRow>]) -> String {
    match families {
        [one] => format!(
            "{}\nThe shader's figures are of a chain of evaluations, four or, in GLSL ES 1.00, one.\n{}\n",
            table::text_table(&ALONE, &alone(one)),
            about(one)
        ),
        several => {
            let body = beside(several);
            let sources: String = several.iter().map(|rows| about(rows) + "\n").collect();
            format!(
                "{body}\nIn per cent of dielectric_exact, its argument from a uniform; a + is a texture fetch.\n{sources}"
            )
        }
    }
}

const ALONE: [&str; 8] = [
    "function",
    "an evaluation",
    "share, %",
    "fetches",
    "shader's instructions",
    "latency",
    "inverse throughput",
    "registers",
];

fn alone(rows: &[CostRow]) -> Vec<Vec<String>> {
    let cells = |row: &CostRow| match &row.figures {
        Ok(figures) => vec![
            row.label(),
            short(Some(figures.cost())),
            percent(row),
            row.fetches.to_string(),
            short(Some(figures.shader.instructions)),
            short(figures.shader.latency),
            short(figures.shader.inverse_throughput),
            short(figures.registers),
        ],
        Err(why) => vec![row.label(), why.clone()],
    };
    rows.iter().map(cells).collect()
}

fn beside(families: &[Vec<CostRow>]) -> String {
    let names = families.iter().filter_map(|rows| rows.first());
    let head: Vec<&str> = ["function"]
        .into_iter()
        .chain(names.map(|row| row.family.name))
        .collect();
    let count = families.first().map_or(0, Vec::len);
    let line = |place: usize| -> Vec<String> {
        let label = families[0][place].label();
        let shares = families.iter().map(|rows| percent(&rows[place]));
        [label].into_iter().chain(shares).collect()
    };
    let lines: Vec<Vec<String>> = (0..count).map(line).collect();
    table::text_table(&head, &lines)
}

/// Who said it, and what it is.
fn about(rows: &[CostRow]) -> String {
    let Some(first) = rows.first() else {
        return String::new();
    };
    let family = first.family;
    let unknown = rows.iter().filter(|row| row.figures.is_err()).count();
    let known = rows.iter().find(|row| row.figures.is_ok());
    let mut about = format!(
        "{}: {}, {}",
        family.name, family.gpu, family.columns.measure
    );
    match known.map(|row| (row.source, row.compiler.as_deref())) {
        Some((Some(CostSource::Record), Some(compiler))) => {
            about += &format!("; recorded with {compiler}")
        }
        Some((_, Some(compiler))) => about += &format!("; {compiler}"),
        _ => {}
    }
    if let Some(Err(why)) = rows.iter().map(|row| &row.figures).find(|one| one.is_err()) {
        let why = why.strip_prefix("not measured: ").unwrap_or(why);
        about += &format!("; {unknown} of {} not measured: {why}", rows.len());
    }
    about
}
