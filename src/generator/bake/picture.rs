//! One picture in all its formats: its tables in every depth, their errors, what the heads of its files say, and the shader
//! functions that read it, one file per language.

use super::request::{ATLAS, BakeRequest, Error, TableMaterial, with_functions};
use crate::generator::command_line::CommandLine;
use crate::generator::emit::{self, MARK, comment_lines};
use crate::generator::fit::ModelError;
use crate::generator::lut::{
    BetweenTexels, Depth, Format, Picture, Stored, TABLES, Table, TableAxis, lookup, table_error,
};
use crate::language::ir::Weights;
use crate::language::targets::Target;

/// A picture during baking.
pub struct Baking<'a> {
    /// The request that it belongs to.
    pub request: &'a BakeRequest,
    /// Its name, a material's or [`ATLAS`].
    pub name: &'a str,
    /// The materials of its rows.
    pub subjects: &'a [TableMaterial],
    /// The axis of cosines.
    pub axis: TableAxis,
    /// Texels in a row.
    pub texels: usize,
    /// Its files.
    pub formats: Vec<Format>,
    rounded: Vec<Rounded>,
}

/// The tables in one depth, with their errors.
pub struct Rounded {
    depth: Depth,
    tables: Vec<Stored>,
    /// The errors of each table, with filtering weights in steps and with exact ones.
    pub errors: Vec<[ModelError; 2]>,
}

impl<'a> Baking<'a> {
    /// Computes the tables and their errors.
    pub fn new(
        request: &'a BakeRequest,
        name: &'a str,
        subjects: &'a [TableMaterial],
        (axis, texels): (TableAxis, usize),
        formats: Vec<Format>,
    ) -> Result<Baking<'a>, Error> {
        let table = |one: &TableMaterial| Table::new(&one.name, &one.reference, axis, texels);
        let tables = subjects.iter().map(table).collect::<Result<Vec<_>, _>>()?;
        Ok(Baking {
            rounded: rounded(subjects, &tables, &formats, texels),
            request,
            name,
            subjects,
            axis,
            texels,
            formats,
        })
    }

    /// The formats, each with its tables.
    pub fn each(&self) -> impl Iterator<Item = (Format, &Rounded)> {
        self.formats.iter().filter_map(|format| {
            let mut all = self.rounded.iter();
            let own = all.find(|rounded| rounded.depth == format.depth())?;
            Some((*format, own))
        })
    }

    /// The depths, each with the names of its files.
    fn by_depth(&self) -> impl Iterator<Item = (String, &Rounded)> {
        self.rounded.iter().map(|rounded| {
            let own = self.formats.iter();
            let own = own.filter(|format| format.depth() == rounded.depth);
            let names = own.map(|format| format!("{}{}", self.name, format.ending()));
            (names.collect::<Vec<_>>().join(", "), rounded)
        })
    }

    /// The scale of all files, if they share one.
    fn shared_scale(&self) -> Option<f32> {
        let mut scales = self.rounded.iter().map(Rounded::scale);
        let first = scales.next().unwrap_or(1.0);
        scales.all(|scale| scale == first).then_some(first)
    }

    /// The path of a file.
    pub fn file(&self, format: Format) -> String {
        format!("{TABLES}/{}{}", self.name, format.ending())
    }

    /// The tables of a format as a picture that describes itself.
    pub fn picture(&self, format: Format, rounded: &Rounded) -> Picture {
        let names = self.subjects.iter().map(|subject| subject.name.as_str());
        let rows: Vec<(&str, &Stored)> = names.zip(&rounded.tables).collect();
        let space = self.subjects.first().and_then(|first| first.space);
        let mut picture = Picture::new(self.name, &rows, space);
        picture.about = self.about(&[format], &[], &picture);
        picture.about.extend(picture.scaling());
        let errors = error_line(&rounded.errors);
        picture.about.push(format!("{errors} CC0-1.0."));
        picture.about = comment_lines(picture.about);
        picture
    }

    /// The first lines of every file of the picture: how to make it again, what it shows, how to look it up.
    fn about(
        &self,
        formats: &[Format],
        targets: &[&'static Target],
        picture: &Picture,
    ) -> Vec<String> {
        let command = self.command(formats, targets);
        let seen = self.subjects.first().map_or("", |first| first.seen());
        let mut lines = vec![
            format!("{MARK}: {command}"),
            format!("{} by cos theta: {seen}", picture.rows.join(", ")),
        ];
        lines.extend(picture.lookup());
        lines
    }

    /// The command that writes these files of the picture again. After a search, it states the size and axis found.
    pub fn command(&self, formats: &[Format], targets: &[&'static Target]) -> String {
        let typed = match self.subjects {
            [one] if self.name != ATLAS => vec![one.argument.clone()],
            _ => self.request.typed.clone(),
        };
        let command = CommandLine::new("fresnel-gen bake")
            .list("material", typed)
            .with(&self.request.flags)
            .list("size", [self.texels])
            .list("axis", [self.axis.name()])
            .list("format", formats.iter().map(|format| format.name()))
            .switch("atlas", self.name == ATLAS);
        with_functions(command, targets, &self.request.prefix).into()
    }
}

impl Rounded {
    /// value = texel × scale, with one scale for all tables of a picture.
    fn scale(&self) -> f32 {
        self.tables.first().map_or(1.0, |table| table.scale)
    }
}

/// The tables in every depth of the formats. Those of one picture share a scale.
fn rounded(
    subjects: &[TableMaterial],
    tables: &[Table],
    formats: &[Format],
    texels: usize,
) -> Vec<Rounded> {
    let axis = tables.first().map_or(TableAxis::Cos, |table| table.axis);
    let between = |subject: &TableMaterial| BetweenTexels::new(&subject.reference, axis, texels);
    let between: Vec<BetweenTexels> = subjects.iter().map(between).collect();
    let all: Vec<&Table> = tables.iter().collect();
    let in_depth = |depth: Depth| {
        let scale = Table::shared_scale(&all, depth);
        let mut rounded = Rounded {
            depth,
            tables: Vec::new(),
            errors: Vec::new(),
        };
        for ((table, subject), between) in tables.iter().zip(subjects).zip(&between) {
            let stored = Stored::scaled(table, depth, scale);
            let error = |weights| table_error(&stored, weights, &subject.reference, between);
            rounded
                .errors
                .push([Weights::Steps256, Weights::Exact].map(error));
            rounded.tables.push(stored);
        }
        rounded
    };
    let depths = Format::depths(formats).into_iter();
    depths.map(in_depth).collect()
}

/// Paths and bytes of the files with functions.
pub fn functions(baking: &Baking) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let targets = baking.request.targets.iter();
    targets.map(|target| function(baking, target)).collect()
}

