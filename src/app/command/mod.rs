//! The commands: from parsed flags to what a run prints and how it ends. Printing itself is `main.rs`'s.

#[cfg(feature = "gpu")]
mod audit;
mod bake;
mod chart;
#[cfg(feature = "gpu")]
mod cost;
mod fit;
mod generate;
mod import;
mod listing;
mod materials;
mod params;
mod reproduce;
mod search;
mod stability;
mod survey;
#[cfg(feature = "gpu")]
mod time;
#[cfg(feature = "gpu")]
mod verify;

#[cfg(feature = "gpu")]
pub(super) use generate::kept;

use std::path::Path;

use super::args::{Cli, Command};
use super::error::Error;
use super::lock::Announce;
use super::write::{is_same_file, try_file, write_file};
use crate::materials::escaped;

/// What a run leaves: text or a file for stdout, remarks for stderr, the exit code.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Output {
    /// For stdout.
    pub stdout: Vec<u8>,
    /// Whether that is a file, which stays as it is to the byte, and not text for people.
    pub is_file: bool,
    /// For stderr, a line each.
    pub remarks: Vec<String>,
    /// 0 done, 1 findings.
    pub code: u8,
}

/// Long work says how far it is: done, of how many, what.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64, &str);

/// Runs what the command line asks for.
///
/// `progress` hears how far long work is; `announce` hears what a person should know before the run ends.
pub fn run(cli: &Cli, progress: Progress, announce: Announce) -> Result<Output, Error> {
    match &cli.command {
        None => generate::run(&cli.generate, announce),
        Some(Command::Methods(listing)) => listing::methods(listing),
        Some(Command::Materials(listing)) => materials::run(listing, progress),
        Some(Command::Targets(listing)) => listing::targets(listing),
        Some(Command::Bake(flags)) => bake::run(flags, progress, announce),
        #[cfg(feature = "gpu")]
        Some(Command::Verify(flags)) => verify::run(flags, progress),
        #[cfg(feature = "gpu")]
        Some(Command::Cost(flags)) => cost::run(flags, progress),
        #[cfg(feature = "gpu")]
        Some(Command::Time(flags)) => time::run(flags, progress),
        #[cfg(feature = "gpu")]
        Some(Command::Audit(flags)) => audit::run(flags, progress),
        #[cfg(not(feature = "gpu"))]
        Some(Command::Verify(_) | Command::Cost(_) | Command::Time(_) | Command::Audit(_)) => {
            Err(Error::Lacking {
                what: "this program was built without the feature `gpu`, and runs no shaders"
                    .to_owned(),
            })
        }
        Some(Command::Chart(flags)) => chart::run(flags, progress),
        Some(Command::Fit(flags)) => fit::run(flags, progress),
        Some(Command::Stability(flags)) => stability::run(flags, progress),
        Some(Command::Reproduce(flags)) => reproduce::run(flags, progress),
    }
}

/// Refuses places that cannot be written, before the work: a report's, and another file's.
fn try_places(report: Option<&Path>, other: Option<&Path>) -> Result<(), Error> {
    let files: Vec<&Path> = report.into_iter().chain(other).collect();
    try_files(&files)
}

/// The same for files that a run writes together, and two that are one.
fn try_files(files: &[&Path]) -> Result<(), Error> {
    for (i, file) in files.iter().enumerate() {
        if files[..i].iter().any(|other| is_same_file(other, file)) {
            return Err(Error::Usage {
                what: format!(
                    "{}: two outputs of this run would be written there; give each a place of its own",
                    file.display()
                ),
            });
        }
    }
    let named = files.iter().filter(|file| **file != Path::new("-"));
    named.copied().try_for_each(try_file)
}

/// A report as text, or as JSON where that was asked for. JSON on stdout stands there alone.
fn report(text: String, json: &serde_json::Value, file: Option<&Path>) -> Result<Output, Error> {
    let Some(file) = file else {
        return Ok(Output {
            stdout: text.into_bytes(),
            ..Output::default()
        });
    };
    let json = serde_json::to_string_pretty(json).expect("a report has only text keys") + "\n";
    let json = escaped(&json);
    if file == Path::new("-") {
        return Ok(Output {
            stdout: json.into_bytes(),
            is_file: true,
            ..Output::default()
        });
    }
    write_file(file, json.as_bytes())?;
    Ok(Output {
        stdout: text.into_bytes(),
        ..Output::default()
    })
}
