//! The flags of `fit`.

use std::path::PathBuf;

use clap::Args;

use crate::emit::CommandLine;
use crate::fit::Weight;
use crate::materials::ViewingConditions;

use super::SightFlags;

/// The flags of fits.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen fit --material gold\n  fresnel-gen fit --material all --terms 5 --json fits.json\n  fresnel-gen fit --material water --weight relative --exact 0,90\n  fresnel-gen fit --search --terms 4\n  fresnel-gen fit --f0 1.0,0.71,0.29 --f82 0.98,0.91,0.66\n\nFits forms shared by all materials, whose coefficients a shader takes as arguments (see `fresnel-gen methods show fitted`). The fit minimises the largest error over all angles. Colours are linear. A star marks what no other form of the same material beats in cost and error. `fresnel-gen --method fitted --material gold` writes the function with the coefficients in it, of least absolute error.\n\nWeights: relative is |f - F| / F. luminance fits red and blue separately, then green so that the error of luminance is least. delta-e weights each channel by its CIEDE2000 per unit at the true colour; the reported error is of all three channels."
)]
pub struct FitFlags {
    /// Names, paths of material files, or all [default: gold, platinum, water, diamond; all for --search]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub material: Vec<String>,
    /// Only forms with so many coefficients: 4 or 5
    #[arg(long, value_name = "N")]
    pub terms: Option<usize>,
    /// Only forms shared by all materials (no effect today)
    #[arg(long)]
    pub shared: bool,
    /// What is minimised, at its largest over all angles: absolute, relative, luminance or delta-e
    #[arg(long, value_name = "NAME", default_value = "absolute")]
    pub weight: String,
    /// Make the fit exact at 0 degrees, at 90, or at both; the report also gives the error without this constraint
    #[arg(long, value_delimiter = ',', value_name = "DEGREES")]
    pub exact: Vec<String>,
    /// Precision of the coefficients: f32, or f16, where the fit rounds them one after another so that each compensates for the others
    #[arg(long, value_name = "NAME", conflicts_with_all = ["exact", "search"])]
    pub precision: Option<String>,
    /// Search over families of short forms. List those on the Pareto frontier of operations and error, and the error of a chosen form
    /// on a substance left out of the choice
    #[arg(long, conflicts_with_all = ["f0", "f82"])]
    pub search: bool,
    /// In place of --material: reflectance at 0 degrees, three numbers from 0 to 1 (requires --f82)
    #[arg(long, value_delimiter = ',', value_name = "R,G,B", requires = "f82", conflicts_with_all = ["material", "medium", "SightFlags"])]
    pub f0: Vec<f64>,
    /// Reflectance at 81.79 degrees (cos θ = 1/7; requires --f0)
    #[arg(long, value_delimiter = ',', value_name = "R,G,B", requires = "f0")]
    pub f82: Vec<f64>,
    /// Medium on the incident side: name or file of a transparent material [default: air]
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

impl FitFlags {
    /// The command that reports this again under these viewing conditions, without places.
    pub fn command_line(&self, sight: &ViewingConditions) -> CommandLine {
        let weight = Some(&self.weight).filter(|name| *name != Weight::default().name());
        CommandLine::new("fit")
            .switch("search", self.search)
            .list("material", &self.material)
            .list("terms", self.terms)
            .list("weight", weight)
            .list("exact", &self.exact)
            .list("precision", &self.precision)
            .list("f0", &self.f0)
            .list("f82", &self.f82)
            .list("medium", &self.medium)
            .seen_as(sight)
    }
}
