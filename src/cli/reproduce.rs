//! `reproduce`: compares the thesis with our own figures.

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::output::{ReportFlags, TreeFlags};
use crate::cli::output::{Output, Progress, report_beside};
use crate::generator::envelope::Report;
use crate::generator::output::write::OutputFile;
use crate::lab::reproduce::{
    ComparisonRow, Figure, NOT_MEASURED, PARTS, Part, Reproduction, ThesisSection, comparison,
    reproduce,
};
use crate::physics::names::UnknownName;
use crate::pictures::figure_chart::figure_chart;
use crate::pictures::table;

/// The flags of `reproduce`.
#[derive(Args, Debug)]
#[command(
    mut_arg("out_dir", |arg| arg.help("Folder for the figures").default_value("reproduced")),
    after_help = "Example:\n  fresnel-gen reproduce table2 --json -")]
pub struct ReproduceFlags {
    /// Only this: table1, table2, table3, table4, table5, table6, table7, table8, claims or figures [default: all]
    #[arg(value_parser = part)]
    pub table: Option<&'static Part>,
    /// The folder for the figures.
    #[command(flatten)]
    pub figures: TreeFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// A part by its name, or a table by its number alone.
fn part(name: &str) -> Result<&'static Part, String> {
    let plain = name.trim().to_lowercase().replace([' ', '-'], "");
    let number = plain.strip_prefix("table").unwrap_or(&plain);
    let is_part =
        |part: &&Part| part.name == plain || part.name.strip_prefix("table") == Some(number);
    if let Some(part) = PARTS.iter().find(is_part) {
        return Ok(part);
    }
    let all = PARTS.each_ref().map(|part| part.name);
    let is_named = |tables: &str| tables.split(' ').any(|word| word == number);
    let unmeasured = NOT_MEASURED.iter().find(|(tables, _)| is_named(tables));
    Err(match unmeasured.filter(|_| !number.is_empty()) {
        Some((tables, why)) => {
            let all = all.join(", ");
            format!("{tables} cannot be reproduced yet: {why}; there are {all}")
        }
        None => UnknownName::new("table", name, &all).to_string(),
    })
}

/// Reproduces the requested parts.
pub fn run(flags: &ReproduceFlags, progress: Progress) -> Result<Output, Error> {
    let parts: Vec<&Part> = match flags.table {
        Some(part) => vec![part],
        None => PARTS.iter().collect(),
    };
    let reproduced = reproduce(&parts, comparison::ANGLES, progress);
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

fn json(reproduced: &Reproduction, part: Option<&Part>) -> Report<ComparisonRow> {
    let command = part.map_or("reproduce".to_owned(), |part| {
        format!("reproduce {}", part.name)
    });
    Report::new(command, reproduced.comparisons().cloned().collect())
}

/// The figures as files to be written.
fn figures(flags: &ReproduceFlags, reproduced: &Reproduction) -> Vec<OutputFile> {
    let (folder, overwrite) = (&flags.figures.out_dir, flags.figures.overwrite);
    let figures = reproduced.figures.iter().map(|figure| {
        let picture = figure_chart(figure).svg();
        OutputFile::of_report(folder.join(figure.plan.file), picture, overwrite)
    });
    figures.collect()
}

/// The width of a paragraph, in characters.
const WIDTH: usize = 110;

/// The report. If it has all parts, it also states what is not among them.
fn reproduction_text(reproduced: &Reproduction) -> String {
    let sections = &reproduced.sections;
    let mut texts: Vec<String> = sections.iter().map(section).collect();
    if sections.len() == PARTS.len() {
        texts.push(not_measured());
    }
    texts.join("\n")
}

/// The tables that have no section, with the reasons.
fn not_measured() -> String {
    let reasons: Vec<String> = NOT_MEASURED
        .iter()
        .map(|(tables, why)| format!("{tables} ({why})"))
        .collect();
    wrapped(
        &format!("Not measured yet: {}.", reasons.join("; ")),
        "",
        "  ",
    )
}

/// Remarks, each once, numbered from 1.
#[derive(Default)]
struct Notes<'a>(Vec<&'a str>);

