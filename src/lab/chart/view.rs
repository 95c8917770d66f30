//! Charts: a set of materials, a measure of error and a measure of cost, with a point for each function, the frontier, and the rows of
//! reports. Functions without a point, or with one that leaves materials out, are listed with the reason.

use std::collections::BTreeMap;

use serde::Serialize;

use super::sets::{LeftOutErrors, MaterialSet, left_out};
use crate::generator::fit::MethodErrors;
use crate::lab::cost::{CostAndError, input_numbers, pareto_frontier};
use crate::language::methods::{Contract, Method};

/// A measure of error.
#[derive(Clone, Copy, Debug)]
pub struct ErrorAxis {
    /// Its name on the command line and in reports.
    pub name: &'static str,
    /// The label of the axis.
    pub short: &'static str,
    /// Its description in full.
    pub title: &'static str,
    /// The error by this measure, where it is known.
    pub value: fn(&MethodErrors) -> Option<f64>,
}

/// All measures. The first is the default.
pub static ERRORS: [ErrorAxis; 4] = [
    ErrorAxis {
        name: "max",
        short: "largest error",
        title: "largest error of reflectance, over angles and channels",
        value: |errors| errors.max_abs,
    },
    ErrorAxis {
        name: "mean-rel",
        short: "mean relative error",
        title: "mean relative error, over angles and channels, as the thesis measures",
        value: |errors| errors.mean_rel,
    },
    ErrorAxis {
        name: "luminance",
        short: "largest error of luminance",
        title: "largest error of luminance, over angles",
        value: |errors| errors.luminance,
    },
    ErrorAxis {
        name: "de2000",
        short: "largest difference, CIEDE2000",
        title: "largest difference of colour, CIEDE2000, over angles",
        value: |errors| errors.de2000,
    },
];

/// A function on the chart: a method with its intended inputs or with those of the smallest largest error, or a user's own.
#[derive(Clone, Debug)]
pub struct ChartEntry {
    /// The method, or the user's function.
    pub function: FunctionOrigin,
    /// Whether its inputs are the best ones, not the intended ones.
    pub is_best: bool,
    /// Texture fetches, which instruction counts do not include.
    pub fetches: usize,
}

/// The origin of a function.
#[derive(Clone, Debug)]
pub enum FunctionOrigin {
    /// A method's.
    Method(&'static Method),
    /// A user's.
    User(UserFunction),
}

/// A user's function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserFunction {
    /// Its name.
    pub name: String,
    /// A description: a sentence without its full stop.
    pub about: String,
    /// What is wrong with it, if anything.
    pub fails: Option<String>,
    /// Why its cost is not comparable with ours, if it is not.
    pub no_cost: Option<String>,
    /// How many numbers describe a material in it.
    pub input_numbers: usize,
}

/// An axis of cost: that of an evaluation, by one measure.
#[derive(Clone, Debug, Serialize)]
pub struct CostAxis {
    /// Its name on the command line: a family of GPUs, or `time`.
    pub name: &'static str,
    /// The label of the axis.
    pub title: String,
    /// Whether the figure includes the cost of texture fetches.
    pub holds_fetches: bool,
    /// The cost of each entry's function. None where it is not known.
    pub costs: Vec<Option<f64>>,
}

/// The data of all charts.
#[derive(Clone, Debug)]
pub struct ChartData {
    /// The functions.
    pub entries: Vec<ChartEntry>,
    /// The axes of cost.
    pub costs: Vec<CostAxis>,
    /// The sets of materials.
    pub sets: Vec<MaterialSet>,
    /// The command that makes the charts.
    pub command: String,
}

/// One of the charts: a set of materials, a measure of cost, and a measure of error.
#[derive(Clone, Copy, Debug)]
pub struct ChartView<'a> {
    /// All data.
    pub data: &'a ChartData,
    /// The set.
    pub set: &'a MaterialSet,
    /// The cost.
    pub cost: &'a CostAxis,
    /// The index of the measure of error in [`ERRORS`].
    pub error: usize,
}

/// A point of a chart.
#[derive(Clone, Copy, Debug)]
pub struct ChartPoint<'a> {
    /// The function.
    pub entry: &'a ChartEntry,
    /// Its cost.
    pub cost: f64,
    /// Its error.
    pub error: f64,
    /// Whether no point is better in one and as good in the other.
    pub is_on_frontier: bool,
}

/// A point in a JSON report.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct PointRow<'a> {
    material: &'a str,
    method: &'a str,
    inputs: &'static str,
    input_numbers: usize,
    gpu: &'static str,
    cost: f64,
    fetches: usize,
    error: &'static str,
    value: f64,
    is_on_frontier: bool,
    fails: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<LeftOutErrors>,
}

