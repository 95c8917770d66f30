//! The flags of `merge`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::args::output::file_only;
use crate::cli::args::{CheckReportFlags, ReportFlags};

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
