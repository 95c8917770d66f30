//! The flags of `bake`.

use std::path::PathBuf;

use clap::Args;

use super::SightFlags;

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
    "SightFlags",
];

/// The flags of `bake`.
#[derive(Args, Debug)]
pub struct BakeFlags {
    /// Names, paths of material files, or all [default: gold, platinum, water, diamond]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub material: Vec<String>,
    /// Medium on the incident side: name or file of a transparent material [default: air]
    #[arg(long, value_name = "NAME")]
    pub medium: Option<String>,
    /// How the material is seen.
    #[command(flatten)]
    pub sight: SightFlags,
    /// Colours outside the working space: keep (integers are scaled then), clip to [0, 1], or scale [default: keep]
    #[arg(long, value_name = "NAME")]
    pub gamut: Option<String>,
    /// Bake the split-sum table of a fitted method (cos θ by roughness, one channel per coefficient) in place of material tables; one
    /// table serves every material fitted by that method
    #[arg(long, conflicts_with_all = NO_MATERIAL)]
    pub dfg: bool,
    /// Whose coefficients the split-sum table is for: fitted, fitted_dielectric [default: fitted]
    #[arg(long, value_name = "NAME", requires = "dfg")]
    pub method: Option<String>,
    /// Texels of a table, 2 to 16384 [default: 64; a side of --dfg, 2 to 1024: 128]
    #[arg(long, value_name = "N")]
    pub size: Option<usize>,
    /// How cosines are spread: cos, square, sqrt, rational, steep, grazing [default: rational]
    #[arg(long, value_name = "NAME")]
    pub axis: Option<String>,
    /// Files: exr-half, exr-float, png8, png16, ktx2, c, rust, js, all [default: exr-half, png16, ktx2]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub format: Vec<String>,
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
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub target: Vec<String>,
    /// Goes before the names of these functions
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// Folder that gets a folder `lut`
    #[arg(long, value_name = "DIR", default_value = "shaders-generated")]
    pub out_dir: PathBuf,
    /// Also replace files that fresnel-gen did not write
    #[arg(long)]
    pub overwrite: bool,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// No table and no summary on success
    #[arg(long, short)]
    pub quiet: bool,
}
