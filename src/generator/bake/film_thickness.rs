//! One table by cos θ and thickness: the outermost film of a material at several thicknesses, a row each, with the function that
//! reads it between rows.

use super::request::{BakeRequest, Error, TableMaterial, TableSize};
use super::row::{BakeRow, Baked, FilmTableRow};
use crate::generator::command_line::CommandLine;
use crate::generator::emit::{self, MARK, comment_lines};
use crate::generator::lut::{Format, Picture, Stored, TABLES, Table, lookup_by_thickness};
use crate::language::ir::Weights;
use crate::language::targets::Target;
use crate::physics::num::in_parallel;

/// The rows of a table by thickness. Of 800 nm they are 6.3 nm apart: fringes of the shortest waves lie 70 nm apart in a film of
/// index 2.6, and a straight line between rows misses a hundredth of their height.
pub const THICKNESS_ROWS: usize = 128;

/// Thicknesses in nanometres, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thicknesses {
    /// That of the first row.
    pub from_nm: f64,
    /// That of the last row.
    pub to_nm: f64,
}

impl Thicknesses {
    /// The thickness of a row, or between two.
    pub fn at(self, row: f64) -> f64 {
        let share = row / (THICKNESS_ROWS - 1) as f64;
        self.from_nm + share * (self.to_nm - self.from_nm)
    }

    /// As the flag takes it.
    pub fn word(self) -> String {
        format!("{}..{}nm", self.from_nm, self.to_nm)
    }
}

/// The request for a table by thickness: `own.subjects` holds the material alone, as it is named.
#[derive(Clone, Debug)]
pub struct FilmTableRequest {
    /// Formats, size, languages and flags.
    pub own: BakeRequest,
    /// The thicknesses of the rows.
    pub thicknesses: Thicknesses,
    /// The material at the thickness of each row, and then half-way to the next: twice as many less one.
    pub halves: Vec<TableMaterial>,
}

impl FilmTableRequest {
    /// The command that reports this again, without the output path.
    pub fn command_line(&self) -> CommandLine {
        self.command_for(&self.own)
    }

    /// The same for other formats and languages.
    fn command_for(&self, own: &BakeRequest) -> CommandLine {
        let command = own.command_line();
        command.list("film-thickness", [self.thicknesses.word()])
    }

    /// The name of its files: the material's, with the thicknesses.
    fn name(&self) -> String {
        let own = self.own.subjects.first().map_or("", |one| &one.name);
        let Thicknesses { from_nm, to_nm } = self.thicknesses;
        format!("{own}_{from_nm}_to_{to_nm}nm").replace('.', "_")
    }
}

/// Bakes the table.
///
/// # Errors
/// A size that no texture has, or a format or language refuses.
pub fn bake_film_thickness(
    request: &FilmTableRequest,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Baked, Error> {
    let name = request.name();
    let (axis, texels) = match request.own.shape {
        TableSize::Fixed { axis, texels } => (axis, texels),
        TableSize::Within { .. } => unreachable!("the flags of both exclude each other"),
    };
    // Texels and the places between them, of rows and between these.
    let fine = 2 * texels - 1;
    let line = |row: usize| {
        let one = &request.halves[row];
        Table::new(&one.name, &one.reference, axis, fine)
    };
    let lines = in_parallel(request.halves.len(), &line, &mut |done, all| {
        progress(done, all, &name);
    });
    let lines = lines.into_iter().collect::<Result<Vec<Table>, _>>()?;
    let tables: Vec<Table> = lines
        .iter()
        .step_by(2)
        .map(|line| Table {
            texels: line.texels.iter().copied().step_by(2).collect(),
            ..line.clone()
        })
        .collect();
    let mut rows = Vec::new();
    let mut files = Vec::new();
    let mut lookups = Vec::new();
    let mut first = None;
    for format in &request.own.formats {
        let scale = Table::shared_scale(&tables.iter().collect::<Vec<_>>(), format.depth());
        let stored: Vec<Stored> = tables
            .iter()
            .map(|table| Stored::scaled(table, format.depth(), scale))
            .collect();
        let error = error(&stored, &lines, request.thicknesses);
        let picture = picture(request, &name, *format, &stored, error);
        let file = format!("{TABLES}/{name}{}", format.ending());
        lookups.push((file.clone(), scale, error));
        let subject = &request.own.subjects[0];
        rows.push(FilmTableRow::new(
            subject,
            [request.thicknesses.from_nm, request.thicknesses.to_nm],
            &picture,
            (*format, &file),
            error,
        ));
        files.push((file, format.encode(&picture)?));
        first.get_or_insert(picture);
    }
    let mut functions = Vec::new();
    for (target, picture) in request.own.targets.iter().zip(first.iter().cycle()) {
        functions.push(function(request, target, picture, &lookups)?);
    }
    let beside: Vec<String> = functions.iter().map(|(path, _)| path.clone()).collect();
    files.extend(functions);
    let rows = rows
        .into_iter()
        .map(|row| BakeRow::Film(Box::new(row.read_by(&beside))));
    Ok(Baked {
        material: Some(request.own.subjects[0].name.clone()),
        method: "table",
        command: format!("fresnel-gen {}", String::from(request.command_line())),
        rows: rows.collect(),
        files,
        name,
    })
}

/// The largest error of the filtered lookup, and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmTableError {
    /// The error.
    pub max_abs: f64,
    /// The cosine there.
    pub cos_theta: f64,
    /// The thickness in nanometres there.
    pub thickness_nm: f64,
}

