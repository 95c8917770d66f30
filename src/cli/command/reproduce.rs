//! `reproduce`: the thesis beside ours.

use crate::cli::args::ReproduceFlags;
use crate::cli::error::Error;
use crate::generator::output::write::OutputFile;
use crate::lab::reproduce::{ComparisonRow, Part, Reproduction, reproduce, thesis};
use crate::generator::envelope::Report;
use crate::cli::reproduce_text::reproduction_text;
use crate::pictures::figure_chart::figure_chart;

use crate::cli::command::{Output, Progress, report_beside};

/// Reproduces.
pub fn run(flags: &ReproduceFlags, progress: Progress) -> Result<Output, Error> {
    let parts = flags
        .table
        .as_ref()
        .map_or(Part::ALL.as_slice(), std::slice::from_ref);
    let reproduced = reproduce(parts, thesis::ANGLES, progress);
    let drawn = figures(flags, &reproduced);
    let (count, folder) = (
        drawn.len(),
        crate::physics::foreign::path(&flags.figures.out_dir),
    );
    let said = (count > 0).then(|| format!("{folder}: {count} figures"));
    let mut output = report_beside(
        reproduction_text(&reproduced),
        &json(&reproduced, flags.table),
        flags.report.json(),
        drawn,
    )?;
    output.code = u8::from(reproduced.has_findings());
    output.remarks.extend(said);
    Ok(output)
}

fn json(reproduced: &Reproduction, part: Option<Part>) -> Report<ComparisonRow> {
    let command = part.map_or("reproduce".to_owned(), |part| {
        format!("reproduce {}", part.name())
    });
    Report::new(command, reproduced.comparisons().cloned().collect())
}

/// The figures, as files that are to be written.
fn figures(flags: &ReproduceFlags, reproduced: &Reproduction) -> Vec<OutputFile> {
    let (folder, overwrite) = (&flags.figures.out_dir, flags.figures.overwrite);
    let figures = reproduced.figures.iter().map(|figure| {
        let picture = figure_chart(figure).svg();
        OutputFile::of_report(folder.join(figure.file), picture, overwrite)
    });
    figures.collect()
}
