//! The command line: flags and subcommands.

mod audit;
mod bake;
mod chart;
mod cost;
mod fit;
mod named;
mod renamed;
mod stability;
mod time;
mod verify;

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand};

use crate::emit::HeaderForm;

use super::precision::PrecisionFlags;
use super::sight::Words;

pub use audit::AuditFlags;
pub use bake::BakeFlags;
pub use chart::ChartFlags;
pub use cost::CostFlags;
pub use fit::FitFlags;
pub use named::NamedFiles;
pub use renamed::with_names_of_today;
pub use stability::StabilityFlags;
pub use time::TimeFlags;
pub use verify::VerifyFlags;

/// Turns measured optical constants into Fresnel reflectance functions that a shader can afford.
///
/// Without a subcommand it generates: shaders for every target, method and material asked for.
#[derive(Debug, Parser)]
#[command(
    name = "fresnel-gen",
    version,
    args_conflicts_with_subcommands = true,
    after_help = "Examples:\n  fresnel-gen --target gles\n  fresnel-gen --material gold --method conductor_exact --target hlsl -o -\n  fresnel-gen --material my_metal.toml --target wgsl --out-dir shaders\n  fresnel-gen --material gold --budget 0.002 --gpu adreno330 -o -\n  fresnel-gen --check\n\nExit codes: 0 done; 1 findings (--check found a difference); 2 usage or input error; 3 something is missing on this machine."
)]
pub struct Cli {
    /// What to do; generation where nothing is named.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The flags of generation.
    #[command(flatten)]
    pub generate: Generate,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List the methods, or show one with formula, source, domain and promised errors
    #[command(after_help = "Example:\n  fresnel-gen methods show schlick_corrected")]
    Methods(Listing),
    /// List the materials, show one, compute its parameters, import more
    #[command(
        after_help = "Examples:\n  fresnel-gen materials list --class metal\n  fresnel-gen materials params gold --space acescg --json -\n  fresnel-gen materials show gold --svg gold.svg\n  fresnel-gen materials import main/Au/nk/Johnson.yml --name my_gold -o my_gold.toml"
    )]
    Materials(Box<MaterialsFlags>),
    /// List the targets, or show one with its validators
    #[command(after_help = "Example:\n  fresnel-gen targets show gles")]
    Targets(Listing),
    /// Bake reflectance into lookup tables: EXR, PNG, KTX2, arrays, with the error of the filtered lookup
    #[command(
        after_help = "Examples:\n  fresnel-gen bake --material gold --format exr-half,ktx2 --target wgsl\n  fresnel-gen bake --material all --atlas --budget 0.001 --json -\n  fresnel-gen bake --dfg --method fitted --format exr-half"
    )]
    Bake(Box<BakeFlags>),
    /// Run the generated functions of every target and compare the results with f64 on the CPU
    Verify(Box<VerifyFlags>),
    /// Show where methods fail: regions of NaN, of lost digits, and of large error against the exact law
    Stability(StabilityFlags),
    /// Show what functions cost, by Mesa's GPU compilers; recorded figures replace a missing compiler
    Cost(Box<CostFlags>),
    /// Measure the time of functions on this machine's device, by overdraw, and as a share of the exact law's time
    Time(TimeFlags),
    /// Fit coefficients: of materials, or of an artist's two colours
    Fit(Box<FitFlags>),
    /// Chart error against cost: one point per method, and the Pareto frontier
    Chart(ChartFlags),
    /// Measure your own function (WGSL, GLSL or HLSL) against a material's exact reflectance and compare it with our methods
    Audit(Box<AuditFlags>),
    /// Recompute the tables, figures and claims of the thesis (Štetić-Kozić 2014) and print both side by side
    Reproduce(Reproduce),
}

impl Cli {
    /// The files that it names.
    pub fn named_files(&self) -> NamedFiles<'_> {
        let mut named = NamedFiles::default();
        let Some(command) = &self.command else {
            let flags = &self.generate;
            named.read(flags.material.iter().chain(&flags.medium));
            named.seen(&flags.sight);
            named.write(flags.output.iter().chain(&flags.depfile));
            return named;
        };
        match command {
            Command::Methods(flags) | Command::Targets(flags) => named.write(&flags.json),
            Command::Materials(flags) => named.materials(flags),
            Command::Bake(flags) => {
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(&flags.json);
            }
            Command::Verify(flags) => {
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(flags.json.iter().chain(&flags.junit));
            }
            Command::Audit(flags) => {
                named.inputs.extend(flags.file.iter().map(Path::new));
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(flags.json.iter().chain(&flags.junit));
            }
            Command::Fit(flags) => {
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(&flags.json);
            }
            Command::Cost(flags) => named.report(&flags.material, &flags.json),
            Command::Time(flags) => named.report(&flags.material, &flags.json),
            Command::Chart(flags) => named.report(&flags.material, &flags.json),
            Command::Stability(flags) => named.report(&flags.material, &flags.json),
            Command::Reproduce(flags) => named.write(&flags.json),
        }
        named
    }
}

