//! The commands: from parsed flags to what a run prints and how it ends. Printing itself is `main.rs`'s.
mod audit;
mod bake;
mod chart;
mod coated;
mod cost;
mod first;
mod fit;
mod gallery;
mod generate;
mod import;
mod language;
mod listing;
mod materials;
mod merge;
mod params;
mod plan;
mod render;
mod reproduce;
mod scene_error;
mod search;
mod stability;
mod survey;
mod time;
mod unsuited;
mod verify;

pub use first::first_help;

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::cli::args::{Cli, Command, NamedFiles, completions};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::output::folder::{is_below, is_plain_file, is_same_file, read, resolved};
use crate::generator::output::lock::Announce;
use crate::generator::output::manifest::{self, Manifest};
use crate::generator::output::tree::TreePlan;
use crate::generator::output::write::{OutputFile, try_file, write_outputs};
use crate::physics::materials::escaped;

/// What a run leaves: text or a file for stdout, remarks for stderr, the exit code.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Output {
    /// For stdout.
    pub stdout: Vec<u8>,
    /// Whether that is a file, which stays as it is to the byte, and not text for people.
    pub is_file: bool,
    /// For stderr, a line each.
    pub remarks: Vec<String>,
    /// 0 done, 1 findings, 2 help where nothing was asked for, 3 a check was not made. That of a fault: `Error::exit_code`.
    pub code: u8,
}

/// Long work says how far it is: done, of how many, what.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64, &str);

/// Runs what the command line asks for.
///
/// `progress` hears how far long work is; `announce` hears what a person should know before the run ends.
///
/// # Errors
/// Flags contradict each other or name what does not exist, a file cannot be read or written, or something needed is missing.
pub fn run(cli: &Cli, progress: Progress, announce: Announce) -> Result<Output, Error> {
    refuse_clashes(&cli.named_files())?;
    match &cli.command {
        None => generate::run(&cli.generate, announce),
        Some(Command::Generate(flags)) => generate::run(flags, announce),
        Some(Command::Completions(flags)) => Ok(Output {
            stdout: completions(flags.shell).into_bytes(),
            is_file: true,
            ..Output::default()
        }),
        Some(Command::Methods(listing)) => listing::methods(listing),
        Some(Command::Materials(listing)) => materials::run(listing, progress),
        Some(Command::Effects(listing)) => listing::effects(listing),
        Some(Command::Targets(listing)) => listing::targets(listing),
        Some(Command::Bake(flags)) => bake::run(flags, progress, announce),
        Some(Command::Verify(flags)) => verify::run(flags, progress),
        Some(Command::Merge(flags)) => merge::run(flags),
        Some(Command::Cost(flags)) => cost::run(flags, progress),
        Some(Command::Time(flags)) => time::run(flags, progress),
        Some(Command::Audit(flags)) => audit::run(flags, progress),
        Some(Command::Render(flags)) => render::run(flags, progress),
        Some(Command::Chart(flags)) => chart::run(flags, progress),
        Some(Command::Fit(flags)) => fit::run(flags, progress),
        Some(Command::Gallery(flags)) => gallery::run(flags, progress),
        Some(Command::Stability(flags)) => stability::run(flags, progress),
        Some(Command::Reproduce(flags)) => reproduce::run(flags, progress),
        Some(Command::Plan(flags)) => plan::run(flags, progress),
        Some(Command::SceneError(flags)) => scene_error::run(flags, progress),
    }
}

/// Refuses places that cannot be written, before the work: a report's, and another file's.
fn try_places(report: Option<&Path>, other: Option<&Path>) -> Result<(), Error> {
    let files: Vec<&Path> = report.into_iter().chain(other).collect();
    try_files(&files)
}

/// An output folder as it is named; the current folder where its name is empty.
fn folder_or_current(out_dir: &Path) -> &Path {
    match out_dir.as_os_str().is_empty() {
        true => Path::new("."),
        false => out_dir,
    }
}

/// Refuses an output that lies where an input of the run does, and two outputs in one place.
fn refuse_clashes(named: &NamedFiles) -> Result<(), Error> {
    let is_page = |output: &Path| output.extension().is_some_and(|ending| ending == "yml");
    for output in &named.outputs {
        let is_read = |input: &&Path| {
            is_same_file(input, output)
                || is_page(output) && input.is_dir() && is_below(input, output)
        };
        if named.inputs.iter().any(is_read) {
            return Err(RequestFault::Place {
                place: output.to_path_buf(),
                why: "this run reads that file; write to another place",
            }
            .into());
        }
    }
    refuse_one_place(&named.outputs)?;
    named
        .outputs
        .iter()
        .try_for_each(|file| refuse_listed(file))
}

/// Refuses an output in the place of a file that a run reads because an input names it.
fn refuse_read<'a>(
    read: impl Iterator<Item = &'a Path>,
    outputs: impl Iterator<Item = &'a Path>,
) -> Result<(), Error> {
    let outputs = outputs.filter(|file| *file != Path::new("-"));
    refuse_clashes(&NamedFiles {
        inputs: read.collect(),
        outputs: outputs.collect(),
    })
}

