//! The program: one file for each command, with its flags, what it does, and its text.
//!
//! [`run`] takes the parsed command line and returns an [`Output`]. Only `main.rs` prints it.
//! A command computes nothing. What it shows comes from the wings below as typed rows, which it prints as text or as JSON.
//! Flags shared by several commands stand in `flags`, rules for output places in `places.rs`, exit codes in `error.rs`.
//! It imports all wings, and is left out without the feature `cli`.
//! Start with [`Command`], which lists the commands, and open the file of the command that you look for.

mod audit;
mod bake;
mod chart;
mod clean;
mod compare_engine;
mod compare_materials;
mod completions;
mod cost;
mod error;
mod first_help;
mod fit;
mod flags;
mod gallery;
mod generate;
mod import;
mod junit;
mod lists;
mod materials;
mod merge;
mod method_remarks;
mod output;
mod params;
mod places;
mod plan;
mod plan_file;
mod plan_input;
mod reflectance;
mod render;
mod reproduce;
mod scene_error;
mod search;
mod stability;
mod survey;
mod time;
mod verify;

use std::path::{Path, PathBuf};

use clap::{Parser, Subcommand};

use crate::cli::flags::groups;
use crate::cli::flags::material::MaterialName;
use crate::cli::flags::named::NamedFiles;
use crate::cli::materials::MaterialsCommand;
use crate::cli::places::refuse_clashes;
use crate::generator::output::lock::Announce;
use crate::generator::request::source;
use crate::language::effects::Effect;
use crate::language::methods::Method;
use crate::language::targets::Target;
use crate::physics::foreign;
use crate::physics::materials::page;

pub use completions::completions;
pub use error::Error;
pub use first_help::first_help;
pub use flags::renamed::with_names_of_today;
pub use output::{Output, Progress, legible};

/// The end of the help of the program and of `generate`.
const EXAMPLES: &str = "Examples:\n  fresnel-gen --target gles\n  fresnel-gen --material gold --method conductor_exact --target hlsl -o -\n  fresnel-gen --material my_metal.toml --target wgsl --out-dir shaders\n  fresnel-gen --material gold --budget 0.002 --gpu adreno330 -o -\n  fresnel-gen --check\n\nExit codes: 0 done; 1 findings (--check found a difference); 2 usage or input error; 3 a check could not be made on this machine (a driver or a compiler is missing, or failed).";

