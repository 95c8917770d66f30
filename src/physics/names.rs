//! Names: which are legal in every language, and which are nearest to an unknown one.

use thiserror::Error;

use crate::physics::foreign::{Foreign, one_line};

/// The similarity (Jaro-Winkler, 0 to 1) from which a name is suggested for another.
const ALIKE: f64 = 0.7;
/// The most names that are suggested.
const OFFERED: usize = 3;
/// No name is longer, in bytes. A longer one is not compared, which would be slow.
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
    /// The kind of thing: `method`, `material`, `target`.
    kind: &'static str,
    name: String,
    /// The nearest names that exist.
    nearest: Vec<String>,
    /// The list of all names, or where to find it.
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

/// What a name stands for in a list, or the error that names the nearest of all.
///
/// # Errors
/// Nothing was found.
pub fn named<T>(
    kind: &'static str,
    name: &str,
    found: Option<T>,
    all: impl Iterator<Item = &'static str>,
) -> Result<T, UnknownName> {
    found.ok_or_else(|| UnknownName::new(kind, name, &all.collect::<Vec<_>>()))
}

/// ` (did you mean …?)` with these names; nothing where there are none.
pub fn offered(nearest: &[String]) -> String {
    if nearest.is_empty() {
        String::new()
    } else {
        format!(" (did you mean {}?)", one_line(&nearest.join(" or ")))
    }
}

/// The list of all names, or where to find it if it is long.
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

/// Words that people use for classes of materials, and the class.
const MEANT: [(&str, &str); 6] = [
    ("alloy", "metal"),
    ("conductor", "metal"),
    ("glass", "dielectric"),
    ("insulator", "dielectric"),
    ("plastic", "dielectric"),
    ("liquid", "dielectric"),
];

/// The names most similar to this one, best first: up to three that are alike or contain it. If none is and the list is short,
/// the best one that shares a letter with it.
pub fn nearest_names(name: &str, all: &[&str]) -> Vec<String> {
    if name.len() > LONGEST {
        return Vec::new();
    }
    let name = name.to_lowercase();
    let mut meant = MEANT.iter().filter(|(word, _)| *word == name);
    if let Some((_, other)) = meant.find(|(_, other)| all.contains(other)) {
        return vec![(*other).to_owned()];
    }
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

/// In bytes: file systems allow 255, and extensions follow.
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
