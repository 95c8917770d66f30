//! `plan`: chooses for each material of a scene the cheapest function whose error is not visible.

use std::path::PathBuf;

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::choice::{Choice, family, in_any_case, method_or_all, one_of, precision};
use crate::cli::flags::output::{PictureFlags, ReportFlags, file_only};
use crate::cli::output::{Output, Progress, report_beside};
use crate::cli::places::{refuse_read, try_places};
use crate::cli::plan_input::{PlanInput, plan_input};
use crate::cli::scene_error::size;
use crate::generator::command_line::{CommandLine, path_again};
use crate::generator::error::RequestFault;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::request::source::comma_list;
use crate::lab::cost::{self, Family, GpuCompiler};
use crate::language::methods::{self, Method};
use crate::physics::materials::ViewingConditions;
use crate::physics::num::Precision;
use crate::physics::spectra::Space;
use crate::pictures::plan::{
    FramePixels, JudgedMaterial, Metric, PlanFault, PlanReport, PlanRequest, PlanTruth,
    material_view, plan, plan_page, prove,
};
use crate::pictures::scene::{Display, TONE_CURVES, ToneCurve};

/// Frames of a renderer, from one word that lists them.
#[derive(Clone, Debug)]
pub struct Frames(Vec<PathBuf>);

/// Parses a word of `--gbuffer`.
fn frames(list: &str) -> Result<Frames, String> {
    let words = comma_list(list).into_iter();
    let files = words.map(|word| file_only("--gbuffer")(&word));
    files.collect::<Result<_, _>>().map(Frames)
}