/// Turns measured optical constants into Fresnel reflectance functions that a shader can afford.
///
/// Without a subcommand, flags are those of `generate`: it writes shaders for every target, method and material asked for.
#[derive(Debug, Parser)]
#[command(
    name = "fresnel-gen",
    version,
    args_conflicts_with_subcommands = true,
    mut_args(groups::in_group),
    mut_subcommands(groups::with_groups),
    after_help = EXAMPLES
)]
pub struct Cli {
    /// What to do; generation where nothing is named.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The flags of generation.
    #[command(flatten)]
    pub generate: generate::GenerateFlags,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write shaders: the same as flags without a subcommand
    #[command(after_help = EXAMPLES)]
    Generate(Box<generate::GenerateFlags>),
    /// List the methods, or show one with formula, source, domain and promised errors
    #[command(after_help = "Example:\n  fresnel-gen methods show schlick_corrected")]
    Methods(lists::ListFlags<Method>),
    /// List the materials, show one, compute its parameters, import more
    #[command(
        after_help = "Examples:\n  fresnel-gen materials list --class metal\n  fresnel-gen materials params gold --space acescg --json -\n  fresnel-gen materials show gold --svg gold.svg\n  fresnel-gen materials compare silver silver_babar --png silver.png\n  fresnel-gen materials import main/Au/nk/Johnson.yml --name my_gold -o my_gold.toml"
    )]
    Materials(Box<materials::MaterialsFlags>),
    /// List the effects, or show one with its functions, their arguments, and where it must be wrong
    #[command(after_help = "Example:\n  fresnel-gen effects show interior")]
    Effects(lists::ListFlags<Effect>),
    /// List the targets, or show one with its validators
    #[command(after_help = "Example:\n  fresnel-gen targets show gles")]
    Targets(lists::ListFlags<Target>),
    /// Bake reflectance into lookup tables: EXR, PNG, KTX2, arrays, with the error of the filtered lookup
    #[command(
        after_help = "Examples:\n  fresnel-gen bake --material gold --format exr-half,ktx2 --target wgsl\n  fresnel-gen bake --material all --atlas --budget 0.001 --json -\n  fresnel-gen bake --dfg --method fitted --format exr-half"
    )]
    Bake(Box<bake::BakeFlags>),
    /// Run the generated functions of every target and compare the results with f64 on the CPU
    Verify(Box<verify::VerifyFlags>),
    /// Put the reports of the shards of one `verify` together, as the report of a whole run
    Merge(merge::MergeFlags),
    /// Show where methods fail: regions of NaN, of lost digits, and of large error against the exact law
    Stability(stability::StabilityFlags),
    /// Show what functions cost, by Mesa's GPU compilers; recorded figures replace a missing compiler
    Cost(Box<cost::CostFlags>),
    /// Measure the time of functions on this machine's device, by overdraw, and as a share of the exact law's time
    Time(time::TimeFlags),
    /// Fit coefficients: of materials, or of an artist's two colours
    Fit(Box<fit::FitFlags>),
    /// Chart error against cost: one point per method, and the Pareto frontier
    Chart(chart::ChartFlags),
    /// Measure your own function (WGSL, GLSL, HLSL or Slang) against a material's exact reflectance and compare it with our methods
    Audit(Box<audit::AuditFlags>),
    /// Recompute the tables, figures and claims of the thesis (Štetić-Kozić 2014) and print both side by side
    Reproduce(reproduce::ReproduceFlags),
    /// Draw an effect with the functions that engines import, beside what a ray tracer sees, and state the difference
    Render(render::RenderFlags),
    /// Show what an engine makes of materials: as it ships, with F82-tint, with these functions, and what is true
    Compare(compare_engine::CompareEngineFlags),
    /// Measure the error of methods in pictures of an object: of the angles that a camera sees
    SceneError(Box<scene_error::SceneErrorFlags>),
    /// Choose for each material of a scene the cheapest function whose error nobody sees in its pictures
    Plan(Box<plan::PlanFlags>),
    /// Write a page that draws every effect live, beside the exact law, with the functions to copy
    Gallery(gallery::GalleryFlags),
    /// Remove what fresnel-gen wrote into a folder, and nothing else
    Clean(clean::CleanFlags),
    /// Write a completion script for a shell to stdout
    #[command(
        after_help = "Examples:\n  fresnel-gen completions bash > ~/.local/share/bash-completion/completions/fresnel-gen\n  fresnel-gen completions fish > ~/.config/fish/completions/fresnel-gen.fish"
    )]
    Completions(completions::CompletionsFlags),
}

impl Cli {
    /// The files that it names.
    pub fn named_files(&self) -> NamedFiles<'_> {
        let mut named = NamedFiles::default();
        let Some(command) = &self.command else {
            named.generation(&self.generate);
            return named;
        };
        match command {
            Command::Generate(flags) => named.generation(flags),
            Command::Clean(_) | Command::Completions(_) => {}
            Command::Methods(flags) => named.write(&flags.report.json),
            Command::Effects(flags) => named.write(&flags.report.json),
            Command::Targets(flags) => named.write(&flags.report.json),
            Command::Materials(flags) => named.materials(flags),
            Command::Bake(flags) => {
                named.seen(&flags.materials, &flags.medium, &flags.viewing.viewing);
                named.write(&flags.report.json);
            }
            Command::Verify(flags) => {
                named.seen(&flags.materials, &flags.medium, &flags.viewing.viewing);
                named.write(flags.report.files());
            }
            Command::Merge(flags) => named.merge(flags),
            Command::Audit(flags) => {
                named.inputs.extend(flags.file.iter().map(Path::new));
                named.seen(&flags.materials, &flags.medium, &flags.viewing.viewing);
                named.write(flags.report.files());
            }
            Command::Fit(flags) => {
                named.seen(&flags.materials, &flags.medium, &flags.gamut.viewing);
                named.write(&flags.report.json);
            }
            Command::Cost(flags) => named.report(&flags.materials, &flags.report),
            Command::Time(flags) => named.report(&flags.materials, &flags.report),
            Command::Chart(flags) => named.report(&flags.materials, &flags.report),
            Command::Stability(flags) => named.report(&flags.materials, &flags.report),
            Command::Reproduce(flags) => named.write(&flags.report.json),
            Command::Gallery(flags) => named.inputs.extend(flags.materials.paths().map(Path::new)),
            Command::Render(flags) => {
                let material = flags.material.iter().filter_map(MaterialName::path);
                let material = material.chain(flags.films.paths());
                named.inputs.extend(material.map(Path::new));
                named.inputs.extend(flags.environment.as_deref());
                named.write(flags.report.json.iter().chain(&flags.output));
            }
            Command::Compare(flags) => {
                named.inputs.extend(flags.inputs());
                named.write(flags.report.json.iter().chain(&flags.output));
            }
            Command::Plan(flags) => {
                named.inputs.extend(flags.inputs().map(PathBuf::as_path));
                named.write(&flags.report.json);
            }
            Command::SceneError(flags) => {
                named.inputs.extend(flags.mesh.as_deref());
                named.seen(&flags.materials, &flags.medium, &flags.viewing.viewing);
                named.write(&flags.report.json);
            }
        }
        named
    }
}

