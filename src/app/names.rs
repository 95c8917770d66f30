//! Names that are not there: what is, and which of it comes nearest.

use crate::cost::{FAMILIES, Family, find};

use super::error::Error;

/// How alike two names must be (Jaro-Winkler, 0 to 1) before one is offered for the other.
const ALIKE: f64 = 0.7;
/// How many are offered at most.
const OFFERED: usize = 3;

/// The error for a name that does not exist.
pub fn unknown(kind: &'static str, name: &str, all: &[&str]) -> Error {
    Error::Unknown {
        kind,
        name: name.to_owned(),
        nearest: nearest(name, all),
        all: listed(kind, all),
    }
}

/// The family of GPUs of this name.
pub fn family(name: &str) -> Result<&'static Family, Error> {
    let all: Vec<&str> = FAMILIES.iter().map(|family| family.name).collect();
    find(name).ok_or_else(|| unknown("GPU family", name, &all))
}

/// All names, or where to find them where they are many.
fn listed(kind: &str, all: &[&str]) -> String {
    const MANY: usize = 40;
    if all.len() > MANY {
        let see = if kind == "substance" {
            "material"
        } else {
            kind
        };
        format!("{} of them: see `fresnel-gen {see}s`", all.len())
    } else {
        all.join(", ")
    }
}

/// The names most like this one, best first.
pub fn nearest(name: &str, all: &[&str]) -> Vec<String> {
    let score = |other: &str| strsim::jaro_winkler(&name.to_lowercase(), &other.to_lowercase());
    let mut alike: Vec<&str> = all
        .iter()
        .copied()
        .filter(|other| score(other) >= ALIKE)
        .collect();
    alike.sort_by(|a, b| score(b).total_cmp(&score(a)));
    alike.into_iter().take(OFFERED).map(str::to_owned).collect()
}
