//! `merge`: the reports of shards as the report of a whole run.

use crate::cli::args::MergeFlags;
use crate::cli::error::Error;
use crate::lab::verify::merge::{merged, parsed};
use crate::generator::request::source;

use crate::cli::command::verify::whole_report;
use crate::cli::command::{Output, try_places};

/// Puts reports together.
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