fn function(baking: &Baking, target: &'static Target) -> Result<(String, Vec<u8>), Error> {
    let name = baking.name;
    let path = format!("{TABLES}/{}/{name}.{}", target.name, target.extension);
    let (scale, rows) = (baking.shared_scale(), baking.subjects.len());
    let function = lookup(baking.axis, baking.texels, scale, rows);
    let function = function.map_err(|fault| emit::Error::generated(&path, fault))?;
    let name = format!("{}{name}_lookup", baking.request.prefix);
    let bytes = emit::lookup(target, name, function, function_head(baking, target))?;
    Ok((path, bytes))
}

/// The head of a function's file: what all files of the picture say, and how they differ.
fn function_head(baking: &Baking, target: &'static Target) -> Vec<String> {
    let Some((format, rounded)) = baking.each().next() else {
        return Vec::new();
    };
    let picture = baking.picture(format, rounded);
    let mut lines = baking.about(&baking.formats, &[target], &picture);
    if picture.height() > 1 {
        lines.push("row: v of that row's middle, as above.".to_owned());
    }
    if baking.shared_scale().is_some() {
        lines.extend(picture.scaling());
    } else {
        let scale = |(names, own): (String, &Rounded)| format!("{:?} for {names}", own.scale());
        let scales: Vec<String> = baking.by_depth().map(scale).collect();
        lines.push(format!("table_scale: {}.", scales.join("; ")));
    }
    lines.extend(baking.by_depth().map(|(names, rounded)| {
        let errors = error_line(&rounded.errors);
        format!("{names}: {errors}")
    }));
    lines
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
