//! Checks of where a run's outputs may lie: not in the place of an input, of each other, or of a file of a generated tree.

use std::path::{Path, PathBuf};

use crate::cli::error::Error;
use crate::cli::flags::named::NamedFiles;
use crate::generator::error::RequestFault;
use crate::generator::output::folder::{is_below, is_plain_file, is_same_file, read, resolved};
use crate::generator::output::manifest::{self, Manifest};
use crate::generator::output::tree::TreePlan;
use crate::generator::output::write::try_file;

fn fault(place: &Path, why: &'static str) -> Error {
    let place = place.to_path_buf();
    RequestFault::Place { place, why }.into()
}

/// Refuses an output that lies where an input of the run does, and two outputs in one place.
pub fn refuse_clashes(named: &NamedFiles) -> Result<(), Error> {
    let is_page = |output: &Path| output.extension().is_some_and(|ending| ending == "yml");
    for output in &named.outputs {
        let is_read = |input: &&Path| {
            is_same_file(input, output)
                || is_page(output) && input.is_dir() && is_below(input, output)
        };
        if named.inputs.iter().any(is_read) {
            return Err(fault(
                output,
                "this run reads that file; write to another place",
            ));
        }
    }
    refuse_one_place(&named.outputs)?;
    named
        .outputs
        .iter()
        .try_for_each(|file| refuse_listed(file))
}

/// Refuses an output in the place of a file that a run reads because an input names it.
pub fn refuse_read<'a>(
    read: impl Iterator<Item = &'a Path>,
    outputs: impl Iterator<Item = &'a Path>,
) -> Result<(), Error> {
    let outputs = outputs.filter(|file| *file != Path::new("-"));
    refuse_clashes(&NamedFiles {
        inputs: read.collect(),
        outputs: outputs.collect(),
    })
}

/// Refuses a file of a generated tree, whichever run made it: the manifest, or a file that the manifest in a folder above lists.
fn refuse_listed(named: &Path) -> Result<(), Error> {
    /// The most folders between a tree's root and its files, with some to spare for tables.
    const DEPTH: usize = 5;
    let whole = resolved(named);
    for folder in whole.ancestors().skip(1).take(DEPTH) {
        let path = folder.join(manifest::FILE);
        // A manifest that is not ours, or cannot be read, lists none of our files.
        let text = if is_plain_file(&path) {
            read(&path).ok().flatten()
        } else {
            None
        };
        let Some(text) = text else { continue };
        let manifest = Manifest::parse(&path, &text);
        let files = manifest.iter().flat_map(|manifest| &manifest.files);
        let mut places: Vec<PathBuf> = files.map(|entry| folder.join(&entry.file)).collect();
        // A manifest that cannot be parsed, for instance because of a merge conflict, is ours all the same.
        let whole = String::from_utf8_lossy(&text);
        if manifest.is_ok()
            || whole.contains("\"tool\": \"fresnel-gen\"") && whole.contains("\"naga\":")
        {
            places.push(path);
        }
        refuse_place_of(&places, named)?;
    }
    Ok(())
}

/// Refuses two outputs that are the same file.
pub(super) fn refuse_one_place(files: &[&Path]) -> Result<(), Error> {
    for (i, file) in files.iter().enumerate() {
        if files[..i].iter().any(|other| is_same_file(other, file)) {
            return Err(fault(
                file,
                "two outputs of this run would be written there; give each a place of its own",
            ));
        }
    }
    Ok(())
}

/// Refuses a file that the user names in the place of one of the tree.
pub fn refuse_within_tree(plan: &TreePlan, named: Option<&Path>) -> Result<(), Error> {
    let Some(named) = named else {
        return Ok(());
    };
    let places: Vec<PathBuf> = plan
        .all()
        .map(|file| plan.out_dir.join(&file.path))
        .collect();
    refuse_place_of(&places, named)
}

/// Refuses a file that the user names in the place of one of these.
pub fn refuse_place_of(places: &[PathBuf], named: &Path) -> Result<(), Error> {
    let is_taken = |place: &PathBuf| named != Path::new("-") && is_same_file(place, named);
    if !places.iter().any(is_taken) {
        return Ok(());
    }
    Err(fault(
        named,
        "a file of the generated tree lies there; write to another place",
    ))
}

/// Refuses paths that cannot be written, before the work: a report's, and another file's.
pub fn try_places(report: Option<&Path>, other: Option<&Path>) -> Result<(), Error> {
    let files: Vec<&Path> = report.into_iter().chain(other).collect();
    try_files(&files)
}

/// Refuses files that cannot be written, and two that are the same, before the work.
pub fn try_files(files: &[&Path]) -> Result<(), Error> {
    refuse_one_place(files)?;
    let named = files.iter().filter(|file| **file != Path::new("-"));
    Ok(named.copied().try_for_each(try_file)?)
}

/// An output folder as the user named it; the current folder where the name is empty.
pub fn folder_or_current(out_dir: &Path) -> &Path {
    if out_dir.as_os_str().is_empty() {
        Path::new(".")
    } else {
        out_dir
    }
}

/// The remarks on files of ours that a report replaced.
pub fn replaced(files: &[PathBuf]) -> impl Iterator<Item = String> {
    files
        .iter()
        .map(|file| format!("replaced: {}", crate::physics::foreign::path(&file)))
}
