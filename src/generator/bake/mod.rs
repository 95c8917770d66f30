//! Baking: materials become tables, and tables become files and rows of a report. It writes no files: its callers do.

mod picture;
mod row;
mod split_sum;
mod subject;

use crate::generator::lut::{Depth, Format, TableAxis, TableKind, smallest};
use crate::language::targets::Target;
use picture::Baking;

pub use row::{
    BakeRow, Error, SplitSumRow, TableRow, material_words, split_sum_methods, viewing_flags,
};
pub use split_sum::{SplitSumRequest, bake_split_sum, usual_method};
pub use subject::{
    DEFAULT_AXIS, DEFAULT_FORMATS, TableMaterial, as_tables_are_seen, usual_request,
};

/// The request for lookup tables.
#[derive(Clone, Debug)]
pub struct BakeRequest {
    /// The materials, sorted by name.
    pub subjects: Vec<TableMaterial>,
    /// The arguments that name all of them again: names, or `all`.
    pub typed: Vec<String>,
    /// The files wanted.
    pub formats: Vec<Format>,
    /// The size of the tables.
    pub shape: TableSize,
    /// Whether to write a picture with one row per material, too.
    pub atlas: bool,
    /// The languages that get a function for each picture.
    pub targets: Vec<&'static Target>,
    /// The prefix of these functions' names.
    pub prefix: String,
    /// The flags of the viewing conditions and the medium, each with a space before it.
    pub flags: String,
}

/// The size of tables.
#[derive(Clone, Debug, PartialEq)]
pub enum TableSize {
    /// This many texels along this axis.
    Fixed {
        /// The axis.
        axis: TableAxis,
        /// The number of texels.
        texels: usize,
    },
    /// The fewest bytes within this error, along one of these axes.
    Within {
        /// The largest error of the filtered lookup.
        budget: f64,
        /// The axes.
        axes: Vec<TableAxis>,
    },
}

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
        let rows = self.rows.iter().filter(|_| self.name == ATLAS);
        let rows = rows.filter_map(|row| match row {
            BakeRow::Table(row) => Some(row),
            BakeRow::SplitSum(_) => None,
        });
        // The report has a row for each format: those of the first file hold all materials.
        let first = rows.clone().next().map(|row| &row.file);
        rows.filter(|row| Some(&row.file) == first)
            .map(|row| row.name.clone())
            .collect()
    }
}

/// The name of the picture with all materials.
pub const ATLAS: &str = "atlas";

/// Bakes the tables. `progress` receives how many are done, of how many.
///
/// # Errors
/// No table is within the error, or a format or language refuses.
pub fn bake(
    request: &BakeRequest,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Baked>, Error> {
    let pictures = request.pictures();
    let all = pictures.len() as u64;
    let bake = |(done, (name, materials)): (usize, (&str, &[TableMaterial]))| {
        progress(done as u64, all, name);
        bake_picture(request, name, materials)
    };
    pictures.into_iter().enumerate().map(bake).collect()
}

impl BakeRequest {
    fn pictures(&self) -> Vec<(&str, &[TableMaterial])> {
        let subjects = self.subjects.iter();
        let alone = subjects.map(|one| (one.name.as_str(), std::slice::from_ref(one)));
        let atlas = self.atlas.then_some((ATLAS, self.subjects.as_slice()));
        alone.chain(atlas).collect()
    }
}

/// The files of one picture, with the functions that read it.
fn bake_picture(
    request: &BakeRequest,
    name: &str,
    subjects: &[TableMaterial],
) -> Result<Baked, Error> {
    let (axis, texels, formats) = chosen(request, subjects)?;
    let baking = Baking::new(request, name, subjects, (axis, texels), formats)?;
    let functions = picture::files(&baking)?;
    let beside: Vec<String> = functions.iter().map(|(file, _)| file.clone()).collect();
    let mut rows = Vec::new();
    let mut files = Vec::new();
    for (format, rounded) in baking.each() {
        let file = baking.file(format);
        let picture = baking.picture(format, rounded);
        let own = row::table_rows(subjects, rounded, &picture, (format, &file), &beside);
        rows.extend(own.map(|row| BakeRow::Table(Box::new(row))));
        files.push((file, format.encode(&picture)?));
    }
    files.extend(functions);
    Ok(Baked {
        name: name.to_owned(),
        method: "table",
        material: (name != ATLAS).then(|| name.to_owned()),
        command: baking.command(&baking.formats, &request.targets),
        files,
        rows,
    })
}

/// Axis, size and formats: those requested, or the smallest table within the error, in the formats of its depth.
fn chosen(
    request: &BakeRequest,
    subjects: &[TableMaterial],
) -> Result<(TableAxis, usize, Vec<Format>), Error> {
    let (budget, axes) = match &request.shape {
        TableSize::Fixed { axis, texels } => return Ok((*axis, *texels, request.formats.clone())),
        TableSize::Within { budget, axes } => (*budget, axes),
    };
    let truths: Vec<_> = subjects.iter().map(|subject| &subject.reference).collect();
    let depths = depths(&request.formats);
    let TableKind {
        axis,
        depth,
        texels,
    } = smallest(&truths, budget, axes, &depths)?;
    let formats = request.formats.iter().copied();
    let formats = formats.filter(|format| format.depth() == depth).collect();
    Ok((axis, texels, formats))
}

/// The depths of these formats, the smallest first, each once.
fn depths(formats: &[Format]) -> Vec<Depth> {
    let wanted = |depth: &Depth| formats.iter().any(|format| format.depth() == *depth);
    Depth::ALL.into_iter().filter(wanted).collect()
}
