//! What errors are of: a material alone, or a class with its materials taken together in some way.

use crate::fit::MethodErrors;
use crate::num::statistics::{median, medians, quantile};
use crate::reference::{MaterialClass, MaterialInMedium};

use super::MaterialSet;

/// How a class is taken together: the middle of its materials, where nine of ten end, the worst, or the middle over substances,
/// each with one vote however often it was measured.
pub const STATISTICS: [&str; 4] = ["median", "p90", "worst", "substances"];

/// The sets of these materials: classes first, where they hold more than one, then each material.
pub fn sets(subjects: &[MaterialInMedium], errors: &[Vec<MethodErrors>]) -> Vec<MaterialSet> {
    let classes = MaterialClass::ALL.into_iter();
    let classes = classes.flat_map(|class| class_sets(class, subjects, errors));
    let alone = subjects
        .iter()
        .zip(errors)
        .map(|(subject, errors)| MaterialSet {
            count: 1,
            name: subject.argument.clone(),
            title: subject.name.replace('_', " "),
            undescribed: undescribed(&[(subject, errors)]),
            errors: errors.clone(),
        });
    classes.chain(alone).collect()
}

/// The name of a class's set.
pub fn set_name(class: MaterialClass, statistic: &str) -> String {
    format!("{}-{statistic}", class.name())
}

/// A class taken together in each way; nothing of fewer than two materials.
fn class_sets(
    class: MaterialClass,
    subjects: &[MaterialInMedium],
    errors: &[Vec<MethodErrors>],
) -> Vec<MaterialSet> {
    let own: Vec<(&MaterialInMedium, &Vec<MethodErrors>)> = subjects
        .iter()
        .zip(errors)
        .filter(|(subject, _)| MaterialClass::containing(subject) == Some(class))
        .collect();
    if own.len() < 2 {
        return Vec::new();
    }
    let set = |statistic: &&str| MaterialSet {
        count: own.len(),
        name: set_name(class, statistic),
        title: set_title(class, statistic, own.len()),
        errors: together(statistic, &own),
        undescribed: undescribed(&own),
    };
    STATISTICS.iter().map(set).collect()
}

/// How many materials each entry has no error of, since its method does not describe them.
fn undescribed(own: &[(&MaterialInMedium, &Vec<MethodErrors>)]) -> Vec<usize> {
    let entries = own.first().map_or(0, |(_, errors)| errors.len());
    let unknown = |place: usize| {
        let errors = own.iter().map(|(_, errors)| errors[place].max_abs);
        errors.filter(Option::is_none).count()
    };
    (0..entries).map(unknown).collect()
}

fn set_title(class: MaterialClass, statistic: &str, count: usize) -> String {
    let statistic = match statistic {
        "median" => "the median of",
        "p90" => "nine of ten of",
        "worst" => "the worst of",
        _ => "one vote a substance over",
    };
    format!("{statistic} {count} {}", class.title())
}

/// Each entry's errors, of all materials together.
fn together(statistic: &str, own: &[(&MaterialInMedium, &Vec<MethodErrors>)]) -> Vec<MethodErrors> {
    let substances = || own.iter().map(|(subject, _)| &*subject.material.substance);
    let taken = |errors: &[f64]| match statistic {
        "median" => median(errors),
        "p90" => quantile(errors, 0.9),
        "worst" => quantile(errors, 1.0),
        _ => median(&medians(errors, substances())),
    };
    let entries = own.first().map_or(0, |(_, errors)| errors.len());
    let entry = |place: usize| {
        let all: Vec<MethodErrors> = own.iter().map(|(_, errors)| errors[place]).collect();
        MethodErrors::together(&all, &taken)
    };
    (0..entries).map(entry).collect()
}
