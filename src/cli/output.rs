//! The output of a run: text or a file for stdout, remarks, an exit code; and reports as text or as JSON.
//!
//! Text is made safe for a terminal: characters that move its cursor, change its title or reverse its lines are shown as escapes.
//! This is a second line of defence: messages hold no such characters, since [`foreign`](crate::physics::foreign) cleans foreign
//! text before it is put in.

use std::path::Path;

use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::places::{refuse_one_place, replaced};
use crate::generator::envelope::json_text;
use crate::generator::error::RequestFault;
use crate::generator::output::write::{OutputFile, write_outputs};
use crate::physics::foreign;
use crate::physics::materials::{escaped, is_hidden};

/// The output of a run: text or a file for stdout, remarks for stderr, the exit code.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Output {
    /// For stdout.
    pub stdout: Vec<u8>,
    /// Whether stdout is a file, which is written byte for byte, rather than text for people.
    pub is_file: bool,
    /// For stderr, a line each.
    pub remarks: Vec<String>,
    /// 0 done, 1 findings, 2 help where nothing was requested, 3 a check was not made. For faults see `Error::exit_code`.
    pub code: u8,
}

/// Receives the progress of long work: the number done, the total, and what is counted.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64, &str);

/// Refuses a time limit of 0, and one that overflows a clock.
pub fn check_limit(seconds: u64) -> Result<(), Error> {
    const MOST_SECONDS: u64 = 86_400;
    if (1..=MOST_SECONDS).contains(&seconds) {
        return Ok(());
    }
    Err(RequestFault::OutOfRange {
        flag: "limit",
        value: format!("{seconds} seconds"),
        allowed: format!("is 1 to {MOST_SECONDS}"),
    }
    .into())
}

/// An SVG document as PNG.
pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, Error> {
    crate::pictures::png::png(svg, scale).map_err(Error::usage)
}

/// A report as text, or as JSON where that was requested. JSON on stdout stands there alone.
pub fn report<T: Serialize>(text: String, json: &T, file: Option<&Path>) -> Result<Output, Error> {
    report_beside(text, json, file, Vec::new())
}

/// A report and the other files of its run: all are written, or none. Files of the folder that were replaced are named.
pub fn report_beside<T: Serialize>(
    text: String,
    json: &T,
    file: Option<&Path>,
    mut files: Vec<OutputFile>,
) -> Result<Output, Error> {
    let (output, own) = reported(text, json, file);
    files.extend(own);
    refuse_one_place(&files.iter().map(OutputFile::path).collect::<Vec<_>>())?;
    let old = write_outputs(&files)?;
    Ok(Output {
        remarks: replaced(&old).collect(),
        ..output
    })
}

/// A report and files that the user names, each of which may be stdout: it stands there alone.
pub fn report_with_files<T: Serialize>(
    text: String,
    json: &T,
    file: Option<&Path>,
    named: Vec<(&Path, Vec<u8>)>,
) -> Result<Output, Error> {
    let (mut output, own) = reported(text, json, file);
    let mut files: Vec<OutputFile> = own.into_iter().collect();
    for (file, bytes) in named {
        if file == Path::new("-") {
            output.stdout = bytes;
            output.is_file = true;
        } else {
            files.push(OutputFile::named(file, bytes));
        }
    }
    write_outputs(&files)?;
    Ok(output)
}

/// Refuses more than one output on stdout, and two in one file. `flags` are their names.
pub fn check_places(flags: &str, places: &[Option<&Path>]) -> Result<(), Error> {
    let given: Vec<&Path> = places.iter().copied().flatten().collect();
    let twice = given
        .iter()
        .enumerate()
        .find(|(i, place)| given[..*i].contains(place));
    match twice {
        None => Ok(()),
        Some((_, place)) => Err(Error::usage(format!(
            "{flags} want different places, and `{}` is named twice",
            foreign::path(place)
        ))),
    }
}

/// Rows as CSV, with their keys as the head.
pub fn csv_text<T: Serialize>(rows: &[T]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer
            .serialize(row)
            .expect("rows are flat, and memory has room");
    }
    finished(writer)
}

/// Records of text as CSV.
pub fn csv_records(records: impl Iterator<Item = Vec<String>>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for record in records {
        writer
            .write_record(record)
            .expect("records are of one length, and memory has room");
    }
    finished(writer)
}

fn finished(writer: csv::Writer<Vec<u8>>) -> String {
    let bytes = writer.into_inner().expect("memory has room");
    escaped(&String::from_utf8(bytes).expect("cells are text"))
}

/// The printed part of a report, and its file where it has one.
pub fn reported<T: Serialize>(
    text: String,
    json: &T,
    file: Option<&Path>,
) -> (Output, Option<OutputFile>) {
    let output = |stdout: String, is_file| Output {
        stdout: stdout.into_bytes(),
        is_file,
        ..Output::default()
    };
    let Some(file) = file else {
        return (output(text, false), None);
    };
    let json = escaped(&json_text(json));
    if file == Path::new("-") {
        return (output(json, true), None);
    }
    (output(text, false), Some(OutputFile::named(file, json)))
}

/// The text with control characters as escapes, such as `\u{1b}`. Line breaks and tabs stay.
pub fn legible(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(c) = letters.next() {
        let ends_line = c == '\n' || c == '\r' && letters.peek() == Some(&'\n');
        if is_hidden(c) && !ends_line && c != '\t' {
            safe += &format!("\\u{{{:x}}}", u32::from(c));
        } else {
            safe.push(c);
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::legible;

    #[test]
    fn what_a_terminal_obeys_is_shown() {
        for (text, shown) in [
            (
                "plain \u{3bb}\ttext\r\nend\n",
                "plain \u{3bb}\ttext\r\nend\n",
            ),
            ("\u{1b}[31mred", "\\u{1b}[31mred"),
            ("\u{1b}]0;title\u{7}", "\\u{1b}]0;title\\u{7}"),
            ("a\u{9b}b\u{7f}c\rd", "a\\u{9b}b\\u{7f}c\\u{d}d"),
            (
                "a\u{202e}b\u{2066}c\u{2028}d",
                "a\\u{202e}b\\u{2066}c\\u{2028}d",
            ),
        ] {
            assert_eq!(legible(text), shown);
        }
    }
}
