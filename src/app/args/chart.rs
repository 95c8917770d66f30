//! The flags of `chart`.

use std::path::PathBuf;

use clap::Args;

use crate::emit::CommandLine;

/// The flags of charts.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen chart --out-dir charts\n  fresnel-gen chart --material gold --gpu adreno330 --error de2000\n  fresnel-gen chart --show dielectrics --of worst --gpu time --json -\n\nCosts are those of library functions, one evaluation, as recorded; `fresnel-gen cost` tells and checks them. Each published method stands twice: with the inputs that its authors meant, and with those whose largest error is least. Into the folder go chart.svg, the picture of what is shown, and chart.html, a page with all of them to choose from."
)]
pub struct ChartFlags {
    /// Materials on the page: names, paths of material files, all [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub material: Vec<String>,
    /// What is shown: metals (and semiconductors), dielectrics, or a material [default: the first of these that there is]
    #[arg(long, value_name = "NAME")]
    pub show: Option<String>,
    /// How a class is taken together: median, p90, worst, substances (the median, each substance one vote)
    #[arg(long, value_name = "NAME", default_value = "median")]
    pub of: String,
    /// Whose cost: operations, gcn4, rdna1, rdna2, rdna3, adreno330, malig72 ... or time, on the device of the record
    #[arg(long, value_name = "NAME", default_value = "rdna2")]
    pub gpu: String,
    /// Which error: max, mean-rel (as the thesis measures), luminance, de2000
    #[arg(long, value_name = "NAME", default_value = "max")]
    pub error: String,
    /// Write chart.svg and chart.html into this folder
    #[arg(long, value_name = "DIR")]
    pub out_dir: Option<PathBuf>,
    /// Also replace files that fresnel-gen did not write
    #[arg(long, requires = "out_dir")]
    pub overwrite: bool,
    /// Write the report as JSON to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

impl ChartFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        let unless =
            |value: &String, usual: &str| Some(value.clone()).filter(|value| value != usual);
        CommandLine::new("chart")
            .list("material", &self.material)
            .list("show", &self.show)
            .list("of", unless(&self.of, "median"))
            .list("gpu", unless(&self.gpu, "rdna2"))
            .list("error", unless(&self.error, "max"))
    }
}
