//! The same for people and for scripts.

use serde_json::{Value, json};

use crate::fit::{Aim, Candidate};
use crate::methods::Method;
use crate::report::frontier::figure;
use crate::report::{class_title, table};

use super::{Errors, Figures, LeftOut};

/// What is told of a class of materials.
#[derive(Clone, Debug)]
pub struct Told {
    /// `metals`, with semiconductors, or `dielectrics`.
    pub class: &'static str,
    /// The errors.
    pub errors: Errors,
}

/// How a method's cost is known.
type Cost<'a> = &'a dyn Fn(&Method) -> Option<f64>;

/// The report for a terminal; a star where nothing with fewer operations comes as near.
pub fn text(told: &[Told], terms: &[usize], gpu: &str, cost: Cost) -> String {
    let one = |told: &Told| {
        format!(
            "{}\n\n{}{}",
            headline(told),
            shapes(told, gpu, cost),
            choices(told, terms)
        )
    };
    told.iter().map(one).collect::<Vec<_>>().join("\n")
}

fn headline(told: &Told) -> String {
    let (materials, substances) = (told.errors.substances.len(), told.errors.count());
    format!(
        "{}: {} shapes for {materials} measurements of {substances} substances",
        class_title(told.class),
        told.errors.tried.len(),
    )
}

fn shapes(told: &Told, gpu: &str, cost: Cost) -> String {
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
    let cells = |row: &super::Row| {
        let figures = row.figures;
        let mut cells = vec![
            if row.is_best { "*" } else { "" }.to_owned(),
            name(&row.candidate).unwrap_or_default().to_owned(),
            row.candidate.shape.terms().to_string(),
            row.operations.to_string(),
        ];
        cells.extend(listed(&figures));
        cells.push(row.cost.map_or_else(String::new, figure));
        cells.push(row.candidate.shape.to_string());
        cells
    };
    let rows: Vec<_> = told.errors.rows(cost).iter().map(cells).collect();
    table::text(&head, &rows)
}

fn name(candidate: &Candidate) -> Option<&'static str> {
    candidate.method.map(|method| method.name)
}

fn listed(figures: &Figures) -> [String; 5] {
    let Figures {
        median,
        p90,
        worst,
        median_vote,
        p90_vote,
    } = *figures;
    [median, p90, worst, median_vote, p90_vote].map(figure)
}

/// Leaving out one substance after the other, for each number of coefficients.
fn choices(told: &Told, terms: &[usize]) -> String {
    let of = |terms: &usize| match told.errors.left_out(*terms) {
        Some(left_out) => choice(*terms, &left_out),
        None => format!("\n{terms} coefficients: a choice is judged by two substances or more\n"),
    };
    terms.iter().map(of).collect()
}

fn choice(terms: usize, left_out: &LeftOut) -> String {
    let head = [
        "errors of",
        "median",
        "90 % within",
        "worst",
        "median by substance",
        "90 % by substance",
    ];
    let row = |of: &str, figures: &Figures| {
        let mut cells = vec![of.to_owned()];
        cells.extend(listed(figures));
        cells
    };
    let rows = [
        row("those who chose", &left_out.seen),
        row("the substance left out", &left_out.unseen),
    ];
    let chosen = left_out.chosen.iter();
    let chosen = chosen.map(|(candidate, times)| format!("  {times} times {}\n", candidate.shape));
    format!(
        "\n{terms} coefficients, the shape with the least 90th percentile over all others, for each substance:\n{}{}",
        table::text(&head, &rows),
        chosen.collect::<String>()
    )
}

/// The rows of the JSON report: shapes first, choices after.
pub fn json(told: &[Told], terms: &[usize], aim: Aim, cost: Cost) -> Vec<Value> {
    let mut rows = Vec::new();
    for one in told {
        rows.extend(shapes_json(one, aim, cost));
        rows.extend(terms.iter().filter_map(|terms| choice_json(one, *terms)));
    }
    rows
}

fn shapes_json(told: &Told, aim: Aim, cost: Cost) -> Vec<Value> {
    let row = |row: &super::Row| {
        let mut shape = json!({
            "row": "shape", "class": told.class, "terms": row.candidate.shape.terms(),
            "shape": row.candidate.shape.to_string(), "family": row.candidate.family,
            "method": name(&row.candidate), "weight": aim.weight.name(),
            "materials": told.errors.substances.len(), "substances": told.errors.count(),
            "operations": row.operations, "cost": row.cost, "is_on_frontier": row.is_best,
            "errors": figures_json(&row.figures),
        });
        if row.cost.is_none() {
            shape["reason"] = json!("its cost is not recorded there");
        }
        shape
    };
    told.errors.rows(cost).iter().map(row).collect()
}

fn choice_json(told: &Told, terms: usize) -> Option<Value> {
    let left_out = told.errors.left_out(terms)?;
    let chosen = left_out.chosen.iter().map(|(candidate, times)| {
        json!({ "shape": candidate.shape.to_string(), "method": name(candidate), "substances": times })
    });
    Some(json!({
        "row": "choice", "class": told.class, "terms": terms, "by": "p90 over the measurements of all other substances",
        "shape": left_out.choice.shape.to_string(), "method": name(&left_out.choice),
        "errors": figures_json(&left_out.seen), "errors_left_out": figures_json(&left_out.unseen),
        "chosen": chosen.collect::<Vec<Value>>(),
    }))
}

fn figures_json(figures: &Figures) -> Value {
    json!({
        "median": figures.median, "p90": figures.p90, "worst": figures.worst,
        "median_by_substance": figures.median_vote, "p90_by_substance": figures.p90_vote,
    })
}
