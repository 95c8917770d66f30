//! Bakes the tables of materials: one picture for each, and one of all.

use super::picture::{Baking, functions};
use super::request::{ATLAS, BakeRequest, Error, TableMaterial, TableSize};
use super::row::{BakeRow, Baked, table_rows};
use crate::generator::lut::{Format, TableAxis, TableKind, smallest};

/// Bakes the tables. `progress` receives how many are done, of how many.
///
/// # Errors
/// No table is within the error, or a format or language refuses.
pub fn bake(
    request: &BakeRequest,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Baked>, Error> {
    let alone = request.subjects.iter();
    let alone = alone.map(|one| (one.name.as_str(), std::slice::from_ref(one)));
    let atlas = request.atlas.then_some((ATLAS, &request.subjects[..]));
    let pictures: Vec<(&str, &[TableMaterial])> = alone.chain(atlas).collect();
    let all = pictures.len() as u64;
    let mut baked = Vec::new();
    for (done, (name, materials)) in pictures.into_iter().enumerate() {
        progress(done as u64, all, name);
        baked.push(bake_picture(request, name, materials)?);
    }
    Ok(baked)
}

/// The files of one picture, with the functions that read it.
fn bake_picture(
    request: &BakeRequest,
    name: &str,
    subjects: &[TableMaterial],
) -> Result<Baked, Error> {
    let (axis, texels, formats) = chosen(request, subjects)?;
    let baking = Baking::new(request, name, subjects, (axis, texels), formats)?;
    let functions = functions(&baking)?;
    let beside: Vec<String> = functions.iter().map(|(file, _)| file.clone()).collect();
    let mut rows = Vec::new();
    let mut files = Vec::new();
    for (format, rounded) in baking.each() {
        let file = baking.file(format);
        let picture = baking.picture(format, rounded);
        let errors = &rounded.errors;
        let own = table_rows(subjects, errors, &picture, (format, &file), &beside);
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
    let depths = Format::depths(&request.formats);
    let TableKind {
        axis,
        depth,
        texels,
    } = smallest(&truths, budget, axes, &depths)?;
    let formats = request.formats.iter().copied();
    let formats = formats.filter(|format| format.depth() == depth).collect();
    Ok((axis, texels, formats))
}
