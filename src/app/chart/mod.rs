//! What charts show: the error of every method for every material, with its intended inputs and with its best ones, and what an
//! evaluation of its library function costs where that was recorded.

mod costs;
mod sets;

use crate::app::parallel::each;
use crate::emit::Subject;
use crate::fit::{
    Curve, ModelError, Truth, best_inputs, error_of, model_error, perceived, values_at,
};
use crate::ir::{Checked, Value};
use crate::methods::{ALL, Class, Light, Method, Values};
use crate::report::frontier::{Data, Entry};
use crate::spectra::Space;

pub use sets::{CLASSES, OF};

/// The names of all axes of cost.
pub fn cost_names() -> Vec<&'static str> {
    let axes = costs::axes(&entries());
    axes.iter().map(|axis| axis.name).collect()
}

const BUILT: &str = "a test builds every method";

/// For each entry, the error on each axis.
type Errors = Vec<[Option<f64>; 4]>;

/// The data of charts of these materials. `progress` hears how many are done.
pub fn data(
    subjects: &[Subject],
    space: Space,
    command: String,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Data {
    let entries = entries();
    let errors = errors(&entries, subjects, space, progress);
    Data {
        costs: costs::axes(&entries),
        sets: sets::sets(subjects, &errors),
        entries,
        command,
    }
}

/// Every method for unpolarised light, and beside it the same with its best inputs where it has inputs of its own to choose.
fn entries() -> Vec<Entry> {
    let mut entries = Vec::new();
    for method in ALL
        .iter()
        .copied()
        .filter(|method| method.light == Light::Unpolarised)
    {
        let own = Entry {
            method,
            is_best: false,
            fetches: library(method).fetches(),
        };
        let has_best = !method.is_fitted() && !method.is_textured();
        let best = has_best.then_some(Entry {
            is_best: true,
            ..own
        });
        entries.extend([own].into_iter().chain(best));
    }
    entries
}

/// The errors of all entries for each material, shared among the processor's cores.
fn errors(
    entries: &[Entry],
    subjects: &[Subject],
    space: Space,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Vec<Errors> {
    let whole = subjects.len() as u64;
    each(
        subjects,
        |subject| of_subject(entries, subject, space),
        &mut |done| progress(done as u64, whole, "materials"),
    )
}

fn of_subject(entries: &[Entry], subject: &Subject, space: Space) -> Errors {
    let transparent = subject.effective.channels.is_transparent();
    let of = |entry: &Entry| {
        if entry.method.class == Class::Dielectric && !transparent {
            return [None; 4];
        }
        of_entry(entry, subject, space)
    };
    entries.iter().map(of).collect()
}

fn of_entry(entry: &Entry, subject: &Subject, space: Space) -> [Option<f64>; 4] {
    let method = entry.method;
    let truth = subject.truth_for(method);
    let values = subject.values(method);
    if method.is_textured() {
        let function = method.specialise(&values).expect(BUILT);
        let error = model_error(&function, &truth);
        return [Some(error.max_abs), error.mean_rel, None, None];
    }
    let values = if entry.is_best {
        let curve = Curve::new(|c| truth.at(c));
        best_inputs(method, &values, &curve).unwrap_or(values)
    } else {
        values
    };
    measured(method, &library(method), &values, &truth, space)
}

/// The four errors; angles at which the method gives no number are left out.
fn measured(
    method: &Method,
    function: &Checked,
    values: &Values,
    truth: &Truth,
    space: Space,
) -> [Option<f64>; 4] {
    let run =
        |cosines: &[f64]| -> Value<f64> { values_at(function, method.inputs, values, cosines) };
    let error: ModelError = error_of(truth, &run);
    let seen = perceived(truth, space, &run);
    [
        Some(error.max_abs),
        error.mean_rel,
        Some(seen.luminance),
        Some(seen.de2000),
    ]
}

/// The library function of a method.
fn library(method: &Method) -> Checked {
    method.function(false).expect(BUILT)
}
