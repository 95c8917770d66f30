//! Two files whose materials come out with one name: `Gläser.csv` and `Glaser.csv`. The second run would take the place of the first
//! one's functions without a word.

use crate::generator::emit::Detail;
use crate::generator::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::output::artifact::Artifact;
use crate::generator::output::manifest::{Entry, Manifest, Provenance};
use crate::generator::output::tree::{Planned, State};

/// Refuses to write what is made of a table or page beside what is made of another, or of a material of the catalogue with its name: a table
/// and a page are named after their files, and the data differ.
/// A material file says its name itself, and is taken to be a newer one of that name.
///
/// # Errors
/// The manifest lists something of another's.
pub fn refuse_namesakes(
    artifacts: &[Artifact],
    files: &[Planned],
    old: &Manifest,
    provenance: &Provenance,
) -> Result<(), Error> {
    for (artifact, file) in artifacts.iter().zip(files) {
        let (Some(name), Some(new)) = (&artifact.material, wanted(artifact)) else {
            continue;
        };
        let [known_data, new_data] = [&old.inputs, &provenance.inputs]
            .map(|inputs| inputs.iter().find(|input| input.name == *name));
        // Whatever of that material lies in the folder counts, in every language and format: a manifest has one hash for all of it.
        let of_name = |entry: &&Entry| entry.material.as_ref() == Some(name);
        for entry in old.files.iter().filter(of_name) {
            let Some(known) = listed(entry).filter(|known| *known != new) else {
                continue;
            };
            // A manifest does not say what tables were made of.
            let is_same = match (known_data, new_data) {
                (Some(known), Some(new)) => known.sha256 == new.sha256,
                _ => entry.file == artifact.path && file.state() == State::Unchanged,
            };
            if !is_same && [known, new].into_iter().all(names_no_material_file) {
                return Err(RequestFault::Namesake {
                    file: entry.file.clone(),
                    words: [known, new].map(str::to_owned),
                }
                .into());
            }
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
        Detail::Adapter(detail) => material_word(&detail.command),
        Detail::Catalogue(_) => None,
    }
}

/// The word after the flag, as a shell takes it: to the first blank that is not quoted.
fn material_word(command: &str) -> Option<&str> {
    let (_, rest) = command.split_once(" --material ")?;
    let (mut quote, mut is_escaped) = (None, false);
    let end = rest.find(|c| {
        match (quote, c) {
            _ if is_escaped => is_escaped = false,
            (None | Some('"'), '\\') => is_escaped = true,
            (None, '\'' | '"') => quote = Some(c),
            (None, ' ') => return true,
            (Some(open), _) if open == c => quote = None,
            _ => {}
        }
        false
    });
    Some(&rest[..end.unwrap_or(rest.len())])
}

/// Whether a word, as a shell takes it, is no material file: a table, a page, or a name of the catalogue.
fn names_no_material_file(word: &str) -> bool {
    let word = word.trim_end_matches(['\'', '"', ')']).to_lowercase();
    !word.ends_with(".toml")
}