/// The smallest error that is drawn. Smaller ones are drawn here and count as equal, since no index was ever measured so well.
pub const LEAST_ERROR: f64 = 1e-5;

impl<'a> ChartView<'a> {
    /// The points, by cost, then by error. Some take no part in the frontier and keep no other point from it: functions that read
    /// a texture, where the cost does not include fetches, and methods that fail inside their domain.
    pub fn points(&self) -> Vec<ChartPoint<'a>> {
        let entries = self.data.entries.iter().enumerate();
        let known = entries.filter_map(|(place, entry)| {
            Some(ChartPoint {
                entry,
                cost: self.cost.costs[place]?,
                error: self.error_of(place)?,
                is_on_frontier: false,
            })
        });
        let mut points: Vec<ChartPoint<'a>> = known.collect();
        points.sort_by(|a, b| {
            let order = a.cost.total_cmp(&b.cost).then(a.error.total_cmp(&b.error));
            order.then_with(|| a.entry.label().cmp(&b.entry.label()))
        });
        let compared = |point: &ChartPoint| {
            self.compares(point.entry).then(|| CostAndError {
                cost: point.cost,
                error: drawn(point.error),
            })
        };
        let compared: Vec<Option<CostAndError>> = points.iter().map(compared).collect();
        for place in pareto_frontier(&compared) {
            points[place].is_on_frontier = true;
        }
        points
    }

    /// The error of an entry by the view's measure.
    fn error_of(&self, place: usize) -> Option<f64> {
        (ERRORS[self.error].value)(&self.set.errors[place])
    }

    fn compares(&self, entry: &ChartEntry) -> bool {
        (entry.fetches == 0 || self.cost.holds_fetches) && entry.fails().is_none()
    }

    /// What a user's function lacks for a point of this chart: its error or its cost.
    pub fn lacks(&self) -> Option<String> {
        let rows = self.data.entries.iter().enumerate();
        let mut own = rows.filter_map(|(place, entry)| Some((place, entry.user()?)));
        let (place, user) = own.next()?;
        let why = match (self.error_of(place), self.cost.costs[place]) {
            (None, _) => "its error is not known",
            (_, None) => user.no_cost.as_deref().unwrap_or("its cost is not known"),
            _ => return None,
        };
        Some(format!("{} has no point here: {why}.", user.name))
    }

    /// The title of the chart: one line that begins with the set's title.
    pub fn title(&self) -> String {
        let (set, error) = (&self.set.title, ERRORS[self.error].title);
        format!("{set}: {error}, against cost")
    }

    /// A row of the report for each point.
    pub fn point_rows(&self) -> Vec<PointRow<'a>> {
        let error = ERRORS[self.error].name;
        let row = |point: ChartPoint<'a>| PointRow {
            material: &self.set.name,
            method: point.entry.name(),
            inputs: point.entry.inputs(),
            input_numbers: point.entry.input_numbers(),
            gpu: self.cost.name,
            cost: point.cost,
            fetches: point.entry.fetches,
            error,
            value: point.error,
            is_on_frontier: point.is_on_frontier,
            fails: point.entry.fails(),
            left_out: match error {
                "max" => point.entry.left_out(self.set),
                _ => None,
            },
        };
        self.points().into_iter().map(row).collect()
    }
}

impl ChartEntry {
    /// The left-out errors of a method with its intended inputs: those by numbers that were chosen without the substance.
    fn left_out(&self, set: &MaterialSet) -> Option<LeftOutErrors> {
        let method = self.method().filter(|_| !self.is_best);
        method.and_then(|method| left_out(method, set))
    }

