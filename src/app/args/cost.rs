//! The flags of `cost`.

use std::path::PathBuf;

use clap::Args;

use crate::emit::CommandLine;

/// The flags of `cost`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen cost --gpu rdna2\n  fresnel-gen cost --gpu rdna2,adreno330 --method schlick,conductor_exact --material gold\n  fresnel-gen cost --check\n\nA figure is that of one evaluation: a quarter of what eight of them in a chain cost more than four, less the chain's own price. Shares are of dielectric_exact with its argument from a uniform. Where a compiler is not here, what was recorded of the same shader stands in its place. Exit codes: 0 done, 1 --check found a difference, 2 wrong input, 3 with --require-all: something could not be measured, with --check: nothing could."
)]
pub struct CostFlags {
    /// Family of GPUs: operations (before any compiler), gcn4, rdna1, rdna2, rdna3, adreno330, malig72 ... [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub gpu: Vec<String>,
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub method: Vec<String>,
    /// Names, paths of material files, all, or none [default: gold, platinum, water, diamond]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub material: Vec<String>,
    /// What functions compute in: f32 or f16 [default: both]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub precision: Vec<String>,
    /// Compare what compilers say now with what was recorded; exit 1 where it differs
    #[arg(long)]
    pub check: bool,
    /// Folder whose folder `mesa` holds compilers, searched before the folder `tools` beside this program
    #[arg(long, value_name = "DIR")]
    pub tools: Option<PathBuf>,
    /// Seconds that a compiler may take for one shader
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub limit: u64,
    /// Exit with 3 where anything could not be measured or checked
    #[arg(long)]
    pub require_all: bool,
    /// Write a page with all figures as cost.html into this folder
    #[arg(long, value_name = "DIR")]
    pub out_dir: Option<PathBuf>,
    /// Also replace files that fresnel-gen did not write
    #[arg(long, requires = "out_dir")]
    pub overwrite: bool,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Answer shaders with what this family's compiler says
    #[arg(long, hide = true, value_name = "NAME")]
    pub worker: Option<String>,
}

impl CostFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("cost")
            .list("gpu", &self.gpu)
            .list("method", &self.method)
            .list("material", &self.material)
            .list("precision", &self.precision)
    }
}
