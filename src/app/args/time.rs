//! The flags of `time`.

use std::path::PathBuf;

use clap::Args;

use crate::emit::CommandLine;

/// The flags of `time`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen time\n  fresnel-gen time --method schlick,conductor_exact --material gold --json times.json\n  fresnel-gen time --hardware --size 2048\n\nA share is the cost of one evaluation over that of dielectric_exact's library function, both net of the empty shader. Exit codes: 0 done, 1 a shader failed or took longer than --limit, 2 wrong input, 3 something is missing here."
)]
pub struct TimeFlags {
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub method: Vec<String>,
    /// Materials that methods are specialised to, beside the library: names, paths of files, all, or none [default: gold, water]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub material: Vec<String>,
    /// What functions compute in: f32, f16, or both [default: both]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub precision: Vec<String>,
    /// The graphics card, by a part of its name [default: the fastest there is]
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// The interface: vulkan, metal, dx12 or gl [default: the first of these that is there]
    #[arg(long, value_name = "NAME")]
    pub backend: Option<String>,
    /// Refuse an adapter that is software
    #[arg(long)]
    pub hardware: bool,
    /// Clock: gpu (the device's timestamps), cpu (CPU time, for software renderers) or wall [default: cpu of software, else gpu where its timestamps advance, else wall]
    #[arg(long, value_name = "NAME")]
    pub clock: Option<String>,
    /// Pixels a side of the square target, 16 to 8192 [default: 256 in software, else 1024]
    #[arg(long, value_name = "PIXELS")]
    pub size: Option<u32>,
    /// Evaluations in a draw, 1 to 8, each from the result before; 1 is what a scene draws
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub evaluations: usize,
    /// Rounds, 1 to 1000. Each draws every shader once, and the reference shader beside every sixth
    #[arg(long, value_name = "N", default_value_t = 75)]
    pub rounds: usize,
    /// Seconds that a single submission may take
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    pub limit: f64,
    /// Exit with 3 where anything could not be measured here
    #[arg(long)]
    pub require_all: bool,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Draw what is asked for, and answer with readings
    #[arg(long, hide = true)]
    pub worker: bool,
}

impl TimeFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("time")
            .list("method", &self.method)
            .list("material", &self.material)
            .list("precision", &self.precision)
            .list("adapter", &self.adapter)
            .list("backend", &self.backend)
            .switch("hardware", self.hardware)
            .list("clock", &self.clock)
            .list("size", self.size)
            .number("evaluations", self.evaluations)
            .number("rounds", self.rounds)
    }
}
