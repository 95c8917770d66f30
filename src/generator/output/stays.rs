//! Files of an output folder that a run leaves alone though they are not what it writes, and why: each is named.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::generator::error::Error;
use crate::generator::output::folder;
use crate::generator::output::manifest::Entry;
use crate::generator::output::ours::{SHARED, could_be_written};
use crate::generator::output::scope::Scope;
use crate::generator::output::tree::Planned;
use crate::physics::num::Precision;

/// A file that a run leaves where it is, and says so.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Stay {
    /// The path, relative to the output folder.
    pub path: String,
    /// Why it is not removed.
    pub why: &'static str,
}

/// What the manifest lists in the scope of the run, and this program could not have written: the entry and the file stay.
pub fn unknown<'a>(
    out_dir: &'a Path,
    old: &'a [Entry],
    files: &'a [Planned],
    scope: &'a Scope,
) -> impl Iterator<Item = Stay> + 'a {
    let is_made = |entry: &&Entry| files.iter().any(|file| file.path == entry.file);
    old.iter()
        .filter(|entry| scope.owns(entry) && !could_be_written(entry))
        .filter(move |entry| !is_made(entry))
        .filter(|entry| fs::symlink_metadata(out_dir.join(&entry.file)).is_ok())
        .map(|entry| Stay {
            path: entry.file.clone(),
            why: "the manifest lists it with a method, an effect or a target that this fresnel-gen does not write there",
        })
}

/// Files in the targets' folders that nothing lists: a run without flags names them.
///
/// # Errors
/// A folder cannot be read.
pub fn strangers(
    out_dir: &Path,
    expected: &BTreeSet<&str>,
    listed: &BTreeMap<&str, &Entry>,
    scope: &Scope,
) -> Result<Vec<Stay>, Error> {
    let first = |path: &&str| path.split_once('/').map(|(first, _)| first.to_owned());
    let paths = expected.iter().chain(listed.keys());
    let mut folders: BTreeSet<String> = paths.filter_map(first).collect();
    folders.extend(scope.targets.iter().chain(&scope.flavours).cloned());
    // `bake` puts tables there under any name.
    folders.remove(crate::generator::lut::TABLES);
    // These stand beside the targets' folders and have none.
    for (_, target) in SHARED {
        folders.remove(target);
    }
    let mut present = folder::list(out_dir, &folders)?;
    present.retain(|path| {
        let is_known = expected.contains(path.as_str()) || listed.contains_key(path.as_str());
        path.contains('/') && !is_known && !is_hidden(path) && is_of_precision(path, scope)
    });
    let stay = |path| Stay {
        path,
        why: "fresnel-gen did not write it, or no manifest lists it",
    };
    Ok(present.into_iter().map(stay).collect())
}

/// Has a file the name of this run's precision? Those of the other are not its own.
fn is_of_precision(path: &str, scope: &Scope) -> bool {
    let name = path.rsplit('/').next().unwrap_or(path);
    let stem = name.split('.').next().unwrap_or(name);
    let half = Precision::F16.suffix();
    stem.ends_with(half) == (scope.precision.suffix() == half)
}

/// Desktops and version control leave such files anywhere.
fn is_hidden(path: &str) -> bool {
    path.split('/').any(|part| part.starts_with('.'))
}