/// The flags of `plan`.
#[derive(Args, Debug)]
#[command(
    mut_arg("out_dir", |arg| arg.help("Write a page with angles, errors, pictures and reasons as plan.html into this folder")),
    after_help = "Examples:\n  fresnel-gen plan data/scenes/gold_dim.toml\n  fresnel-gen plan scene.glb --budget 0.5 --gpu adreno330 --json plan.json\n  fresnel-gen plan --gbuffer frame1.exr,frame2.exr --materials ids.toml --json plan.json\n\nFor each material: the cheapest function whose error in the scene's pictures is within the budget. The error is the difference that 99.9 % of the material's pixels do not exceed, in the frame where it is worst. Exit codes: 0 done; 1 a material has nothing within the budget, and gets the function that errs least; 2 wrong input; 3 with --prove: there is no graphics stack here. `fresnel-gen --plan plan.json` writes the functions of a plan."
)]
pub struct PlanFlags {
    /// The scene: .toml, .glb or .gltf
    #[arg(value_name = "SCENE", required_unless_present = "gbuffer", conflicts_with_all = ["gbuffer", "materials"])]
    pub scene: Option<PathBuf>,
    /// In place of a scene frames of your own renderer: EXR files with cos_theta, material_id, light and more
    #[arg(long, num_args = 1.., value_name = "FILE", requires = "materials", value_parser = frames)]
    pub gbuffer: Vec<Frames>,
    /// Which id of the frames is which material: a TOML file
    #[arg(long, value_name = "FILE", requires = "gbuffer", value_parser = file_only("--materials"))]
    pub materials: Option<PathBuf>,
    /// What is around a glTF scene: a picture twice as wide as high, HDR, EXR, PNG or JPEG [default: white]
    #[arg(long, value_name = "FILE", value_parser = file_only("--environment"), conflicts_with = "gbuffer")]
    pub environment: Option<PathBuf>,
    /// Pixels across and down of a glTF scene's frames, each 16 to 2048 [default: 640x480]
    #[arg(long, value_name = "WxH", value_parser = size, conflicts_with = "gbuffer")]
    pub size: Option<[u32; 2]>,
    /// A file that the scene may name though it lies outside of the scene's folder, or a folder of such files
    #[arg(long, value_name = "PATH")]
    pub allow: Vec<PathBuf>,
    /// The largest error [default: 1; .0039 with --metric linear]
    #[arg(long, value_name = "ERR", allow_negative_numbers = true)]
    pub budget: Option<f64>,
    /// What errors are measured by: de2000, code8 (8-bit codes of sRGB), itp (high dynamic range), linear
    #[arg(long, value_name = "NAME", default_value = "de2000", value_parser = one_of("metric", Metric::ALL, Metric::name))]
    pub metric: Metric,
    /// Brighter by so many stops, -16 to 16 [default: the scene's]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    /// What keeps bright things apart: none, aces, reinhard [default: the scene's]
    #[arg(long, value_name = "NAME", value_parser = one_of("tone curve", TONE_CURVES, |curve| curve.name))]
    pub tone_curve: Option<ToneCurve>,
    /// Also up to so many stops darker and brighter, 0 to 8: the worst counts
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "STOPS",
        default_value_t = 0.0
    )]
    pub exposure_range: f64,
    /// A material that no frame shows on so many pixels is held to the budget at every angle
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "PIXELS",
        default_value_t = 100
    )]
    pub min_pixels: usize,
    /// What functions are held against: spectrum (the exact law at each wavelength), exact (one index a channel)
    #[arg(long, value_name = "NAME", default_value = "spectrum", value_parser = one_of("reference", PlanTruth::ALL, PlanTruth::name))]
    pub reference: PlanTruth,
    /// The GPUs whose recorded costs decide, see `cost` [default: rdna2]
    #[arg(long, value_name = "NAME", value_parser = family())]
    pub gpu: Option<&'static Family>,
    /// What functions compute in: f32, f16 [default: f32]
    #[arg(long, value_name = "NAME", value_parser = precision())]
    pub precision: Option<Precision>,
    /// Functions of 3 channels, or also of 1, with the green channel's values for all: 1,3
    #[arg(long, value_delimiter = ',', value_name = "N", default_value = "3", value_parser = clap::builder::PossibleValuesParser::new(["1", "3"]))]
    pub channels: Vec<String>,
    /// Methods among which it chooses, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// What a texture fetch costs, in units of the cost: with it tables are taken too
    #[arg(long, allow_negative_numbers = true, value_name = "UNITS")]
    pub fetch_cost: Option<f64>,
    /// What another function in the shaders costs, in units × pixels: with it materials share library functions
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "UNITS",
        default_value_t = 0.0
    )]
    pub variant_cost: f64,
    /// Working space of the pictures: srgb, p3, rec2020, acescg; all linear [default: srgb]
    #[arg(long, value_name = "NAME", value_parser = in_any_case(one_of("space", Space::ALL, Space::name)))]
    pub space: Option<Space>,
    /// Also run the chosen functions' text on this machine's graphics stack, and hold the pictures of it to the budget
    #[arg(long)]
    pub prove: bool,
    /// The folder of the page.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl PlanFlags {
    /// The files that it reads.
    pub fn inputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.scene
            .iter()
            .chain(&self.environment)
            .chain(self.frames())
            .chain(&self.materials)
    }

    /// The frames of a renderer.
    pub fn frames(&self) -> impl Iterator<Item = &PathBuf> {
        self.gbuffer.iter().flat_map(|frames| &frames.0)
    }

    /// The largest error.
    pub fn budget(&self) -> f64 {
        self.budget.unwrap_or(self.metric.usual_budget())
    }

    /// The command that makes this plan again, without the paths of outputs.
    pub fn command_line(&self) -> CommandLine {
        let again = |file: &PathBuf| path_again(&file.to_string_lossy());
        let above_0 = |value: f64| (value != 0.0).then_some(value);
        let command = CommandLine::new("plan");
        let command = match &self.scene {
            Some(scene) => command.argument(&again(scene)),
            None => command,
        };
        command
            .list("gbuffer", self.frames().map(again))
            .list("materials", self.materials.iter().map(again))
            .list("environment", self.environment.iter().map(again))
            .list("allow", self.allow.iter().map(again))
            .list(
                "size",
                self.size.map(|[width, height]| format!("{width}x{height}")),
            )
            .list("budget", self.budget)
            .list(
                "metric",
                (self.metric != Metric::De2000).then_some(self.metric.name()),
            )
            .list("exposure", self.exposure)
            .list("tone-curve", self.tone_curve.map(|curve| curve.name))
            .list("exposure-range", above_0(self.exposure_range))
            .list(
                "min-pixels",
                (self.min_pixels != 100).then_some(self.min_pixels),
            )
            .list(
                "reference",
                (self.reference != PlanTruth::Spectrum).then_some(self.reference.name()),
            )
            .list("gpu", self.gpu.map(|family| family.name))
            .list("precision", self.precision.map(Precision::name))
            .list(
                "channels",
                Some(self.channels.join(",")).filter(|word| word != "3"),
            )
            .list("method", &self.method)
            .list("fetch-cost", self.fetch_cost)
            .list("variant-cost", above_0(self.variant_cost))
            .list("space", self.space.map(Space::name))
            .switch("prove", self.prove)
    }
}

/// The GPU family whose costs decide where none is named.
const USUAL_GPU: &str = "rdna2";

/// The page's name in its folder.
const PAGE: &str = "plan.html";

