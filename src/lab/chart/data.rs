//! What charts show: the error of every method for every material, with its intended inputs and with its best ones, and what an
//! evaluation of its library function costs where that was recorded; a user's own function beside them.
//!
//! What methods are worth whose numbers were chosen on a class of materials: each substance judged by numbers that were chosen
//! without it. `tests/fit-f82 --left-out` finds the figures.
//!
//! Which methods have no point on a chart, or one without some of the materials, and why.
//!
//! What some methods and the exact law give for one material at all angles.
//!
//! The axes of cost: what compilers count in library functions, the graph's own operations, and times. An axis in powers of ten has no
//! 0: a function that costs nothing has no cost there, and so no point.

use std::collections::BTreeMap;

use serde::Serialize;

use super::audited::ChartedFunction;
use super::{
    ChartData, ChartEntry, ChartView, CostAxis, FunctionOrigin, MaterialSet, STATISTICS, set_name,
    sets,
};
use crate::generator::emit::{Bounds, FunctionForm, Naming, specialised_function};
use crate::generator::fit::{FitCurve, InputChoice, MethodErrors};
use crate::generator::reference::{Derivation, MaterialClass, MaterialInMedium};
use crate::lab::cost::{FAMILIES, Family, GpuCompiler, library_cost, records};
use crate::lab::overdraw::times;
use crate::language::ir::{Value, evaluate};
use crate::language::methods::{self, ALL, Light, Method};
use crate::physics::materials::{self, ViewingConditions};
use crate::physics::num::{Precision, in_parallel};
use crate::physics::optics::cosine;
use crate::physics::records::rows;
use crate::physics::spectra::Space;

/// The names of all axes of cost.
pub fn cost_names() -> Vec<&'static str> {
    let axes = axes(&entries());
    axes.iter().map(|axis| axis.name).collect()
}

/// The data of charts of these materials, with a user's function as one more entry. `progress` hears how many are done.
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

/// Every method for unpolarised light, and beside it the same with its best inputs where it has inputs of its own to choose.
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

/// The errors of all entries for a material; unknown of methods that do not describe it.
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

/// Largest errors over angles and channels, of materials by numbers that were chosen without their substance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeftOutErrors {
    /// The median, each measurement once.
    pub median: f64,
    /// The 90th percentile, each measurement once.
    pub p90: f64,
    /// The median, each substance once.
    pub median_by_substance: f64,
    /// The 90th percentile, each substance once.
    pub p90_by_substance: f64,
}

/// How many of the sample's measurements are of metals.
const METALS_OF_THE_SAMPLE: usize = 66;

/// The errors of a method over the sample of metals and semiconductors on which its numbers were chosen; none beside sets of other materials
/// or of fewer metals than the sample has, and for methods whose numbers were not chosen on it.
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

/// A sentence for each reason, with the functions that it keeps from the chart.
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
        // A user's function without a point says why itself.
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

/// The reflectance of a material of the catalogue at these angles, in degrees: by each of these methods, and last by the exact law
/// of the whole spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct Reflectances {
    /// By methods, in their order.
    pub by_methods: Vec<Vec<[f64; 3]>>,
    /// By the exact law.
    pub exact: Vec<[f64; 3]>,
}

/// Computes them, in air and as materials are seen by default.
///
/// # Errors
/// A material or a method is not there, or cannot be seen.
pub fn exact_and_approximated(
    material: &str,
    methods: &[&str],
    degrees: &[f64],
) -> Result<Reflectances, String> {
    let found = materials::find(material);
    let found = found.ok_or_else(|| format!("there is no material {material}"))?;
    let typed = (material.to_owned(), found.map_err(|why| why.to_string())?);
    let viewing = ViewingConditions::default();
    let subject = MaterialInMedium::new(typed, None, &viewing, Derivation::default());
    let subject = subject.map_err(|why| why.to_string())?;
    let cosines: Vec<f64> = degrees.iter().copied().map(cosine).collect();
    let mut by_methods = Vec::new();
    for name in methods {
        let method = methods::find(name).ok_or_else(|| format!("there is no method {name}"))?;
        let (naming, bounds) = (Naming::default(), Bounds::recorded());
        let emitted = specialised_function(method, &subject, &naming, &bounds);
        let function = emitted.map_err(|why| why.to_string())?.function;
        let values = evaluate(&function, &[Value::each(cosines.clone())]);
        by_methods.push((0..cosines.len()).map(|i| values.at(i)).collect());
    }
    let exact = cosines.iter().map(|c| subject.reference.at(*c)).collect();
    Ok(Reflectances { by_methods, exact })
}

/// An axis for each family of which anything is recorded, and one of times.
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

/// Shares of time on the device of the record.
fn timed(entries: &[ChartEntry]) -> Option<CostAxis> {
    let all: Vec<_> = times()
        .into_iter()
        .filter(|time| time.form == FunctionForm::Library && time.precision == Precision::F32)
        .collect();
    let device = all.first()?.device.clone();
    let share = |entry: &ChartEntry| {
        let own = all
            .iter()
            .find(|time| time.method == entry.name() && time.device == device);
        own.map(|time| 100.0 * time.share)
    };
    Some(CostAxis {
        name: "time",
        title: format!("time on {device}, in per cent of dielectric_exact"),
        holds_fetches: true,
        costs: entries.iter().map(share).collect(),
    })
}
