//! `reproduce`: the thesis beside ours.

use std::path::PathBuf;

use crate::app::args::Reproduce;
use crate::app::error::Error;
use crate::app::names::unknown;
use crate::app::write::write_report;
use crate::report::Report;
use crate::report::reproduce::{
    ComparisonRow, NOT_MEASURED, Part, Reproduction, reproduce, thesis,
};

use super::{Output, Progress, replaced, report};

/// Reproduces.
pub fn run(flags: &Reproduce, progress: Progress) -> Result<Output, Error> {
    let part = flags.table.as_deref().map(part).transpose()?;
    let parts = part
        .as_ref()
        .map_or(Part::ALL.as_slice(), std::slice::from_ref);
    let reproduced = reproduce(parts, thesis::ANGLES, progress);
    let drawn = draw(flags, &reproduced)?;
    let mut output = report(
        reproduced.in_words(),
        &json(&reproduced, part),
        flags.json.as_deref(),
    )?;
    output.code = u8::from(reproduced.has_findings());
    output.remarks.extend(drawn);
    Ok(output)
}

/// A part by its name, or a table by its number alone.
fn part(name: &str) -> Result<Part, Error> {
    let plain = name.trim().to_lowercase().replace([' ', '-'], "");
    let number = plain.strip_prefix("table").unwrap_or(&plain);
    let found = Part::ALL
        .into_iter()
        .find(|part| part.name() == plain || part.name().strip_prefix("table") == Some(number));
    if let Some(part) = found {
        return Ok(part);
    }
    let all = Part::ALL.map(Part::name);
    match NOT_MEASURED
        .iter()
        .find(|(tables, _)| !number.is_empty() && tables.split(' ').any(|word| word == number))
    {
        Some((tables, why)) => Err(Error::Usage {
            what: format!(
                "{tables} cannot be reproduced yet: {why}; there are {}",
                all.join(", ")
            ),
        }),
        None => Err(unknown("table", name, &all)),
    }
}

fn json(reproduced: &Reproduction, part: Option<Part>) -> Report<ComparisonRow> {
    let command = part.map_or("reproduce".to_owned(), |part| {
        format!("reproduce {}", part.name())
    });
    Report::new(command, reproduced.comparisons().cloned().collect())
}

/// Draws the figures, and says where.
fn draw(flags: &Reproduce, reproduced: &Reproduction) -> Result<Vec<String>, Error> {
    let pictures: Vec<(PathBuf, String)> = (reproduced.drawings.iter())
        .map(|drawing| (flags.out_dir.join(&drawing.file), drawing.chart.svg()))
        .collect();
    let files: Vec<(PathBuf, &[u8])> = (pictures.iter())
        .map(|(path, text)| (path.clone(), text.as_bytes()))
        .collect();
    let old = write_report(&files, flags.overwrite)?;
    let count = files.len();
    let folder = flags.out_dir.display();
    let said = (count > 0).then(|| format!("{folder}: {count} figures"));
    Ok(replaced(&old).chain(said).collect())
}
