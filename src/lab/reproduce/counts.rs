//! Table 6: relative times on five devices, beside the instruction counts of those GPUs' compilers for the same formulas.
//!
//! A count is not a time. A time includes the fixed cost of a draw (rasterising, blending, writing), which the thesis did not
//! subtract. So beside each share stands the one predicted by the line `time = fixed + rate * count` that fits the device best.

use serde::Deserialize;

use super::comparison::{
    self, ComparisonRow, ComparisonVerdict, Figure, RELATIVE_TIMES, ThesisSection,
};
use crate::lab::cost::{self, GpuCompiler, find};
use crate::lab::overdraw::{LibraryTime, library_times};
use crate::language::methods;
use crate::physics::num::statistics::{least_squares, rank_correlation};
use crate::physics::records;

/// The devices of the thesis, and the families whose compilers stand for their GPUs.
const DEVICES: [(&str, &str); 5] = [
    ("Lenovo W530, Intel HD4000", "hd4000"),
    ("Samsung Galaxy S3, Mali 400", "mali450"),
    ("Apple iPhone 5s, PowerVR G6430", "powervr"),
    ("Google Nexus 4, Adreno 320", "adreno320"),
    ("Samsung Galaxy S5, Adreno 330", "adreno330"),
];

/// The methods that the thesis timed, in the order of its columns.
const METHODS: [&str; 7] = [
    "dielectric_textbook",
    "schlick_ior",
    "conductor_textbook",
    "schlick_rescaled",
    "schlick_corrected",
    "table",
    "empirical",
];

/// The index of the lookup table. Counts do not include its texture fetch, so it is left out of all statistics.
const TABLE: usize = 5;

/// Percentage points within which a count is near a time.
const NEAR: f64 = 15.0;

/// Table 6 and the counts.
pub fn section() -> ThesisSection {
    ThesisSection {
        title: "Table 6: shares of the time of dielectric_exact on five devices, beside shares of the instructions that \
            Mesa's compilers for these GPUs make of our textbook formulas (data/records/costs), net of an empty shader. A count \
            holds where it is within 15 points"
            .to_owned(),
        rows: DEVICES
            .iter()
            .flat_map(|(device, family)| device_rows(device, family))
            .chain(timed_here())
            .collect(),
    }
}

/// A device's times and counts, in per cent of the first method.
struct Pairs {
    times: Vec<f64>,
    counts: Vec<f64>,
    /// The counts of the formulas as the thesis prints them, where ours are written differently.
    printed: Vec<Option<f64>>,
}

/// Those counts.
static PRINTED: &str = include_str!("../../../data/records/thesis-forms.csv");

/// A formula as the thesis prints it, counted.
#[derive(Deserialize)]
struct PrintedForm {
    gpu: String,
    method: String,
    net_instructions: f64,
}

/// Instructions of a formula as the thesis prints it.
fn printed(family: &str, method: &str) -> Option<f64> {
    let rows: Vec<PrintedForm> = records::rows(PRINTED);
    let own = |row: &PrintedForm| row.gpu == family && row.method == method;
    Some(rows.into_iter().find(own)?.net_instructions)
}

impl Pairs {
    fn recorded(device: &str, family: &str) -> Option<Pairs> {
        let record = cost::records(family);
        let count = |method: &&str| Some(record.library(methods::find(method)?)?.net.instructions);
        let counts: Option<Vec<f64>> = METHODS.iter().map(count).collect();
        let counts = counts?;
        let share = |count: f64| 100.0 * count / counts[0];
        Some(Pairs {
            printed: METHODS
                .map(|method| printed(family, method).map(share))
                .to_vec(),
            times: comparison::numbers(&[RELATIVE_TIMES, device]),
            counts: counts.iter().copied().map(share).collect(),
        })
    }

    /// Times and counts without the lookup table.
    fn arithmetic(&self) -> (Vec<f64>, Vec<f64>) {
        let pairs = self.counts.iter().zip(&self.times).enumerate();
        pairs
            .filter(|(place, _)| *place != TABLE)
            .map(|(_, (count, time))| (*count, *time))
            .unzip()
    }
}

fn device_rows(device: &str, family: &str) -> Vec<ComparisonRow> {
    let names = comparison::names(&[RELATIVE_TIMES, "columns"]);
    let Some(pairs) = Pairs::recorded(device, family) else {
        return unmeasured(device, family, &names);
    };
    let (counts, times) = pairs.arithmetic();
    let (fixed, rate) = least_squares(&counts, &times);
    let row = |place: usize| {
        let (time, count) = (pairs.times[place], pairs.counts[place]);
        let row = ComparisonRow::new("table6", device, names[place])
            .thesis(Figure::Number(time, 0, " %"))
            .ours(Figure::Number(count, 0, " %"));
        match place {
            0 => row.remark("what the others are shares of"),
            TABLE => row.remark("the count does not include the texture fetch"),
            _ if (count - time).abs() <= NEAR => row.verdict(ComparisonVerdict::Holds),
            _ => apart(row, &pairs, place, fixed + rate * count, fixed),
        }
    };
    let mut rows: Vec<ComparisonRow> = (0..METHODS.len()).map(row).collect();
    rows.extend(statistics(device, &counts, &times));
    rows
}

