//! Baking: materials become tables, tables become files and rows of a report. Pure; the command writes.

mod picture;
mod row;
mod shader;
mod split_sum;
mod subject;
mod usual;
mod words;

use serde_json::{Value, json};

use crate::lut::{Axis, Choice, Depth, Format, smallest};
use crate::report::SCHEMA;
use crate::targets::Target;

use crate::app::artifact::{Artifact, TABLES};
use crate::app::error::Error;
use picture::Baking;

pub use split_sum::{SplitSumRequest, bake_split_sum};
pub use subject::{Lit, Wanted, lit};
pub use usual::{DEFAULT_AXIS, DEFAULT_FORMATS, add_tables, as_tables_are_seen};
pub use words::{canonical, said, typed};

/// What is baked.
#[derive(Clone, Debug)]
pub struct Request {
    /// The materials, sorted by name.
    pub subjects: Vec<Lit>,
    /// What a user types to get all of them again: names with commas between, or `all`.
    pub typed: String,
    /// The files wanted.
    pub formats: Vec<Format>,
    /// How large.
    pub shape: Shape,
    /// All of them as the rows of one picture besides.
    pub atlas: bool,
    /// The languages that get a function for each picture.
    pub targets: Vec<&'static Target>,
    /// Goes before the names of these functions.
    pub prefix: String,
    /// The flags of the sight and the medium, each with a space before it.
    pub flags: String,
}

/// How large tables are.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// So many texels along this axis.
    Fixed {
        /// The axis.
        axis: Axis,
        /// The number of texels.
        texels: usize,
    },
    /// As small as this error allows, along one of these axes.
    Within {
        /// The largest error of the filtered lookup.
        budget: f64,
        /// The axes.
        axes: Vec<Axis>,
    },
}

/// Files in memory, and what is known of them.
#[derive(Clone, Debug, Default)]
pub struct Baked {
    /// The files, as a manifest lists them.
    pub files: Vec<Artifact>,
    /// A row for each material and format.
    pub rows: Vec<Value>,
}

/// The name of the picture of all.
pub const ATLAS: &str = "atlas";

/// Bakes. `progress` hears how many tables are done, of how many.
pub fn bake(request: &Request, progress: &mut dyn FnMut(u64, u64, &str)) -> Result<Baked, Error> {
    let mut baked = Baked::default();
    let pictures = request.pictures();
    for (done, (name, subjects)) in pictures.iter().enumerate() {
        progress(done as u64, pictures.len() as u64, name);
        let one = picture(request, name, subjects)?;
        baked.files.extend(one.files);
        baked.rows.extend(one.rows);
    }
    Ok(baked)
}

impl Request {
    /// The pictures, each with its rows.
    fn pictures(&self) -> Vec<(&str, &[Lit])> {
        let subjects = self.subjects.iter();
        let alone = subjects.map(|one| (one.name.as_str(), std::slice::from_ref(one)));
        let atlas = self.atlas.then_some((ATLAS, self.subjects.as_slice()));
        alone.chain(atlas).collect()
    }
}

/// The files of one picture, with functions that read it and a description beside them.
fn picture(request: &Request, name: &str, subjects: &[Lit]) -> Result<Baked, Error> {
    let (axis, texels, formats) = chosen(request, subjects)?;
    let baking = Baking::new(request, name, subjects, (axis, texels), formats)?;
    let functions = shader::files(&baking)?;
    let beside: Vec<&str> = functions.iter().map(|(file, _)| file.as_str()).collect();
    let mut rows = Vec::new();
    let mut files = Vec::new();
    for (format, rounded) in baking.each() {
        let file = baking.file(format);
        let picture = baking.picture(format, rounded);
        let own = row::rows(subjects, rounded, &picture, format, &file);
        rows.extend(own.map(|mut row| {
            row["lookup"]["functions"] = json!(beside);
            row
        }));
        files.push((file, format.encode(&picture)?));
    }
    files.extend(functions);
    let command = baking.command(&baking.formats, &request.targets);
    let material = (name != ATLAS).then_some(name);
    let files = described(files, &rows, &command, name, ("table", material));
    Ok(Baked { files, rows })
}

/// The files of a picture as a manifest lists them, and a description of all beside them.
fn described(
    mut files: Vec<(String, Vec<u8>)>,
    rows: &[Value],
    command: &str,
    name: &str,
    (method, material): (&str, Option<&str>),
) -> Vec<Artifact> {
    let full = serde_json::to_string_pretty(&report(command, rows));
    let text = full.expect("a report has only text keys") + "\n";
    let description = format!("{TABLES}/{name}.json");
    files.push((description.clone(), text.into_bytes()));
    let listed = |(path, bytes)| Artifact {
        path,
        bytes,
        target: TABLES.to_owned(),
        method: Some(method.to_owned()),
        material: material.map(str::to_owned),
        detail: json!({ "command": command, "description": description, "licence": "CC0-1.0" }),
    };
    files.into_iter().map(listed).collect()
}

/// A report in the shape that all have.
pub fn report(command: &str, rows: &[Value]) -> Value {
    json!({ "tool": "fresnel-gen", "schema": SCHEMA, "command": command, "device": null, "rows": rows })
}

/// Axis, size and formats: as asked for, or the smallest that is good enough in those of its depth.
fn chosen(request: &Request, subjects: &[Lit]) -> Result<(Axis, usize, Vec<Format>), Error> {
    let (budget, axes) = match &request.shape {
        Shape::Fixed { axis, texels } => return Ok((*axis, *texels, request.formats.clone())),
        Shape::Within { budget, axes } => (*budget, axes),
    };
    let truths: Vec<_> = subjects.iter().map(|subject| &subject.truth).collect();
    let depths = depths(&request.formats);
    let Choice {
        axis,
        depth,
        texels,
    } = smallest(&truths, budget, axes, &depths)?;
    let formats = request.formats.iter().copied();
    let formats = formats.filter(|format| format.depth() == depth).collect();
    Ok((axis, texels, formats))
}

/// The kinds of number of these formats, the smallest first, each once.
fn depths(formats: &[Format]) -> Vec<Depth> {
    let wanted = |depth: &Depth| formats.iter().any(|format| format.depth() == *depth);
    Depth::ALL.into_iter().filter(wanted).collect()
}
