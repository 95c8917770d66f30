//! The flags of `bake`.

use clap::Args;

use crate::generator::bake::split_sum_methods;
use crate::generator::lut::{Format, SPLIT_SUM_AXES, SplitSumAxis, SplitSumLayout, TableAxis};
use crate::language::methods::{self, Method};
use crate::language::targets::{self, Finish, Target};
use crate::physics::names::UnknownName;

use crate::cli::args::choice::{Choice, in_any_case, one_of, one_or_all};
use crate::cli::args::{GamutFlags, MaterialFlags, MediumFlags, ReportFlags, TreeFlags};

/// Flags that conflict with `--dfg`.
const NO_MATERIAL: [&str; 8] = [
    "material",
    "medium",
    "gamut",
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
    /// Bake the split-sum table of a method (cos θ by roughness, one channel per number of a material) in place of material tables;
    /// one table serves every material
    #[arg(long, conflicts_with_all = NO_MATERIAL)]
    pub dfg: bool,
    /// Whose numbers the split-sum table is for: any method that is affine in numbers of a material, such as schlick, schlick_f90,
    /// f82_tint, hoffman_f82, fitted_f82, fitted, fitted_dielectric [default: fitted; schlick with --layout]
    #[arg(long, value_name = "NAME", requires = "dfg", conflicts_with_all = NO_MATERIAL, value_parser = split_sum_method)]
    pub method: Option<&'static Method>,
    /// What an engine binds in place of its own table: filament (128 x 128), unreal (128 x 32); of schlick
    #[arg(long, value_name = "NAME", requires = "dfg", conflicts_with_all = ["size", "axis", "material", "medium"], value_parser = in_any_case(one_of("layout", SplitSumLayout::ENGINES, SplitSumLayout::name)))]
    pub layout: Option<SplitSumLayout>,
    /// Texels of a table, 2 to 16384 [default: 64; a side of --dfg, 2 to 1024: 128]
    #[arg(long, value_name = "N")]
    pub size: Option<usize>,
    /// How cosines are spread: cos, square, sqrt, rational, steep, grazing [default: rational]; with --dfg how cosines and roughness are
    /// spread, COSINE,ROUGHNESS, each of linear, sqrt, fourth-root; one name is for both [default: sqrt]
    #[arg(long, value_name = "NAME")]
    pub axis: Option<String>,
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

/// A method. Those that are not affine are known, and refused with the reason when they are baked.
fn split_sum_method(word: &str) -> Result<&'static Method, UnknownName> {
    methods::find(word).ok_or_else(|| UnknownName::new("method", word, &split_sum_methods()))
}

impl BakeFlags {
    /// The axis of tables of materials, where one is named.
    ///
    /// # Errors
    /// No such axis.
    pub fn table_axis(&self) -> Result<Option<TableAxis>, UnknownName> {
        let parse = in_any_case(one_of("axis", TableAxis::ALL, TableAxis::name));
        self.axis.as_deref().map(parse).transpose()
    }

    /// The axes of cosine and roughness of a split-sum table.
    ///
    /// # Errors
    /// No such axis.
    pub fn split_sum_axes(&self) -> Result<[SplitSumAxis; 2], UnknownName> {
        let parse = in_any_case(one_of("axis", SplitSumAxis::ALL, SplitSumAxis::name));
        let Some(words) = self.axis.as_deref() else {
            return Ok(SPLIT_SUM_AXES);
        };
        let (cosine, roughness) = words.split_once(',').unwrap_or((words, words));
        Ok([parse(cosine)?, parse(roughness)?])
    }
}
