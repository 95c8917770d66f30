//! The flags of `stability`.

use std::path::PathBuf;

use clap::Args;

use crate::emit::CommandLine;

/// The flags of `stability`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen stability\n  fresnel-gen stability --method schlick,conductor_textbook --out-dir stability\n  fresnel-gen stability --material gold --json -"
)]
pub struct StabilityFlags {
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub method: Vec<String>,
    /// Scan the functions specialised to these instead: names, paths of material files, or all
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub material: Vec<String>,
    /// What functions compute in: f32, or f16, rounded after every operation [default: f32]
    #[arg(long, value_name = "NAME")]
    pub precision: Option<String>,
    /// Draw maps of the errors and a page that shows them into this folder
    #[arg(long, value_name = "DIR", conflicts_with = "material")]
    pub out_dir: Option<PathBuf>,
    /// Also replace files that fresnel-gen did not write
    #[arg(long, requires = "out_dir")]
    pub overwrite: bool,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

impl StabilityFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("stability")
            .list("method", &self.method)
            .list("material", &self.material)
            .list("precision", &self.precision)
    }
}
