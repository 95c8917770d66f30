//! Which variant of a method a GPU wants. The [variants](Method::variants) of a method mean the same and cost differently: weights that
//! channels share save where a GPU computes one number at a time, and cost where it computes vectors or counts waits. The choice is made
//! by recorded costs and stands in `data/records/variants.csv`.

use core::fmt;
use std::collections::BTreeSet;
use std::str::FromStr;
use std::sync::LazyLock;

use serde::Deserialize;

use super::method::Method;
use crate::physics::names::{UnknownName, named};
use crate::physics::num::Precision;
use crate::physics::records;

/// What functions are written for: a family of GPUs as `cost` knows them, or a mix of families.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Gpu(&'static str);

/// Families that functions are written for together. Of each family counts the cost of a variant as a share of the usual form's.
#[derive(Debug)]
pub struct Mix {
    /// The mix.
    pub gpu: Gpu,
    /// The names of its families.
    pub families: &'static [&'static str],
    /// The families in words.
    pub words: &'static str,
}

/// All mixes.
pub static MIXES: [Mix; 2] = [
    Mix {
        gpu: Gpu::DESKTOP,
        families: &["rdna2", "xe", "maxwell"],
        words: "desktops (RDNA 2, Intel Xe and NVIDIA Maxwell alike)",
    },
    Mix {
        gpu: Gpu::PHONES,
        families: &["adreno630", "malig57", "malig72"],
        words: "phones (Adreno 630, Mali-G57 and Mali-G72 alike)",
    },
];

impl Gpu {
    /// Desktops.
    pub const DESKTOP: Gpu = Gpu("desktop");
    /// Phones.
    pub const PHONES: Gpu = Gpu("phones");
    /// No GPU: operations are counted, and each method is written in its usual form.
    const OPERATIONS: Gpu = Gpu("operations");

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        self.0
    }

    /// What it is, for the head of a file.
    pub fn words(self) -> &'static str {
        let mix = MIXES.iter().find(|mix| mix.gpu == self);
        mix.map_or(self.0, |mix| mix.words)
    }

    /// All: mixes first, then families.
    pub fn all() -> impl Iterator<Item = Gpu> {
        let families = CHOICES.iter().map(|row| Gpu(&row.gpu));
        let mut all: Vec<Gpu> = families.filter(|gpu| !gpu.is_mix()).collect();
        all.dedup();
        let mixes = MIXES.iter().map(|mix| mix.gpu);
        mixes.chain([Gpu::OPERATIONS]).chain(all)
    }

    /// The one of this name. There is none for a family that no compiler is known of.
    pub fn find(name: &str) -> Option<Gpu> {
        Gpu::all().find(|gpu| gpu.0 == name)
    }

    /// GPUs for which, together, each variant is written that any GPU gets.
    pub fn covering() -> Vec<Gpu> {
        let (mut written, mut gpus) = (BTreeSet::new(), Vec::new());
        for row in CHOICES.iter() {
            let gpu = Gpu(&row.gpu);
            if written.insert((&row.method, &row.form, &row.precision, &row.variant)) {
                gpus.push(gpu);
            }
        }
        gpus.dedup();
        gpus
    }

    fn is_mix(self) -> bool {
        MIXES.iter().any(|mix| mix.gpu == self)
    }
}

impl fmt::Display for Gpu {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(self.0)
    }
}

impl FromStr for Gpu {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Gpu, UnknownName> {
        named("GPU", name, Gpu::find(name), Gpu::all().map(Gpu::name))
    }
}

/// A row of the record.
#[derive(Deserialize)]
struct Choice {
    gpu: String,
    method: String,
    /// What the function takes, as reports name it: `library`, `scalar`, `specialised`.
    form: String,
    precision: String,
    /// The variant; empty for the usual form.
    variant: String,
}

static RECORD: &str = include_str!("../../../data/records/variants.csv");

static CHOICES: LazyLock<Vec<Choice>> = LazyLock::new(|| records::rows(RECORD));

impl Method {
    /// This method as it is written for a GPU: one of its variants, or itself. `form` is what the function takes, as reports name it:
    /// `library`, `scalar`, `specialised`.
    pub fn written_for(
        &'static self,
        gpu: Gpu,
        form: &'static str,
        precision: Precision,
    ) -> &'static Method {
        let is_row = |row: &&Choice| {
            row.gpu == gpu.0
                && row.method == self.name
                && row.form == form
                && row.precision == precision.name()
        };
        let of = |name: &str| self.variants.iter().find(|one| one.variant == name);
        let has_choice = !self.variants.is_empty();
        let row = has_choice.then(|| CHOICES.iter().find(is_row)).flatten();
        row.and_then(|row| of(&row.variant))
            .copied()
            .unwrap_or(self)
    }
}
