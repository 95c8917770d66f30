//! Fits for people and for scripts: coefficients, and their errors.

use serde::{Serialize, Serializer};

use crate::pictures::table::{self, short_number};
use crate::generator::emit::Missed;
use crate::generator::fit::{Coefficients, FitObjective, Follows, ModelError, Weight};
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::{CostAndError, pareto_frontier};
use crate::language::methods::Method;
use crate::physics::foreign::Foreign;
use crate::physics::num::each_channel;
use crate::physics::spectra::Gamut;

/// A fitted method and what it was fitted to.
#[derive(Clone, Debug, Serialize)]
pub struct FitRow {
    /// The material's name, where it is one.
    material: Option<String>,
    /// Its class.
    class: Option<&'static str>,
    /// The working space.
    space: &'static str,
    method: &'static str,
    terms: usize,
    shape: &'static [&'static str],
    /// Every shape is one for all materials.
    shared: bool,
    /// The coefficients of each channel.
    coefficients: [Vec<f64>; 3],
    max_abs: f64,
    mean_rel: Option<f64>,
    cost: Option<f64>,
    weight: &'static str,
    error: f64,
    exact: Vec<u32>,
    precision: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    error_without_exact: Option<f64>,
    /// The largest error where the form need not keep to [0, 1] before its limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    max_abs_without_gamut: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Whether it misses what its method promises of the material's class.
    #[serde(
        skip_serializing_if = "Option::is_none",
        serialize_with = "missed_columns"
    )]
    misses_its_class: Option<Missed>,
    /// What each channel follows, where two colours were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    follows: Option<[FollowedCurve; 3]>,
    #[serde(skip)]
    aim: FitObjective,
}

/// What a channel follows between its two colours.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FollowedCurve {
    /// The exact law of an index.
    Law {
        /// Its real part.
        n: f64,
        /// Its extinction coefficient.
        k: f64,
    },
    /// The method `f82_tint`.
    F82Tint {
        /// The reflectance at 0 degrees.
        f0: f64,
        /// That at 81.79 degrees, over Schlick's value there.
        tint: f64,
    },
}

impl From<Follows> for FollowedCurve {
    fn from(follows: Follows) -> FollowedCurve {
        match follows {
            Follows::Law(index) => FollowedCurve::Law {
                n: index.n,
                k: index.k,
            },
            Follows::Tint { f0, tint } => FollowedCurve::F82Tint { f0, tint },
        }
    }
}

fn missed_columns<S: Serializer>(missed: &Option<Missed>, to: S) -> Result<S::Ok, S::Error> {
    missed.as_ref().map(Missed::detail).serialize(to)
}

impl FitRow {
    /// The row of a method with these coefficients and errors, and with the cost of its library function where that was recorded.
    /// It is of no material yet.
    pub fn new(
        method: &'static Method,
        fitted: &Coefficients,
        error: &ModelError,
        cost: Option<f64>,
        space: &'static str,
    ) -> FitRow {
        let inputs = || method.inputs.iter();
        let channel = |i: usize| inputs().map(|input| fitted.values[input.name][i]).collect();
        FitRow {
            material: None,
            class: None,
            space,
            method: method.name,
            terms: method.inputs.len(),
            shape: method.formula,
            shared: true,
            coefficients: each_channel(channel),
            max_abs: error.max_abs,
            mean_rel: error.mean_rel,
            cost,
            weight: fitted.aim.weight.name(),
            error: fitted.error,
            exact: fitted.aim.exact.degrees(),
            precision: fitted.aim.precision.name(),
            error_without_exact: fitted.error_without_exact,
            max_abs_without_gamut: None,
            reason: lacking(error.mean_rel, cost),
            misses_its_class: None,
            follows: None,
            aim: fitted.aim,
        }
    }

    /// The row of a material, with the largest error of a form that need not keep to [0, 1].
    pub fn of_material(
        mut self,
        subject: &MaterialInMedium,
        missed: Option<Missed>,
        without_gamut: f64,
    ) -> FitRow {
        self.max_abs_without_gamut = (self.aim.gamut != Gamut::Keep).then_some(without_gamut);
        self.material = Some(subject.argument.clone());
        self.class = Some(subject.material.kind.name());
        self.misses_its_class = missed;
        self
    }

    /// The row of two colours, with what each channel follows between them.
    pub fn of_colours(mut self, follows: [Follows; 3]) -> FitRow {
        self.follows = Some(follows.map(FollowedCurve::from));
        self
    }

    fn name(&self) -> &str {
        self.material.as_deref().unwrap_or("two colours")
    }
}

/// Why a figure is not known, where one is not.
fn lacking(mean_rel: Option<f64>, cost: Option<f64>) -> Option<String> {
    let reasons = [
        (
            mean_rel.is_none(),
            "a channel that reflects nothing has no relative error",
        ),
        (cost.is_none(), "its cost is not recorded there"),
    ];
    let lacking = reasons.into_iter().filter(|(lacks, _)| *lacks);
    let lacking: Vec<&str> = lacking.map(|(_, why)| why).collect();
    (!lacking.is_empty()).then(|| lacking.join("; "))
}

