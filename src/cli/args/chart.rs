//! The flags of `chart`.

use clap::Args;

use crate::generator::command_line::CommandLine;
use crate::lab::chart::{ERRORS, ErrorAxis, STATISTICS, cost_names};
use crate::physics::names::UnknownName;

use crate::cli::args::choice::one_of;
use crate::cli::args::{MaterialFlags, PictureFlags, ReportFlags};

/// The flags of charts.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Materials on the page: names, paths of material files, all [default: all]")),
    mut_arg("out_dir", |arg| arg.help("Write chart.svg and chart.html into this folder")),
    after_help = "Examples:\n  fresnel-gen chart --out-dir charts\n  fresnel-gen chart --material gold --gpu adreno330 --error de2000\n  fresnel-gen chart --show dielectrics --of worst --gpu time --json -\n\nCosts are those of library functions, one evaluation, as recorded; `fresnel-gen cost` tells and checks them. Each method with inputs to choose stands twice: with those that it is meant to have, and with those whose largest error is least. Into the folder go chart.svg, the picture of what is shown, and chart.html, a page with all of them to choose from."
)]
pub struct ChartFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What is shown: metals, semiconductors, dielectrics, or a material [default: the first of these that there is]
    #[arg(long, value_name = "NAME")]
    pub show: Option<String>,
    /// How a class is taken together: median, p90, worst, substances (the median, each substance one vote)
    #[arg(long, value_name = "NAME", default_value = "median", value_parser = one_of("way of taking a class together", STATISTICS, |name| name))]
    pub of: &'static str,
    /// Whose cost: operations, gcn4, rdna1, rdna2, rdna3, adreno330, malig72 ... or time, on the device of the record
    #[arg(long, value_name = "NAME", default_value = "rdna2", value_parser = cost)]
    pub gpu: &'static str,
    /// Which error: max, mean-rel (as the thesis measures), luminance, de2000
    #[arg(long, value_name = "NAME", default_value = "max", value_parser = one_of("error", ERRORS, |error| error.name))]
    pub error: ErrorAxis,
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl ChartFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        let unless = |usual: &'static str, name: &'static str| (name != usual).then_some(name);
        CommandLine::new("chart")
            .list("material", self.materials.choices())
            .list("show", &self.show)
            .list("of", unless("median", self.of))
            .list("gpu", unless("rdna2", self.gpu))
            .list("error", unless("max", self.error.name))
    }
}

/// The name of a cost that charts know. The records of costs are read only where it is asked for.
fn cost(word: &str) -> Result<&'static str, UnknownName> {
    one_of("cost", cost_names(), |name| name)(word)
}
