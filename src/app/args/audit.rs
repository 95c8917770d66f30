//! The flags of `audit`.

use std::path::PathBuf;

use clap::Args;

use crate::emit::{CommandLine, file_name};
use crate::materials::ViewingConditions;

use super::SightFlags;

/// The flags of `audit`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen audit mine.glsl --function fresnel --material gold\n  fresnel-gen audit mine.hlsl --function schlick --arg f0=1.03,.73,.36 --material gold --json -\n  fresnel-gen audit mine.wgsl --material gold,platinum --out-dir charts\n\nThe function takes the cosine and whatever --arg binds; arguments named as ours are (eta, n, k, f0, f82, lambda, c0 ...) that are not bound have the material's values. A function of single numbers is called once a channel where they differ. It runs in a process of its own, within --limit. Exit codes: 0 done, 1 a compiler refuses it, it does not end, or a result is no reflectance; 2 wrong input, 3 something is missing here. Being dominated is no finding."
)]
pub struct AuditFlags {
    /// The file: .wgsl, .glsl (as GLSL ES 3.00) or .hlsl
    #[arg(required_unless_present = "worker")]
    pub file: Option<String>,
    /// The function; a file that holds one needs no name
    #[arg(long, value_name = "NAME")]
    pub function: Option<String>,
    /// The language, where the file's ending does not tell it: wgsl, glsl or hlsl
    #[arg(long, value_name = "NAME")]
    pub language: Option<String>,
    /// An argument's value: name=number or name=number,number,number
    #[arg(long, value_name = "NAME=V[,V,V]")]
    pub arg: Vec<String>,
    /// Names, or paths of material files
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "NAME",
        required_unless_present = "worker"
    )]
    pub material: Vec<String>,
    /// Medium on the incident side: name or file of a transparent material [default: air]
    #[arg(long, value_name = "NAME")]
    pub medium: Option<String>,
    /// How the material is seen.
    #[command(flatten)]
    pub sight: SightFlags,
    /// Colours outside the working space: keep, clip to [0, 1], or scale [default: clip]
    #[arg(long, value_name = "NAME")]
    pub gamut: Option<String>,
    /// Families of GPUs whose compilers say what it costs, see `fresnel-gen cost`; or none [default: rdna2, adreno330]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub gpu: Vec<String>,
    /// Folder of compilers, searched before PATH and the folder `tools` beside this program
    #[arg(long, value_name = "DIR")]
    pub tools: Option<PathBuf>,
    /// Seconds that one step may take
    #[arg(long, value_name = "SECONDS", default_value_t = 20)]
    pub limit: u64,
    /// Write chart.svg and chart.html into this folder: `chart` of these materials, with this function as one more point
    #[arg(long, value_name = "DIR")]
    pub out_dir: Option<PathBuf>,
    /// Also replace files that fresnel-gen did not write
    #[arg(long, requires = "out_dir")]
    pub overwrite: bool,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write the report as JUnit's XML to this file
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Compile and run what is handed over
    #[arg(long, hide = true)]
    pub worker: bool,
}

impl AuditFlags {
    /// The command that reports this again under these viewing conditions, without places.
    pub fn command_line(&self, sight: &ViewingConditions) -> CommandLine {
        let file = self.file.as_deref().unwrap_or_default();
        let command = CommandLine::new("audit")
            .argument(file_name(file))
            .list("language", &self.language)
            .list("function", &self.function);
        let arguments = self.arg.iter();
        arguments
            .fold(command, |command, one| command.list("arg", [one]))
            .list("material", &self.material)
            .list("medium", &self.medium)
            .seen_as(sight)
            .list("gpu", &self.gpu)
    }
}
