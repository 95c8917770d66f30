//! Names that are not there: what is, and which of it comes nearest.

use thiserror::Error;

/// How alike two names must be (Jaro-Winkler, 0 to 1) before one is offered for the other.
const ALIKE: f64 = 0.7;
/// How many are offered at most.
const OFFERED: usize = 3;

/// A name that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no {kind} `{name}`{}; there are {all}", offered(nearest))]
pub struct UnknownName {
    /// What was named: `method`, `material`, `target`.
    kind: &'static str,
    /// The name.
    name: String,
    /// The nearest right names.
    nearest: Vec<String>,
    /// All of them.
    all: String,
}

impl UnknownName {
    /// The error for a name that is none of these.
    pub fn new(kind: &'static str, name: &str, all: &[&str]) -> UnknownName {
        UnknownName {
            kind,
            name: name.to_owned(),
            nearest: nearest_names(name, all),
            all: listed(kind, all),
        }
    }
}

/// The question whether one of these was meant; nothing where there are none.
pub fn offered(nearest: &[String]) -> String {
    if nearest.is_empty() {
        String::new()
    } else {
        format!(" (did you mean {}?)", nearest.join(" or "))
    }
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
pub fn nearest_names(name: &str, all: &[&str]) -> Vec<String> {
    let score = |other: &str| strsim::jaro_winkler(&name.to_lowercase(), &other.to_lowercase());
    let mut alike: Vec<&str> = all
        .iter()
        .copied()
        .filter(|other| score(other) >= ALIKE)
        .collect();
    alike.sort_by(|a, b| score(b).total_cmp(&score(a)));
    alike.into_iter().take(OFFERED).map(str::to_owned).collect()
}
