//! Baking: materials become tables, tables become files and rows of a report. Pure; the command writes.

mod row;
mod subject;

use serde_json::{Value, json};

use crate::emit::MARK;
use crate::fit::ModelError;
use crate::ir::Weights;
use crate::lut::{Axis, Choice, Depth, Format, Picture, Stored, Table, smallest};
use crate::lut::{Between, table_error};

use super::error::Error;
use super::names::quoted;

pub use subject::{Lit, Wanted, lit};

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
    /// Paths relative to the output folder, and bytes.
    pub files: Vec<(String, Vec<u8>)>,
    /// A row for each material and format.
    pub rows: Vec<Value>,
}

/// The folder of the tables in the output folder.
const FOLDER: &str = "lut";
/// The name of the picture of all.
pub const ATLAS: &str = "atlas";

/// Bakes. `progress` hears how many tables are done, of how many.
pub fn bake(request: &Request, progress: &mut dyn FnMut(u64, u64, &str)) -> Result<Baked, Error> {
    let mut baked = Baked::default();
    let whole = (request.subjects.len() + usize::from(request.atlas)) as u64;
    for (done, subject) in request.subjects.iter().enumerate() {
        progress(done as u64, whole, &subject.name);
        baked.add(request, &subject.name, std::slice::from_ref(subject))?;
    }
    if request.atlas {
        progress(whole - 1, whole, ATLAS);
        baked.add(request, ATLAS, &request.subjects)?;
    }
    Ok(baked)
}

/// A kind of number with the tables in it, and how wrong each is.
struct Rounded {
    depth: Depth,
    tables: Vec<Stored>,
    errors: Vec<[ModelError; 2]>,
}

impl Baked {
    /// The files of one picture, with a description beside them.
    fn add(&mut self, request: &Request, name: &str, subjects: &[Lit]) -> Result<(), Error> {
        let (axis, texels, formats) = chosen(request, subjects)?;
        let tables = subjects
            .iter()
            .map(|subject| Table::new(&subject.name, &subject.truth, axis, texels))
            .collect::<Result<Vec<_>, _>>()?;
        let rounded = rounded(subjects, &tables, &formats, texels);
        let mut rows = Vec::new();
        for format in formats {
            let Some(rounded) = rounded.iter().find(|one| one.depth == format.depth()) else {
                continue;
            };
            let file = format!("{FOLDER}/{name}{}", format.ending());
            let picture = picture(request, name, subjects, rounded, format);
            rows.extend(row::rows(subjects, rounded, &picture, format, &file));
            self.files.push((file, format.encode(&picture)?));
        }
        let full = report(&command(request, name, subjects, axis, texels, None), &rows);
        let text = serde_json::to_string_pretty(&full).expect("a report has only text keys") + "\n";
        self.files
            .push((format!("{FOLDER}/{name}.json"), text.into_bytes()));
        self.rows.extend(rows);
        Ok(())
    }
}

/// A report in the shape that all have.
pub fn report(command: &str, rows: &[Value]) -> Value {
    json!({ "tool": "fresnel-gen", "command": command, "device": null, "rows": rows })
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

/// The tables in every depth that the formats have. Those of one picture share a scale.
fn rounded(subjects: &[Lit], tables: &[Table], formats: &[Format], texels: usize) -> Vec<Rounded> {
    let axis = tables.first().map_or(Axis::Cos, |table| table.axis);
    let between = |subject: &Lit| Between::new(&subject.truth, axis, texels);
    let between: Vec<Between> = subjects.iter().map(between).collect();
    let all: Vec<&Table> = tables.iter().collect();
    let of = |depth: Depth| {
        let scale = depth.scale(&all);
        let stored = |table| Stored::scaled(table, depth, scale);
        let tables: Vec<Stored> = tables.iter().map(stored).collect();
        let error = |((stored, subject), between): ((&Stored, &Lit), &Between)| {
            [Weights::Steps256, Weights::Exact]
                .map(|weights| table_error(stored, weights, &subject.truth, between))
        };
        let errors = tables.iter().zip(subjects).zip(&between).map(error);
        Rounded {
            depth,
            errors: errors.collect(),
            tables,
        }
    };
    depths(formats).into_iter().map(of).collect()
}

/// The tables of one depth as a picture that says what it is.
fn picture(
    request: &Request,
    name: &str,
    subjects: &[Lit],
    rounded: &Rounded,
    format: Format,
) -> Picture {
    let names = subjects.iter().map(|subject| subject.name.as_str());
    let rows: Vec<(&str, &Stored)> = names.zip(&rounded.tables).collect();
    let mut picture = Picture::new(name, &rows, subjects.first().and_then(|first| first.space));
    let command = command(
        request,
        name,
        subjects,
        picture.axis,
        picture.width,
        Some(format),
    );
    let seen = subjects.first().map_or("", |first| first.seen());
    picture.about = vec![
        format!("{MARK}: {command}"),
        format!("{} by cos theta: {seen}", picture.rows.join(", ")),
    ];
    picture.about.extend(picture.lookup());
    picture.about.push(row::error_line(&rounded.errors));
    picture.about = crate::emit::comment_lines(picture.about);
    picture
}

/// The command that writes it again. A search is told by what it found.
fn command(
    request: &Request,
    name: &str,
    subjects: &[Lit],
    axis: Axis,
    texels: usize,
    format: Option<Format>,
) -> String {
    let typed = match subjects {
        [one] if name != ATLAS => quoted(&one.argument),
        _ => request.typed.clone(),
    };
    let formats: Vec<&str> = match format {
        Some(format) => vec![format.name()],
        None => request.formats.iter().map(|format| format.name()).collect(),
    };
    let atlas = if name == ATLAS { " --atlas" } else { "" };
    format!(
        "fresnel-gen bake --material {typed}{} --size {texels} --axis {} --format {}{atlas}",
        request.flags,
        axis.name(),
        formats.join(",")
    )
}
