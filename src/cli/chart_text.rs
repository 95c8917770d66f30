//! The chart for a terminal: its points as a table, and what follows from them in a sentence each.

use crate::lab::chart::{ChartPoint, ChartView, ERRORS, without_point};
use crate::pictures::plot::capital;
use crate::pictures::table::{self, short_number};

/// The points by cost, the frontier marked, and the headline.
pub fn chart_text(view: &ChartView) -> String {
    let head = [
        "",
        "method",
        "inputs",
        "cost",
        ERRORS[view.error].name,
        "fetches",
    ];
    let points = view.points();
    let rows: Vec<Vec<String>> = points.iter().map(cells).collect();
    format!(
        "{}\nCost: {}.\n\n{}\nA star marks the frontier: what errs less costs more, and what costs less errs more.\n\
         Left out:\n{}{}\n{}",
        capital(&view.title()),
        view.cost.title,
        table::text_table(&head, &rows),
        absent(view),
        failing(&points),
        gains_of_ours(view)
    )
}

/// The methods that have no point, or one without some materials: a line a reason.
fn absent(view: &ChartView) -> String {
    let lines = without_point(view).into_iter();
    lines.map(|line| format!("  {line}\n")).collect()
}

/// A remark on each method that fails: the frontier is without it.
fn failing(points: &[ChartPoint]) -> String {
    let own = points.iter().filter(|point| !point.entry.is_best);
    let remark = |point: &ChartPoint| {
        let why = point.entry.fails()?;
        Some(format!(
            "{} fails, and takes no part in that: {why}.\n",
            point.entry.name()
        ))
    };
    own.filter_map(remark).collect()
}

fn cells(point: &ChartPoint) -> Vec<String> {
    let star = if point.is_on_frontier { "*" } else { "" };
    vec![
        star.to_owned(),
        point.entry.name().to_owned(),
        point.entry.inputs().to_owned(),
        short_number(point.cost),
        short_number(point.error),
        point.entry.fetches.to_string(),
    ]
}

/// What a method of ours gains on a competitor with its intended inputs and with its best ones, at which part of its cost: of each against
/// the nearest competitor that is no cheaper than it by more than a tenth.
fn gains_of_ours(view: &ChartView) -> String {
    let points = view.points();
    let ours = points
        .iter()
        .filter(|point| point.entry.is_ours() && !point.entry.is_best);
    ours.filter_map(|our| sentence(our, &points)).collect()
}

fn sentence(our: &ChartPoint, points: &[ChartPoint]) -> Option<String> {
    let is_competitor = |point: &&ChartPoint| {
        let is_published = point.entry.method().is_some_and(|method| !method.is_ours());
        let is_cheap = our.cost <= 1.1 * point.cost && point.cost <= 2.0 * our.cost;
        is_published && point.entry.fetches == 0 && is_cheap && our.error < point.error
    };
    let competitors: Vec<&ChartPoint> = points.iter().filter(is_competitor).collect();
    let intended = competitors.iter().filter(|point| !point.entry.is_best);
    let nearest = intended.min_by(|a, b| a.error.total_cmp(&b.error))?;
    let is_same =
        |point: &&&ChartPoint| point.entry.is_best && point.entry.name() == nearest.entry.name();
    let best = competitors.iter().find(is_same);
    let best = best.map_or(String::new(), |best| {
        format!(", {} with its best", times(best.error / our.error))
    });
    Some(format!(
        "{} errs {} less than {} with its intended inputs{best}, at {} of its cost.\n",
        our.entry.name(),
        times(nearest.error / our.error),
        nearest.entry.name(),
        short_number(our.cost / nearest.cost),
    ))
}

fn times(ratio: f64) -> String {
    format!("{} times", short_number(ratio))
}
