//! The flags of `stability`.

use clap::Args;

use crate::generator::command_line::CommandLine;
use crate::language::methods::{self, Method};
use crate::physics::num::Precision;

use crate::cli::args::choice::{Choice, one_or_all, precision};
use crate::cli::args::{MaterialFlags, PictureFlags, ReportFlags};

/// The flags of `stability`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Scan the functions specialised to these instead: names, paths of material files, or all")),
    mut_arg("out_dir", |arg| arg.help("Draw maps of the errors and a page that shows them into this folder").conflicts_with("material")),
    after_help = "Examples:\n  fresnel-gen stability\n  fresnel-gen stability --method schlick,conductor_textbook --out-dir stability\n  fresnel-gen stability --material gold --json -"
)]
pub struct StabilityFlags {
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = scanned_method)]
    pub method: Vec<Choice<&'static Method>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What functions compute in: f32, or f16, rounded after every operation [default: f32]
    #[arg(long, value_name = "NAME", value_parser = precision())]
    pub precision: Option<Precision>,
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl StabilityFlags {
    /// The command that reports this again, without places.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("stability")
            .list("method", &self.method)
            .list("material", self.materials.choices())
            .list("precision", self.precision.map(Precision::name))
    }
}

/// A method that is scanned. What reads a texture is as stable as its sampler.
fn scanned_method(word: &str) -> Result<Choice<&'static Method>, String> {
    if methods::find(word).is_some_and(Method::is_textured) {
        return Err(format!(
            "`{word}` reads a texture, and is as stable as its sampler: not scanned"
        ));
    }
    let scanned = methods::ALL.iter().filter(|method| !method.is_textured());
    let parse = one_or_all("method", scanned.copied(), |method| method.name);
    parse(word).map_err(|unknown| unknown.to_string())
}
