//! The flags of `verify`.

use std::path::PathBuf;

use clap::Args;
use crate::generator::command_line::CommandLine;
use crate::generator::emit::Naming;
use crate::lab::gpu::Backend;
use crate::language::effects::Effect;
use crate::language::methods::Method;
use crate::language::targets::Target;
use crate::physics::materials::ViewingConditions;
use crate::physics::num::Precision;
use crate::cli::args::choice::{one_of, Choice, effect_or_all, method_or_all, target_or_all};
use crate::cli::args::{CheckReportFlags, GamutFlags, MaterialFlags, MediumFlags, PrecisionFlags};

/// The flags of `verify`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen verify\n  fresnel-gen verify --target gles --material gold --junit verify.xml\n  fresnel-gen verify --exhaustive --method schlick --material gold\n  fresnel-gen verify --shards 8 --shard 3 --json part-3.json\n\nFiles are taken from --out-dir as they lie there; what is not there is generated. Exit codes: 0 all is as promised, 1 something is not, 2 wrong input, 3 a compiler or a driver is missing here, or failed without a word about the files."
)]
pub struct VerifyFlags {
    /// Output language, see `fresnel-gen targets`; all means those written by default [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = target_or_all())]
    pub target: Vec<Choice<&'static Target>>,
    /// Method, see `fresnel-gen methods` [default: all; of a material's file those that it holds]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Effect, see `fresnel-gen effects`, or all: run its functions and nothing else, with R by --method, specialised to --material [default: all where nothing is named]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = effect_or_all(), conflicts_with = "exhaustive")]
    pub effect: Vec<Choice<&'static Effect>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// Goes before every function's name
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// What functions compute in.
    #[command(flatten)]
    pub precision: PrecisionFlags,
    /// Degrees at which the corrected Schlick meets the exact law [default: that of cosine 0.15, 81.373]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub matching_angle: Option<f64>,
    /// Folder whose files are run
    #[arg(long, value_name = "DIR", default_value = "shaders-generated")]
    pub out_dir: PathBuf,
    /// The graphics card, by a part of its name [default: the fastest there is]
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// What WGSL and SPIR-V run on: vulkan or gl (gl has no SPIR-V) [default: vulkan]
    #[arg(long, value_name = "NAME", value_parser = one_of("backend", [Backend::Vulkan, Backend::OpenGl], Backend::name))]
    pub backend: Option<Backend>,
    /// Cosines for each function and material, 100 to 10000000
    #[arg(long, value_name = "N", default_value_t = 20_000)]
    pub points: usize,
    /// Every f32, all 2^32 bit patterns, for the methods and materials named, in WGSL
    #[arg(long, requires_all = ["method", "material"])]
    pub exhaustive: bool,
    /// Folder of compilers, searched before PATH and the folder `tools` beside this program
    #[arg(long, value_name = "DIR")]
    pub tools: Option<PathBuf>,
    /// Seconds that one file may take
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub limit: u64,
    /// Run one of so many shares of the work; `fresnel-gen merge` puts their JSON reports together
    #[arg(long, value_name = "N")]
    pub shards: Option<usize>,
    /// Which share, 0 to N-1 [default: SLURM_ARRAY_TASK_ID or JOB_COMPLETION_INDEX]
    #[arg(long, value_name = "I", requires = "shards")]
    pub shard: Option<usize>,
    /// Exit with 3 where anything could not be checked
    #[arg(long)]
    pub require_all: bool,
    /// The report.
    #[command(flatten)]
    pub report: CheckReportFlags,
    /// Read numbers of files and answer with rows
    #[arg(long, hide = true)]
    pub worker: bool,
}
impl VerifyFlags {
    /// The command that reports this again under these viewing conditions, without places.
    pub fn command_line(&self, viewing: &ViewingConditions) -> CommandLine {
        let is_half = self.precision.precision == Some(Precision::F16);
        let points = (!self.exhaustive && !is_half).then_some(self.points);
        CommandLine::new("verify")
            .list("target", &self.target)
            .list("effect", &self.effect)
            .list("method", &self.method)
            .list("material", self.materials.choices())
            .list("medium", &self.medium.medium)
            .list("prefix", Naming::flag_of_prefix(&self.prefix))
            .seen_as(viewing)
            .list("precision", self.precision.precision.map(Precision::name))
            .switch("force", self.precision.force)
            .list("matching-angle", self.matching_angle)
            .list("adapter", &self.adapter)
            .list("backend", self.backend.map(Backend::name))
            .switch("exhaustive", self.exhaustive)
            .list("points", points)
    }
}
