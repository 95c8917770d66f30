//! What charts show: the error of every method for every material, with its intended inputs and with its best ones, and what an
//! evaluation of its library function costs where that was recorded; a user's own function beside them.

use crate::fit::{
    Curve, ModelError, best_inputs, error_of, inputs_of, model_error, perceived, values_at,
};
use crate::ir::{Checked, Value};
use crate::methods::{ALL, Light, Method, Values};
use crate::num::in_parallel;
use crate::reference::{Subject, Truth};
use crate::spectra::Space;

use super::own::Own;
use super::{Data, Entry, Function, costs, sets};

/// The names of all axes of cost.
pub fn cost_names() -> Vec<&'static str> {
    let axes = costs::axes(&entries());
    axes.iter().map(|axis| axis.name).collect()
}

const BUILT: &str = "a test builds every method";

/// For each entry, the error on each axis.
pub(super) type Errors = Vec<[Option<f64>; 4]>;

/// The data of charts of these materials, with a user's function as one more entry. `progress` hears how many are done.
pub fn data(
    subjects: &[Subject],
    space: Space,
    own: Option<&Own>,
    command: String,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Data {
    let entries = entries();
    let mut errors = errors(&entries, subjects, space, progress);
    if let Some(own) = own {
        own.join(&mut errors);
    }
    let data = Data {
        costs: costs::axes(&entries),
        sets: sets::sets(subjects, &errors),
        entries,
        command,
    };
    match own {
        Some(own) => own.beside(data),
        None => data,
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
            function: Function::Method(method),
            is_best: false,
            fetches: library(method).fetches(),
        };
        let has_best = !method.is_fitted() && !method.is_textured();
        let best = has_best.then_some(Entry {
            is_best: true,
            ..own.clone()
        });
        entries.extend([own].into_iter().chain(best));
    }
    entries
}

/// The errors of all entries for each material.
fn errors(
    entries: &[Entry],
    subjects: &[Subject],
    space: Space,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Vec<Errors> {
    let of = |i: usize| of_subject(entries, &subjects[i], space);
    in_parallel(subjects.len(), &of, &mut |done, whole| {
        progress(done, whole, "materials");
    })
}

fn of_subject(entries: &[Entry], subject: &Subject, space: Space) -> Errors {
    let curve = Curve::new(|c| subject.truth.at(c));
    let of = |entry: &Entry| match entry.method() {
        Some(method) if subject.is_described_by(method) => {
            of_method(method, entry.is_best, subject, &curve, space)
        }
        _ => [None; 4],
    };
    entries.iter().map(of).collect()
}

fn of_method(
    method: &Method,
    is_best: bool,
    subject: &Subject,
    curve: &Curve,
    space: Space,
) -> [Option<f64>; 4] {
    let values = inputs_of(subject, method);
    if method.is_textured() {
        let function = method.specialise(&values).expect(BUILT);
        let error = model_error(&function, &subject.truth_for(method));
        return [Some(error.max_abs), error.mean_rel, None, None];
    }
    let values = if is_best {
        best_inputs(method, &values, curve).unwrap_or(values)
    } else {
        values
    };
    measured(method, &library(method), &values, &subject.truth, space)
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
