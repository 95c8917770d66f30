//! The comparison of a figure of the thesis with ours, its verdict, and the thesis's printed figures from
//! `data/thesis-tables.json`.
//!
//! Source: Štetić-Kozić, "Poređenje metoda za računanje koeficijenata Frenelove refleksije u programima za senčenje",
//! diploma thesis, School of Electrical Engineering, University of Belgrade, 2014.
//!
//! Comparisons stand in sections, the parts of the report. A meter shows the progress of what is computed for them.

use std::sync::LazyLock;

use serde::{Serialize, Serializer};
use serde_json::Value;

/// A line of the report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ComparisonRow {
    /// The part of the report: `table2`, `claims`, `figures`.
    pub table: &'static str,
    /// The material, device or claim.
    pub row: String,
    /// The quantity that is compared.
    pub column: String,
    /// The thesis's figure.
    pub thesis: Figure,
    /// Our figure.
    pub ours: Figure,
    unit: Option<&'static str>,
    /// The verdict.
    pub verdict: ComparisonVerdict,
    /// How it was measured, and why it differs if it does.
    pub remark: String,
    /// Why a figure is missing, where one is.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
    /// The file that shows it, relative to the output folder.
    #[serde(skip_serializing_if = "Option::is_none")]
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

/// The verdict of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComparisonVerdict {
    /// Equal to the last printed digit.
    Agrees,
    /// Different, for the reason in the remark.
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

impl ComparisonRow {
    /// A row that compares nothing yet.
    pub fn new(table: &'static str, row: &str, column: &str) -> ComparisonRow {
        let open = ComparisonRow {
            table,
            row: row.to_owned(),
            column: column.to_owned(),
            thesis: Figure::Missing("the thesis gives no figure"),
            ours: Figure::Missing("not measured"),
            unit: None,
            verdict: ComparisonVerdict::Open,
            remark: String::new(),
            reason: None,
            file: None,
        };
        open.with_reason()
    }

    /// With the thesis's figure.
    pub fn thesis(mut self, figure: Figure) -> ComparisonRow {
        self.thesis = figure;
        self.with_reason()
    }

    /// With our figure.
    pub fn ours(mut self, figure: Figure) -> ComparisonRow {
        self.unit = figure.unit();
        self.ours = figure;
        self.with_reason()
    }

    /// With the reason of the first figure that is missing.
    fn with_reason(mut self) -> ComparisonRow {
        self.reason = self.thesis.reason().or(self.ours.reason());
        self
    }

    /// With the verdict.
    pub fn verdict(mut self, verdict: ComparisonVerdict) -> ComparisonRow {
        self.verdict = verdict;
        self
    }

    /// With both figures in per cent, which must agree to the printed digit.
    pub fn percents(self, thesis: f64, ours: f64) -> ComparisonRow {
        self.thesis(Figure::percent(thesis))
            .ours(Figure::percent(ours))
            .verdict(ComparisonVerdict::of_digits(thesis, ours, 2))
    }

    /// With a difference, if there is one, that the remark explains.
    pub fn explained(mut self) -> ComparisonRow {
        if self.verdict == ComparisonVerdict::Differs {
            self.verdict = ComparisonVerdict::Explained;
        }
        self
    }

    /// With a remark: how it was measured, and why it differs.
    pub fn remark(mut self, remark: impl Into<String>) -> ComparisonRow {
        self.remark = remark.into();
        self
    }

    /// Whether the row states a claim in words, which is too long for a column.
    pub fn is_statement(&self) -> bool {
        matches!(self.thesis, Figure::Words(_))
    }
}

impl Figure {
    /// Per cent, with two decimals as in the thesis.
    pub fn percent(value: f64) -> Figure {
        Figure::Number(value, 2, " %")
    }

    /// The figure in words, for people.
    pub fn in_words(&self) -> String {
        match self {
            Figure::Number(value, decimals, unit) => format!("{value:.decimals$}{unit}"),
            Figure::Index([n, 0.0]) => n.to_string(),
            Figure::Index([n, k]) => format!("{n} + {k}i"),
            Figure::Words(words) => words.clone(),
            Figure::Missing(_) => "none".to_owned(),
        }
    }

    fn unit(&self) -> Option<&'static str> {
        match self {
            Figure::Number(_, _, unit) => Some(unit.trim()).filter(|unit| !unit.is_empty()),
            _ => None,
        }
    }

    fn reason(&self) -> Option<&'static str> {
        match self {
            Figure::Missing(reason) => Some(reason),
            _ => None,
        }
    }
}

impl Serialize for Figure {
    /// Serialises numbers with all digits, whatever the text rounds them to.
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Figure::Number(value, ..) => value.serialize(to),
            Figure::Index(index) => index.serialize(to),
            Figure::Words(words) => words.serialize(to),
            Figure::Missing(_) => to.serialize_none(),
        }
    }
}

