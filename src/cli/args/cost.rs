//! The flags of `cost`.

use std::path::PathBuf;

use clap::Args;

use crate::generator::command_line::CommandLine;
use crate::lab::cost::Family;
use crate::language::effects::Effect;
use crate::language::methods::Method;
use crate::physics::num::Precision;

use crate::cli::args::choice::{Choice, effect_or_all, family, family_or_all, method_or_all, precision};
use crate::cli::args::{MaterialFlags, PictureFlags, ReportFlags};

/// The flags of `cost`.
#[derive(Args, Debug)]
#[command(
    mut_arg("out_dir", |arg| arg.help("Write a page with all figures as cost.html into this folder")),
    after_help = "Examples:\n  fresnel-gen cost --gpu rdna2\n  fresnel-gen cost --gpu rdna2,adreno330 --method schlick,conductor_exact --material gold\n  fresnel-gen cost --gpu rdna2 --effect interior --method schlick_ior\n  fresnel-gen cost --check\n\nA figure is that of one evaluation: a quarter of what eight of them in a chain cost more than four, less the chain's own price. Shares are of dielectric_exact with its argument from a uniform. Where a compiler is not here, what was recorded of the same shader stands in its place. Exit codes: 0 done, 1 --check found a difference, 2 wrong input, 3 with --require-all: something could not be measured, with --check: nothing could."
)]
pub struct CostFlags {
    /// Family of GPUs: operations (before any compiler), gcn4, rdna1, rdna2, rdna3, adreno330, malig72 ... [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = family_or_all())]
    pub gpu: Vec<Choice<&'static Family>>,
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Effect, see `fresnel-gen effects`, or all: its functions and nothing else, with R by --method [default: all where no method is named]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = effect_or_all(), conflicts_with = "material")]
    pub effect: Vec<Choice<&'static Effect>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What functions compute in: f32, f16 [default: each]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = precision())]
    pub precision: Vec<Precision>,
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
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
    /// Answer shaders with what this family's compiler says
    #[arg(long, hide = true, value_name = "NAME", value_parser = family())]
    pub worker: Option<&'static Family>,
}

impl CostFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("cost")
            .list("gpu", &self.gpu)
            .list("method", &self.method)
            .list("effect", &self.effect)
            .list("material", self.materials.choices())
            .list(
                "precision",
                self.precision.iter().map(|precision| precision.name()),
            )
    }
}
