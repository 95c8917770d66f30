//! The fitted coefficients of many materials as a constant array of a language, and as a storage buffer.
//!
//! The array holds the coefficients that the library functions `fitted` and `fitted_dielectric` take, four colours per material,
//! and has each material's row by name. The buffer holds the same numbers, each colour as a little-endian `vec4`.
//!
//! Source: std430 aligns an array of `vec4` to 16 bytes per element (Khronos, *The OpenGL Graphics System 4.6*, section 7.6.2.2,
//! 2022, <https://registry.khronos.org/OpenGL/specs/gl/glspec46.core.pdf>), and so does WGSL (W3C, *WebGPU Shading Language*,
//! section 14.4.1, 2024, <https://www.w3.org/TR/WGSL/#alignment-and-size>).

use serde::Serialize;

use super::row::{
    CATALOGUE, COEFFICIENTS, CatalogueRow, first_dielectric, method_number, methods_of,
};
use crate::generator::emit::artifact::{Artifact, CatalogueDetail, Detail};
use crate::generator::emit::comment;
use crate::generator::emit::error::Error;
use crate::generator::emit::figures::at_most;
use crate::generator::emit::function::Naming;
use crate::generator::emit::header::{OUTPUT_LICENCE, formula, licence_line, source, start};
use crate::generator::emit::page::{comments, guard, render_template};
use crate::generator::fit::rounded_up;
use crate::language::targets::{self, Target};

/// The constant for the row at which the method changes.
const DIELECTRICS: &str = "first_dielectric";

/// The data of a template.
#[derive(Serialize)]
struct CatalogueView {
    header: Vec<String>,
    guard: String,
    name: String,
    size: usize,
    materials: Vec<MaterialView>,
    dielectrics_doc: Vec<String>,
    dielectrics: Option<PlaceView>,
}

#[derive(Serialize)]
struct PlaceView {
    constant: String,
    row: usize,
}

#[derive(Serialize)]
struct MaterialView {
    constant: String,
    row: usize,
    remark: String,
    rows: Vec<RowView>,
}

#[derive(Serialize)]
struct RowView {
    colour: String,
    remark: String,
    is_last: bool,
}

/// The file of a target; none where the language has no constants, or there is no material. The rows of one method stand
/// together, unless they are in an order of their own. `seen` is the viewing conditions in words.
///
/// # Errors
/// A name is a keyword of the language, or the language refuses a text.
pub fn catalogue_array(
    target: &'static Target,
    rows: &[CatalogueRow],
    order: RowOrder,
    naming: &Naming,
    seen: &str,
    command: &str,
) -> Result<Option<Artifact>, Error> {
    let Some(template) = target.catalogue.filter(|_| !rows.is_empty()) else {
        return Ok(None);
    };
    let view = view(target, rows, order, naming, seen, command);
    check_names(&view)?;
    let name = format!("{CATALOGUE}.{}", target.extension);
    let bytes = render_template(template, &view, target.finish, &name)?;
    let detail = Detail::Catalogue(CatalogueDetail {
        command: command.to_owned(),
        array: Some(view.name),
        materials: rows.len(),
        rows: Some(view.size),
        row_materials: Vec::new(),
        seen: seen.to_owned(),
        licence: OUTPUT_LICENCE,
    });
    let path = format!("{}/{name}", target.name);
    Ok(Some(Artifact::new(target.name, path, bytes, detail)))
}

fn view(
    target: &Target,
    rows: &[CatalogueRow],
    order: RowOrder,
    naming: &Naming,
    seen: &str,
    command: &str,
) -> CatalogueView {
    let is_last = |i: usize| i + 1 == rows.len();
    let all = rows.iter().enumerate();
    CatalogueView {
        header: comments(target, &header(rows, order, naming, seen, command)),
        guard: guard(target, &constant(naming, CATALOGUE)),
        name: constant(naming, CATALOGUE),
        size: COEFFICIENTS * rows.len(),
        materials: all
            .map(|(i, row)| material(target, naming, i, row, is_last(i)))
            .collect(),
        dielectrics_doc: comments(target, &comment::lines(vec![where_methods_change(rows)])),
        dielectrics: (order == RowOrder::ByMethod).then(|| PlaceView {
            constant: constant(naming, DIELECTRICS),
            row: first_dielectric(rows),
        }),
    }
}