impl ComparisonVerdict {
    /// In words.
    pub fn in_words(self) -> &'static str {
        match self {
            ComparisonVerdict::Agrees => "agrees",
            ComparisonVerdict::Explained => "differs, explained",
            ComparisonVerdict::Differs => "differs",
            ComparisonVerdict::Holds => "holds",
            ComparisonVerdict::InPart => "holds in part",
            ComparisonVerdict::Fails => "does not hold",
            ComparisonVerdict::Open => "",
        }
    }

    /// The verdict on two figures that must agree.
    pub fn of_agreement(agrees: bool) -> ComparisonVerdict {
        if agrees {
            ComparisonVerdict::Agrees
        } else {
            ComparisonVerdict::Differs
        }
    }

    /// The verdict on two figures that must be equal to the printed digit.
    pub fn of_digits(thesis: f64, ours: f64, decimals: usize) -> ComparisonVerdict {
        let agrees = format!("{thesis:.decimals$}") == format!("{ours:.decimals$}");
        ComparisonVerdict::of_agreement(agrees)
    }

    /// The verdict on a claim that holds or does not.
    pub fn of_claim(holds: bool) -> ComparisonVerdict {
        ComparisonVerdict::of_cases(usize::from(holds), 1)
    }

    /// The verdict on a claim that holds in some of these cases.
    pub fn of_cases(holding: usize, cases: usize) -> ComparisonVerdict {
        match holding {
            0 => ComparisonVerdict::Fails,
            all if all == cases => ComparisonVerdict::Holds,
            _ => ComparisonVerdict::InPart,
        }
    }
}

impl Serialize for ComparisonVerdict {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.in_words())
    }
}

/// A claim of the text in words, beside our finding.
pub fn statement(name: &str, section: &str, thesis: &str, ours: String) -> ComparisonRow {
    ComparisonRow::new("claims", name, section)
        .thesis(Figure::Words(thesis.to_owned()))
        .ours(Figure::Words(ours))
}

/// A figure behind a claim.
pub fn measured(name: &str, column: &str, ours: Figure) -> ComparisonRow {
    ComparisonRow::new("claims", name, column).ours(ours)
}

static RECORD: LazyLock<Value> = LazyLock::new(|| {
    serde_json::from_str(include_str!("../../../data/thesis-tables.json"))
        .expect("the record is part of the program, and a test reads it")
});

/// The number of angles at which function errors are taken (section 5.2).
pub const ANGLES: usize = 1_000_000;

/// cos θ at which λ is matched according to the text: 84.26 degrees (section 3.2.4).
pub const TEXT_MATCHING_COS: f64 = 0.10;

/// The table of relative times in the record.
pub const RELATIVE_TIMES: &str = "table6_relative_time_percent";
/// The channels in the order of the thesis.
pub const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// The figure at a path of keys.
pub fn number(keys: &[&str]) -> f64 {
    at(keys)
        .as_f64()
        .expect("the keys are constants, and a test reads them all")
}

/// The row of figures at a path of keys.
pub fn numbers(keys: &[&str]) -> Vec<f64> {
    let row = at(keys).as_array().into_iter().flatten();
    row.map(|value| value.as_f64().expect("a row of figures holds figures"))
        .collect()
}

/// The row of names at a path of keys.
pub fn names(keys: &[&str]) -> Vec<&'static str> {
    let row = at(keys).as_array().into_iter().flatten();
    row.filter_map(Value::as_str).collect()
}

/// The devices of a table of times, in the order of the thesis.
pub fn devices(table: &str) -> Vec<&'static str> {
    let entries = at(&[table]).as_object().into_iter().flatten();
    let rows = entries.filter(|(_, row)| row.get(0).is_some_and(Value::is_number));
    rows.map(|(name, _)| name.as_str()).collect()
}

fn at(keys: &[&str]) -> &'static Value {
    keys.iter().fold(&RECORD, |value, key| &value[*key])
}

/// A part reproduced.
#[derive(Clone, Debug, PartialEq)]
pub struct ThesisSection {
    /// A title that says how it is measured.
    pub title: String,
    /// The comparisons.
    pub rows: Vec<ComparisonRow>,
}

/// Counts evaluated angles and reports the progress.
pub struct Meter<'a> {
    done: usize,
    whole: usize,
    say: &'a mut dyn FnMut(u64, u64, &str),
}

impl<'a> Meter<'a> {
    /// A meter of `whole` angles, none of which is done.
    pub fn new(whole: usize, say: &'a mut dyn FnMut(u64, u64, &str)) -> Meter<'a> {
        Meter {
            done: 0,
            whole,
            say,
        }
    }

    /// Counts so many more angles as done.
    pub fn add(&mut self, angles: usize, what: &str) {
        self.done += angles;
        (self.say)(self.done as u64, self.whole as u64, what);
    }
}
