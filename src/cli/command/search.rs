//! `fit --search`: shapes tried on the catalogue.

use crate::cli::args::FitFlags;
use crate::cli::error::Error;
use crate::generator::fit::{Candidate, FitCurve, FitObjective, FitProblem, TriedShapes, candidates, search};
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::lab::cost::{SEARCHED, SearchResult, SearchRow, SearchedClass, library_cost, records};
use crate::language::methods::Method;
use crate::physics::materials::{Material, find};
use crate::physics::num::in_parallel;
use crate::generator::envelope::Report;
use crate::cli::search_text::search_text;

use crate::cli::command::fit::subjects;
use crate::cli::command::{Output, Progress, report, try_places};

/// Searches.
pub(super) fn run(
    flags: &FitFlags,
    aim: FitObjective,
    progress: Progress,
) -> Result<Output, Error> {
    let terms = flags.terms.map_or(vec![4, 5], |terms| vec![terms]);
    try_places(flags.report.json(), None)?;
    let (subjects, mut remarks) = subjects(flags)?;
    let outside = subjects
        .iter()
        .filter(|subject| MaterialClass::containing(subject).is_none());
    remarks.extend(outside.map(|subject| {
        format!(
            "left out: {}: {OUTSIDE}",
            crate::physics::foreign::Foreign(&subject.argument)
        )
    }));
    let shapes: Vec<Candidate> = terms.iter().flat_map(|terms| candidates(*terms)).collect();
    let record = records(flags.gpu.name);
    let cost = |method: &Method| library_cost(method, flags.gpu, &record);
    let mut results = Vec::new();
    for class in &SEARCHED {
        let tried = tried_shapes(class, &subjects, &shapes, aim, progress);
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

/// Why a material takes no part.
const OUTSIDE: &str = "gases, dielectrics that absorb, and what is known at three wavelengths alone are in no class that shapes are for";

/// All shapes tried on the materials of a class; none where there are none.
fn tried_shapes(
    class: &SearchedClass,
    subjects: &[MaterialInMedium],
    shapes: &[Candidate],
    aim: FitObjective,
    progress: Progress,
) -> Option<TriedShapes> {
    let own = subjects.iter().filter(|subject| class.holds(subject));
    let own: Vec<&MaterialInMedium> = own.collect();
    let curve = |i: usize| FitCurve::unclipped(own[i]);
    let curves: Vec<FitCurve> = in_parallel(own.len(), &curve, &mut |done, whole| {
        progress(done, whole, "materials");
    });
    let tasks: Vec<FitProblem> = curves
        .iter()
        .map(|curve| FitProblem::new(curve, aim))
        .collect();
    let tried = search(shapes, &tasks, &mut |done, whole| {
        progress(done, whole, "shapes");
    });
    (!own.is_empty() && !tried.is_empty()).then(|| TriedShapes {
        substances: own
            .iter()
            .map(|subject| substance(&subject.material))
            .collect(),
        tried,
    })
}

/// What a material is: of the catalogue its substance, of a page besides it the book that it stands in, such as `main/Au`.
fn substance(material: &Material) -> String {
    let is_known = find(&material.substance).is_some();
    let mut parts = material.page.split('/');
    match (parts.next(), parts.next()) {
        (Some("main"), Some(book)) if !is_known => format!("main/{book}"),
        _ => material.substance.clone(),
    }
}
