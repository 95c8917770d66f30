//! One figure of the thesis beside ours, and what follows from the comparison.

use serde_json::{Value, json};

/// A line of the report.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The part of the report: `table2`, `claims`, `figures`.
    pub table: &'static str,
    /// The material, device or claim.
    pub row: String,
    /// What of it.
    pub column: String,
    /// What the thesis prints.
    pub thesis: Figure,
    /// What we get.
    pub ours: Figure,
    /// What follows.
    pub verdict: Verdict,
    /// How it was measured, and why it differs where it does.
    pub remark: String,
    /// The file that shows it, relative to the output folder.
    pub file: Option<String>,
}

/// A figure in a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Figure {
    /// A number, printed with so many decimals and this unit.
    Number(f64, usize, &'static str),
    /// An index of refraction, n and k.
    Index([f64; 2]),
    /// Words.
    Words(String),
    /// There is none, and why.
    Missing(&'static str),
}

/// What follows from the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Equal to the last printed digit.
    Agrees,
    /// Different, and the remark tells the reason.
    Explained,
    /// Different where it must agree: a finding.
    Differs,
    /// A claim that is true.
    Holds,
    /// A claim that is true in one sense and not in another.
    InPart,
    /// A claim that is not true.
    Fails,
    /// Nothing to compare with.
    Open,
}

impl Row {
    /// A row that compares nothing yet.
    pub fn new(table: &'static str, row: &str, column: &str) -> Row {
        Row {
            table,
            row: row.to_owned(),
            column: column.to_owned(),
            thesis: Figure::Missing("the thesis gives no figure"),
            ours: Figure::Missing("not measured"),
            verdict: Verdict::Open,
            remark: String::new(),
            file: None,
        }
    }

    /// With the thesis's figure.
    pub fn thesis(mut self, figure: Figure) -> Row {
        self.thesis = figure;
        self
    }

    /// With our figure.
    pub fn ours(mut self, figure: Figure) -> Row {
        self.ours = figure;
        self
    }

    /// With what follows.
    pub fn verdict(mut self, verdict: Verdict) -> Row {
        self.verdict = verdict;
        self
    }

    /// With how, and why.
    pub fn remark(mut self, remark: impl Into<String>) -> Row {
        self.remark = remark.into();
        self
    }

    /// The row in a report's JSON.
    pub fn json(&self) -> Value {
        let mut row = json!({
            "table": self.table, "row": self.row, "column": self.column, "thesis": self.thesis.json(),
            "ours": self.ours.json(), "unit": self.unit(), "verdict": self.verdict.text(), "remark": self.remark,
        });
        let reasons = [&self.thesis, &self.ours].into_iter();
        if let Some(reason) = reasons.filter_map(Figure::reason).next() {
            row["reason"] = json!(reason);
        }
        if let Some(file) = &self.file {
            row["file"] = json!(file);
        }
        row
    }

    /// Whether the row states a claim in words, which no column can hold.
    pub fn is_statement(&self) -> bool {
        matches!(self.thesis, Figure::Words(_))
    }

    fn unit(&self) -> Option<&'static str> {
        match self.ours {
            Figure::Number(_, _, unit) => Some(unit.trim()).filter(|unit| !unit.is_empty()),
            _ => None,
        }
    }
}

impl Figure {
    /// Per cent, with two decimals as in the thesis.
    pub fn percent(value: f64) -> Figure {
        Figure::Number(value, 2, " %")
    }

    /// As people read it.
    pub fn text(&self) -> String {
        match self {
            Figure::Number(value, decimals, unit) => format!("{value:.decimals$}{unit}"),
            Figure::Index([n, 0.0]) => n.to_string(),
            Figure::Index([n, k]) => format!("{n} + {k}i"),
            Figure::Words(words) => words.clone(),
            Figure::Missing(_) => "none".to_owned(),
        }
    }

    /// Numbers in full, whatever the text rounds them to.
    pub fn json(&self) -> Value {
        match self {
            Figure::Number(value, ..) => json!(value),
            Figure::Index(index) => json!(index),
            Figure::Words(words) => json!(words),
            Figure::Missing(_) => Value::Null,
        }
    }

    fn reason(&self) -> Option<&'static str> {
        match self {
            Figure::Missing(reason) => Some(reason),
            _ => None,
        }
    }
}

impl Verdict {
    /// In words.
    pub fn text(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Explained => "differs, explained",
            Verdict::Differs => "differs",
            Verdict::Holds => "holds",
            Verdict::InPart => "holds in part",
            Verdict::Fails => "does not hold",
            Verdict::Open => "",
        }
    }

    /// Agreement to the printed digit, or a finding.
    pub fn of_digits(thesis: f64, ours: f64, decimals: usize) -> Verdict {
        if format!("{thesis:.decimals$}") == format!("{ours:.decimals$}") {
            Verdict::Agrees
        } else {
            Verdict::Differs
        }
    }

    /// A claim that holds or does not.
    pub fn of(holds: bool) -> Verdict {
        if holds {
            Verdict::Holds
        } else {
            Verdict::Fails
        }
    }
}