/// Reads the scene, judges the candidates, and chooses.
pub fn run(flags: &PlanFlags, progress: Progress) -> Result<Output, Error> {
    check(flags)?;
    let page = flags.pictures.folder().map(|folder| folder.join(PAGE));
    try_places(flags.report.json(), page.as_deref())?;
    try_places_of_ours(page.as_slice(), flags.pictures.overwrite)?;
    let viewing = viewing(flags);
    let PlanInput {
        materials,
        unplanned,
        remarks,
        read,
        nothing_is_seen,
        display,
        frames,
        mut frame,
    } = plan_input(flags, &viewing)?;
    let outputs = flags.report.json().into_iter().chain(page.as_deref());
    refuse_read(read.iter().map(PathBuf::as_path), outputs)?;
    let request = request(flags, &viewing, display)?;
    let judged = plan(
        &request,
        materials,
        frames,
        &mut *frame,
        &mut |done, whole| {
            progress(done, whole, "frames");
        },
    )
    .map_err(fault)?;
    if judged.iter().all(|material| material.pixels == 0) {
        return Err(Error::usage(nothing_is_seen));
    }
    let proofs = if flags.prove {
        prove(&request, &judged, &mut *frame, &mut |done, whole| {
            progress(done, whole, "functions");
        })
        .map_err(fault)?
    } else {
        (None, Vec::new())
    };
    let command: String = flags.command_line().into();
    let said_of_scene = (unplanned, remarks);
    let made = PlanReport::new(command, &request, &judged, frames, said_of_scene, proofs);
    let page = page.map(|page| paged(flags, &request, &judged, &made, &mut *frame, page));
    let page = page.transpose()?;
    let said = page.as_ref().map(|page| {
        format!(
            "{}: angles, errors, pictures and reasons",
            crate::physics::foreign::path(page.path())
        )
    });
    let files = page.into_iter().collect();
    let mut output = report_beside(made.text(), &made, flags.report.json(), files)?;
    output.remarks.extend(said);
    output.code = made.exit_code();
    Ok(output)
}

/// The page as a file to be written, with pictures of the frames where functions are worst.
fn paged(
    flags: &PlanFlags,
    request: &PlanRequest,
    judged: &[JudgedMaterial],
    made: &PlanReport,
    frame: &mut dyn FnMut(usize) -> Result<FramePixels, Error>,
    page: PathBuf,
) -> Result<OutputFile, Error> {
    let mut views = Vec::new();
    for (i, material) in judged.iter().enumerate() {
        let frame = frame(material.chosen().worst_frame)?;
        let view = material_view(request, material, &frame.of_material[i], frame.size[0]);
        views.push(view.map_err(Error::usage)?);
    }
    let text = plan_page(made, &views).map_err(Error::usage)?;
    Ok(OutputFile::of_report(page, text, flags.pictures.overwrite))
}

fn check(flags: &PlanFlags) -> Result<(), Error> {
    let numbers = [
        ("budget", Some(flags.budget()), 0.0..=1e6),
        ("exposure", flags.exposure, -16.0..=16.0),
        ("exposure-range", Some(flags.exposure_range), 0.0..=8.0),
        ("fetch-cost", flags.fetch_cost, 0.0..=1e6),
        ("variant-cost", Some(flags.variant_cost), 0.0..=1e15),
    ];
    for (flag, value, range) in numbers {
        let beyond = value.filter(|value| !range.contains(value));
        if let Some(value) = beyond {
            let allowed = format!("is {} to {}", range.start(), range.end());
            let value = value.to_string();
            return Err(RequestFault::OutOfRange {
                flag,
                value,
                allowed,
            }
            .into());
        }
    }
    Ok(())
}

fn viewing(flags: &PlanFlags) -> ViewingConditions {
    let mut viewing = ViewingConditions::default();
    viewing.integration.space = flags.space.unwrap_or_default();
    viewing
}

/// The settings from the flags; what they leave open, the scene states.
fn request(
    flags: &PlanFlags,
    viewing: &ViewingConditions,
    display: Display,
) -> Result<PlanRequest, Error> {
    let methods = if flags.method.is_empty() {
        methods::ALL.to_vec()
    } else {
        Choice::methods(&flags.method)
    };
    Ok(PlanRequest {
        budget: flags.budget(),
        metric: flags.metric,
        display: Display {
            exposure: flags.exposure.unwrap_or(display.exposure),
            curve: flags.tone_curve.unwrap_or(display.curve),
        },
        space: viewing.integration.space,
        exposure_range: flags.exposure_range,
        min_pixels: flags.min_pixels,
        truth: flags.reference,
        family: family_of(flags)?,
        precision: flags.precision.unwrap_or_default(),
        channels: flags
            .channels
            .iter()
            .filter_map(|word| word.parse().ok())
            .collect(),
        methods,
        fetch: flags.fetch_cost,
        price: flags.variant_cost,
    })
}

fn family_of(flags: &PlanFlags) -> Result<&'static Family, Error> {
    let usual = || cost::find(USUAL_GPU).expect("a test names it");
    let family = flags.gpu.unwrap_or_else(usual);
    if let GpuCompiler::None(reason) = family.compiler {
        let gpu = family.name;
        return Err(crate::lab::budget::Error::NoCosts { gpu, reason }.into());
    }
    Ok(family)
}

fn fault(fault: PlanFault<Error>) -> Error {
    match fault {
        PlanFault::Frame(error) => error,
        PlanFault::Function(error) => error.into(),
        PlanFault::NoCost { .. } => Error::usage(fault.to_string()),
    }
}