/// What the first column means.
const STAR: &str = "A star marks the frontier of a material: what errs less costs more, and what costs less errs more.";

/// The rows for a terminal; a star where no other of the same material is cheaper and as near.
pub fn fits_text(rows: &[FitRow], gpu: &str) -> String {
    let aim = rows.first().map_or(FitObjective::default(), |row| row.aim);
    let mut head = vec!["", "material", "method", "terms", "largest error"];
    let known = |column: &Column| rows.iter().any(|row| column.1(row).is_some());
    let columns: Vec<Column> = measure_columns(aim).filter(known).collect();
    head.extend(columns.iter().map(|(title, _)| *title));
    head.extend(["mean relative, %", gpu]);
    let mut lines = Vec::new();
    for alike in rows.chunk_by(|a, b| a.material == b.material) {
        let points: Vec<_> = alike
            .iter()
            .map(|row| {
                let error = row.max_abs;
                row.cost.map(|cost| CostAndError { cost, error })
            })
            .collect();
        let best = pareto_frontier(&points);
        let starred = alike.iter().enumerate();
        lines.extend(starred.map(|(place, row)| cells(row, best.contains(&place), &columns)));
    }
    let table = table::text_table(&head, &lines);
    let few = rows.len() <= SHOWN;
    let coefficients: String = rows.iter().filter(|_| few).map(coefficient_lines).collect();
    format!("{table}\n{STAR}\n{coefficients}{}", remarks(rows))
}

/// A column of a row's.
type Column = (&'static str, fn(&FitRow) -> Option<f64>);

/// The columns of the measure that was minimised, of what the gamut and of what an exact end cost.
fn measure_columns(aim: FitObjective) -> impl Iterator<Item = Column> {
    let title = match aim.weight {
        Weight::Absolute => "largest on paper",
        Weight::Relative => "largest relative",
        Weight::Luminance => "largest of luminance",
        Weight::DeltaE => "largest CIEDE2000",
    };
    let error: Column = (title, |row| Some(row.error));
    let free: Column = ("the same, not exact at an end", |row| {
        row.error_without_exact
    });
    let is_any = aim.exact.is_any();
    let without_gamut: Column = ("the same, not kept to [0, 1]", |row| {
        row.max_abs_without_gamut
    });
    let is_paper = is_any || aim.weight != Weight::Absolute || aim.gamut == Gamut::Keep;
    let column = is_paper.then_some(error);
    let columns = column.into_iter().chain(is_any.then_some(free));
    (aim.gamut != Gamut::Keep)
        .then_some(without_gamut)
        .into_iter()
        .chain(columns)
}

/// Rows of which the coefficients are printed too.
const SHOWN: usize = 6;

fn cells(row: &FitRow, is_best: bool, columns: &[Column]) -> Vec<String> {
    let shown = |value: Option<f64>| value.map_or_else(String::new, short_number);
    let mut cells = vec![
        if is_best { "*" } else { "" }.to_owned(),
        row.name().to_owned(),
        row.method.to_owned(),
        row.terms.to_string(),
        short_number(row.max_abs),
    ];
    cells.extend(columns.iter().map(|(_, value)| shown(value(row))));
    cells.push(shown(row.mean_rel.map(|share| 100.0 * share)));
    cells.push(shown(row.cost));
    cells
}

/// The coefficients as arguments, one after the other.
fn coefficient_lines(row: &FitRow) -> String {
    let line = |i: usize| {
        let channels = row.coefficients.iter();
        let numbers: Vec<String> = channels.map(|c| (c[i] as f32).to_string()).collect();
        format!("  c{i} = {}\n", numbers.join(", "))
    };
    let lines: String = (0..row.terms).map(line).collect();
    format!("\n{}, {}:\n{lines}", Foreign(row.name()), row.method)
}

/// What became of colours that no index has.
const HALF: &str = "\ncoefficients are rounded to f16, errors are those of exact arithmetic with them, and costs those of single precision\n";

fn remarks(rows: &[FitRow]) -> String {
    let is_half = rows.first().is_some_and(|row| row.aim.precision.is_half());
    let half = if is_half { HALF } else { "" };
    let missed = rows.iter().filter_map(|row| {
        let missed = row.misses_its_class.as_ref()?;
        Some(format!("{}: {}\n", Foreign(row.name()), missed.words()))
    });
    let half = half.to_owned() + &missed.collect::<String>();
    let Some(follows) = rows.first().and_then(|row| row.follows) else {
        return half;
    };
    let channels = ["red", "green", "blue"].into_iter().zip(follows);
    let remark = |(channel, follows): (&str, FollowedCurve)| match follows {
        FollowedCurve::Law { n, k } => format!("{channel}: n {n:.4}, k {k:.4}\n"),
        FollowedCurve::F82Tint { tint, .. } => format!(
            "{channel}: no n and k with an F0 of at most .985 give both colours, so it follows f82_tint with a tint of {tint:.4}\n"
        ),
    };
    half + "\n" + &channels.map(remark).collect::<String>()
}
