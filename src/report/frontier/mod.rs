//! Error against cost: every method a point, and the frontier of those that nothing beats in both.

mod labels;
#[cfg(feature = "cli")]
mod page;
mod svg;
mod text;

use serde_json::{Value, json};

use crate::methods::{Contract, Method};

#[cfg(feature = "cli")]
pub use page::page;
pub use svg::svg;
pub(super) use text::figure;
pub use text::{headline, text};

/// How error is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ErrorAxis {
    /// Its name on the command line and in reports.
    pub name: &'static str,
    /// What stands along the axis.
    pub short: &'static str,
    /// What it is, in full.
    pub title: &'static str,
}

/// All of them; the first is the default.
pub static ERRORS: [ErrorAxis; 4] = [
    ErrorAxis {
        name: "max",
        short: "largest error",
        title: "largest error of reflectance, over angles and channels",
    },
    ErrorAxis {
        name: "mean-rel",
        short: "mean relative error",
        title: "mean relative error, over angles and channels, as the thesis measures",
    },
    ErrorAxis {
        name: "luminance",
        short: "largest error of luminance",
        title: "largest error of luminance, over angles",
    },
    ErrorAxis {
        name: "de2000",
        short: "largest difference, CIEDE2000",
        title: "largest difference of colour, CIEDE2000, over angles",
    },
];

/// A function on the chart: a method with its intended inputs, or with those whose largest error is least.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The method.
    pub method: &'static Method,
    /// Whether its inputs are the best ones, not those that it was meant to have.
    pub is_best: bool,
    /// Texture fetches, whose cost no count shows.
    pub fetches: usize,
}

/// What an evaluation costs somewhere.
#[derive(Clone, Debug)]
pub struct CostAxis {
    /// Its name on the command line: a family of GPUs, or `time`.
    pub name: &'static str,
    /// What stands along the axis.
    pub title: String,
    /// Whether the figure holds what a texture fetch costs.
    pub holds_fetches: bool,
    /// The cost of each entry's method; none where it is not known.
    pub costs: Vec<Option<f64>>,
}

/// A material, or many of them taken together.
#[derive(Clone, Debug)]
pub struct Set {
    /// Its name on the page: a material's, or a class with how it is taken together.
    pub name: String,
    /// In words.
    pub title: String,
    /// For each entry the error on each of [`ERRORS`]; none where the method does not describe it.
    pub errors: Vec<[Option<f64>; 4]>,
}

/// All that the charts show.
#[derive(Clone, Debug)]
pub struct Data {
    /// The functions.
    pub entries: Vec<Entry>,
    /// The axes of cost.
    pub costs: Vec<CostAxis>,
    /// What errors are of.
    pub sets: Vec<Set>,
    /// The command that makes it.
    pub command: String,
}

/// One chart of them: which set, by which cost, by which error.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// All data.
    pub data: &'a Data,
    /// The set.
    pub set: &'a Set,
    /// The cost.
    pub cost: &'a CostAxis,
    /// Which of [`ERRORS`].
    pub error: usize,
}

/// A point of a chart.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// The function.
    pub entry: Entry,
    /// Its cost.
    pub cost: f64,
    /// Its error.
    pub error: f64,
    /// Whether nothing is better in one and as good in the other.
    pub is_on_frontier: bool,
}

/// What errs by less is drawn here, and is as good: no index was ever measured so well.
const LEAST_ERROR: f64 = 1e-5;

impl<'a> View<'a> {
    /// The points, by cost, then by error. Where the figure does not hold what a fetch costs, what reads a texture is not on
    /// the frontier, and keeps nothing from it; nor does a method that fails inside its domain.
    pub fn points(&self) -> Vec<Point> {
        let rows = self.data.entries.iter().enumerate();
        let known = rows.filter_map(|(place, entry)| {
            let error = self.set.errors[place][self.error]?;
            Some((*entry, self.cost.costs[place]?, error))
        });
        let mut known: Vec<(Entry, f64, f64)> = known.collect();
        known.sort_by(|a, b| {
            let order = a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2));
            order.then(a.0.label().cmp(&b.0.label()))
        });
        let compared: Vec<Option<(f64, f64)>> = known
            .iter()
            .map(|(entry, cost, error)| self.compares(entry).then_some((*cost, drawn(*error))))
            .collect();
        let best = frontier(&compared);
        let point = |(place, (entry, cost, error)): (usize, &(Entry, f64, f64))| Point {
            entry: *entry,
            cost: *cost,
            error: *error,
            is_on_frontier: best.contains(&place),
        };
        known.iter().enumerate().map(point).collect()
    }

    fn compares(&self, entry: &Entry) -> bool {
        (entry.fetches == 0 || self.cost.holds_fetches) && entry.fails().is_none()
    }

    /// What the chart shows, in one line.
    pub fn title(&self) -> String {
        let (set, error) = (&self.set.title, ERRORS[self.error].title);
        capital(&format!("{set}: {error}, against cost"))
    }

    /// A row of the report for each point.
    pub fn json(&self) -> Vec<Value> {
        let row = |point: &Point| {
            json!({
                "material": self.set.name, "method": point.entry.method.name,
                "inputs": point.entry.inputs(), "gpu": self.cost.name, "cost": point.cost,
                "fetches": point.entry.fetches, "error": ERRORS[self.error].name, "value": point.error,
                "is_on_frontier": point.is_on_frontier, "fails": point.entry.fails(),
            })
        };
        self.points().iter().map(row).collect()
    }
}