/// The flags of generation.
#[derive(Args, Debug)]
pub struct Generate {
    /// Output language, see `fresnel-gen targets`; all means those written by default [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub target: Vec<String>,
    /// Method, see `fresnel-gen methods` [default: all; for a material: exact, fitted, two Schlick variants and table]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub method: Vec<String>,
    /// Material to specialise to: names, paths of material files, all; or none [default: gold, platinum, water, diamond]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
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
    /// Goes before every function's name
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// What functions compute in.
    #[command(flatten)]
    pub precision: PrecisionFlags,
    /// Degrees at which the corrected Schlick meets the exact law [default: that of cosine 0.15, 81.373]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub matching_angle: Option<f64>,
    /// Comments of generated files; what short ones leave out stands in manifest.json
    #[arg(long, value_enum, value_name = "FORM", default_value_t)]
    pub header: HeaderForm,
    /// Write one function per material: the cheapest whose largest error over angles and channels is at most this
    #[arg(long, value_name = "ERR", allow_negative_numbers = true)]
    pub budget: Option<f64>,
    /// GPU family whose recorded costs --budget compares: rdna2, adreno330 ... as for `cost` [default: rdna2]
    #[arg(long, value_name = "NAME", requires = "budget")]
    pub gpu: Option<String>,
    /// Folder for the generated tree
    #[arg(long, value_name = "DIR", default_value = "shaders-generated")]
    pub out_dir: PathBuf,
    /// Write the functions asked for into this one file, or `-` for stdout; one target [default: wgsl]
    #[arg(short = 'o', value_name = "FILE", conflicts_with_all = ["check", "list", "out_dir"])]
    pub output: Option<PathBuf>,
    /// Write nothing: compare with the folder, print a diff, exit 1 where it differs
    #[arg(long, conflicts_with_all = ["list", "depfile"])]
    pub check: bool,
    /// Also replace files that fresnel-gen did not write
    #[arg(long)]
    pub overwrite: bool,
    /// Write the run's outputs and inputs as a Makefile rule
    #[arg(long, value_name = "FILE", conflicts_with = "list")]
    pub depfile: Option<PathBuf>,
    /// Print the names of the files that would be written, and write nothing
    #[arg(long)]
    pub list: bool,
    /// No summary on success
    #[arg(long, short)]
    pub quiet: bool,
}

/// How materials are seen: the flags of every command that makes three channels of a spectrum.
#[derive(Args, Clone, Debug, Default)]
pub struct SightFlags {
    /// Working space: srgb, p3, rec2020, acescg; all linear [default: srgb]
    #[arg(long, value_name = "NAME")]
    pub space: Option<String>,
    /// The light: D65, E, A, F11, LED-B3, or a file of two columns, nm and power [default: D65]
    #[arg(long, value_name = "NAME")]
    pub illuminant: Option<String>,
    /// The eye: cie1931 or cie2015 [default: cie1931]
    #[arg(long, value_name = "NAME")]
    pub observer: Option<String>,
    /// How the colour of a perfect mirror becomes (1, 1, 1): scale (divide each channel) or bradford [default: scale]
    #[arg(long, value_name = "NAME")]
    pub adaptation: Option<String>,
    /// Steps of the spectrum: 5nm or 1nm [default: 5nm]
    #[arg(long, value_name = "STEP")]
    pub step: Option<String>,
    /// Use one wavelength per channel, in nm, in place of the spectrum (the thesis uses 685,535,475)
    #[arg(long, value_delimiter = ',', value_name = "R,G,B")]
    pub wavelengths: Vec<f64>,
    /// Beyond the measured range: refuse, or hold the last value [default: refuse]
    #[arg(long, value_name = "HOW")]
    pub extrapolate: Option<String>,
}