/// Refuses a file of a generated tree, whichever run made it: the manifest in a folder above lists it, or it is the manifest.
fn refuse_listed(named: &Path) -> Result<(), Error> {
    /// A file of a tree lies this many folders below it at most, with some to spare for tables.
    const DEPTH: usize = 5;
    let whole = resolved(named);
    for folder in whole.ancestors().skip(1).take(DEPTH) {
        let path = folder.join(manifest::FILE);
        // A manifest that is not ours, or cannot be read, lists nothing of ours.
        let text = if is_plain_file(&path) {
            read(&path).ok().flatten()
        } else {
            None
        };
        let Some(text) = text else { continue };
        let manifest = Manifest::parse(&path, &text);
        let files = manifest.iter().flat_map(|manifest| &manifest.files);
        let mut places: Vec<PathBuf> = files.map(|entry| folder.join(&entry.file)).collect();
        // One that cannot be read, for a merge conflict in it, is ours all the same.
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

/// Refuses two outputs that are one file.
fn refuse_one_place(files: &[&Path]) -> Result<(), Error> {
    for (i, file) in files.iter().enumerate() {
        if files[..i].iter().any(|other| is_same_file(other, file)) {
            return Err(RequestFault::Place {
                place: file.to_path_buf(),
                why: "two outputs of this run would be written there; give each a place of its own",
            }
            .into());
        }
    }
    Ok(())
}

/// Refuses a file that the user names in the place of one of the tree.
fn refuse_within_tree(plan: &TreePlan, named: Option<&Path>) -> Result<(), Error> {
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
fn refuse_place_of(places: &[PathBuf], named: &Path) -> Result<(), Error> {
    let is_taken = |place: &PathBuf| named != Path::new("-") && is_same_file(place, named);
    if !places.iter().any(is_taken) {
        return Ok(());
    }
    Err(RequestFault::Place {
        place: named.to_path_buf(),
        why: "a file of the generated tree lies there; write to another place",
    }
    .into())
}

/// Refuses a time limit of 0, and one that no clock can add.
fn check_limit(seconds: u64) -> Result<(), Error> {
    const MOST_SECONDS: u64 = 86_400;
    if (1..=MOST_SECONDS).contains(&seconds) {
        return Ok(());
    }
    Err(RequestFault::OutOfRange {
        flag: "limit",
        value: format!("{seconds} seconds"),
        allowed: format!("is 1 to {MOST_SECONDS}"),
    }
    .into())
}

/// What could not be drawn, for this reason.
fn not_drawn(reason: String) -> Error {
    RequestFault::NotDrawn { reason }.into()
}

/// An SVG document as PNG.
fn png(svg: &str, scale: f32) -> Result<Vec<u8>, Error> {
    crate::pictures::png::png(svg, scale).map_err(not_drawn)
}

/// What is said of files of ours that a report replaced.
fn replaced(files: &[PathBuf]) -> impl Iterator<Item = String> {
    files
        .iter()
        .map(|file| format!("replaced: {}", crate::physics::foreign::path(&file)))
}

/// Refuses files that cannot be written, and two that are one, before the work.
fn try_files(files: &[&Path]) -> Result<(), Error> {
    refuse_one_place(files)?;
    let named = files.iter().filter(|file| **file != Path::new("-"));
    Ok(named.copied().try_for_each(try_file)?)
}

/// A report as text, or as JSON where that was asked for. JSON on stdout stands there alone.
fn report<T: Serialize>(text: String, json: &T, file: Option<&Path>) -> Result<Output, Error> {
    report_beside(text, json, file, Vec::new())
}

/// A report, and the other files of its run: all are written, or none. Files that a report's folder had before are named.
fn report_beside<T: Serialize>(
    text: String,
    json: &T,
    file: Option<&Path>,
    mut files: Vec<OutputFile>,
) -> Result<Output, Error> {
    let (output, own) = reported(text, json, file);
    files.extend(own);
    let old = write_outputs(&files)?;
    Ok(Output {
        remarks: replaced(&old).collect(),
        ..output
    })
}

/// What a report prints, and its file where it has one.
fn reported<T: Serialize>(
    text: String,
    json: &T,
    file: Option<&Path>,
) -> (Output, Option<OutputFile>) {
    let output = |stdout: String, is_file| Output {
        stdout: stdout.into_bytes(),
        is_file,
        ..Output::default()
    };
    let Some(file) = file else {
        return (output(text, false), None);
    };
    let json = serde_json::to_string_pretty(json).expect("a report has only text keys") + "\n";
    let json = escaped(&json);
    if file == Path::new("-") {
        return (output(json, true), None);
    }
    (output(text, false), Some(OutputFile::named(file, json)))
}
