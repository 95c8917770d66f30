//! Fits for people and for scripts: coefficients, and how near they come.

use serde_json::{Value, json};

use super::table::{self, short_number};
use crate::cost::{CostAndError, pareto_frontier};
use crate::emit::Missed;
use crate::fit::{Aim, Follows, Weight};
use crate::methods::Method;

/// A fitted method and what it was fitted to.
#[derive(Clone, Debug)]
pub struct Row {
    /// The material's name, where it is one.
    pub material: Option<String>,
    /// Its class.
    pub class: Option<&'static str>,
    /// What each channel follows, where two colours were given.
    pub follows: Option<[Follows; 3]>,
    /// The working space.
    pub space: &'static str,
    /// The method.
    pub method: &'static Method,
    /// Each coefficient for three channels, as the aim's precision holds it.
    pub coefficients: Vec<[f64; 3]>,
    /// The largest error.
    pub max_abs: f64,
    /// The mean relative error; none where a channel reflects nothing.
    pub mean_rel: Option<f64>,
    /// What an evaluation of the library function costs, where that was recorded.
    pub cost: Option<f64>,
    /// What was minimised, and what is met exactly.
    pub aim: Aim,
    /// The largest error in the measure that was minimised, on paper and before the limit to [0, 1].
    pub error: f64,
    /// The same without the ends that are met exactly, where there are any.
    pub free: Option<f64>,
    /// Whether it misses what its method promises of the material's class.
    pub missed: Option<Missed>,
}

impl Row {
    /// The row in a report's JSON.
    pub fn json(&self) -> Value {
        let mut row = json!({
            "material": self.material, "class": self.class, "space": self.space, "method": self.method.name,
            "terms": self.coefficients.len(), "shape": self.method.formula, "shared": true,
            "coefficients": self.channels(), "max_abs": self.max_abs, "mean_rel": self.mean_rel, "cost": self.cost,
            "weight": self.aim.weight.name(), "error": self.error, "exact": self.aim.exact.degrees(),
            "precision": self.aim.precision.name(),
        });
        if let Some(free) = self.free {
            row["error_without_exact"] = json!(free);
        }
        let reasons = [
            (
                self.mean_rel.is_none(),
                "a channel that reflects nothing has no relative error",
            ),
            (self.cost.is_none(), "its cost is not recorded there"),
        ];
        let lacking = reasons.into_iter().filter(|(lacks, _)| *lacks);
        let lacking: Vec<&str> = lacking.map(|(_, why)| why).collect();
        if !lacking.is_empty() {
            row["reason"] = json!(lacking.join("; "));
        }
        if let Some(missed) = &self.missed {
            row["misses_its_class"] = missed.json();
        }
        if let Some(follows) = &self.follows {
            row["follows"] = follows.iter().map(followed).collect();
        }
        row
    }

    /// The coefficients of each channel.
    fn channels(&self) -> [Vec<f64>; 3] {
        [0, 1, 2].map(|i| self.coefficients.iter().map(|c| c[i]).collect())
    }

    fn name(&self) -> &str {
        self.material.as_deref().unwrap_or("two colours")
    }
}

fn followed(follows: &Follows) -> Value {
    match follows {
        Follows::Law(index) => json!({ "law": { "n": index.n, "k": index.k } }),
        Follows::Tint { f0, tint } => json!({ "f82_tint": { "f0": f0, "tint": tint } }),
    }
}

/// The rows for a terminal; a star where no other of the same material is cheaper and as near.
pub fn text(rows: &[Row], gpu: &str) -> String {
    let aim = rows.first().map_or(Aim::default(), |row| row.aim);
    let mut head = vec!["", "material", "method", "terms", "largest error"];
    head.extend(measure(aim).map(|(title, _)| title));
    head.extend(["mean relative, %", gpu]);
    let mut lines = Vec::new();
    for of in rows.chunk_by(|a, b| a.material == b.material) {
        let points: Vec<_> = of
            .iter()
            .map(|row| {
                let error = row.max_abs;
                row.cost.map(|cost| CostAndError { cost, error })
            })
            .collect();
        let best = pareto_frontier(&points);
        let starred = of.iter().enumerate();
        lines.extend(starred.map(|(place, row)| cells(row, best.contains(&place))));
    }
    let table = table::text(&head, &lines);
    let few = rows.len() <= SHOWN;
    let coefficients: String = rows.iter().filter(|_| few).map(listed).collect();
    format!("{table}\n{coefficients}{}", remarks(rows))
}

/// A column of a row's.
type Column = (&'static str, fn(&Row) -> Option<f64>);

/// What is told of the measure that was minimised, and of what an exact end costs, where that is asked for.
fn measure(aim: Aim) -> impl Iterator<Item = Column> {
    let title = match aim.weight {
        Weight::Absolute => "largest on paper",
        Weight::Relative => "largest relative",
        Weight::Luminance => "largest of luminance",
        Weight::DeltaE => "largest CIEDE2000",
    };
    let error: Column = (title, |row| Some(row.error));
    let free: Column = ("the same, no end exact", |row| row.free);
    let is_any = aim.exact.is_any();
    let told = (is_any || aim.weight != Weight::Absolute).then_some(error);
    told.into_iter().chain(is_any.then_some(free))
}

/// Rows of which the coefficients are printed too.
const SHOWN: usize = 6;

fn cells(row: &Row, is_best: bool) -> Vec<String> {
    let shown = |value: Option<f64>| value.map_or_else(String::new, short_number);
    let mut cells = vec![
        if is_best { "*" } else { "" }.to_owned(),
        row.name().to_owned(),
        row.method.name.to_owned(),
        row.coefficients.len().to_string(),
        short_number(row.max_abs),
    ];
    cells.extend(measure(row.aim).map(|(_, value)| shown(value(row))));
    cells.push(shown(row.mean_rel.map(|share| 100.0 * share)));
    cells.push(shown(row.cost));
    cells
}

/// The coefficients as arguments, one after the other.
fn listed(row: &Row) -> String {
    let numbers = |c: &[f64; 3]| c.map(|value| (value as f32).to_string()).join(", ");
    let lines = row.coefficients.iter().enumerate();
    let lines = lines.map(|(i, c)| format!("  c{i} = {}\n", numbers(c)));
    format!(
        "\n{}, {}:\n{}",
        row.name(),
        row.method.name,
        lines.collect::<String>()
    )
}

/// What became of colours that no index has.
const HALF: &str = "\ncoefficients are rounded to f16, errors are those of exact arithmetic with them, and costs those of single precision\n";

fn remarks(rows: &[Row]) -> String {
    let is_half = rows.first().is_some_and(|row| row.aim.precision.is_half());
    let half = if is_half { HALF } else { "" };
    let missed = rows.iter().filter_map(|row| {
        let missed = row.missed.as_ref()?;
        Some(format!("{}: {}\n", row.name(), missed.words()))
    });
    let half = half.to_owned() + &missed.collect::<String>();
    let Some(follows) = rows.first().and_then(|row| row.follows) else {
        return half;
    };
    let channels = ["red", "green", "blue"].into_iter().zip(follows);
    let remark = |(channel, follows): (&str, Follows)| match follows {
        Follows::Law(index) => format!("{channel}: n {:.4}, k {:.4}\n", index.n, index.k),
        Follows::Tint { tint, .. } => format!(
            "{channel}: no index below an F0 of .985 has these colours; it follows f82_tint with a tint of {tint:.4}\n"
        ),
    };
    half + "\n" + &channels.map(remark).collect::<String>()
}
