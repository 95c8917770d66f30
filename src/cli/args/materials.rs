//! The flags of `materials`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use crate::generator::exchange::{self, Format};
use crate::physics::materials::{ConstantIndex, MaterialKind};
use crate::physics::names::UnknownName;

use crate::cli::args::choice::one_of;
use crate::cli::args::viewing::colour;
use crate::cli::args::{MaterialName, MediumFlags, ReportFlags, ViewingFlags};

/// The flags of `materials`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct MaterialsFlags {
    /// What to do [default: list]
    #[command(subcommand)]
    pub what: Option<MaterialsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is done with materials.
#[derive(Debug, Subcommand)]
pub enum MaterialsCommand {
    /// Name, class, measured range and summary of each
    List(FilterFlags),
    /// All that is known of one, as text, and as a picture
    Show(ShowFlags),
    /// The numbers that an engine wants: F0, F82, n and k per channel, averages, and how well they are known
    #[command(
        after_help = "Examples:\n  fresnel-gen materials params gold --space acescg --json -\n  fresnel-gen materials params gold --as materialx -o gold.mtlx"
    )]
    Params(ParamsFlags),
    /// Colours of a metal in air, F0 and F82, turned into its colours under a clear coat
    #[command(
        after_help = "Example:\n  fresnel-gen materials coat --f0 1,.71,.29 --f82 .98,.91,.66 --index 1.5\n\nEach channel takes the n and k that give its F0 and F82, relative to the coat. Where no n and k give both, those of the nearest F82 are taken, and the report says so. Of a measured material `materials params gold --medium 1.5` gives the colours by its spectrum. A shader computes F0 by `--effect coat`."
    )]
    Coat(CoatFlags),
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
    #[arg(long, value_name = "NAME", value_parser = class())]
    pub class: Option<MaterialKind>,
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
    /// Which material, and how it is looked at.
    #[command(flatten)]
    pub of: SeenFlags,
    /// Draw n, k, reflectance and colour as SVG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Draw them as PNG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
}

/// Which material, and how it is looked at.
#[derive(Args, Debug)]
pub struct SeenFlags {
    /// A name, or the path of a material file, page or table
    #[arg(value_parser = MaterialName::parse)]
    pub name: MaterialName,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How it is looked at.
    #[command(flatten)]
    pub viewing: ViewingFlags,
}

/// The flags of `materials params`.
#[derive(Args, Debug)]
pub struct ParamsFlags {
    /// Which material, and how it is looked at.
    #[command(flatten)]
    pub of: SeenFlags,
    /// Write the numbers for an engine or a tool: openpbr, materialx, gltf, usd, blender, unreal, filament
    #[arg(long = "as", value_name = "FORMAT", value_parser = one_of("format", exchange::ALL.iter().copied(), |format| format.name))]
    pub format: Option<&'static Format>,
    /// Write that file here, or `-` for stdout [default: stdout]
    #[arg(short = 'o', value_name = "FILE", requires = "format")]
    pub output: Option<PathBuf>,
    /// Also replace a file that fresnel-gen did not write
    #[arg(long, requires = "output")]
    pub overwrite: bool,
}

/// The flags of `materials coat`.
#[derive(Args, Debug)]
pub struct CoatFlags {
    /// Reflectance in air at 0 degrees, three numbers from 0 to 1
    #[arg(long, value_name = "R,G,B", value_parser = colour)]
    pub f0: [f64; 3],
    /// Reflectance in air at 81.79 degrees (cos θ = 1/7), likewise
    #[arg(long, value_name = "R,G,B", value_parser = colour)]
    pub f82: [f64; 3],
    /// The coat's refractive index, from 1 to 10
    #[arg(long, value_name = "N", default_value = "1.5", value_parser = index, allow_negative_numbers = true)]
    pub index: ConstantIndex,
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
    #[arg(long, value_name = "NAME", value_parser = class())]
    pub class: Option<MaterialKind>,
    /// Write the material file here, or `-` for stdout [default: stdout]
    #[arg(short = 'o', value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// The flags of `materials survey`.
#[derive(Args, Debug)]
pub struct SurveyFlags {
    /// A folder of pages, or one page
    pub folder: PathBuf,
    /// How they are looked at.
    #[command(flatten)]
    pub viewing: ViewingFlags,
}

/// The parser of a class's name.
fn class() -> impl Fn(&str) -> Result<MaterialKind, UnknownName> + Clone {
    one_of("class", MaterialKind::ALL, MaterialKind::name)
}

/// The parser of a coat's index.
fn index(word: &str) -> Result<ConstantIndex, String> {
    let wanted = || "a coat's index is a number from 1 to 10, such as 1.5".to_owned();
    let index = ConstantIndex::parse(word).ok_or_else(wanted)?;
    index.map_err(|_| wanted())
}
