//! `fit --search`: tries families of shapes on the catalogue.

use crate::cli::error::Error;
use crate::cli::fit::{FitFlags, subjects};
use crate::cli::output::{Output, Progress, report};
use crate::cli::places::try_places;
use crate::generator::envelope::Report;
use crate::generator::fit::{
    Candidate, ErrorQuantiles, FitCurve, FitObjective, FitProblem, TriedShapes, candidates, search,
};
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::lab::cost::{
    ChoiceRow, SEARCHED, SearchResult, SearchRow, SearchedClass, ShapeRow, library_cost, records,
};
use crate::physics::materials::{Material, find};
use crate::physics::num::in_parallel;
use crate::pictures::table::{self, short_number};

/// Searches.
pub(super) fn run(
    flags: &FitFlags,
    aim: FitObjective,
    progress: Progress,
) -> Result<Output, Error> {
    let terms = flags.terms.map_or(vec![4, 5], |terms| vec![terms]);
    if terms.contains(&6) {
        return Err(Error::usage("a search has forms with 4 or 5 coefficients"));
    }
    try_places(flags.report.json(), None)?;
    let (materials, mut remarks) = subjects(flags)?;
    let outside = materials
        .iter()
        .filter(|material| MaterialClass::containing(material).is_none());
    remarks.extend(outside.map(|material| {
        format!(
            "left out: {}: {OUTSIDE}",
            crate::physics::foreign::Foreign(&material.argument)
        )
    }));
    let shapes: Vec<Candidate> = terms.iter().flat_map(|terms| candidates(*terms)).collect();
    let record = records(flags.gpu.name);
    let cost = |method| library_cost(method, flags.gpu, &record);
    let mut results = Vec::new();
    for class in &SEARCHED {
        let tried = tried_shapes(class, &materials, &shapes, aim, progress);
        let result = |tried| SearchResult::new(class, &tried, &terms, aim.weight, &cost);
        results.extend(tried.map(result));
    }
    if results.is_empty() {
        let what = format!("there is no material to search shapes for: {OUTSIDE}");
        return Err(Error::usage(what));
    }
    let rows: Vec<SearchRow> = results.iter().flat_map(SearchResult::search_rows).collect();
    let command = flags.command_line(&flags.gamut.conditions()?);
    let json = Report::new(command, rows);
    let text = search_text(&results, flags.gpu.name);
    let mut output = report(text, &json, flags.report.json())?;
    output.remarks = remarks;
    Ok(output)
}

/// Why a material is left out.
const OUTSIDE: &str = "gases, dielectrics that absorb, and what is known at three wavelengths alone are in no class that shapes are for";

/// All shapes, tried on the materials of a class; `None` where it has no materials.
fn tried_shapes(
    class: &SearchedClass,
    materials: &[MaterialInMedium],
    shapes: &[Candidate],
    aim: FitObjective,
    progress: Progress,
) -> Option<TriedShapes> {
    let own = materials.iter().filter(|material| class.holds(material));
    let own: Vec<&MaterialInMedium> = own.collect();
    let curve = |i: usize| FitCurve::unclipped(own[i]);
    let curves: Vec<FitCurve> = in_parallel(own.len(), &curve, &mut |done, whole| {
        progress(done, whole, "materials");
    });
    let tasks = curves.iter().map(|curve| FitProblem::new(curve, aim));
    let tasks: Vec<FitProblem> = tasks.collect();
    let tried = search(shapes, &tasks, &mut |done, whole| {
        progress(done, whole, "shapes");
    });
    let substances = own.iter().map(|material| substance(&material.material));
    (!own.is_empty() && !tried.is_empty()).then(|| TriedShapes {
        substances: substances.collect(),
        tried,
    })
}

/// The substance of a material. A page from outside the catalogue is identified by its book, such as `main/Au`.
fn substance(material: &Material) -> String {
    let is_known = find(&material.substance).is_some();
    let mut parts = material.page.split('/');
    match (parts.next(), parts.next()) {
        (Some("main"), Some(book)) if !is_known => format!("main/{book}"),
        _ => material.substance.clone(),
    }
}

/// The report for a terminal. A star marks a shape if none with fewer operations is as accurate.
fn search_text(results: &[SearchResult], gpu: &str) -> String {
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

/// The meaning of the first column.
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

/// The results of leaving out each substance in turn.
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
