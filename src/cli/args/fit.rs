//! The flags of `fit`.

use clap::Args;

use crate::generator::command_line::CommandLine;
use crate::generator::fit::Weight;
use crate::lab::cost::Family;
use crate::physics::materials::ViewingConditions;
use crate::physics::num::Precision;

use crate::cli::args::choice::{family, one_of, precision};
use crate::cli::args::viewing::colour;
use crate::cli::args::{GamutFlags, MaterialFlags, MediumFlags, ReportFlags};

/// The flags of fits.
#[derive(Args, Debug)]
#[command(
    mut_arg("gamut", |arg| arg.help("What reflects outside [0, 1]: clip and scale fit a form that keeps to [0, 1] by itself, as image light needs it; keep leaves it free [default: clip]")),
    mut_arg("material", |arg| arg.help("Names, paths of material files, or all [default: gold, platinum, water, diamond; all for --search]")),
    after_help = "Examples:\n  fresnel-gen fit --material gold\n  fresnel-gen fit --material all --terms 5 --json fits.json\n  fresnel-gen fit --material water --weight relative --exact 0,90\n  fresnel-gen fit --search --terms 4\n  fresnel-gen fit --f0 1.0,0.71,0.29 --f82 0.98,0.91,0.66\n\nFits forms shared by all materials, whose coefficients a shader takes as arguments (see `fresnel-gen methods show fitted`). The fit minimises the largest error over all angles. Colours are linear. A star marks what no other form of the same material beats in cost and error. `fresnel-gen --method fitted --material gold` writes the function with the coefficients in it, of least absolute error.\n\nWeights: relative is |f - F| / F. luminance fits red and blue separately, then green so that the error of luminance is least. delta-e weights each channel by its CIEDE2000 per unit at the true colour; the reported error is of all three channels."
)]
pub struct FitFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// Only forms with so many coefficients: 4 or 5
    #[arg(long, value_name = "N", value_parser = terms)]
    pub terms: Option<usize>,
    /// Without effect: all forms are shared by all materials
    #[arg(long, hide = true)]
    pub shared: bool,
    /// What is minimised, at its largest over all angles: absolute, relative, luminance or delta-e
    #[arg(long, value_name = "NAME", default_value = "absolute", value_parser = one_of("weight", Weight::ALL, Weight::name))]
    pub weight: Weight,
    /// Make the fit exact at 0 degrees, at 90, or at both; the report also gives the error without this constraint
    #[arg(long, value_delimiter = ',', value_name = "DEGREES", value_parser = one_of("end of the right angle", End::ALL, End::name))]
    pub exact: Vec<End>,
    /// Precision of the coefficients: f32, or f16, where the fit rounds them one after another so that each compensates for the others
    #[arg(long, value_name = "NAME", value_parser = precision(), conflicts_with_all = ["exact", "search"])]
    pub precision: Option<Precision>,
    /// Search over families of short forms. List those on the Pareto frontier of operations and error, and the error of a chosen form
    /// on a substance left out of the choice
    #[arg(long, conflicts_with_all = ["f0", "f82", "gamut"])]
    pub search: bool,
    /// In place of --material: reflectance at 0 degrees, three numbers from 0 to 1 (requires --f82)
    #[arg(long, value_name = "R,G,B", value_parser = colour, requires = "f82", conflicts_with_all = ["material", "medium", "ViewingFlags", "gamut"])]
    pub f0: Option<[f64; 3]>,
    /// Reflectance at 81.79 degrees (cos θ = 1/7; requires --f0)
    #[arg(long, value_name = "R,G,B", value_parser = colour, requires = "f0")]
    pub f82: Option<[f64; 3]>,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// Whose cost stands beside the error: rdna2, adreno330, malig72 ... as for `cost`
    #[arg(long, value_name = "NAME", default_value = "rdna2", value_parser = family())]
    pub gpu: &'static Family,
    /// How materials are looked at.
    #[command(flatten)]
    pub gamut: GamutFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl FitFlags {
    /// The command that reports this again under these viewing conditions, without places.
    pub fn command_line(&self, viewing: &ViewingConditions) -> CommandLine {
        let weight = (self.weight != Weight::default()).then_some(self.weight.name());
        CommandLine::new("fit")
            .switch("search", self.search)
            .list("material", self.materials.choices())
            .list("terms", self.terms)
            .list("weight", weight)
            .list("exact", self.exact.iter().map(|end| end.name()))
            .list("precision", self.precision.map(Precision::name))
            .list("f0", self.f0.iter().flatten())
            .list("f82", self.f82.iter().flatten())
            .list("medium", &self.medium.medium)
            .seen_as(viewing)
    }
}

/// An end of the right angle, where a fit can be exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// 0 degrees.
    Normal,
    /// 90 degrees.
    Grazing,
}

impl End {
    const ALL: [End; 2] = [End::Normal, End::Grazing];

    fn name(self) -> &'static str {
        match self {
            End::Normal => "0",
            End::Grazing => "90",
        }
    }
}

/// A number of coefficients that forms have.
fn terms(word: &str) -> Result<usize, &'static str> {
    let terms = word.parse().ok();
    let terms = terms.filter(|terms| [4, 5].contains(terms));
    terms.ok_or("no form has so many coefficients; there are forms with 4 or 5")
}
