//! Names: which are legal in every language, and for one that is not there, which come nearest.

use thiserror::Error;

use crate::physics::foreign::{Foreign, one_line};

/// How alike two names must be (Jaro-Winkler, 0 to 1) before one is offered for the other.
const ALIKE: f64 = 0.7;
/// How many are offered at most.
const OFFERED: usize = 3;
/// No name is longer. What is longer is like none, and comparing it takes its time.
const LONGEST: usize = 200;
/// More names than this are not listed.
const MANY: usize = 40;

/// A name that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "there is no {kind} `{}`{}; there are {all}",
    Foreign(name),
    offered(nearest)
)]
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
        format!(" (did you mean {}?)", one_line(&nearest.join(" or ")))
    }
}

/// All names, or where to find them where they are many.
fn listed(kind: &str, all: &[&str]) -> String {
    if all.len() > MANY {
        let see = if kind == "substance" {
            "material"
        } else {
            kind
        };
        format!("{} of them: see `fresnel-gen {see}s`", all.len())
    } else {
        one_line(&all.join(", "))
    }
}

/// The names most like this one, best first: all that are alike, or that hold the name. Of a short list where none is, the best
/// that shares a letter with it.
pub fn nearest_names(name: &str, all: &[&str]) -> Vec<String> {
    if name.len() > LONGEST {
        return Vec::new();
    }
    let name = name.to_lowercase();
    let score = |other: &str| {
        let other = other.to_lowercase();
        let score = strsim::jaro_winkler(&name, &other);
        let holds = !name.is_empty() && other.contains(&name);
        if holds { score.max(ALIKE) } else { score }
    };
    let mut scored: Vec<(f64, &str)> = all.iter().map(|other| (score(other), *other)).collect();
    scored.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let alike = scored.iter().take_while(|(score, _)| *score >= ALIKE);
    let count = alike.count().min(OFFERED);
    let shares = scored.first().is_some_and(|(score, _)| *score > 0.0);
    let is_short = all.len() <= MANY;
    scored.truncate(count.max(usize::from(is_short && shares)));
    scored
        .into_iter()
        .map(|(_, other)| other.to_owned())
        .collect()
}

/// File systems allow 255 bytes, and endings follow.
const LONGEST_NAME: usize = 200;

/// What is wrong with a name, if anything: it must be legal in every language.
pub fn identifier_fault(name: &str) -> Option<&'static str> {
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        Some("it must start with a letter from a to z")
    } else if !name.chars().all(legal) {
        Some("only letters from a to z, digits and underscores are allowed")
    } else if name.contains("__") {
        Some("two underscores in a row are reserved in GLSL")
    } else if name.ends_with('_') {
        Some("a name must not end in an underscore")
    } else if name.len() > LONGEST_NAME {
        Some("a name must not have more than 200 characters: files are named after functions")
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(name: &str, all: &[&str], nearest: &[&str]) {
        assert_eq!(nearest_names(name, all), nearest, "{name}");
    }

    #[test]
    fn a_wrong_name_is_answered_with_the_nearest() {
        check("shlick", &["exact", "schlick"], &["schlick"]);
        check("GLES", &["gles", "wgsl"], &["gles"]);
    }

    #[test]
    fn a_short_name_is_answered_too() {
        check("1931", &["cie2015", "cie1931"], &["cie1931"]);
        check("f64", &["f32", "f16"], &["f32"]);
        check("2nm", &["5nm", "1nm"], &["5nm", "1nm"]);
        check("exr", &["png8", "exr-half"], &["exr-half"]);
    }

    #[test]
    fn what_is_like_nothing_is_answered_with_nothing() {
        check("", &["gles", "wgsl"], &[]);
        check("zzz", &["gold", "silver"], &[]);
        check(&"gold".repeat(LONGEST), &["gold", "silver"], &[]);
    }
}
