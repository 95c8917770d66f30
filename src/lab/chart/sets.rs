//! The sets of materials that errors are shown for: a single material, or a class summarised by a statistic.

use super::MaterialSet;
use crate::generator::fit::MethodErrors;
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::physics::num::statistics::{median, medians, quantile};

/// The statistics of a class: the median of its materials, the 90th percentile, the worst, or the median over substances, each of
/// which counts once however often it was measured.
pub const STATISTICS: [&str; 4] = ["median", "p90", "worst", "substances"];

/// The sets of these materials: first the classes that hold more than one, then each material.
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

/// A class by each statistic. Empty for fewer than two materials.
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

/// The materials for which each entry has no error, since its method does not describe them.
fn undescribed(own: &[(&MaterialInMedium, &Vec<MethodErrors>)]) -> Vec<Vec<String>> {
    let entries = own.first().map_or(0, |(_, errors)| errors.len());
    let unknown = |place: usize| {
        let none = own
            .iter()
            .filter(|(_, errors)| errors[place].max_abs.is_none());
        none.map(|(subject, _)| subject.argument.clone()).collect()
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

/// A method is shown for a class if it describes all materials but one in this many.
const ALL_BUT: usize = 20;

/// Each entry's errors by a statistic over all materials, or over all but the few that the method does not describe.
fn together(statistic: &str, own: &[(&MaterialInMedium, &Vec<MethodErrors>)]) -> Vec<MethodErrors> {
    let taken = |described: &[(&str, MethodErrors)]| {
        let substances = || described.iter().map(|(substance, _)| *substance);
        let taken = |errors: &[f64]| match statistic {
            "median" => median(errors),
            "p90" => quantile(errors, 0.9),
            "worst" => quantile(errors, 1.0),
            _ => median(&medians(errors, substances())),
        };
        let errors: Vec<MethodErrors> = described.iter().map(|(_, errors)| *errors).collect();
        MethodErrors::together(&errors, &taken)
    };
    let entries = own.first().map_or(0, |(_, errors)| errors.len());
    let entry = |place: usize| {
        let all = own
            .iter()
            .map(|(subject, errors)| (&*subject.material.substance, errors[place]));
        let described = all.filter(|(_, errors)| errors.max_abs.is_some());
        let described: Vec<(&str, MethodErrors)> = described.collect();
        if ALL_BUT * (own.len() - described.len()) <= own.len() {
            taken(&described)
        } else {
            MethodErrors::default()
        }
    };
    (0..entries).map(entry).collect()
}
