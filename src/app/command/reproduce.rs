//! `reproduce`: the thesis beside ours.

use std::path::PathBuf;

use crate::app::args::ReproduceFlags;
use crate::app::error::Error;
use crate::app::write::write_report;
use crate::report::Report;
use crate::report::reproduce::{figure_chart, reproduction_text};
use crate::reproduce::{ComparisonRow, Part, Reproduction, reproduce, thesis};

use super::{Output, Progress, replaced, report};

/// Reproduces.
pub fn run(flags: &ReproduceFlags, progress: Progress) -> Result<Output, Error> {
    let parts = flags
        .table
        .as_ref()
        .map_or(Part::ALL.as_slice(), std::slice::from_ref);
    let reproduced = reproduce(parts, thesis::ANGLES, progress);
    let drawn = draw(flags, &reproduced)?;
    let mut output = report(
        reproduction_text(&reproduced),
        &json(&reproduced, flags.table),
        flags.report.json(),
    )?;
    output.code = u8::from(reproduced.has_findings());
    output.remarks.extend(drawn);
    Ok(output)
}

fn json(reproduced: &Reproduction, part: Option<Part>) -> Report<ComparisonRow> {
    let command = part.map_or("reproduce".to_owned(), |part| {
        format!("reproduce {}", part.name())
    });
    Report::new(command, reproduced.comparisons().cloned().collect())
}

/// Draws the figures, and says where.
fn draw(flags: &ReproduceFlags, reproduced: &Reproduction) -> Result<Vec<String>, Error> {
    let folder = &flags.figures.out_dir;
    let pictures: Vec<(PathBuf, String)> = (reproduced.figures.iter())
        .map(|figure| (folder.join(figure.file), figure_chart(figure).svg()))
        .collect();
    let files: Vec<(PathBuf, &[u8])> = (pictures.iter())
        .map(|(path, text)| (path.clone(), text.as_bytes()))
        .collect();
    let old = write_report(&files, flags.figures.overwrite)?;
    let count = files.len();
    let said = (count > 0).then(|| format!("{}: {count} figures", crate::foreign::path(&folder)));
    Ok(replaced(&old).chain(said).collect())
}
