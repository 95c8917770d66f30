//! The rows of the report: what a file is, how to look it up, and the error of the lookup. Also the command of a bake, and its
//! errors.

use serde::Serialize;

use super::picture::Rounded;
use super::subject::TableMaterial;
use super::{BakeRequest, TableSize};
use crate::generator::command_line::CommandLine;
use crate::generator::emit::{self, Naming};
use crate::generator::fit::ModelError;
use crate::generator::lut::{self, Format, MOST_TERM, Picture, TERMS, TableAxis, term_range};
use crate::language::methods::{self, Method};
use crate::language::targets::Target;
use crate::physics::materials::ViewingConditions;
use crate::physics::spectra::Gamut;

/// The filtering weights for which errors are given.
pub const WEIGHTS: &str = "steps of 1/256, as GPUs filter";

/// A row of the report.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum BakeRow {
    /// A material in a file.
    Table(Box<TableRow>),
    /// A split-sum table in a file.
    SplitSum(Box<SplitSumRow>),
}

/// A material in a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableRow {
    material: String,
    medium: String,
    /// The format's name.
    pub format: &'static str,
    /// Texels in a row.
    pub texels: usize,
    /// The axis of cosines.
    pub axis: &'static str,
    /// The file's path.
    pub file: String,
    row: usize,
    rows: usize,
    /// value = texel × scale.
    pub scale: f64,
    /// The largest error of the filtered lookup.
    pub max_abs: f64,
    /// The mean relative error; none where a channel reflects nothing.
    pub mean_rel: Option<f64>,
    mean_abs: f64,
    worst_cos: f64,
    exact_weights: ExactWeights,
    depth: &'static str,
    bytes: usize,
    channels: &'static str,
    texel_centres: &'static str,
    lookup: TableLookup,
    /// The material's name, with the medium's.
    pub name: String,
    space: Option<&'static str>,
    gamut: &'static str,
    truth: String,
    extrapolated: Option<String>,
    weights: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// The errors with exact filtering weights.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct ExactWeights {
    max_abs: f64,
    mean_rel: Option<f64>,
    mean_abs: f64,
    worst_cos: f64,
}

/// How a table is looked up.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct TableLookup {
    c: &'static str,
    w: &'static str,
    u: String,
    v: &'static str,
    wrap: &'static str,
    filter: &'static str,
    level: u32,
    warp: Option<f64>,
    functions: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// A split-sum table in a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SplitSumRow {
    pub(super) material: Option<&'static str>,
    pub(super) medium: Option<&'static str>,
    pub(super) reason: &'static str,
    /// The table's name.
    pub name: String,
    pub(super) method: &'static str,
    pub(super) formula: &'static [&'static str],
    /// The meaning of the channels: `terms`, or an engine's name.
    pub(super) layout: &'static str,
    /// The format's name.
    pub format: &'static str,
    /// Texels in a row.
    pub texels: usize,
    pub(super) rows: usize,
    /// The axes of cosines and roughness: two names with a comma between.
    pub axis: String,
    /// The file's path.
    pub file: String,
    /// The file of the fourth term, if that has its own.
    pub(super) second_file: Option<String>,
    /// value = texel × scale.
    pub scale: f64,
    /// The largest error of a term's filtered lookup.
    pub max_abs: f64,
    /// Always none: no mean is taken over angles.
    pub mean_rel: Option<f64>,
    pub(super) term_max_abs: Vec<f64>,
    pub(super) weights: &'static str,
    pub(super) exact_weights: ExactTermWeights,
    pub(super) least_roughness: f64,
    pub(super) depth: &'static str,
    pub(super) bytes: usize,
    pub(super) channels: &'static str,
    /// The factors of the terms, as formulas of the method's inputs.
    pub(super) numbers: Vec<&'static str>,
    pub(super) averages: Vec<f64>,
    pub(super) albedo: String,
    pub(super) alpha: &'static str,
    pub(super) distribution: &'static str,
    pub(super) lookup: SplitSumLookup,
}

/// The errors of terms with exact filtering weights.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactTermWeights {
    pub(super) max_abs: f64,
    pub(super) term_max_abs: Vec<f64>,
}

/// How a split-sum table is looked up.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SplitSumLookup {
    pub(super) u: String,
    pub(super) v: String,
    pub(super) wrap: &'static str,
    pub(super) filter: &'static str,
    pub(super) level: u32,
    pub(super) functions: Vec<String>,
}

/// One row for each material of a picture in this file, with the functions that read it.
pub fn table_rows<'a>(
    subjects: &'a [TableMaterial],
    rounded: &'a Rounded,
    picture: &'a Picture,
    (format, file): (Format, &'a str),
    functions: &'a [String],
) -> impl Iterator<Item = TableRow> + 'a {
    let all = subjects.iter().zip(&rounded.errors).enumerate();
    all.map(move |(row, (subject, [steps, exact]))| {
        let surface = &subject.reference.surface;
        TableRow {
            material: subject.argument.clone(),
            medium: subject.medium.clone().unwrap_or_else(|| "air".to_owned()),
            format: format.name(),
            texels: picture.width,
            axis: picture.axis.name(),
            file: file.to_owned(),
            row,
            rows: picture.height(),
            scale: f64::from(picture.scale),
            max_abs: steps.max_abs,
            mean_rel: steps.mean_rel,
            mean_abs: steps.mean_abs,
            worst_cos: steps.worst_cos,
            exact_weights: ExactWeights::new(exact),
            depth: picture.depth.name(),
            bytes: picture.width * picture.depth.bytes(),
            channels: "linear red, green, blue",
            texel_centres: "the first at cos_theta = 0, the last at 1",
            lookup: TableLookup::new(picture, functions),
            name: subject.name.clone(),
            space: subject.space.map(|space| space.name()),
            gamut: surface.gamut.name(),
            truth: surface.seen.clone(),
            extrapolated: surface.extrapolation(),
            weights: WEIGHTS,
            reason: steps.mean_rel.is_none().then_some(
                "a channel reflects nothing at some angle, so that no relative error can be taken there",
            ),
        }
    })
}