/// A row whose count is far from its time. The line explains it if its fixed cost is plausible and its prediction is near. The
/// formula as printed explains it if its own count is near.
fn apart(
    row: ComparisonRow,
    pairs: &Pairs,
    place: usize,
    on_line: f64,
    fixed: f64,
) -> ComparisonRow {
    let is_near = |value: f64| (value - pairs.times[place]).abs() <= NEAR;
    let printed = pairs.printed[place];
    let explains = fixed >= 0.0 && is_near(on_line);
    let line = match (fixed >= 0.0, explains) {
        (true, true) => format!(
            "a time of {on_line:.0} % on the line below: what does not depend on the formula is in it"
        ),
        (true, false) => format!("{on_line:.0} % on the line below, which does not explain it"),
        (false, _) => "no line explains it: the best one begins below 0".to_owned(),
    };
    let as_printed = printed
        .map(|count| format!("; as printed, with pow, it counts {count:.0} % (data/thesis-forms)"));
    let verdict = if explains || printed.is_some_and(is_near) {
        ComparisonVerdict::Explained
    } else {
        ComparisonVerdict::Fails
    };
    row.verdict(verdict)
        .remark(line + &as_printed.unwrap_or_default())
}

fn unmeasured(device: &str, family: &str, names: &[&'static str]) -> Vec<ComparisonRow> {
    let why = match find(family).map(|family| family.compiler) {
        Some(GpuCompiler::None(why)) => why,
        _ => "nothing is recorded",
    };
    let times = comparison::numbers(&[RELATIVE_TIMES, device]);
    let row = |(name, time): (&&'static str, &f64)| {
        ComparisonRow::new("table6", device, name)
            .thesis(Figure::Number(*time, 0, " %"))
            .remark(why)
    };
    names.iter().zip(&times).map(row).collect()
}

/// How well the counts of a device predict its times.
fn statistics(device: &str, counts: &[f64], times: &[f64]) -> Vec<ComparisonRow> {
    let (fixed, rate) = least_squares(counts, times);
    let pairs = || counts.iter().zip(times);
    // The first method is 100 % of both.
    let differences = pairs().skip(1).map(|(count, time)| (count - time).abs());
    let mean = differences.sum::<f64>() / (counts.len() - 1) as f64;
    let off = pairs().map(|(count, time)| (fixed + rate * count - time).abs());
    let worst = off.fold(0.0, f64::max);
    let row = |column: &str, figure| ComparisonRow::new("table6", device, column).ours(figure);
    vec![
        row(
            "rank correlation",
            Figure::Number(rank_correlation(counts, times), 2, ""),
        )
        .remark("Spearman's, of counts and times, without the table"),
        row("mean difference", Figure::Number(mean, 0, " points"))
            .remark("of counts and times, without the table"),
        row(
            "time = fixed + rate * count, fixed",
            Figure::Number(fixed, 0, " %"),
        )
        .remark(format!(
            "rate {rate:.2}; least squares over the six methods, at most {worst:.0} points off"
        )),
    ]
}

/// Rows of the devices that were timed by `fresnel-gen time`: the rank correlation of times with operations of the same
/// functions. No GPU was both timed here and counted by its own compiler.
fn timed_here() -> Vec<ComparisonRow> {
    let times = library_times();
    let mut devices: Vec<&str> = times.iter().map(|time| time.device.as_str()).collect();
    devices.sort_unstable();
    devices.dedup();
    devices
        .iter()
        .map(|device| correlated(device, &times))
        .collect()
}

fn correlated(device: &str, times: &[LibraryTime]) -> ComparisonRow {
    let own = times
        .iter()
        .filter(|time| time.device == device && !time.method.is_textured());
    let pairs = own.filter_map(|time| {
        let function = time.method.function(false).ok()?;
        Some((function.work() as f64, time.share))
    });
    let (counts, shares): (Vec<f64>, Vec<f64>) = pairs.unzip();
    ComparisonRow::new("table6", device, "rank correlation")
        .ours(Figure::Number(rank_correlation(&counts, &shares), 2, ""))
        .remark(format!(
            "of operations and times (data/records/times.csv) of {} library functions, without the table",
            counts.len()
        ))
}
