//! The data of charts. It holds the error of every method for every material, with its intended inputs and with its best ones, the
//! recorded cost of its library function, and a user's own function beside them.
//!
//! The axes of cost are compilers' counts of library functions, the graph's own operations, and times. A logarithmic axis has no
//! 0, so a function that costs nothing has no point there. Methods without a point, or with one that leaves materials out, are
//! listed with the reason.
//!
//! Methods whose numbers were chosen on a class of materials also have left-out errors: each substance is judged by numbers that
//! were chosen without it. `tests/fit-f82 --left-out` finds these figures.

use std::collections::BTreeMap;

use serde::Serialize;

use super::audited::ChartedFunction;
use super::{
    ChartData, ChartEntry, ChartView, CostAxis, FunctionOrigin, MaterialSet, STATISTICS, set_name,
    sets,
};
use crate::generator::fit::{FitCurve, InputChoice, MethodErrors};
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::lab::cost::{FAMILIES, Family, GpuCompiler, library_cost, records};
use crate::lab::overdraw::library_times;
use crate::language::methods::{ALL, Light, Method};
use crate::physics::num::in_parallel;
use crate::physics::records::rows;
use crate::physics::spectra::Space;

/// The names of all axes of cost.
pub fn cost_names() -> Vec<&'static str> {
    let axes = axes(&entries());
    axes.iter().map(|axis| axis.name).collect()
}

/// The data of charts of these materials, with a user's function as one more entry. `progress` is told how many are done.
pub fn chart_data(
    subjects: &[MaterialInMedium],
    space: Space,
    own: Option<&ChartedFunction>,
    command: String,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> ChartData {
    let entries = entries();
    let mut errors = errors(&entries, subjects, space, progress);
    if let Some(own) = own {
        own.join(&mut errors);
    }
    let data = ChartData {
        costs: axes(&entries),
        sets: sets::sets(subjects, &errors),
        entries,
        command,
    };
    match own {
        Some(own) => own.with_function(data),
        None => data,
    }
}

/// Every method for unpolarised light, and a second entry with its best inputs where its inputs can be chosen.
fn entries() -> Vec<ChartEntry> {
    let mut entries = Vec::new();
    for method in ALL
        .iter()
        .copied()
        .filter(|method| method.light == Light::Unpolarised)
    {
        let library = method.function(false).expect("a test builds every method");
        let own = ChartEntry {
            function: FunctionOrigin::Method(method),
            is_best: false,
            fetches: library.fetches(),
        };
        let has_best = !method.is_fitted() && !method.is_textured();
        let best = has_best.then_some(ChartEntry {
            is_best: true,
            ..own.clone()
        });
        entries.extend([own].into_iter().chain(best));
    }
    entries
}

/// The errors of all entries for each material.
fn errors(
    entries: &[ChartEntry],
    subjects: &[MaterialInMedium],
    space: Space,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Vec<Vec<MethodErrors>> {
    let one = |i: usize| entry_errors(entries, &subjects[i], space);
    in_parallel(subjects.len(), &one, &mut |done, whole| {
        progress(done, whole, "materials");
    })
}

/// The errors of all entries for a material. Unknown for methods that do not describe it.
fn entry_errors(
    entries: &[ChartEntry],
    subject: &MaterialInMedium,
    space: Space,
) -> Vec<MethodErrors> {
    let curve = FitCurve::new(|c| subject.reference.at(c));
    let one = |entry: &ChartEntry| match entry.method() {
        Some(method) if subject.is_described_by(method) => {
            let inputs = if entry.is_best {
                InputChoice::Best
            } else {
                InputChoice::Intended
            };
            MethodErrors::new(method, inputs, subject, &curve, space)
        }
        _ => MethodErrors::default(),
    };
    entries.iter().map(one).collect()
}

static RECORD: &str = include_str!("../../../data/records/left-out.csv");

/// Statistics of the largest errors over angles and channels, for materials judged by numbers that were chosen without their
/// substance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeftOutErrors {
    /// The median over measurements.
    pub median: f64,
    /// The 90th percentile over measurements.
    pub p90: f64,
    /// The median over substances.
    pub median_by_substance: f64,
    /// The 90th percentile over substances.
    pub p90_by_substance: f64,
}

/// The number of the sample's measurements that are of metals.
const METALS_OF_THE_SAMPLE: usize = 66;

/// The left-out errors of a method over the sample of metals and semiconductors on which its numbers were chosen. None for sets
/// of other materials or of fewer metals than the sample has, and for methods whose numbers were not chosen on it.
pub fn left_out(method: &Method, set: &MaterialSet) -> Option<LeftOutErrors> {
    let is_set = |statistic| set.name == set_name(MaterialClass::Metals, statistic);
    if set.count < METALS_OF_THE_SAMPLE || !STATISTICS.into_iter().any(is_set) {
        return None;
    }
    let recorded: Vec<(String, f64, f64, f64, f64)> = rows(RECORD);
    let own = recorded.into_iter().find(|row| row.0 == method.name)?;
    let (_, median, p90, median_by_substance, p90_by_substance) = own;
    Some(LeftOutErrors {
        median,
        p90,
        median_by_substance,
        p90_by_substance,
    })
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
        return is_part.then(|| {
            format!(
                "shown without {}: it gives no number there",
                undescribed.join(", ")
            )
        });
    };
    let described = method.class.described();
    if !undescribed.is_empty() {
        let of = match (undescribed.len(), count) {
            (_, 1) => "this is none".to_owned(),
            (some, all) if some == all => "none of these is one".to_owned(),
            (some, all) if !has_error => format!("{some} of these {all} are none"),
            _ => {
                return Some(format!(
                    "shown without {}, of {described} only",
                    undescribed.join(", ")
                ));
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

/// An axis for each family with recorded costs, and one of times.
pub fn axes(entries: &[ChartEntry]) -> Vec<CostAxis> {
    let mut axes = Vec::new();
    for family in FAMILIES.iter() {
        let record = records(family.name);
        let cost = |entry: &ChartEntry| {
            let cost = library_cost(entry.method()?, family, &record);
            cost.filter(|cost| *cost > 0.0)
        };
        let costs: Vec<Option<f64>> = entries.iter().map(cost).collect();
        if costs.iter().any(Option::is_some) {
            axes.push(CostAxis {
                name: family.name,
                title: title(family),
                holds_fetches: false,
                costs,
            });
        }
    }
    axes.extend(timed(entries));
    axes
}

fn title(family: &Family) -> String {
    let measure = family.columns.measure;
    match family.compiler {
        GpuCompiler::Operations => format!("{measure} in the function itself, before any compiler"),
        _ => format!(
            "{measure} of an evaluation on {} ({}), by its compiler",
            family.gpu, family.vendor
        ),
    }
}

/// The axis of times, as shares on the device of the record.
fn timed(entries: &[ChartEntry]) -> Option<CostAxis> {
    let all = library_times();
    let device = all.first()?.device.clone();
    let share = |entry: &ChartEntry| {
        let own = all
            .iter()
            .find(|time| time.method.name == entry.name() && time.device == device);
        own.map(|time| 100.0 * time.share)
    };
    Some(CostAxis {
        name: "time",
        title: format!("time on {device}, in per cent of dielectric_exact"),
        holds_fetches: true,
        costs: entries.iter().map(share).collect(),
    })
}