/// The error at texels, rows, and half-way between both, weights in steps of 1/256.
fn error(stored: &[Stored], lines: &[Table], thicknesses: Thicknesses) -> FilmTableError {
    let fine = lines.first().map_or(0, |line| line.texels.len());
    let mut worst = FilmTableError {
        max_abs: 0.0,
        cos_theta: 1.0,
        thickness_nm: thicknesses.from_nm,
    };
    for (half, line) in lines.iter().enumerate() {
        for (place, want) in line.texels.iter().enumerate() {
            let cos_theta = line.axis.cosine(place as f64 / (fine - 1) as f64);
            let [first, second] = [half / 2, half.div_ceil(2)].map(|row| {
                let row = &stored[row];
                row.sample(Weights::Steps256, row.coordinate(cos_theta as f32))
            });
            for i in 0..3 {
                let mixed = 0.5 * (first[i] + second[i]) * stored[0].scale;
                let max_abs = (f64::from(mixed) - want[i]).abs();
                if max_abs > worst.max_abs {
                    worst = FilmTableError {
                        max_abs,
                        cos_theta,
                        thickness_nm: thicknesses.at(half as f64 / 2.0),
                    };
                }
            }
        }
    }
    worst
}

/// The head of all files: how to make them again, what they show, how they are looked up.
fn about(
    request: &FilmTableRequest,
    formats: &[Format],
    targets: &[&'static Target],
    picture: &Picture,
) -> Vec<String> {
    let Thicknesses { from_nm, to_nm } = request.thicknesses;
    let own = BakeRequest {
        formats: formats.to_vec(),
        targets: targets.to_vec(),
        ..request.own.clone()
    };
    let command = request.command_for(&own);
    let subject = &request.own.subjects[0];
    let mut lines = vec![
        format!("{MARK}: fresnel-gen {}", String::from(command)),
        format!(
            "{} by cos theta and by the thickness of its outermost film, {from_nm} to {to_nm} nm: {}",
            subject.name,
            subject.seen()
        ),
    ];
    lines.extend(picture.lookup());
    lines.push(format!(
        "A thickness t in nm lies at i = clamp((t - {from_nm}) / {}, 0, 1) * {}, between two rows.",
        to_nm - from_nm,
        THICKNESS_ROWS - 1
    ));
    lines.push(
        "The first row is the thinnest. A loader that turns a picture over (three.js: EXRLoader, and TextureLoader unless flipY = false) turns thicknesses over: take the KTX2."
            .to_owned(),
    );
    let mut texels = picture.texels.iter().flatten();
    if texels.any(|value| !(-1e-6..=1.0 + 1e-6).contains(&f64::from(value * picture.scale))) {
        lines.push(
            "Some values lie outside 0 to 1: colours that the space does not hold. --gamut clip limits them."
                .to_owned(),
        );
    }
    lines
}

fn error_words(error: FilmTableError) -> String {
    format!(
        "Error of the filtered lookup at texels, rows and half-way between both, weights in steps of 1/256: at most {:.6} (at cos theta {:.4} and {:.2} nm).",
        error.max_abs, error.cos_theta, error.thickness_nm
    )
}

fn picture(
    request: &FilmTableRequest,
    name: &str,
    format: Format,
    stored: &[Stored],
    error: FilmTableError,
) -> Picture {
    let names: Vec<String> = (0..stored.len())
        .map(|row| format!("{:.2} nm", request.thicknesses.at(row as f64)))
        .collect();
    let rows: Vec<(&str, &Stored)> = names.iter().map(String::as_str).zip(stored).collect();
    let mut picture = Picture::new(name, &rows, request.own.subjects[0].space);
    let mut lines = about(request, &[format], &[], &picture);
    lines.extend(picture.scaling());
    lines.push(format!("{} CC0-1.0.", error_words(error)));
    picture.about = comment_lines(lines);
    picture
}

/// The file of a function that reads the table in a language.
fn function(
    request: &FilmTableRequest,
    target: &'static Target,
    picture: &Picture,
    files: &[(String, f32, FilmTableError)],
) -> Result<(String, Vec<u8>), Error> {
    let name = &picture.name;
    let path = format!("{TABLES}/{}/{name}.{}", target.name, target.extension);
    let is_shared = files.iter().all(|(_, scale, _)| *scale == picture.scale);
    let shared = is_shared.then_some(picture.scale);
    let function = lookup_by_thickness(
        (picture.axis, picture.width),
        shared,
        THICKNESS_ROWS,
        [request.thicknesses.from_nm, request.thicknesses.to_nm],
    );
    let function = function.map_err(|fault| emit::Error::generated(&path, fault))?;
    let mut lines = about(request, &request.own.formats, &[target], picture);
    for (file, scale, error) in files {
        let scaled = if is_shared {
            String::new()
        } else {
            format!("table_scale {scale:?}. ")
        };
        lines.push(format!("{file}: {scaled}{}", error_words(*error)));
    }
    let called = format!("{}{name}_lookup", request.own.prefix);
    Ok((path, emit::lookup(target, called, function, lines)?))
}