fn section(section: &ThesisSection) -> String {
    let mut notes = Notes::default();
    let (statements, figures): (Vec<&ComparisonRow>, Vec<&ComparisonRow>) =
        section.rows.iter().partition(|row| row.is_statement());
    let (ours, both): (Vec<&ComparisonRow>, Vec<&ComparisonRow>) = figures
        .into_iter()
        .partition(|row| matches!(row.thesis, Figure::Missing(_)));
    let mut text = wrapped(&section.title, "", "  ");
    text.extend(statements.into_iter().map(statement));
    text += &beside(&both, &mut notes);
    text += &alone(&ours, &mut notes);
    text + &notes.in_words()
}

fn statement(row: &ComparisonRow) -> String {
    let head = format!(
        "\n{} ({}): {}\n",
        row.row,
        row.column,
        row.verdict.in_words()
    );
    let thesis = wrapped(&row.thesis.in_words(), "  thesis  ", "          ");
    head + &thesis + &wrapped(&row.ours.in_words(), "  ours    ", "          ")
}

/// Figures that the thesis also gives, side by side with ours.
fn beside<'a>(rows: &[&'a ComparisonRow], notes: &mut Notes<'a>) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let cells = |row: &&'a ComparisonRow| {
        let verdict = row.verdict.in_words().to_owned() + &notes.mark(&row.remark);
        vec![
            row.row.clone(),
            row.column.clone(),
            row.thesis.in_words(),
            row.ours.in_words(),
            verdict,
        ]
    };
    let rows: Vec<Vec<String>> = rows.iter().map(cells).collect();
    "\n".to_owned() + &table::text_table(&["", "", "thesis", "ours", ""], &rows)
}

/// Figures of ours alone: a line for each subject, and a new table where the columns change.
fn alone<'a>(rows: &[&'a ComparisonRow], notes: &mut Notes<'a>) -> String {
    let lines: Vec<&[&'a ComparisonRow]> = rows.chunk_by(|a, b| a.row == b.row).collect();
    let columns = |line: &[&'a ComparisonRow]| {
        line.iter()
            .map(|row| row.column.clone())
            .collect::<Vec<_>>()
    };
    let mut text = String::new();
    for lines in lines.chunk_by(|a, b| columns(a) == columns(b)) {
        let head = columns(lines[0]);
        let head: Vec<&str> = [""]
            .into_iter()
            .chain(head.iter().map(String::as_str))
            .collect();
        let cells = |line: &&[&'a ComparisonRow]| {
            let ours = line
                .iter()
                .map(|row| row.ours.in_words() + &notes.mark(&row.remark));
            [line[0].row.clone()].into_iter().chain(ours).collect()
        };
        let rows: Vec<Vec<String>> = lines.iter().map(cells).collect();
        text += "\n";
        text += &table::text_table(&head, &rows);
    }
    text
}

impl<'a> Notes<'a> {
    /// The number that refers to a remark.
    fn mark(&mut self, remark: &'a str) -> String {
        if remark.is_empty() {
            return String::new();
        }
        let place = self.0.iter().position(|note| *note == remark);
        let place = place.unwrap_or_else(|| {
            self.0.push(remark);
            self.0.len() - 1
        });
        format!(" ({})", place + 1)
    }

    fn in_words(&self) -> String {
        let lines = self.0.iter().enumerate();
        lines
            .map(|(i, note)| wrapped(note, &format!("  ({}) ", i + 1), "      "))
            .collect()
    }
}

/// Words wrapped into lines. The first line begins with `first`, the others with `other`.
fn wrapped(words: &str, first: &str, other: &str) -> String {
    let mut lines = Vec::new();
    let mut line = first.to_owned();
    let mut words = words.split(' ');
    line += words.next().unwrap_or_default();
    for word in words {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(std::mem::replace(&mut line, other.to_owned() + word));
        } else {
            line = line + " " + word;
        }
    }
    lines.push(line);
    lines.join("\n") + "\n"
}
