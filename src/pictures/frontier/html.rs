//! The HTML page with all charts, where a reader chooses the set, the axes and what is shown. Self-contained, for any browser.

use serde::Serialize;
use tera::Context;

use crate::generator::fit::MethodErrors;
use crate::lab::chart::{ChartData, ChartEntry, CostAxis, ERRORS, FunctionOrigin, LEAST_ERROR};
use crate::pictures::html;

static TEMPLATE: &str = include_str!("../../../templates/chart.html.tera");

/// The data that the page's script reads.
#[derive(Serialize)]
struct PageData<'a> {
    least_error: f64,
    as_near: f64,
    entries: Vec<EntryColumns<'a>>,
    errors: [[&'static str; 2]; 4],
    costs: &'a [CostAxis],
    sets: Vec<SetColumns<'a>>,
}

#[derive(Serialize)]
struct EntryColumns<'a> {
    label: String,
    inputs: &'static str,
    input_numbers: usize,
    summary: &'a str,
    source: String,
    fetches: usize,
    fails: Option<&'a str>,
    is_ours: bool,
    describes: Option<&'static str>,
    no_cost: Option<&'a str>,
}

#[derive(Serialize)]
struct SetColumns<'a> {
    name: &'a str,
    title: &'a str,
    count: usize,
    undescribed: &'a [Vec<String>],
    errors: Vec<[Option<f64>; 4]>,
}

/// The page, or why it cannot be made. It opens with this set, cost and error.
///
/// # Errors
/// The page's template cannot be filled.
pub fn chart_page(data: &ChartData, [set, cost, error]: [usize; 3]) -> Result<String, String> {
    let mut context = Context::new();
    context.insert("data", &html::script_json(&page_data(data))?);
    context.insert("first", &[set, cost, error]);
    context.insert("command", &data.command);
    let user = data.entries.iter().find_map(ChartEntry::user);
    context.insert("user", &user.map(|user| &user.name));
    html::fill(TEMPLATE, &context)
}

fn page_data(data: &ChartData) -> PageData<'_> {
    let sets = data.sets.iter().map(|set| SetColumns {
        name: &set.name,
        title: &set.title,
        count: set.count,
        undescribed: &set.undescribed,
        errors: set.errors.iter().map(four_digits).collect(),
    });
    PageData {
        least_error: LEAST_ERROR,
        as_near: crate::lab::cost::TIE,
        entries: data.entries.iter().map(entry_columns).collect(),
        errors: ERRORS.map(|error| [error.short, error.title]),
        costs: &data.costs,
        sets: sets.collect(),
    }
}

fn entry_columns(entry: &ChartEntry) -> EntryColumns<'_> {
    let (summary, source) = match &entry.function {
        FunctionOrigin::Method(method) => (method.summary, method.source_in_full()),
        FunctionOrigin::User(user) => (user.about.as_str(), String::new()),
    };
    EntryColumns {
        label: entry.label(),
        inputs: entry.inputs(),
        input_numbers: entry.input_numbers(),
        summary,
        source,
        fetches: entry.fetches,
        fails: entry.fails(),
        is_ours: entry.is_ours(),
        describes: entry.method().map(|method| method.class.described()),
        no_cost: entry.user().and_then(|user| user.no_cost.as_deref()),
    }
}

/// Each error with four significant digits, as much as a reader can see of a point on a page.
pub fn four_digits(errors: &MethodErrors) -> [Option<f64>; 4] {
    ERRORS.map(|axis| {
        let error = (axis.value)(errors)?;
        format!("{error:.3e}").parse().ok()
    })
}
