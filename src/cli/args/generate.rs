//! The flags of generation.

use std::path::PathBuf;

use clap::Args;

use crate::generator::emit::HeaderForm;
use crate::generator::flavours::Flavour;
use crate::lab::cost::Family;
use crate::language::effects::Effect;
use crate::language::methods::Method;
use crate::language::targets::Target;

use crate::cli::args::choice::{Choice, effect_or_all, family, flavour, method_or_all, one_of, target_or_all};
use crate::cli::args::output::file_only;
use crate::cli::args::{GamutFlags, MaterialFlags, MediumFlags, PrecisionFlags, TreeFlags};

/// The flags of generation.
#[derive(Args, Debug)]
#[command(mut_arg("material", |arg| arg.help("Material to specialise to: names, paths of material files, all; or none [default: gold, platinum, water, diamond; none with -o or --effect]")))]
pub struct GenerateFlags {
    /// Output language, see `fresnel-gen targets`; all means those written by default [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = target_or_all())]
    pub target: Vec<Choice<&'static Target>>,
    /// Method, see `fresnel-gen methods` [default: all; for a material: exact, fitted, two Schlick variants and table, with -o exact alone]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Effect, see `fresnel-gen effects`, or all: write its functions and nothing else, with R by --method, specialised to --material [default: all where nothing is named]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = effect_or_all(), conflicts_with = "budget")]
    pub effect: Vec<Choice<&'static Effect>>,
    /// Engine or renderer: write an adapter for it and nothing else, in its own folder; --target beside it writes that too
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = flavour(), conflicts_with_all = ["budget", "plan", "output"])]
    pub flavour: Vec<&'static Flavour>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// What functions compute in.
    #[command(flatten)]
    pub precision: PrecisionFlags,
    /// Degrees at which the corrected Schlick meets the exact law [default: that of cosine 0.15, 81.373]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub matching_angle: Option<f64>,
    /// Goes before every function's name
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// Comments of generated files: short (what a function is, its largest error, its cost, its source, and warnings; the rest stands in manifest.json) or full
    #[arg(long, value_name = "FORM", default_value = "short", value_parser = one_of("form of comments", HeaderForm::ALL, HeaderForm::name))]
    pub header: HeaderForm,
    /// Write one function per material: the cheapest whose largest error over angles and channels is at most this
    #[arg(long, value_name = "ERR", allow_negative_numbers = true)]
    pub budget: Option<f64>,
    /// GPU family whose recorded costs --budget compares: rdna2, adreno330 ... as for `cost` [default: rdna2]
    #[arg(long, value_name = "NAME", requires = "budget", value_parser = family())]
    pub gpu: Option<&'static Family>,
    /// Write exactly the functions of this plan, which `fresnel-gen plan --json FILE` made
    #[arg(long, value_name = "FILE", value_parser = file_only("--plan"), conflicts_with_all = ["method", "effect", "material", "medium", "matching_angle", "precision", "force", "budget", "space", "illuminant", "observer", "adaptation", "step", "wavelengths", "extrapolate", "gamut"])]
    pub plan: Option<PathBuf>,
    /// A material file that the plan may name though it lies outside of the plan's folder, or a folder of such files
    #[arg(long, value_name = "PATH", requires = "plan")]
    pub allow: Vec<PathBuf>,
    /// The folder for the generated tree.
    #[command(flatten)]
    pub tree: TreeFlags,
    /// Write the functions asked for into this one file and nothing else, or to stdout (`-`); one target [default: by the file's ending; wgsl for `-`]
    #[arg(short = 'o', value_name = "FILE", conflicts_with_all = ["check", "list", "out_dir"])]
    pub output: Option<PathBuf>,
    /// Write nothing: compare with the folder, print a diff, exit 1 where it differs
    #[arg(long, conflicts_with_all = ["list", "depfile"])]
    pub check: bool,
    /// Write the run's outputs and inputs as a Makefile rule
    #[arg(long, value_name = "FILE", value_parser = file_only("--depfile"), conflicts_with = "list")]
    pub depfile: Option<PathBuf>,
    /// What the rule of --depfile is for, as the build system names it [default: the file of -o, or all files of the folder]
    #[arg(long, value_name = "FILE", value_parser = file_only("--depfile-target"), requires = "depfile")]
    pub depfile_target: Option<PathBuf>,
    /// Print the names of the files that would be written, and write nothing
    #[arg(long)]
    pub list: bool,
    /// No summary on success
    #[arg(long, short)]
    pub quiet: bool,
}
