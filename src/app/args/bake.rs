//! The flags of `bake`.

use clap::Args;

use crate::lut::{Format, TableAxis};
use crate::methods::{self, Method};
use crate::names::UnknownName;
use crate::targets::{self, Finish, Target};

use super::choice::{Choice, in_any_case, one_of, one_or_all};
use super::{GamutFlags, MaterialFlags, MediumFlags, ReportFlags, TreeFlags};

/// Flags that conflict with `--dfg`.
const NO_MATERIAL: [&str; 9] = [
    "material",
    "medium",
    "gamut",
    "axis",
    "atlas",
    "budget",
    "target",
    "prefix",
    "ViewingFlags",
];

/// The flags of `bake`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Names, paths of material files, or all [default: gold, platinum, water, diamond]")),
    mut_arg("gamut", |arg| arg.help("Colours outside the working space: keep (integers are scaled then), clip to [0, 1], or scale [default: keep]")),
    mut_arg("out_dir", |arg| arg.help("Folder that gets a folder `lut`"))
)]
pub struct BakeFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// Bake the split-sum table of a fitted method (cos θ by roughness, one channel per coefficient) in place of material tables; one
    /// table serves every material fitted by that method
    #[arg(long, conflicts_with_all = NO_MATERIAL)]
    pub dfg: bool,
    /// Whose coefficients the split-sum table is for: fitted, fitted_dielectric
    #[arg(long, value_name = "NAME", requires = "dfg", default_value = "fitted", value_parser = split_sum_method)]
    pub method: &'static Method,
    /// Texels of a table, 2 to 16384 [default: 64; a side of --dfg, 2 to 1024: 128]
    #[arg(long, value_name = "N")]
    pub size: Option<usize>,
    /// How cosines are spread: cos, square, sqrt, rational, steep, grazing [default: rational]
    #[arg(long, value_name = "NAME", value_parser = in_any_case(one_of("axis", TableAxis::ALL, TableAxis::name)))]
    pub axis: Option<TableAxis>,
    /// Files: exr-half, exr-float, png8, png16, ktx2, c, rust, js, all [default: exr-half, png16, ktx2]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = in_any_case(one_or_all("format", Format::ALL, Format::name)))]
    pub format: Vec<Choice<Format>>,
    /// Also write one image with one row per material
    #[arg(long)]
    pub atlas: bool,
    /// Search size, axis and bit depth: the smallest table whose filtered lookup errs by at most this, among the formats
    /// and axes named [default: all axes; png8, exr-half, png16 and exr-float]
    #[arg(
        long,
        value_name = "ERR",
        conflicts_with = "size",
        allow_negative_numbers = true
    )]
    pub budget: Option<f64>,
    /// Write a function that reads the table, beside it, in these languages: gles, glsl, hlsl, msl, wgsl; all means those
    /// written by default [default: none]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = target)]
    pub target: Vec<Choice<&'static Target>>,
    /// Goes before the names of these functions
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// The folder that gets a folder `lut`.
    #[command(flatten)]
    pub tree: TreeFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
    /// No table and no summary on success
    #[arg(long, short)]
    pub quiet: bool,
}

/// A language whose functions read tables, or `all`.
fn target(word: &str) -> Result<Choice<&'static Target>, String> {
    if targets::find(word).is_some_and(|target| target.finish == Finish::Spirv) {
        return Err("a module is not a function that a shader could call; take wgsl, and compile it with your shader".to_owned());
    }
    let text = targets::ALL.iter().copied();
    let text = text.filter(|target| target.finish != Finish::Spirv);
    let parse = one_or_all("target", text, |target| target.name);
    parse(word).map_err(|unknown| unknown.to_string())
}

/// A method. Those that are not fitted are known, and refused with the reason when they are baked.
fn split_sum_method(word: &str) -> Result<&'static Method, UnknownName> {
    let fitted = methods::ALL.iter().filter(|method| method.is_fitted());
    let names: Vec<&str> = fitted.map(|method| method.name).collect();
    methods::find(word).ok_or_else(|| UnknownName::new("method", word, &names))
}