/// The name of a constant, in capitals.
fn constant(naming: &Naming, of: &str) -> String {
    format!("{}{of}", naming.prefix).to_uppercase()
}

fn material(
    target: &Target,
    naming: &Naming,
    place: usize,
    row: &CatalogueRow,
    is_last: bool,
) -> MaterialView {
    let mut rows = Vec::new();
    for (i, values) in row.coefficients.iter().enumerate() {
        rows.push(RowView {
            colour: colour(target, *values),
            remark: if i == 0 { &row.name } else { "" }.to_owned(),
            is_last: is_last && i + 1 == COEFFICIENTS,
        });
    }
    MaterialView {
        constant: constant(naming, &row.name),
        row: COEFFICIENTS * place,
        remark: remark(row),
        rows,
    }
}

fn remark(row: &CatalogueRow) -> String {
    let mut remark = format!("{}, {}", row.class.name(), at_most(&row.error));
    if let Some(better) = &row.better {
        let (name, most) = (better.method.name, rounded_up(better.max_abs));
        remark += &format!("; {name} at most {most}");
    }
    if let Some(held) = &row.held {
        remark += &format!("; extrapolated: {held}");
    }
    remark
}

/// A colour in the shortest digits that give the same f32.
fn colour(target: &Target, values: [f64; 3]) -> String {
    let spelling = &target.spelling;
    let numbers = values.map(|value| spelling.number(value));
    format!("{}({})", spelling.rgb, numbers.join(", "))
}

fn where_methods_change(rows: &[CatalogueRow]) -> String {
    match methods_of(rows).as_slice() {
        [first, then, ..] => format!(
            "From this row on the method is {}, before it {}.",
            then.name, first.name
        ),
        _ => "The row after the last: all materials have one method.".to_owned(),
    }
}

fn header(
    rows: &[CatalogueRow],
    order: RowOrder,
    naming: &Naming,
    seen: &str,
    command: &str,
) -> Vec<String> {
    let mut lines = start(command);
    let array = constant(naming, CATALOGUE);
    let row = constant(naming, &rows[0].name);
    let suffix = naming.precision.suffix();
    let function = format!("{}{}{suffix}", naming.prefix, rows[0].method.name);
    lines.push(format!(
        "{CATALOGUE}: coefficients fitted to {} materials, four rows of {array} each, c0 to c3",
        rows.len()
    ));
    for method in methods_of(rows) {
        let of = rows.iter().filter(|row| row.method.name == method.name);
        lines.push(format!("{}: {} of them", method.name, of.count()));
        lines.extend(formula(method));
    }
    lines.push(source(rows[0].method));
    lines.push(format!(
        "Use: {function}(cos_theta, {array}[{row}], {array}[{row} + 1], {array}[{row} + 2], {array}[{row} + 3]), with the library \
         function of the material's method. By a constant it costs nothing. If the material is known at run time only, do not \
         index the array: some compilers copy it into the memory of each invocation. Read the same numbers from a buffer \
         ({CATALOGUE_BUFFER}) or a texture ({CATALOGUE}.f32.ktx2), where the fourth number of c0 is 1 for fitted and 2 for \
         fitted_dielectric. {}",
        match order {
            RowOrder::ByMethod => "A run without flags writes both",
            RowOrder::AsGiven => "They lie beside this folder",
        }
    ));
    if naming.precision.is_half() {
        lines.push(
            "Half precision: the coefficients were fitted as half floats, and each file holds them exactly".to_owned(),
        );
    }
    lines.push(format!("Truth: {seen}"));
    lines.push(worst(rows));
    lines.push(
        "Where another method stands beside a material it follows it more closely: semiconductors need the five coefficients of \
         fitted_five, and some metals miss what fitted promises of metals"
            .to_owned(),
    );
    lines.push("Code error: that of the library functions".to_owned());
    // A list of one's own may hold one's own files.
    let data = match order {
        RowOrder::ByMethod => "CC0-1.0, each with its reference",
        RowOrder::AsGiven => "each with its licence and reference",
    };
    lines.push(format!(
        "Data: {data}: `fresnel-gen materials show {}`",
        rows[0].argument
    ));
    lines.push(licence_line());
    comment::lines(lines)
}

