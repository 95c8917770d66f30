//! The functions that read a picture in a shader: one file for each language.

use crate::generator::emit;
use crate::generator::lut::{TABLES, lookup};
use crate::language::targets::Target;

use super::Error;
use super::picture::Baking;
use super::row;

/// Paths and bytes.
pub fn files(baking: &Baking) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let targets = baking.request.targets.iter();
    targets.map(|target| file(baking, target)).collect()
}

fn file(baking: &Baking, target: &'static Target) -> Result<(String, Vec<u8>), Error> {
    let name = baking.name;
    let path = format!("{TABLES}/{}/{name}.{}", target.name, target.extension);
    let function = lookup(
        baking.axis,
        baking.texels,
        shared_scale(baking),
        baking.subjects.len(),
    );
    let function = function.map_err(|fault| emit::Error::Generated {
        file: path.clone(),
        what: fault.to_string(),
    })?;
    let emitted = format!("{}{name}_lookup", baking.request.prefix);
    let bytes = emit::lookup(target, emitted, function, about(baking, target))?;
    Ok((path, bytes))
}

/// The scale of all files, where they have one.
fn shared_scale(baking: &Baking) -> Option<f32> {
    let mut scales = baking.by_depth().map(|(_, rounded)| rounded.scale());
    let first = scales.next().unwrap_or(1.0);
    scales.all(|scale| scale == first).then_some(first)
}

/// The head: what all files of the picture say, and what differs from file to file.
fn about(baking: &Baking, target: &'static Target) -> Vec<String> {
    let Some((format, rounded)) = baking.each().next() else {
        return Vec::new();
    };
    let picture = baking.picture(format, rounded);
    let mut lines = baking.about(&baking.formats, &[target], &picture);
    if picture.height() > 1 {
        lines.push("row: v of that row's middle, as above.".to_owned());
    }
    match shared_scale(baking) {
        Some(_) => lines.extend(picture.scaling()),
        None => lines.push(scales(baking)),
    }
    lines.extend(baking.by_depth().map(|(names, rounded)| {
        let errors = row::error_line(&rounded.errors);
        format!("{names}: {errors}")
    }));
    lines
}

/// Which scale belongs to which files.
fn scales(baking: &Baking) -> String {
    let each = baking.by_depth();
    let scales: Vec<String> = each
        .map(|(names, rounded)| format!("{:?} for {names}", rounded.scale()))
        .collect();
    format!("table_scale: {}.", scales.join("; "))
}
