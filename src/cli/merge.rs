//! `merge`: combines the reports of shards into the report of a whole run.

use std::path::PathBuf;

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::output::{CheckReportFlags, ReportFlags, file_only};
use crate::cli::output::Output;
use crate::cli::places::try_places;
use crate::cli::verify::whole_report;
use crate::generator::request::source;
use crate::lab::verify::merge::{merged, parsed};

/// The flags of `merge`.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  fresnel-gen merge part-*.json -o report.json\n\nThe report is the one that a run without --shards writes, to the byte, and the exit code is that run's."
)]
pub struct MergeFlags {
    /// The JSON report of each shard, in any order
    #[arg(value_name = "REPORT", required = true)]
    pub reports: Vec<PathBuf>,
    /// Write the report of the whole run as JSON to this file, or `-` for stdout
    #[arg(short = 'o', long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write the report as JUnit's XML to this file
    #[arg(long, value_name = "FILE", value_parser = file_only("--junit"))]
    pub junit: Option<PathBuf>,
}

impl MergeFlags {
    /// Where the report goes.
    pub fn report(&self) -> CheckReportFlags {
        CheckReportFlags {
            report: ReportFlags {
                json: self.json.clone(),
            },
            junit: self.junit.clone(),
        }
    }
}

/// Merges the reports.
pub fn run(flags: &MergeFlags) -> Result<Output, Error> {
    let places = flags.report();
    try_places(places.report.json(), places.junit.as_deref())?;
    let mut reports = Vec::new();
    for file in &flags.reports {
        reports.push(parsed(file, &source::report(file)?)?);
    }
    let count = reports.len();
    let whole = merged(reports)?;
    let mut output = whole_report(whole, &places)?;
    output.remarks.push(format!("{count} shards put together"));
    Ok(output)
}
