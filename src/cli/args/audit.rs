//! The flags of `audit`.

use std::path::PathBuf;

use clap::Args;
use crate::generator::command_line::{CommandLine, path_again};
use crate::lab::audit::Language;
use crate::lab::cost::Family;
use crate::physics::materials::ViewingConditions;
use crate::physics::names::UnknownName;
use crate::cli::args::choice::{one_of, Choice, family_or_all};
use crate::cli::args::{CheckReportFlags, GamutFlags, MaterialFlags, MediumFlags, PictureFlags};

/// The flags of `audit`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Names, or paths of material files").required_unless_present("worker")),
    mut_arg("out_dir", |arg| arg.help("Write chart.svg and chart.html into this folder: `chart` of these materials, with this function as one more point")),
    after_help = "Examples:\n  fresnel-gen audit mine.glsl --function fresnel --material gold\n  fresnel-gen audit mine.hlsl --function schlick --arg f0=1.03,.73,.36 --material gold --json -\n  fresnel-gen audit mine.wgsl --material gold,platinum --out-dir charts\n  fresnel-gen audit mine.slang --arg ior=1/eta --material water,diamond --max-error 0.001\n\nThe function takes the cosine and whatever --arg binds; arguments that are not bound and have names of ours (eta, n, k, f0, f82, lambda, c0 ...) or of engines (ior, extinction, SpecularColor, edgeTint ...) have the material's values. A function of single numbers is called once a channel where they differ. It runs in a process of its own, within --limit. Exit codes: 0 done, 1 a compiler refuses it, it does not end, a result is no reflectance, or its error is above --max-error; 2 wrong input, 3 a compiler or a driver is missing here, or failed without a word about the text. Being dominated is no finding."
)]
pub struct AuditFlags {
    /// The file: .wgsl, .glsl (as GLSL ES 3.00, or of the desktop where it says so), .hlsl or .slang
    #[arg(required_unless_present = "worker")]
    pub file: Option<String>,
    /// The function; a file that holds one needs no name, and NAME:LINE tells two of one name apart
    #[arg(long, value_name = "NAME")]
    pub function: Option<String>,
    /// A name for the preprocessor, as compilers take it: NAME, or NAME=VALUE
    #[arg(short = 'D', long, value_name = "NAME=VALUE")]
    pub define: Vec<String>,
    /// The language, where the file's ending does not tell it: wgsl, glsl, hlsl or slang
    #[arg(long, value_name = "NAME", value_parser = one_of("language", Language::NAMED, |(name, _)| name))]
    pub language: Option<(&'static str, Language)>,
    /// The value of an argument, or of a uniform: name=number, name=number,number,number, a quantity of the material, as in ior=1/eta, or what it is of the angle: cos, 1-cos, cos^2, sin, sin^2, angle, degrees
    #[arg(long, value_name = "NAME=VALUE")]
    pub arg: Vec<String>,
    /// The largest error that is no finding [default: none is]
    #[arg(long, value_name = "ERROR")]
    pub max_error: Option<f64>,
    /// Compare it with methods alone that take at most so many numbers of a material (schlick 3, f82_tint 6, fitted 12)
    #[arg(long, value_name = "NUMBER")]
    pub max_inputs: Option<usize>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// Families of GPUs whose compilers say what it costs, see `fresnel-gen cost`; or none [default: rdna2, adreno330]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = asked_family)]
    pub gpu: Vec<Choice<&'static Family>>,
    /// Folder of compilers, searched before PATH and the folder `tools` beside this program
    #[arg(long, value_name = "DIR")]
    pub tools: Option<PathBuf>,
    /// Seconds that one step may take
    #[arg(long, value_name = "SECONDS", default_value_t = 20)]
    pub limit: u64,
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: CheckReportFlags,
    /// Compile and run what is handed over
    #[arg(long, hide = true)]
    pub worker: bool,
}
impl AuditFlags {
    /// The command that reports this again under these viewing conditions, without places.
    pub fn command_line(&self, viewing: &ViewingConditions) -> CommandLine {
        let file = self.file.as_deref().unwrap_or_default();
        let command = CommandLine::new("audit")
            .argument(&path_again(file))
            .list("language", self.language.map(|(name, _)| name))
            .list("function", &self.function);
        let arguments = self.arg.iter();
        let defined = self.define.iter();
        let command = defined.fold(command, |command, one| command.list("define", [one]));
        arguments
            .fold(command, |command, one| command.list("arg", [one]))
            .list("material", self.materials.choices())
            .list("medium", &self.medium.medium)
            .seen_as(viewing)
            .list("gpu", &self.gpu)
            .list("max-error", self.max_error)
            .list("max-inputs", self.max_inputs)
    }
}

/// The parser of a word of `--gpu`.
fn asked_family(word: &str) -> Result<Choice<&'static Family>, UnknownName> {
    match word {
        "none" => Ok(Choice::None),
        name => family_or_all()(name),
    }
}
