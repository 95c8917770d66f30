//! The lines above the numbers of a format's file: mark, command, what the material is, errors, remarks.

use super::engine_material::EngineMaterial;
use super::format::{Format, Notes};
use crate::generator::emit::{MARK, OUTPUT_LICENCE, comment_lines};

/// The command as a line.
pub fn regenerate(notes: &Notes) -> String {
    format!("Regenerate: {}", notes.command)
}

/// The lines of the head, without the mark and the command.
pub fn about(format: &Format, material: &EngineMaterial, notes: &Notes) -> Vec<String> {
    let own = &material.subject.material;
    let around = match &material.subject.medium {
        Some((_, medium)) => format!(", in {}", medium.name),
        None => String::new(),
    };
    let mut lines = vec![
        format!("Licence of this file: {OUTPUT_LICENCE}"),
        format!("{}{around}: {}", own.name, own.summary),
    ];
    lines.extend(own.data_line());
    lines.extend([
        format!("Format: {}", format.summary),
        format!("Colours: {}", material.subject.reference.surface.seen),
    ]);
    lines.extend(material.hex().map(|hex| format!("F0 in sRGB: {hex}")));
    lines.extend(
        notes
            .errors
            .iter()
            .map(|error| format!("{}.", error.line())),
    );
    lines.extend(
        notes
            .remarks
            .iter()
            .map(|remark| format!("Remark: {remark}.")),
    );
    lines
}

/// The whole head as comments with this start.
pub fn comments(start: &str, format: &Format, material: &EngineMaterial, notes: &Notes) -> String {
    let mut lines = vec![MARK.to_owned(), regenerate(notes)];
    lines.extend(about(format, material, notes));
    let lines = comment_lines(lines);
    let lines = lines.iter().map(|line| format!("{start} {line}\n"));
    lines.collect()
}
