//! The flags of `fit`.

use std::path::PathBuf;

use clap::Args;

use super::SightFlags;

/// The flags of fits.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen fit --material gold\n  fresnel-gen fit --material all --terms 5 --json fits.json\n  fresnel-gen fit --material water --weight relative --exact 0,90\n  fresnel-gen fit --search --terms 4\n  fresnel-gen fit --f0 1.0,0.71,0.29 --f82 0.98,0.91,0.66\n\nFits the shared forms, whose coefficients a shader takes as arguments (see `fresnel-gen methods show fitted`): those with the\nleast largest error over all angles. Colours are linear. A star marks what no other form of the same material beats in cost\nand error. `fresnel-gen --method fitted --material gold` writes the function with the coefficients in it, of least absolute error.\n\nWeights: relative is |f - F| / F. luminance keeps red and blue at their own best and lets green make the luminance of all three\nthe best there is. delta-e weighs each channel by the CIEDE2000 per unit of it at the true colour, channel by channel; the error\ntold is that of all three."
)]
pub struct FitFlags {
    /// Names, paths of material files, or all [default: gold, platinum, water, diamond; all for --search]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub material: Vec<String>,
    /// Only forms with so many coefficients: 4 or 5
    #[arg(long, value_name = "N")]
    pub terms: Option<usize>,
    /// Only forms that all materials share: today all are
    #[arg(long)]
    pub shared: bool,
    /// What is minimised, at its largest over all angles: absolute, relative, luminance or delta-e
    #[arg(long, value_name = "NAME", default_value = "absolute")]
    pub weight: String,
    /// Meet what is true exactly at 0 degrees, at 90, or at both; the error without that stands beside it
    #[arg(long, value_delimiter = ',', value_name = "DEGREES")]
    pub exact: Vec<String>,
    /// What holds the coefficients: f32, or f16, in which they are rounded in the fit, each making up for the others
    #[arg(long, value_name = "NAME", conflicts_with_all = ["exact", "search"])]
    pub precision: Option<String>,
    /// Search the shape itself: families of short forms with their constants in steps, which of them nothing beats in operations
    /// and error, and what a choice is worth for a substance that had no part in it
    #[arg(long, conflicts_with_all = ["f0", "f82"])]
    pub search: bool,
    /// No material: reflectance at 0 degrees, three numbers from 0 to 1; with --f82
    #[arg(long, value_delimiter = ',', value_name = "R,G,B", requires = "f82", conflicts_with_all = ["material", "medium", "SightFlags"])]
    pub f0: Vec<f64>,
    /// And at 81.79 degrees (cos θ = 1/7)
    #[arg(long, value_delimiter = ',', value_name = "R,G,B", requires = "f0")]
    pub f82: Vec<f64>,
    /// What the light comes from: a transparent material's name or file [default: air]
    #[arg(long, value_name = "NAME")]
    pub medium: Option<String>,
    /// Whose cost stands beside the error: rdna2, adreno330, malig72 ... as for `cost`
    #[arg(long, value_name = "NAME", default_value = "rdna2")]
    pub gpu: String,
    /// How materials are seen
    #[command(flatten)]
    pub sight: SightFlags,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}
