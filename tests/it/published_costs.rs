//! The record of what published functions cost, and its table beside ours. `audit::ranked` measures them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use fresnel_gen::generator::emit::FunctionForm;
use fresnel_gen::lab::cost::{FAMILIES, records};
use fresnel_gen::language::methods;
use fresnel_gen::physics::num::Precision;

/// Families with a compiler: the count of operations has none, and none of PowerVR's is available.
pub fn families() -> impl Iterator<Item = &'static str> {
    let names = FAMILIES.iter().map(|family| family.name);
    names.filter(|name| !["operations", "powervr"].contains(name))
}

/// What a published function costs on a family. The test that measures needs compilers; it reads the field that others do not.
#[derive(Clone, Debug, Deserialize)]
pub struct PublishedCost {
    /// The family.
    pub gpu: String,
    /// Our method that computes the same.
    pub ours: String,
    /// How many channels.
    pub channels: usize,
    /// The file and the function.
    pub function: String,
    /// The cost.
    pub cost: f64,
}

/// Where it stands.
pub fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/records/published-costs.csv")
}

/// Its rows.
pub fn recorded() -> Vec<PublishedCost> {
    let text = std::fs::read_to_string(path()).unwrap_or_default();
    fresnel_gen::physics::records::rows(&text)
}

/// What ours costs there, in the form that is written for the family.
pub fn own(gpu: &str, ours: &str, channels: usize) -> f64 {
    let form = match channels {
        1 => FunctionForm::Scalar,
        _ => FunctionForm::Library,
    };
    let method = methods::find(ours).expect("it is a method");
    let figures = records(gpu).of_library(method, form, Precision::F32);
    figures.expect("it is recorded").cost()
}

/// What a class of functions is called in the document: ours, and the channels.
const COLUMNS: [(&str, usize, &str); 9] = [
    ("schlick", 3, "`schlick`"),
    (
        "schlick_spherical_gaussian",
        3,
        "`schlick_spherical_gaussian`",
    ),
    ("hoffman_f82", 3, "`hoffman_f82`"),
    ("f82_tint", 3, "`f82_tint`"),
    ("dielectric_exact", 3, "`dielectric_exact`"),
    ("dielectric_exact", 1, "the same, one channel"),
    ("conductor_exact_metal", 3, "`conductor_exact_metal`"),
    ("dielectric_tinted", 3, "`dielectric_tinted`"),
    ("schlick_f82_f90", 3, "`schlick_f82_f90`"),
];

/// For each family ours, and the cheapest published function that computes the same.
pub fn published_table() -> String {
    let mut cheapest: BTreeMap<(String, String, usize), f64> = BTreeMap::new();
    for row in recorded() {
        let key = (row.gpu, row.ours, row.channels);
        let least = cheapest.entry(key).or_insert(f64::INFINITY);
        *least = least.min(row.cost);
    }
    let titles = COLUMNS.map(|(_, _, title)| title).join(" | ");
    let mut text = format!(
        "| family | {titles} |\n| --- |{}\n",
        " --- |".repeat(COLUMNS.len())
    );
    for gpu in families() {
        let cell = |(ours, channels, _): (&str, usize, &str)| {
            let key = (gpu.to_owned(), ours.to_owned(), channels);
            let theirs = cheapest.get(&key).expect("it is recorded");
            format!("{} / {}", figure(own(gpu, ours, channels)), figure(*theirs))
        };
        text += &format!("| {gpu} | {} |\n", COLUMNS.map(cell).join(" | "));
    }
    text
}

/// Three digits.
fn figure(cost: f64) -> String {
    match cost {
        c if c >= 10.0 => format!("{c:.0}"),
        c if c >= 1.0 => format!("{c:.1}"),
        c => format!("{c:.2}"),
    }
}
