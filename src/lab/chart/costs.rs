//! The axes of cost: what compilers count in library functions, the graph's own operations, and times. An axis in powers of ten has no
//! 0: a function that costs nothing has no cost there, and so no point.

use crate::generator::emit::FunctionForm;
use crate::lab::cost::{FAMILIES, Family, GpuCompiler, library_cost, records};
use crate::lab::overdraw::times;
use crate::physics::num::Precision;

use super::{ChartEntry, CostAxis};

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