/// Runs the command line.
///
/// `progress` gets the progress of long work; `announce` gets what a person should know before the run ends.
///
/// # Errors
/// Flags contradict each other or name something that does not exist, a file cannot be read or written, or something needed is
/// missing.
pub fn run(cli: &Cli, progress: Progress, announce: Announce) -> Result<Output, Error> {
    let named = cli.named_files();
    refuse_clashes(&named)?;
    let mut output = run_command(cli, progress, announce)?;
    output.remarks.extend(unit_remarks(cli, &named));
    Ok(output)
}

/// The unit of a table whose header names none. A command that shows the material's note says it there.
fn unit_remarks(cli: &Cli, named: &NamedFiles) -> Vec<String> {
    if let Some(Command::Materials(flags)) = &cli.command
        && matches!(
            flags.what,
            Some(MaterialsCommand::Show(_) | MaterialsCommand::Import(_))
        )
    {
        return Vec::new();
    }
    let remark = |file: &&Path| {
        let text = source::text(file).ok()?;
        let page = page(&file.to_string_lossy(), &text)?.ok()?;
        let remark = page.unit_remark()?;
        Some(format!("{}: {remark}", foreign::path(file)))
    };
    named.inputs.iter().filter_map(remark).collect()
}

fn run_command(cli: &Cli, progress: Progress, announce: Announce) -> Result<Output, Error> {
    match &cli.command {
        None => generate::run(&cli.generate, announce),
        Some(Command::Generate(flags)) => generate::run(flags, announce),
        Some(Command::Clean(flags)) => clean::run(flags, announce),
        Some(Command::Completions(flags)) => Ok(Output {
            stdout: completions(flags.shell).into_bytes(),
            is_file: true,
            ..Output::default()
        }),
        Some(Command::Methods(listing)) => lists::run(listing),
        Some(Command::Materials(listing)) => materials::run(listing, progress),
        Some(Command::Effects(listing)) => lists::run(listing),
        Some(Command::Targets(listing)) => lists::run(listing),
        Some(Command::Bake(flags)) => bake::run(flags, progress, announce),
        Some(Command::Verify(flags)) => verify::run(flags, progress),
        Some(Command::Merge(flags)) => merge::run(flags),
        Some(Command::Cost(flags)) => cost::run(flags, progress),
        Some(Command::Time(flags)) => time::run(flags, progress),
        Some(Command::Audit(flags)) => audit::run(flags, progress),
        Some(Command::Render(flags)) => render::run(flags, progress),
        Some(Command::Compare(flags)) => compare_engine::run(flags, progress),
        Some(Command::Chart(flags)) => chart::run(flags, progress),
        Some(Command::Fit(flags)) => fit::run(flags, progress),
        Some(Command::Gallery(flags)) => gallery::run(flags, progress),
        Some(Command::Stability(flags)) => stability::run(flags, progress),
        Some(Command::Reproduce(flags)) => reproduce::run(flags, progress),
        Some(Command::Plan(flags)) => plan::run(flags, progress),
        Some(Command::SceneError(flags)) => scene_error::run(flags, progress),
    }
}