    /// Its method, unless it is a user's.
    pub fn method(&self) -> Option<&'static Method> {
        match self.function {
            FunctionOrigin::Method(method) => Some(method),
            FunctionOrigin::User(_) => None,
        }
    }

    /// The user's function, if it is one.
    pub fn user(&self) -> Option<&UserFunction> {
        match &self.function {
            FunctionOrigin::Method(_) => None,
            FunctionOrigin::User(user) => Some(user),
        }
    }

    /// The name of its method, or its own.
    pub fn name(&self) -> &str {
        match &self.function {
            FunctionOrigin::Method(method) => method.name,
            FunctionOrigin::User(user) => &user.name,
        }
    }

    /// Its name on charts, with a star where its inputs are the best ones, or a word where it is a user's.
    pub fn label(&self) -> String {
        let mark = match (&self.function, self.is_best) {
            (FunctionOrigin::User(_), _) => " (yours)",
            (_, true) => "*",
            (_, false) => "",
        };
        format!("{}{mark}", self.name())
    }

    /// Where it fails, if it does not keep the contract of functions.
    pub fn fails(&self) -> Option<&str> {
        match &self.function {
            FunctionOrigin::User(user) => user.fails.as_deref(),
            FunctionOrigin::Method(method) => match method.contract {
                Contract::Kept => None,
                Contract::Exempt(why) => Some(why),
            },
        }
    }

    /// Whether its formula is ours.
    pub fn is_ours(&self) -> bool {
        self.method().is_some_and(Method::is_ours)
    }

    /// Whether its coefficients are fitted to a material.
    pub fn is_fitted(&self) -> bool {
        self.method().is_some_and(Method::is_fitted)
    }

    /// How many numbers describe a material in it.
    pub fn input_numbers(&self) -> usize {
        match &self.function {
            FunctionOrigin::User(user) => user.input_numbers,
            FunctionOrigin::Method(method) => input_numbers(method),
        }
    }

    /// One word for its inputs, or for a user's function.
    pub fn inputs(&self) -> &'static str {
        match (&self.function, self.is_best) {
            (FunctionOrigin::User(_), _) => "yours",
            (FunctionOrigin::Method(method), _) if method.is_fitted() => "fitted",
            (_, true) => "best",
            (_, false) => "intended",
        }
    }
}

/// The position at which an error is drawn, at least [`LEAST_ERROR`].
pub fn drawn(error: f64) -> f64 {
    error.max(LEAST_ERROR)
}

/// A sentence for each reason why functions have no complete point on a chart, with their names.
pub fn without_point(view: &ChartView) -> Vec<String> {
    let entries = view.data.entries.iter().enumerate();
    let functions = entries.filter(|(_, entry)| !entry.is_best);
    let mut reasons: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (place, entry) in functions {
        if let Some(why) = reason(view, place, entry) {
            reasons.entry(why).or_default().push(entry.name());
        }
    }
    let sentence = |(why, names): (String, Vec<&str>)| format!("{}: {why}.", names.join(", "));
    reasons.into_iter().map(sentence).collect()
}

fn reason(view: &ChartView, place: usize, entry: &ChartEntry) -> Option<String> {
    let (undescribed, count) = (&view.set.undescribed[place], view.set.count);
    let has_error = view.error_of(place).is_some();
    let Some(method) = entry.method() else {
        // The reason of a user's function without a point is stated elsewhere.
        let is_part = has_error && !undescribed.is_empty();
        let undescribed = undescribed.join(", ");
        return is_part.then(|| format!("shown without {undescribed}: it gives no number there"));
    };
    let described = method.class.described();
    if !undescribed.is_empty() {
        let of = match (undescribed.len(), count) {
            (_, 1) => "this is none".to_owned(),
            (some, all) if some == all => "none of these is one".to_owned(),
            (some, all) if !has_error => format!("{some} of these {all} are none"),
            _ => {
                let undescribed = undescribed.join(", ");
                return Some(format!("shown without {undescribed}, of {described} only"));
            }
        };
        return Some(format!("only for {described}, and {of}"));
    }
    if !has_error {
        return Some("this error is not measured of what reads a texture".to_owned());
    }
    let unknown = view.cost.costs[place].is_none();
    unknown.then(|| format!("costs nothing or is not recorded on {}", view.cost.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_is_compared_only_where_its_fetch_is_counted() {
        let method = |name| crate::language::methods::find(name).expect("it is there");
        let entry = |name, fetches| ChartEntry {
            function: FunctionOrigin::Method(method(name)),
            is_best: false,
            fetches,
        };
        let largest = |error| MethodErrors {
            max_abs: Some(error),
            ..MethodErrors::default()
        };
        let mut data = ChartData {
            entries: vec![entry("table", 1), entry("schlick", 0)],
            costs: vec![CostAxis {
                name: "rdna2",
                title: String::new(),
                holds_fetches: false,
                costs: vec![Some(1.0), Some(2.0)],
            }],
            sets: vec![MaterialSet {
                count: 1,
                name: "gold".to_owned(),
                title: "gold".to_owned(),
                undescribed: vec![Vec::new(), Vec::new()],
                errors: [0.1, 0.2].map(largest).to_vec(),
            }],
            command: String::new(),
        };
        let best = |data: &ChartData| -> Vec<String> {
            let (set, cost) = (&data.sets[0], &data.costs[0]);
            let view = ChartView {
                data,
                set,
                cost,
                error: 0,
            };
            let points = view.points().into_iter();
            let best = points.filter(|point| point.is_on_frontier);
            best.map(|point| point.entry.label()).collect()
        };
        assert_eq!(best(&data), ["schlick"]);
        data.costs[0].holds_fetches = true;
        assert_eq!(best(&data), ["table"]);
    }
}
