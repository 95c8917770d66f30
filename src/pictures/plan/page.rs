//! The HTML page of a plan: for each material the choice and its reason, the angles with errors over them, and pictures.

use serde::Serialize;
use tera::Context;

use super::page_data::{AngleCurve, MaterialView, ViewPicture};
use super::report::{PlanReport, cost_exact, named};
use super::row::PlanRow;
use crate::pictures::html;
use crate::pictures::plot::{ChartAxis, LineChart, Look, Series, Style, ticks};
use crate::pictures::table::short_number;

const TEMPLATE: &str = include_str!("../../../templates/plan.html.tera");
/// A chart ends at this many times the budget, or above the chosen function's largest error.
const ABOVE_BUDGET: f64 = 4.0;
/// The height of the histogram, as a share of the chart.
const HISTOGRAM: f64 = 0.9;

const ANGLES: Look = Look {
    colour: "#9aa0a6",
    dashes: "",
    width: 1.2,
    dots: false,
};
const BUDGET: Look = Look {
    colour: "#c0392b",
    dashes: "2 4",
    width: 1.6,
    dots: false,
};

/// What the page says of a material.
#[derive(Serialize)]
struct Section<'a> {
    material: String,
    why: String,
    /// Facts about the choice, as pairs of name and text.
    facts: Vec<[String; 2]>,
    /// The chart as SVG.
    chart: String,
    pictures: &'a [ViewPicture],
    cheaper: Vec<[String; 3]>,
}

/// The page, or why it cannot be made.
///
/// # Errors
/// The template cannot be filled.
pub fn plan_page(report: &PlanReport, views: &[MaterialView]) -> Result<String, String> {
    let sections = report.rows.iter().zip(views);
    let sections = sections.map(|(row, view)| section(report, row, view));
    let sections: Vec<Section> = sections.collect();
    let mut context = Context::new();
    context.insert("sections", &sections);
    context.insert("unplanned", &report.unplanned);
    context.insert("remarks", &report.remarks);
    context.insert("total", &report.total());
    context.insert("cost_of", report.cost_of);
    context.insert("gpu", report.gpu);
    context.insert("unit", report.unit);
    context.insert("command", report.origin.command());
    html::fill(TEMPLATE, &context)
}

fn section<'a>(report: &PlanReport, row: &PlanRow, view: &'a MaterialView) -> Section<'a> {
    let fact = |name: &str, value: String| [name.to_owned(), value];
    let cheaper = row.cheaper.iter().map(|one| {
        let form = format!("{}, {}", one.method, one.form.name());
        [form, short_number(one.cost), format!("{:.4}", one.error)]
    });
    Section {
        material: named(row),
        why: row.why.clone(),
        facts: vec![
            fact("function", format!("{}, {}", row.method, row.form.name())),
            fact("error", format!("{:.4} {}", row.error, report.unit)),
            fact("cost", short_number(row.cost)),
            fact("the exact law costs", cost_exact(row)),
            fact("pixels of a frame", format!("{:.0}", row.pixels)),
            fact("worst frame (the first is 0)", row.worst_frame.to_string()),
        ],
        chart: chart(report, row, view).svg(),
        pictures: &view.pictures,
        cheaper: cheaper.collect(),
    }
}

/// The chart of errors over angles, above a histogram of the angles.
fn chart(report: &PlanReport, row: &PlanRow, view: &MaterialView) -> LineChart {
    let most = |curve: &AngleCurve| curve.points.iter().map(|(_, e)| *e).fold(0.0, f64::max);
    let all = view.curves.iter().map(most).fold(0.0, f64::max);
    let chosen = view.curves.first().map_or(0.0, most);
    let high = (1.05 * all).min((ABOVE_BUDGET * row.budget).max(1.2 * chosen));
    let high = if high > 0.0 { high } else { 1.0 };
    let largest = view.angles.iter().copied().fold(0.0, f64::max);
    let steps = view.angles.iter().enumerate().flat_map(|(degree, share)| {
        let y = HISTOGRAM * high * share / largest.max(f64::MIN_POSITIVE);
        [(degree as f64, y), (degree as f64 + 1.0, y)]
    });
    let mut series = vec![Series {
        name: format!(
            "pixels (highest: {} % a degree)",
            short_number(100.0 * largest)
        ),
        style: Style::Own(ANGLES),
        points: steps.collect(),
    }];
    let line = |(number, curve): (usize, &AngleCurve)| Series {
        name: curve.name.clone(),
        style: match number {
            0 => Style::Exact,
            other => Style::Approximate(other - 1),
        },
        points: curve.points.clone(),
    };
    series.extend(view.curves.iter().enumerate().map(line));
    series.push(Series {
        name: format!("budget, {}", row.budget),
        style: Style::Own(BUDGET),
        points: vec![(0.0, row.budget), (90.0, row.budget)],
    });
    LineChart {
        title: format!(
            "{}: what is seen, and what functions err there",
            row.material
        ),
        subtitle: format!(
            "the largest difference on screen in the pixels of each degree, frame {}; grey: how often an angle is seen in all frames",
            row.worst_frame
        ),
        x: ChartAxis::angle_of_incidence(),
        y: ChartAxis {
            label: format!("difference, {}", report.unit),
            low: 0.0,
            high,
            ticks: ticks(0.0, high, 5),
            unit: "",
        },
        series,
        marks: Vec::new(),
        foot: String::new(),
    }
}
