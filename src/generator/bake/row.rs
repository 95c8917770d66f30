//! What a bake gives: files in memory, and the rows of the report, which say what a file is, how to look it up, and the error of
//! the lookup.

use serde::Serialize;

use super::film_thickness::FilmTableError;
use super::request::{ATLAS, TableMaterial};
use crate::generator::fit::ModelError;
use crate::generator::lut::{Format, Picture, TableAxis};

/// A picture as files in memory, with their description.
#[derive(Clone, Debug, PartialEq)]
pub struct Baked {
    /// Its name, a material's or [`ATLAS`].
    pub name: String,
    /// The method of the files: `table`, or the method of a split-sum table.
    pub method: &'static str,
    /// The material, if the picture holds only one.
    pub material: Option<String>,
    /// The command that writes the files again.
    pub command: String,
    /// The files: path and bytes.
    pub files: Vec<(String, Vec<u8>)>,
    /// A row for each material and format.
    pub rows: Vec<BakeRow>,
}

impl Baked {
    /// The materials of an atlas, in the order of its rows; empty for other pictures.
    pub fn row_materials(&self) -> Vec<String> {
        let rows = self.rows.iter().filter_map(|row| match row {
            BakeRow::Table(row) if self.name == ATLAS => Some(row),
            _ => None,
        });
        // The report has a row for each format: those of the first file hold all materials.
        let first = rows.clone().next().map(|row| &row.file);
        rows.filter(|row| Some(&row.file) == first)
            .map(|row| row.name.clone())
            .collect()
    }
}

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
    /// A table by thickness in a file.
    Film(Box<FilmTableRow>),
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
    /// The files of further terms, where the first has no channels for them.
    pub(super) second_file: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) third_file: Option<String>,
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
    pub(super) channels: String,
    /// The factors of the terms, as formulas of the method's inputs.
    pub(super) numbers: Vec<String>,
    pub(super) averages: Vec<f64>,
    pub(super) albedo: String,
    pub(super) alpha: &'static str,
    pub(super) distribution: &'static str,
    pub(super) lookup: SplitSumLookup,
}

impl SplitSumRow {
    /// All files of its terms, with a comma between.
    pub fn files(&self) -> String {
        let more = self.second_file.iter().chain(&self.third_file);
        let all: Vec<&str> = [&self.file]
            .into_iter()
            .chain(more)
            .map(String::as_str)
            .collect();
        all.join(", ")
    }
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

/// A table by cosine and thickness of a film in a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FilmTableRow {
    material: String,
    medium: String,
    /// The thickness of the first row and of the last one.
    film_thickness_nm: [f64; 2],
    /// The format's name.
    pub format: &'static str,
    /// Texels in a row.
    pub texels: usize,
    rows: usize,
    /// The axis of cosines.
    pub axis: &'static str,
    /// The file's path.
    pub file: String,
    /// value = texel × scale.
    pub scale: f64,
    /// The largest error of the filtered lookup, between texels and rows too.
    pub max_abs: f64,
    worst_cos: f64,
    worst_thickness_nm: f64,
    depth: &'static str,
    bytes: usize,
    channels: &'static str,
    lookup: FilmLookup,
    /// The table's name.
    pub name: String,
    space: Option<&'static str>,
    gamut: &'static str,
    truth: String,
    weights: &'static str,
}

/// How a table by thickness is looked up.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct FilmLookup {
    u: String,
    v: String,
    wrap: &'static str,
    filter: &'static str,
    level: u32,
    functions: Vec<String>,
}

impl FilmTableRow {
    /// The row of a picture of these thicknesses in this file, with its error.
    pub fn new(
        subject: &TableMaterial,
        [from_nm, to_nm]: [f64; 2],
        picture: &Picture,
        (format, file): (Format, &str),
        error: FilmTableError,
    ) -> FilmTableRow {
        let own = TableLookup::new(picture, &[]);
        let rows = picture.height();
        FilmTableRow {
            material: subject.argument.clone(),
            medium: subject.medium.clone().unwrap_or_else(|| "air".to_owned()),
            film_thickness_nm: [from_nm, to_nm],
            format: format.name(),
            texels: picture.width,
            rows,
            axis: picture.axis.name(),
            file: file.to_owned(),
            scale: f64::from(picture.scale),
            max_abs: error.max_abs,
            worst_cos: error.cos_theta,
            worst_thickness_nm: error.thickness_nm,
            depth: picture.depth.name(),
            bytes: picture.width * rows * picture.depth.bytes(),
            channels: "linear red, green, blue",
            lookup: FilmLookup {
                u: format!("w = {}, {}", own.w, own.u),
                v: format!(
                    "(clamp((thickness_nm - {from_nm}) / {}, 0.0, 1.0) * {} + 0.5) / {rows}",
                    to_nm - from_nm,
                    rows - 1
                ),
                wrap: own.wrap,
                filter: own.filter,
                level: own.level,
                functions: Vec::new(),
            },
            name: picture.name.clone(),
            space: subject.space.map(|space| space.name()),
            gamut: subject.reference.surface.gamut.name(),
            truth: subject.seen().to_owned(),
            weights: WEIGHTS,
        }
    }

    /// The same, with the functions that read it.
    pub fn read_by(mut self, functions: &[String]) -> FilmTableRow {
        self.lookup.functions = functions.to_vec();
        self
    }
}

/// One row for each material of a picture in this file, with the functions that read it. The errors of each table are those with
/// filtering weights in steps and with exact ones.
pub fn table_rows<'a>(
    subjects: &'a [TableMaterial],
    errors: &'a [[ModelError; 2]],
    picture: &'a Picture,
    (format, file): (Format, &'a str),
    functions: &'a [String],
) -> impl Iterator<Item = TableRow> + 'a {
    let all = subjects.iter().zip(errors).enumerate();
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
