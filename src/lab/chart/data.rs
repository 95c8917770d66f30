//! The data of charts. It holds the error of every method for every material, with its intended inputs and with its best ones, the
//! recorded cost of its library function, and a user's own function beside them.
//!
//! The axes of cost are compilers' counts of library functions, the graph's own operations, and times. A logarithmic axis has no
//! 0, so a function that costs nothing has no point there.

use std::cell::LazyCell;
use std::collections::HashMap;
use std::sync::LazyLock;

use super::audited::ChartedFunction;
use super::recorded::{RECORDED, RecordedErrors, fingerprint, mark};
use super::sets::sets;
use super::view::{ChartData, ChartEntry, CostAxis, FunctionOrigin};
use crate::generator::emit;
use crate::generator::fit::{InputChoice, MaterialTruth, MethodErrors};
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::{FAMILIES, Family, GpuCompiler, library_cost, records};
use crate::lab::overdraw::library_times;
use crate::language::ir::Checked;
use crate::language::methods::{ALL, Light, Method};
use crate::physics::num::in_parallel;
use crate::physics::spectra::Space;

/// The axes of cost of all entries.
static AXES: LazyLock<Vec<CostAxis>> = LazyLock::new(|| axes(&entries()));

/// The names of all axes of cost.
pub fn cost_names() -> Vec<&'static str> {
    AXES.iter().map(|axis| axis.name).collect()
}

/// The data of charts of these materials, with a user's function as one more entry. `progress` is told how many are done.
pub fn chart_data(
    materials: &[MaterialInMedium],
    space: Space,
    own: Option<&ChartedFunction>,
    command: String,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> ChartData {
    let entries = entries();
    let mut errors = errors(&entries, materials, space, progress);
    if let Some(own) = own {
        own.join(&mut errors);
    }
    let data = ChartData {
        costs: AXES.clone(),
        sets: sets(materials, &errors),
        entries,
        command,
    };
    match own {
        Some(own) => own.with_function(data),
        None => data,
    }
}

/// The data of these methods alone, with their intended inputs.
pub fn intended_data(
    methods: impl Iterator<Item = &'static Method>,
    materials: &[MaterialInMedium],
    space: Space,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> ChartData {
    let entries: Vec<ChartEntry> = methods.map(intended).collect();
    let errors = errors(&entries, materials, space, progress);
    ChartData {
        costs: axes(&entries),
        sets: sets(materials, &errors),
        entries,
        command: String::new(),
    }
}

/// A method with its intended inputs.
fn intended(method: &'static Method) -> ChartEntry {
    ChartEntry {
        function: FunctionOrigin::Method(method),
        is_best: false,
        fetches: library(method).fetches(),
    }
}

fn library(method: &Method) -> Checked {
    method.function(false).expect("a test builds every method")
}

/// Every method for unpolarised light, and a second entry with its best inputs where its inputs can be chosen.
fn entries() -> Vec<ChartEntry> {
    let mut entries = Vec::new();
    let unpolarised = ALL.iter().copied();
    for method in unpolarised.filter(|method| method.light == Light::Unpolarised) {
        let own = intended(method);
        entries.push(own.clone());
        if !method.is_fitted() && !method.is_textured() && !method.keeps_inputs() {
            entries.push(ChartEntry {
                is_best: true,
                ..own
            });
        }
    }
    entries
}

/// The errors of all entries for each material.
fn errors(
    entries: &[ChartEntry],
    materials: &[MaterialInMedium],
    space: Space,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Vec<Vec<MethodErrors>> {
    let measured = measured(entries);
    let one = |i: usize| {
        let rows = errors_of(&measured, &materials[i], space, &RECORDED);
        let mut errors = vec![MethodErrors::default(); entries.len()];
        for (one, _, own) in rows {
            errors[one.at] = own;
        }
        errors
    };
    in_parallel(materials.len(), &one, &mut |done, whole| {
        progress(done, whole, "materials");
    })
}

/// The rows of `data/records/errors.csv`, without a look into it.
pub fn error_rows(materials: &[MaterialInMedium], space: Space) -> Vec<RecordedErrors> {
    let (entries, nothing) = (entries(), HashMap::new());
    let measured = measured(&entries);
    let one = |i: usize| {
        let rows = errors_of(&measured, &materials[i], space, &nothing).into_iter();
        let row = |(one, fingerprint, errors): EntryErrors| RecordedErrors {
            material: materials[i].label().to_owned(),
            method: one.method.name.to_owned(),
            inputs: one.inputs.name().to_owned(),
            fingerprint,
            max_abs: errors.max_abs,
            mean_rel: errors.mean_rel,
            luminance: errors.luminance,
            de2000: errors.de2000,
        };
        rows.map(row).collect::<Vec<_>>()
    };
    let all = in_parallel(materials.len(), &one, &mut |_, _| {});
    all.into_iter().flatten().collect()
}

/// An entry whose errors are measured here.
struct MeasuredEntry {
    /// Its place among the entries.
    at: usize,
    inputs: InputChoice,
    method: &'static Method,
    function: Checked,
    /// The function's fingerprint.
    mark: String,
}

/// An entry's errors, and their fingerprint.
type EntryErrors<'a> = (&'a MeasuredEntry, String, MethodErrors);

fn measured(entries: &[ChartEntry]) -> Vec<MeasuredEntry> {
    let mut all = Vec::new();
    for (at, entry) in entries.iter().enumerate() {
        let Some(method) = entry.method() else {
            continue;
        };
        let function = library(method);
        all.push(MeasuredEntry {
            at,
            inputs: match entry.is_best {
                true => InputChoice::Best,
                false => InputChoice::Intended,
            },
            method,
            mark: emit::fingerprint(&function),
            function,
        });
    }
    all
}

/// The errors of each entry that describes a material: as recorded, or found now.
fn errors_of<'a>(
    entries: &'a [MeasuredEntry],
    material: &MaterialInMedium,
    space: Space,
    known: &HashMap<String, MethodErrors>,
) -> Vec<EntryErrors<'a>> {
    let truth = LazyCell::new(|| MaterialTruth::new(material, space));
    let of_material = mark(material, space);
    let mut rows = Vec::new();
    for one in entries {
        if !material.is_described_by(one.method) {
            continue;
        }
        let fingerprint = fingerprint(&one.mark, one.inputs, &of_material);
        let errors = known.get(&fingerprint).copied().unwrap_or_else(|| {
            MethodErrors::new((one.method, &one.function), one.inputs, &truth).in_six_digits()
        });
        rows.push((one, fingerprint, errors));
    }
    rows
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
