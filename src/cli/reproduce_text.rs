//! The report for a terminal: claims in words as paragraphs, then figures beside the thesis's, then figures that
//! the thesis does not give, then notes.

use crate::lab::reproduce::{ComparisonRow, Figure, NOT_MEASURED, Part, Reproduction, ThesisSection};
use crate::pictures::table;

/// How wide a paragraph is.
const WIDTH: usize = 110;

/// The report. Where it has all parts it also says what is not among them.
pub fn reproduction_text(reproduced: &Reproduction) -> String {
    let sections = &reproduced.sections;
    let mut texts: Vec<String> = sections.iter().map(section).collect();
    if sections.len() == Part::ALL.len() {
        texts.push(not_measured());
    }
    texts.join("\n")
}

/// The tables that have no section, and why.
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

/// Figures that the thesis gives too.
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

/// Figures of ours alone: a line a subject, and a new table where the columns change.
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
    /// The mark that leads to a remark.
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

/// Words in lines, the first after `first`, the others after `other`.
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