/// The largest model error of all, and where each one's is listed.
fn worst(rows: &[CatalogueRow]) -> String {
    let by_error =
        |a: &&CatalogueRow, b: &&CatalogueRow| a.error.max_abs.total_cmp(&b.error.max_abs);
    let worst = rows.iter().max_by(by_error).expect("there are rows");
    let degrees = libm::acos(worst.error.worst_cos).to_degrees();
    format!(
        "Model error: beside each material, over all angles and channels; the largest is {}'s, {} (at {degrees:.2} degrees)",
        worst.name,
        at_most(&worst.error)
    )
}

/// Checks that the constants' names are free in every language, as functions' names are.
fn check_names(view: &CatalogueView) -> Result<(), Error> {
    let materials = view.materials.iter().map(|material| &material.constant);
    let first = view.dielectrics.as_ref().map(|place| &place.constant);
    let mut names = materials.chain([&view.name]).chain(first);
    // The array's own name, and names that begin as the guards of its files do.
    let own = |name: &str| name == view.name || name.starts_with(&format!("{}_", view.name));
    if let Some(material) = view.materials.iter().find(|one| own(&one.constant)) {
        let what = format!(
            "`{}` is a name of the catalogue's own; rename the material",
            material.constant
        );
        return Err(Error::Name { what });
    }
    match names.find_map(|name| targets::name_fault(name)) {
        Some(what) => Err(Error::Name { what }),
        None => Ok(()),
    }
}

/// The order of the rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowOrder {
    /// By method, then by name. The row where the method changes has a constant.
    ByMethod,
    /// The order in which materials were named.
    AsGiven,
}

/// The file's name.
pub const CATALOGUE_BUFFER: &str = "catalogue.std430.bin";
/// The name of the file in half floats.
pub const HALF_BUFFER: &str = "catalogue.f16.std430.bin";
const ELEMENT: usize = 16;
/// The fourth numbers, in words.
pub const FOURTH: &str = "of c0 the method's number, of c1 to c3 1";

/// The fourth numbers of all rows, in the buffers and the textures: of c0 the method's number, otherwise 1. None is 0, so that readers of
/// images that multiply by alpha lose nothing.
pub fn fourths(rows: &[CatalogueRow]) -> impl Iterator<Item = f32> {
    let of = |row: &CatalogueRow| [f32::from(method_number(row.method)), 1.0, 1.0, 1.0];
    rows.iter().flat_map(of)
}

/// The entry of the buffer's file in `catalogue.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BufferDetail {
    file: &'static str,
    layout: &'static str,
    stride: usize,
    fourth: &'static str,
}

impl BufferDetail {
    /// The entry of the file in half floats.
    pub const HALF: BufferDetail = BufferDetail {
        file: HALF_BUFFER,
        layout: "std430, little endian, no header: array<vec4<f16>>, c0 to c3 of each material",
        stride: COEFFICIENTS * ELEMENT / 2,
        fourth: FOURTH,
    };

    /// The entry, which is the same for every catalogue.
    pub const ENTRY: BufferDetail = BufferDetail {
        file: CATALOGUE_BUFFER,
        layout: "std430, little endian, no header: array<vec4<f32>>, c0 to c3 of each material",
        stride: COEFFICIENTS * ELEMENT,
        fourth: FOURTH,
    };
}

/// The file's bytes: rows in the order of the array.
pub fn catalogue_buffer(rows: &[CatalogueRow]) -> Vec<u8> {
    numbers(rows).flat_map(f32::to_le_bytes).collect()
}

/// The bytes of the file in half floats.
pub fn half_buffer(rows: &[CatalogueRow]) -> Vec<u8> {
    let halves = numbers(rows).map(half::f16::from_f32);
    halves.flat_map(half::f16::to_le_bytes).collect()
}

fn numbers(rows: &[CatalogueRow]) -> impl Iterator<Item = f32> {
    let colours = rows.iter().flat_map(|row| &row.coefficients);
    let fours = colours.zip(fourths(rows));
    fours.flat_map(|([r, g, b], fourth)| [*r as f32, *g as f32, *b as f32, fourth])
}

/// The byte offset of the material with this index.
pub(super) fn offset(place: usize) -> usize {
    place * COEFFICIENTS * ELEMENT
}
