//! The materials that claims over the catalogue are measured on: `data/records/samples.csv`. A new material is in no sample, so that
//! it changes no claim, and the record says which fitted methods miss it; `BLESS=1` adds its line. To take it into a sample, write
//! `yes` there: claims are then measured with it.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::fits::catalogue;
use fresnel_gen::generator::reference::MaterialInMedium;

/// The fitted methods that miss a material: they err more than they promise of its class.
pub type Misses<'a> = BTreeMap<&'a str, Vec<&'static str>>;

/// The samples that a material is in.
#[derive(Clone, Copy, Default)]
struct InSamples {
    /// The measurements of metals and semiconductors that choices of shapes are judged on.
    shapes: bool,
    /// What methods promise of classes of materials is measured on these.
    classes: bool,
}

pub fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/records/samples.csv")
}

fn samples_of(subject: &MaterialInMedium) -> InSamples {
    static SAMPLES: OnceLock<BTreeMap<String, InSamples>> = OnceLock::new();
    let line = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let samples = InSamples {
            shapes: cells[2] == "yes",
            classes: cells[3] == "yes",
        };
        (cells[0].to_owned(), samples)
    };
    let read = || {
        let text = std::fs::read_to_string(path()).expect("the record is there");
        text.lines().skip(1).map(line).collect()
    };
    let samples = SAMPLES.get_or_init(read).get(&subject.name);
    samples.copied().unwrap_or_default()
}

pub fn is_of_shapes(subject: &MaterialInMedium) -> bool {
    samples_of(subject).shapes
}

pub fn is_of_classes(subject: &MaterialInMedium) -> bool {
    samples_of(subject).classes
}

/// The measurements that choices of shapes are judged on.
pub fn shapes() -> Vec<&'static MaterialInMedium> {
    let own = catalogue().iter();
    own.filter(|subject| is_of_shapes(subject)).collect()
}

/// The record for the catalogue as it is.
pub fn record(misses: &Misses) -> String {
    let mut record = String::from("material,class,shapes,classes,misses\n");
    let word = |is_in: bool| if is_in { "yes" } else { "no" };
    for subject in catalogue() {
        let (name, class) = (&subject.name, subject.material.kind.name());
        let InSamples { shapes, classes } = samples_of(subject);
        let (shapes, classes) = (word(shapes), word(classes));
        let misses = misses
            .get(name.as_str())
            .map_or(String::new(), |all| all.join(" "));
        let _ = writeln!(record, "{name},{class},{shapes},{classes},{misses}");
    }
    record
}
