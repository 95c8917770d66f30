//! The flags of `time`.

use clap::Args;
use crate::generator::command_line::CommandLine;
use crate::lab::gpu::Backend;
use crate::lab::overdraw::Clock;
use crate::language::methods::Method;
use crate::physics::num::Precision;

use crate::cli::args::choice::{Choice, method_or_all, one_of, precision};
use crate::cli::args::{MaterialFlags, ReportFlags};

/// OpenGL ES runs vertex shaders here, and draws nothing.
const DRAWING_BACKENDS: [Backend; 4] = [
    Backend::Vulkan,
    Backend::Metal,
    Backend::Direct3d12,
    Backend::OpenGl,
];

/// The flags of `time`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Materials that methods are specialised to, beside the library: names, paths of files, all, or none [default: gold, water]")),
    after_help = "Examples:\n  fresnel-gen time\n  fresnel-gen time --method schlick,conductor_exact --material gold --json times.json\n  fresnel-gen time --hardware --size 2048\n\nA share is the cost of one evaluation over that of dielectric_exact's library function, both net of the empty shader. Exit codes: 0 done, 1 a shader failed or took longer than --limit, 2 wrong input, 3 something is missing here."
)]
pub struct TimeFlags {
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What functions compute in: f32, f16 [default: each]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = precision())]
    pub precision: Vec<Precision>,
    /// The graphics card, by a part of its name [default: the fastest there is]
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// The interface: vulkan, metal, dx12 or gl [default: the first of these that is there]
    #[arg(long, value_name = "NAME", value_parser = one_of("backend", DRAWING_BACKENDS, Backend::name))]
    pub backend: Option<Backend>,
    /// Refuse an adapter that is software
    #[arg(long)]
    pub hardware: bool,
    /// Clock: gpu (the device's timestamps), cpu (CPU time, for software renderers) or wall [default: cpu of software, else gpu where its timestamps advance, else wall]
    #[arg(long, value_name = "NAME", value_parser = one_of("clock", Clock::ALL, Clock::name))]
    pub clock: Option<Clock>,
    /// Pixels a side of the square target, 16 to 8192 [default: 256 in software, else 1024]
    #[arg(long, value_name = "PIXELS")]
    pub size: Option<u32>,
    /// Operations in a draw, 100 to 20000, about: evaluations of a function, each from the result before, and of half as many. More where the cost of the draw itself hides a function [default: 400 in software, else 2000]
    #[arg(long, value_name = "N")]
    pub operations: Option<usize>,
    /// Rounds, 1 to 1000. Each draws every shader once, and the reference shader beside every sixth
    #[arg(long, value_name = "N", default_value_t = 75)]
    pub rounds: usize,
    /// Seconds that a single submission may take
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    pub limit: f64,
    /// Exit with 3 where anything could not be measured here
    #[arg(long)]
    pub require_all: bool,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
    /// Draw what is asked for, and answer with readings
    #[arg(long, hide = true)]
    pub worker: bool,
}
impl TimeFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("time")
            .list("method", &self.method)
            .list("material", self.materials.choices())
            .list(
                "precision",
                self.precision.iter().map(|precision| precision.name()),
            )
            .list("adapter", &self.adapter)
            .list("backend", self.backend.map(Backend::name))
            .switch("hardware", self.hardware)
            .list("clock", self.clock.map(Clock::name))
            .list("size", self.size)
            .list("operations", self.operations)
            .number("rounds", self.rounds)
    }
}
