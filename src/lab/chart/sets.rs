//! The sets of materials that errors are shown for: a single material, or a class summarised by a statistic.
//!
//! Methods whose numbers were chosen on a class of materials have left-out errors too: each substance is judged by numbers that were
//! chosen without it. `tests/fit-f82 --left-out` finds these figures.

use serde::Serialize;

use crate::generator::fit::MethodErrors;
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::language::methods::Method;
use crate::physics::num::statistics::{median, medians, quantile};
use crate::physics::records::rows;

/// A material, or a class of materials summarised by a statistic.
#[derive(Clone, Debug)]
pub struct MaterialSet {
    /// Its name on the page: a material's, or a class's with a statistic.
    pub name: String,
    /// Its name in words.
    pub title: String,
    /// The number of its materials.
    pub count: usize,
    /// The errors of each entry. Unknown where the method does not describe the material.
    pub errors: Vec<MethodErrors>,
    /// The materials that the method of each entry does not describe.
    pub undescribed: Vec<Vec<String>>,
}

/// The statistics of a class: the median of its materials, the 90th percentile, the worst, or the median over substances, each of
/// which counts once however often it was measured.
pub const STATISTICS: [&str; 4] = ["median", "p90", "worst", "substances"];

/// The sets of these materials: first the classes that hold more than one, then each material.
pub fn sets(materials: &[MaterialInMedium], errors: &[Vec<MethodErrors>]) -> Vec<MaterialSet> {
    let alone = |(material, errors): (&MaterialInMedium, &Vec<MethodErrors>)| MaterialSet {
        count: 1,
        name: material.label().to_owned(),
        title: material.name.replace('_', " "),
        undescribed: undescribed(&[(material, errors)]),
        errors: errors.clone(),
    };
    let classes = MaterialClass::ALL.into_iter();
    classes
        .flat_map(|class| class_sets(class, materials, errors))
        .chain(materials.iter().zip(errors).map(alone))
        .collect()
}

/// The name of a class's set.
pub fn set_name(class: MaterialClass, statistic: &str) -> String {
    format!("{}-{statistic}", class.name())
}

/// A class by each statistic. Empty for fewer than two materials.
fn class_sets(
    class: MaterialClass,
    materials: &[MaterialInMedium],
    errors: &[Vec<MethodErrors>],
) -> Vec<MaterialSet> {
    let own: Vec<(&MaterialInMedium, &Vec<MethodErrors>)> = materials
        .iter()
        .zip(errors)
        .filter(|(material, _)| MaterialClass::containing(material) == Some(class))
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
        none.map(|(material, _)| material.label().to_owned())
            .collect()
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
    let entries = own.first().map_or(0, |(_, errors)| errors.len());
    let entry = |place: usize| {
        let described = own
            .iter()
            .filter(|(_, errors)| errors[place].max_abs.is_some())
            .map(|(material, errors)| (&*material.material.substance, errors[place]));
        let (substances, errors): (Vec<&str>, Vec<MethodErrors>) = described.unzip();
        if ALL_BUT * (own.len() - errors.len()) > own.len() {
            return MethodErrors::default();
        }
        MethodErrors::together(&errors, &|errors| match statistic {
            "median" => median(errors),
            "p90" => quantile(errors, 0.9),
            "worst" => quantile(errors, 1.0),
            _ => median(&medians(errors, substances.iter().copied())),
        })
    };
    (0..entries).map(entry).collect()
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
