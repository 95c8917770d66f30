//! What charts show: the error of every method for every material, with its intended inputs and with its best ones, and what an
//! evaluation of its library function costs where that was recorded; a user's own function beside them.

use crate::generator::fit::{FitCurve, InputChoice, MethodErrors};
use crate::generator::reference::MaterialInMedium;
use crate::language::methods::{ALL, Light};
use crate::physics::num::in_parallel;
use crate::physics::spectra::Space;

use super::own::ChartedFunction;
use super::{ChartData, ChartEntry, FunctionOrigin, costs, sets};

/// The names of all axes of cost.
pub fn cost_names() -> Vec<&'static str> {
    let axes = costs::axes(&entries());
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
        costs: costs::axes(&entries),
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
