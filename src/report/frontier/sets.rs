//! What errors are of: a material alone, or a class with its materials taken together in some way.

use crate::materials::Kind;
use crate::num::statistics::{median, medians, quantile};
use crate::reference::{LEAST_FITTED_N, Subject};
use crate::report::class_title;

use super::Set;
use super::measure::Errors;

/// The classes, by the names of their sets.
pub const CLASSES: [&str; 2] = ["metals", "dielectrics"];
/// How a class is taken together: the middle of its materials, where nine of ten end, the worst, or the middle over substances,
/// each with one vote however often it was measured.
pub const OF: [&str; 4] = ["median", "p90", "worst", "substances"];

/// The sets of these materials: classes first, where they hold more than one, then each material.
pub fn sets(subjects: &[Subject], errors: &[Errors]) -> Vec<Set> {
    let together = CLASSES
        .iter()
        .flat_map(|class| together(class, subjects, errors));
    let alone = subjects.iter().zip(errors).map(|(subject, errors)| Set {
        name: subject.argument.clone(),
        title: subject.name.replace('_', " "),
        errors: errors.clone(),
    });
    together.chain(alone).collect()
}

/// The class that a material is in: none for gases, and for dielectrics that absorb.
pub fn class(subject: &Subject) -> Option<&'static str> {
    let n = subject.effective.channels.n;
    let is_solid = n.iter().all(|n| *n >= LEAST_FITTED_N);
    match subject.material.kind {
        Kind::Metal | Kind::Semiconductor => Some(CLASSES[0]),
        Kind::Dielectric if is_solid && subject.effective.channels.is_transparent() => {
            Some(CLASSES[1])
        }
        Kind::Dielectric => None,
    }
}

fn together(class: &str, subjects: &[Subject], errors: &[Errors]) -> Vec<Set> {
    let own: Vec<(&Subject, &Errors)> = subjects
        .iter()
        .zip(errors)
        .filter(|(subject, _)| self::class(subject) == Some(class))
        .collect();
    if own.len() < 2 {
        return Vec::new();
    }
    let set = |of: &&str| Set {
        name: format!("{class}-{of}"),
        title: title(class, of, own.len()),
        errors: taken(of, &own),
    };
    OF.iter().map(set).collect()
}

fn title(class: &str, of: &str, count: usize) -> String {
    let class = class_title(class);
    let of = match of {
        "median" => "the median of",
        "p90" => "nine of ten of",
        "worst" => "the worst of",
        _ => "one vote a substance over",
    };
    format!("{of} {count} {class}")
}

/// Each entry's error on each axis, of all materials together; none where it is not known of one of them.
fn taken(of: &str, own: &[(&Subject, &Errors)]) -> Errors {
    let substances = || own.iter().map(|(subject, _)| &*subject.material.substance);
    let entries = own.first().map_or(0, |(_, errors)| errors.len());
    let figure = |entry: usize, axis: usize| -> Option<f64> {
        let known: Option<Vec<f64>> = own.iter().map(|(_, errors)| errors[entry][axis]).collect();
        let known = known?;
        Some(match of {
            "median" => median(&known),
            "p90" => quantile(&known, 0.9),
            "worst" => quantile(&known, 1.0),
            _ => median(&medians(&known, substances())),
        })
    };
    let axes = |entry: usize| [0, 1, 2, 3].map(|axis| figure(entry, axis));
    (0..entries).map(axes).collect()
}