impl SightFlags {
    /// What they say, in words.
    pub fn words<'a>(&'a self, gamut: Option<&'a str>) -> Words<'a> {
        Words {
            space: self.space.as_deref(),
            gamut,
            illuminant: self.illuminant.as_deref(),
            observer: self.observer.as_deref(),
            adaptation: self.adaptation.as_deref(),
            step: self.step.as_deref(),
            wavelengths: &self.wavelengths,
            extrapolate: self.extrapolate.as_deref(),
        }
    }
}

/// The flags of `methods` and `targets`.
#[derive(Args, Debug)]
pub struct Listing {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<ListingCommand>,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE", global = true)]
    pub json: Option<PathBuf>,
}

/// What a listing does.
#[derive(Debug, Subcommand)]
pub enum ListingCommand {
    /// Name, summary and source of each
    List,
    /// All that is known of one
    Show {
        /// Its name
        name: String,
    },
}

/// The flags of `materials`.
#[derive(Args, Debug)]
pub struct MaterialsFlags {
    /// What to do [default: list]
    #[command(subcommand)]
    pub what: Option<MaterialsCommand>,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE", global = true)]
    pub json: Option<PathBuf>,
}

/// What is done with materials.
#[derive(Debug, Subcommand)]
pub enum MaterialsCommand {
    /// Name, class, measured range and summary of each
    List(FilterFlags),
    /// All that is known of one, as text, and as a picture
    Show(ShowFlags),
    /// The numbers that an engine wants: F0, F82, n and k per channel, averages, and how well they are known
    #[command(after_help = "Example:\n  fresnel-gen materials params gold --space acescg --json -")]
    Params(ParamsFlags),
    /// Turn a page of refractiveindex.info or a CSV table into a material file
    #[command(
        after_help = "Example:\n  fresnel-gen materials import main/Au/nk/Johnson.yml --name my_gold -o my_gold.toml"
    )]
    Import(ImportFlags),
    /// Read every page of refractiveindex.info below a folder: what it is, its colour, or why it cannot be used
    #[command(
        after_help = "Example:\n  fresnel-gen materials survey refractiveindex.info-database/database/data --json pages.json"
    )]
    Survey(SurveyFlags),
}

/// Which materials are listed.
#[derive(Args, Debug, Default)]
pub struct FilterFlags {
    /// Only metal, semiconductor or dielectric
    #[arg(long, value_name = "NAME")]
    pub class: Option<String>,
    /// Only measurements of this substance, such as gold
    #[arg(long, value_name = "NAME")]
    pub substance: Option<String>,
    /// Only those whose name, summary or source holds this text
    #[arg(long, value_name = "TEXT")]
    pub search: Option<String>,
    /// Only those known over the whole visible spectrum
    #[arg(long)]
    pub full: bool,
}

/// The flags of `materials show`.
#[derive(Args, Debug)]
pub struct ShowFlags {
    /// Which material, and how it is seen.
    #[command(flatten)]
    pub of: ParamsFlags,
    /// Draw n, k, reflectance and colour as SVG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Draw them as PNG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
}

/// The flags of `materials params`.
#[derive(Args, Debug)]
pub struct ParamsFlags {
    /// A name, or the path of a material file, page or table
    pub name: String,
    /// Medium on the incident side: name or file of a transparent material [default: air]
    #[arg(long, value_name = "NAME")]
    pub medium: Option<String>,
    /// How it is seen.
    #[command(flatten)]
    pub sight: SightFlags,
}

/// The flags of `materials import`.
#[derive(Args, Debug)]
pub struct ImportFlags {
    /// The page (.yml) or table (.csv)
    pub page: String,
    /// The material's name [default: made of the file's path]
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// metal, semiconductor or dielectric [default: guessed from n and k]
    #[arg(long, value_name = "NAME")]
    pub class: Option<String>,
    /// Write the material file here, or `-` for stdout [default: stdout]
    #[arg(short = 'o', value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// The flags of `materials survey`.
#[derive(Args, Debug)]
pub struct SurveyFlags {
    /// A folder of pages, or one page
    pub folder: PathBuf,
    /// How they are seen.
    #[command(flatten)]
    pub sight: SightFlags,
}

/// The flags of `reproduce`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  fresnel-gen reproduce table2 --json -")]
pub struct Reproduce {
    /// Only this: table1, table2, table3, table4, table5, table6, table7, table8, claims or figures [default: all]
    pub table: Option<String>,
    /// Folder for the figures
    #[arg(long, value_name = "DIR", default_value = "reproduced")]
    pub out_dir: PathBuf,
    /// Also replace files that fresnel-gen did not write
    #[arg(long)]
    pub overwrite: bool,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}