impl ExactWeights {
    fn new(error: &ModelError) -> ExactWeights {
        ExactWeights {
            max_abs: error.max_abs,
            mean_rel: error.mean_rel,
            mean_abs: error.mean_abs,
            worst_cos: error.worst_cos,
        }
    }
}

impl TableLookup {
    fn new(picture: &Picture, functions: &[String]) -> TableLookup {
        let (scale, offset) = TableAxis::half_texel(picture.width);
        let warp = picture.axis.constant();
        TableLookup {
            c: "clamp(cos_theta, 0.0, 1.0)",
            w: picture.axis.formula(),
            u: format!("w * {scale:?} + {offset:?}"),
            v: "(row + 0.5) / rows",
            wrap: "clamp to edge",
            filter: "linear",
            level: 0,
            warp,
            functions: functions.to_vec(),
            reason: warp.is_none().then_some(
                "the library's fresnel_table warps by (1 + warp) c / (1 + warp c), and this axis is no such: take the functions of --target",
            ),
        }
    }
}

/// The errors of all rows in one line, for the file's own description.
pub fn error_line(errors: &[[ModelError; 2]]) -> String {
    let all = errors.iter().map(|[steps, _]| steps);
    let most = |value: fn(&ModelError) -> f64| all.clone().map(value).fold(0.0, f64::max);
    format!(
        "Error of the filtered lookup, weights in steps of 1/256: at most {:.6}; in the mean over angles at most {:.4} %.",
        most(|error| error.max_abs),
        100.0 * most(|error| error.mean_rel.unwrap_or(0.0))
    )
}

/// The arguments that name the materials on the command line.
pub fn material_words(subjects: &[TableMaterial]) -> Vec<String> {
    subjects.iter().map(|one| one.argument.clone()).collect()
}

/// The flags of the medium and the viewing conditions, each with a space before it.
pub fn viewing_flags(subjects: &[TableMaterial], viewing: &ViewingConditions) -> String {
    let medium = subjects.first().and_then(|subject| subject.medium.as_ref());
    // Tables keep colours outside the space by default; functions clip them.
    let clips = viewing.gamut == Gamut::Clip && viewing.wavelengths_nm.is_none();
    CommandLine::new("")
        .list("medium", medium)
        .seen_as(viewing)
        .list("gamut", clips.then_some(Gamut::Clip.name()))
        .into()
}

impl BakeRequest {
    /// The command that reports this again, without the output path.
    pub fn command_line(&self) -> CommandLine {
        let command = CommandLine::new("bake")
            .list("material", &self.typed)
            .with(&self.flags);
        let command = match &self.shape {
            TableSize::Fixed { axis, texels } => {
                command.list("size", [texels]).list("axis", [axis.name()])
            }
            TableSize::Within { budget, axes } => {
                let only = axes.first().filter(|_| axes.len() == 1);
                command
                    .number("budget", format_args!("{budget:?}"))
                    .list("axis", only.map(|axis| axis.name()))
            }
        };
        let command = command
            .list("format", self.formats.iter().map(|format| format.name()))
            .switch("atlas", self.atlas);
        with_functions(command, &self.targets, &self.prefix)
    }
}

/// The same command, with the functions beside the tables.
pub fn with_functions(
    command: CommandLine,
    targets: &[&'static Target],
    prefix: &str,
) -> CommandLine {
    if targets.is_empty() {
        return command;
    }
    command
        .list("target", targets.iter().map(|target| target.name))
        .list("prefix", Naming::flag_of_prefix(prefix))
}

/// An error of baking.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A table cannot be made.
    #[error(transparent)]
    Table(#[from] lut::Error),
    /// A language refuses the function that reads a table.
    #[error(transparent)]
    Function(#[from] emit::Error),
    /// A split-sum table of a method that is not affine in numbers of the material.
    #[error(
        "--dfg takes a method that is affine in numbers of a material ({}), and `{method}` is none",
        affine_methods()
    )]
    NotAffine {
        /// The method.
        method: &'static str,
    },
    /// An engine's table with a method that the engine does not use.
    #[error(
        "--layout {layout} holds the terms of schlick, and not of `{method}`: leave --method out"
    )]
    EnginesMethod {
        /// The layout.
        layout: &'static str,
        /// The method.
        method: &'static str,
    },
    /// Terms below 0 or above 1 in an integer format.
    #[error(
        "the terms of `{method}` lie beyond 0 to 1, which {format} does not hold: take exr-half, exr-float, ktx2, c, rust or js"
    )]
    Integers {
        /// The method.
        method: &'static str,
        /// The format.
        format: &'static str,
    },
}

/// The methods that have a split-sum table.
pub fn split_sum_methods() -> Vec<&'static str> {
    let has_table = |method: &&Method| {
        let basis = method.basis();
        basis.is_some_and(|basis| basis.terms() <= TERMS && term_range(&basis)[1] <= MOST_TERM)
    };
    let all = methods::ALL.iter().copied().filter(has_table);
    all.map(|method| method.name).collect()
}

fn affine_methods() -> String {
    split_sum_methods().join(", ")
}
