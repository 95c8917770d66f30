//! The flags of `render`.

use std::path::PathBuf;

use clap::Args;

use crate::generator::command_line::{CommandLine, path_again};
use crate::pictures::scene::{self, RenderRow, TONE_CURVES, ToneCurve};

use crate::cli::args::choice::one_of;
use crate::cli::args::output::file_only;
use crate::cli::args::{MaterialName, ReportFlags};

/// The flags of `render`.
#[derive(Args, Debug)]
#[command(after_help = after_help())]
pub struct RenderFlags {
    /// Which effect: see below
    #[arg(value_name = "NAME", value_parser = one_of("picture", scene::ALL, |row: &RenderRow| row.name))]
    pub name: &'static RenderRow,
    /// Pixels a side of each panel, 16 to 2048
    #[arg(long, value_name = "PIXELS", default_value_t = 512)]
    pub size: u32,
    /// The picture: .png as it is shown, .exr as linear radiance [default: NAME.png]
    #[arg(short = 'o', value_name = "FILE", value_parser = file_only("-o"))]
    pub output: Option<PathBuf>,
    /// Brighter by so many stops, -16 to 16
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub exposure: f64,
    /// What keeps bright things apart: none, aces, reinhard
    #[arg(long, value_name = "NAME", default_value = "none", value_parser = one_of("tone curve", TONE_CURVES, |curve| curve.name))]
    pub tone_curve: ToneCurve,
    /// What the body is made of: a name, or the path of a material file [default: the picture's own]
    #[arg(long, value_name = "NAME", value_parser = MaterialName::parse)]
    pub material: Option<MaterialName>,
    /// What is around it: a picture twice as wide as high, HDR, EXR, PNG or JPEG [default: a sky of ours]
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,
    /// Draw with the environment clamped to white, as a picture of 8 bits is; the truth keeps its range
    #[arg(long)]
    pub ldr: bool,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl RenderFlags {
    /// Where the picture goes.
    pub fn file(&self) -> PathBuf {
        let usual = || PathBuf::from(format!("{}.png", self.name.name));
        self.output.clone().unwrap_or_else(usual)
    }

    /// The command that draws this again, without places of outputs.
    pub fn command_line(&self) -> CommandLine {
        let number = |value: f64| (value != 0.0).then_some(value);
        let curve = self.tone_curve.name;
        CommandLine::new("render")
            .argument(self.name.name)
            .number("size", self.size)
            .list("exposure", number(self.exposure))
            .list("tone-curve", (curve != "none").then_some(curve))
            .list("material", &self.material)
            .list(
                "environment",
                self.environment
                    .iter()
                    .map(|file| path_again(&file.to_string_lossy())),
            )
            .switch("ldr", self.ldr)
    }
}

fn after_help() -> String {
    let width = scene::ALL
        .iter()
        .map(|row| row.name.len())
        .max()
        .unwrap_or(0);
    let line = |row: &RenderRow| format!("  {:width$}  {}\n", row.name, row.summary);
    let names: String = scene::ALL.iter().map(line).collect();
    format!(
        "Names:\n{names}\nExamples:\n  fresnel-gen render double_refraction -o ball.png\n  fresnel-gen render double_refraction --material sf11 --size 256 --tone-curve aces --json -\n\nThe picture has three panels: what the effect draws, what a ray tracer in f64 sees, and their difference (CIEDE2000, 0 dark to 20 bright). Exit codes: 0 done, 2 wrong input, 3 something is missing here."
    )
}
