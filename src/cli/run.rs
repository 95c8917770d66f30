//! The commands: from parsed flags to what a run prints and how it ends. Printing itself is `main.rs`'s.

use crate::cli::places::{refuse_clashes, replaced};
use crate::cli::{
    audit, bake, chart, cost, fit, gallery, generate, lists, materials, merge, plan, render,
    reproduce, scene_error, stability, time, verify,
};
use std::path::Path;

use serde::Serialize;

use crate::cli::command_line::{Cli, Command};
use crate::cli::completions::completions;
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::output::lock::Announce;
use crate::generator::output::write::{OutputFile, write_outputs};
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
        Some(Command::Methods(listing)) => lists::methods(listing),
        Some(Command::Materials(listing)) => materials::run(listing, progress),
        Some(Command::Effects(listing)) => lists::effects(listing),
        Some(Command::Targets(listing)) => lists::targets(listing),
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

/// Refuses a time limit of 0, and one that no clock can add.
pub fn check_limit(seconds: u64) -> Result<(), Error> {
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
pub fn not_drawn(reason: String) -> Error {
    RequestFault::NotDrawn { reason }.into()
}

/// An SVG document as PNG.
pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, Error> {
    crate::pictures::png::png(svg, scale).map_err(not_drawn)
}

/// A report as text, or as JSON where that was asked for. JSON on stdout stands there alone.
pub fn report<T: Serialize>(text: String, json: &T, file: Option<&Path>) -> Result<Output, Error> {
    report_beside(text, json, file, Vec::new())
}

/// A report, and the other files of its run: all are written, or none. Files that a report's folder had before are named.
pub fn report_beside<T: Serialize>(
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
pub fn reported<T: Serialize>(
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
