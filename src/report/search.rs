//! A search for shapes: those that nothing beats and those of methods, and what a choice is worth for a substance that had no
//! part in it. For people and for scripts.

use serde::Serialize;

use crate::cost::{CostAndError, pareto_frontier};
use crate::fit::{Candidate, ErrorQuantiles, LeaveOneOut, Tried, TriedShapes, Weight};
use crate::methods::Method;
use crate::reference::MaterialClass;

use super::table::{self, short_number};

/// What was found for a class of materials.
#[derive(Clone, Debug)]
pub struct SearchResult {
    class: MaterialClass,
    /// How many shapes were tried.
    tried: usize,
    /// Over how many measurements, and of how many substances.
    materials: usize,
    substances: usize,
    shapes: Vec<ShapeRow>,
    /// For each number of coefficients; none where there is nothing to choose by.
    choices: Vec<(usize, Option<ChoiceRow>)>,
}

/// A row of the JSON report.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum SearchRow {
    /// A shape.
    Shape(ShapeRow),
    /// A choice among shapes.
    Choice(ChoiceRow),
}

/// A shape, how far it misses, and what it costs.
#[derive(Clone, Debug, Serialize)]
pub struct ShapeRow {
    row: &'static str,
    class: &'static str,
    terms: usize,
    shape: String,
    family: &'static str,
    method: Option<&'static str>,
    weight: &'static str,
    materials: usize,
    substances: usize,
    operations: usize,
    cost: Option<f64>,
    is_on_frontier: bool,
    errors: ErrorQuantiles,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// The shape that is chosen among those with so many coefficients, and what the choice is worth.
#[derive(Clone, Debug, Serialize)]
pub struct ChoiceRow {
    row: &'static str,
    class: &'static str,
    terms: usize,
    by: &'static str,
    shape: String,
    method: Option<&'static str>,
    errors: ErrorQuantiles,
    errors_left_out: ErrorQuantiles,
    chosen: Vec<ChosenShape>,
}

/// A shape that is chosen for so many substances, each time without them.
#[derive(Clone, Debug, Serialize)]
pub struct ChosenShape {
    shape: String,
    method: Option<&'static str>,
    substances: usize,
}

impl SearchResult {
    /// What the errors of these shapes tell. `cost` is that of a method's library function, where it is recorded.
    pub fn new(
        class: MaterialClass,
        tried: &TriedShapes,
        terms: &[usize],
        weight: Weight,
        cost: &dyn Fn(&Method) -> Option<f64>,
    ) -> SearchResult {
        let choice = |terms: &usize| {
            let left_out = tried.leave_one_out(*terms);
            let choice = left_out.map(|left_out| ChoiceRow::new(class, *terms, &left_out));
            (*terms, choice)
        };
        SearchResult {
            class,
            tried: tried.tried.len(),
            materials: tried.substances.len(),
            substances: tried.substance_count(),
            shapes: best_shapes(class, tried, weight, cost),
            choices: terms.iter().map(choice).collect(),
        }
    }

    /// The rows of the JSON report: shapes first, choices after.
    pub fn search_rows(&self) -> impl Iterator<Item = SearchRow> {
        let choices = self.choices.iter().filter_map(|(_, choice)| choice.clone());
        let shapes = self.shapes.iter().cloned().map(SearchRow::Shape);
        shapes.chain(choices.map(SearchRow::Choice))
    }

    fn headline(&self) -> String {
        format!(
            "{}: {} shapes for {} measurements of {} substances",
            self.class.title(),
            self.tried,
            self.materials,
            self.substances
        )
    }
}

/// The shapes that nothing beats in operations and 90th percentile, and those of methods, the fewest operations first.
fn best_shapes(
    class: MaterialClass,
    tried: &TriedShapes,
    weight: Weight,
    cost: &dyn Fn(&Method) -> Option<f64>,
) -> Vec<ShapeRow> {
    let row = |shape: &Tried| {
        let cost = shape.candidate.method.and_then(cost);
        ShapeRow::new(class, tried, shape, weight, cost)
    };
    let mut rows: Vec<ShapeRow> = tried.tried.iter().map(row).collect();
    let point = |row: &ShapeRow| {
        Some(CostAndError {
            cost: row.operations as f64,
            error: row.errors.p90,
        })
    };
    let points: Vec<_> = rows.iter().map(point).collect();
    for place in pareto_frontier(&points) {
        rows[place].is_on_frontier = true;
    }
    rows.retain(|row| row.is_on_frontier || row.method.is_some());
    let order = |a: &ShapeRow, b: &ShapeRow| a.errors.p90.total_cmp(&b.errors.p90);
    rows.sort_by(|a, b| a.operations.cmp(&b.operations).then(order(a, b)));
    rows
}

impl ShapeRow {
    fn new(
        class: MaterialClass,
        all: &TriedShapes,
        tried: &Tried,
        weight: Weight,
        cost: Option<f64>,
    ) -> ShapeRow {
        let candidate = &tried.candidate;
        ShapeRow {
            row: "shape",
            class: class.name(),
            terms: candidate.shape.terms(),
            shape: candidate.shape.to_string(),
            family: candidate.family,
            method: method_name(candidate),
            weight: weight.name(),
            materials: all.substances.len(),
            substances: all.substance_count(),
            operations: candidate.operations(),
            cost,
            is_on_frontier: false,
            errors: ErrorQuantiles::new(&tried.errors, &all.substances),
            reason: cost.is_none().then_some("its cost is not recorded there"),
        }
    }
}

impl ChoiceRow {
    fn new(class: MaterialClass, terms: usize, left_out: &LeaveOneOut) -> ChoiceRow {
        let chosen = left_out.chosen.iter();
        let chosen = chosen.map(|(candidate, substances)| ChosenShape {
            shape: candidate.shape.to_string(),
            method: method_name(candidate),
            substances: *substances,
        });
        ChoiceRow {
            row: "choice",
            class: class.name(),
            terms,
            by: "p90 over the measurements of all other substances",
            shape: left_out.choice.shape.to_string(),
            method: method_name(&left_out.choice),
            errors: left_out.seen,
            errors_left_out: left_out.unseen,
            chosen: chosen.collect(),
        }
    }
}

fn method_name(candidate: &Candidate) -> Option<&'static str> {
    candidate.method.map(|method| method.name)
}

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
            result.headline(),
            shapes_text(&result.shapes, gpu),
            choices.collect::<String>()
        )
    };
    results.iter().map(one).collect::<Vec<_>>().join("\n")
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::candidates;

    #[test]
    fn what_is_beaten_is_left_out_unless_it_is_shipped() {
        let tried = candidates(4).into_iter().zip([1.0, 2.0]);
        let tried = tried.map(|(candidate, error)| Tried {
            candidate,
            errors: vec![error],
        });
        let tried = TriedShapes {
            substances: vec!["gold".to_owned()],
            tried: tried.collect(),
        };
        let rows = best_shapes(MaterialClass::Metals, &tried, Weight::default(), &|_| None);
        assert!(rows.iter().any(|row| row.is_on_frontier));
        assert!(rows.is_sorted_by_key(|row| row.operations));
    }
}