impl Entry {
    /// Its name on charts: a star where its inputs are the best ones.
    pub fn label(&self) -> String {
        let star = if self.is_best { "*" } else { "" };
        format!("{}{star}", self.method.name)
    }

    /// Where its method fails, if it breaks the contract of functions.
    pub fn fails(&self) -> Option<&'static str> {
        match self.method.contract {
            Contract::Kept => None,
            Contract::Exempt(why) => Some(why),
        }
    }

    /// Which inputs it has, in one word.
    pub fn inputs(&self) -> &'static str {
        match (self.method.is_fitted(), self.is_best) {
            (true, _) => "fitted",
            (false, true) => "best",
            (false, false) => "intended",
        }
    }
}

/// Where an error is drawn.
fn drawn(error: f64) -> f64 {
    error.max(LEAST_ERROR)
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// What errs by less than this share less is as near: nobody pays for it.
const AS_NEAR: f64 = 0.01;

/// The places of those that nothing beats, in a walk from the cheapest: each is nearer than all before it by what counts.
/// Two that cost and err the same stand both. What is not known takes no part.
pub fn frontier(points: &[Option<(f64, f64)>]) -> Vec<usize> {
    let places = points.iter().enumerate();
    let mut known: Vec<(usize, (f64, f64))> = places
        .filter_map(|(place, point)| Some((place, (*point)?)))
        .collect();
    known.sort_by(|(_, a), (_, b)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut best: Vec<(usize, (f64, f64))> = Vec::new();
    for (place, point) in known {
        let is_better =
            |last: &(usize, (f64, f64))| point == last.1 || point.1 * (1.0 + AS_NEAR) < last.1.1;
        if best.last().is_none_or(is_better) {
            best.push((place, point));
        }
    }
    let mut places: Vec<usize> = best.into_iter().map(|(place, _)| place).collect();
    places.sort_unstable();
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frontier_holds_what_nothing_beats() {
        type Case = (&'static [Option<(f64, f64)>], &'static [usize]);
        const CASES: [Case; 11] = [
            (&[], &[]),
            (&[None], &[]),
            (&[Some((1.0, 1.0))], &[0]),
            // A staircase, and one behind it.
            (
                &[
                    Some((1.0, 3.0)),
                    Some((2.0, 2.0)),
                    Some((3.0, 1.0)),
                    Some((3.0, 2.5)),
                ],
                &[0, 1, 2],
            ),
            // As dear and as wrong: both stand.
            (&[Some((1.0, 1.0)), Some((1.0, 1.0))], &[0, 1]),
            // As dear and less wrong, or as wrong and cheaper, is enough.
            (&[Some((1.0, 1.0)), Some((1.0, 0.5))], &[1]),
            (&[Some((2.0, 0.5)), Some((1.0, 0.5))], &[1]),
            // Less wrong by nothing that counts is not worth a higher price; at the same price it is.
            (&[Some((2.0, 0.999)), Some((1.0, 1.0))], &[1]),
            (&[Some((1.0, 0.999)), Some((1.0, 1.0))], &[0]),
            // Small steps add up.
            (
                &[
                    Some((1.0, 1.0)),
                    Some((2.0, 0.993)),
                    Some((3.0, 0.987)),
                    Some((4.0, 0.98)),
                ],
                &[0, 2],
            ),
            // One that is not known beats nothing.
            (&[Some((2.0, 1.0)), None, Some((1.0, 2.0))], &[0, 2]),
        ];
        for (points, wanted) in CASES {
            assert_eq!(frontier(points), wanted, "{points:?}");
        }
    }

    #[test]
    fn a_texture_is_compared_only_where_its_fetch_is_counted() {
        let method = |name| crate::methods::find(name).expect("it is there");
        let entry = |name, fetches| Entry {
            method: method(name),
            is_best: false,
            fetches,
        };
        let mut data = Data {
            entries: vec![entry("table", 1), entry("schlick", 0)],
            costs: vec![CostAxis {
                name: "rdna2",
                title: String::new(),
                holds_fetches: false,
                costs: vec![Some(1.0), Some(2.0)],
            }],
            sets: vec![Set {
                name: "gold".to_owned(),
                title: "gold".to_owned(),
                errors: vec![[Some(0.1); 4], [Some(0.2); 4]],
            }],
            command: String::new(),
        };
        let best = |data: &Data| -> Vec<String> {
            let (set, cost) = (&data.sets[0], &data.costs[0]);
            let view = View {
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
