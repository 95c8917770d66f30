//! Two files whose materials come out with one name: `Gläser.csv` and `Glaser.csv`. The second run would take the place of the first
//! one's functions without a word.

use super::artifact::Artifact;
use super::error::Error;
use super::fault::RequestFault;
use super::manifest::{Entry, Manifest, Provenance};
use super::tree::{Planned, State};
use crate::emit::Detail;

/// Refuses to write the functions of a table or page in the place of another's: both are named after their files, and their data differ.
/// A material file says its name itself, and is taken to be a newer one of that name.
///
/// # Errors
/// Such a file of another's lies there.
pub fn refuse_namesakes(
    artifacts: &[Artifact],
    files: &[Planned],
    old: &Manifest,
    provenance: &Provenance,
) -> Result<(), Error> {
    for (artifact, file) in artifacts.iter().zip(files) {
        let Some(name) = &artifact.material else {
            continue;
        };
        let entry = old.files.iter().find(|entry| entry.file == artifact.path);
        let words = entry.and_then(|entry| Some([listed(entry)?, wanted(artifact)?]));
        let Some(words) = words.filter(|_| file.old.is_some()) else {
            continue;
        };
        let [is_known, is_new] = [&old.inputs, &provenance.inputs]
            .map(|inputs| inputs.iter().find(|input| input.name == *name));
        // A manifest does not say what tables were made of.
        let is_same = match (is_known, is_new) {
            (Some(known), Some(new)) => known.sha256 == new.sha256,
            _ => file.state() == State::Unchanged,
        };
        if words[0] != words[1] && words.iter().all(|word| is_named_by_file(word)) && !is_same {
            return Err(RequestFault::Namesake {
                file: artifact.path.clone(),
                words: words.map(str::to_owned),
            }
            .into());
        }
    }
    Ok(())
}

/// The material in the command of an entry.
fn listed(entry: &Entry) -> Option<&str> {
    material_word(entry.detail.get("command")?.as_str()?)
}

/// The material in the command of an artifact.
fn wanted(artifact: &Artifact) -> Option<&str> {
    match &artifact.detail {
        Detail::Functions(detail) => material_word(&detail.command),
        Detail::Table(detail) => material_word(&detail.command),
        Detail::Catalogue(_) | Detail::Adapter(_) => None,
    }
}

fn material_word(command: &str) -> Option<&str> {
    let (_, rest) = command.split_once(" --material ")?;
    Some(rest.split(" --").next().unwrap_or(rest))
}

/// Whether a word, as a shell takes it, is a table or a page.
fn is_named_by_file(word: &str) -> bool {
    let word = word.trim_end_matches(['\'', '"', ')']).to_lowercase();
    [".csv", ".yml", ".yaml", ".txt", ".tsv"]
        .iter()
        .any(|ending| word.ends_with(ending))
}
