//! Fits for people and for scripts: coefficients, and how near they come.

use serde_json::{Value, json};

use super::frontier::{figure, frontier};
use super::table;
use crate::fit::Follows;
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
    /// Each coefficient for three channels, as f32 holds it.
    pub coefficients: Vec<[f64; 3]>,
    /// The largest error.
    pub max_abs: f64,
    /// The mean relative error; none where a channel reflects nothing.
    pub mean_rel: Option<f64>,
    /// What an evaluation of the library function costs, where that was recorded.
    pub cost: Option<f64>,
}

impl Row {
    /// The row in a report's JSON.
    pub fn json(&self) -> Value {
        let mut row = json!({
            "material": self.material, "class": self.class, "space": self.space, "method": self.method.name,
            "terms": self.coefficients.len(), "shape": self.method.formula, "shared": true,
            "coefficients": self.channels(), "max_abs": self.max_abs, "mean_rel": self.mean_rel, "cost": self.cost,
        });
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
    let head = [
        "",
        "material",
        "method",
        "terms",
        "largest error",
        "mean relative, %",
        gpu,
    ];
    let mut lines = Vec::new();
    for of in rows.chunk_by(|a, b| a.material == b.material) {
        let points: Vec<_> = of
            .iter()
            .map(|row| row.cost.map(|cost| (cost, row.max_abs)))
            .collect();
        let best = frontier(&points);
        let starred = of.iter().enumerate();
        lines.extend(starred.map(|(place, row)| cells(row, best.contains(&place))));
    }
    let table = table::text(&head, &lines);
    let few = rows.len() <= SHOWN;
    let coefficients: String = rows.iter().filter(|_| few).map(listed).collect();
    format!("{table}\n{coefficients}{}", remarks(rows))
}

/// Rows of which the coefficients are printed too.
const SHOWN: usize = 6;

fn cells(row: &Row, is_best: bool) -> Vec<String> {
    let shown = |value: Option<f64>| value.map_or_else(String::new, figure);
    vec![
        if is_best { "*" } else { "" }.to_owned(),
        row.name().to_owned(),
        row.method.name.to_owned(),
        row.coefficients.len().to_string(),
        figure(row.max_abs),
        shown(row.mean_rel.map(|share| 100.0 * share)),
        shown(row.cost),
    ]
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
fn remarks(rows: &[Row]) -> String {
    let Some(follows) = rows.first().and_then(|row| row.follows) else {
        return String::new();
    };
    let channels = ["red", "green", "blue"].into_iter().zip(follows);
    let remark = |(channel, follows): (&str, Follows)| match follows {
        Follows::Law(index) => format!("{channel}: n {:.4}, k {:.4}\n", index.n, index.k),
        Follows::Tint { tint, .. } => format!(
            "{channel}: no index below an F0 of .985 has these colours; it follows f82_tint with a tint of {tint:.4}\n"
        ),
    };
    "\n".to_owned() + &channels.map(remark).collect::<String>()
}
