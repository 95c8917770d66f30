//! Flags for where outputs go.

use std::path::{Path, PathBuf};

use clap::Args;

/// The place of a report.
#[derive(Args, Clone, Debug, Default)]
pub struct ReportFlags {
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

impl ReportFlags {
    /// The path of the JSON report, or `-`.
    pub fn json(&self) -> Option<&Path> {
        self.json.as_deref()
    }
}

/// The places of a report of checks.
#[derive(Args, Clone, Debug, Default)]
pub struct CheckReportFlags {
    /// As JSON.
    #[command(flatten)]
    pub report: ReportFlags,
    /// Write the report as JUnit's XML to this file
    #[arg(long, value_name = "FILE", value_parser = file_only("--junit"))]
    pub junit: Option<PathBuf>,
}

impl CheckReportFlags {
    /// The files of the report.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.report.json.iter().chain(&self.junit)
    }
}

/// Parses a flag that takes a file but not `-` for stdout.
pub fn file_only(flag: &'static str) -> impl Fn(&str) -> Result<PathBuf, String> + Clone {
    move |word: &str| match word {
        "-" => Err(format!("{flag} takes a file, and not stdout")),
        "" => Err(format!("{flag} takes a file, and this name is empty")),
        path => Ok(path.into()),
    }
}

/// The folder of the generated tree.
#[derive(Args, Clone, Debug)]
pub struct TreeFlags {
    /// Folder for the generated tree
    #[arg(long, value_name = "DIR", default_value = "shaders-generated")]
    pub out_dir: PathBuf,
    /// Also replace files that fresnel-gen did not write
    #[arg(long)]
    pub overwrite: bool,
}

/// The folder of pictures and pages, where they are wanted.
#[derive(Args, Clone, Debug)]
pub struct PictureFlags {
    /// Write pictures and pages into this folder
    #[arg(long, value_name = "DIR")]
    pub out_dir: Option<PathBuf>,
    /// Also replace files that fresnel-gen did not write
    #[arg(long, requires = "out_dir")]
    pub overwrite: bool,
}

impl PictureFlags {
    /// The folder.
    pub fn folder(&self) -> Option<&Path> {
        self.out_dir.as_deref()
    }
}
