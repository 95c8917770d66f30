//! The record of an exchange format, a material exported to one, and the lines above the numbers of its file: mark, command, what the
//! material is, errors, remarks.

use super::coat::ClearCoat;
use super::engine_material::{Body, EngineMaterial, ExchangeFault};
use super::model::NodeError;
use super::sheet::{Node, Sheet};
use crate::generator::emit::{MARK, OUTPUT_LICENCE, comment_lines};
use crate::physics::spectra::Space;

/// A format that engines or tools read.
#[derive(Debug)]
pub struct Format {
    /// Its name, used for its file, for `--as`, and in the table of `docs/materials.md`.
    pub name: &'static str,
    /// A description in one line.
    pub summary: &'static str,
    /// The working spaces that its colours may be in.
    pub spaces: &'static [Space],
    /// Whether it has a film of its own.
    pub has_film: bool,
    /// Its clear coat, if it has one whose formula is known.
    pub coat: Option<ClearCoat>,
    /// The format's nodes with their numbers, and what was clamped.
    pub sheet: fn(&EngineMaterial) -> Sheet,
    /// The text of the file.
    pub text: fn(&EngineMaterial, &Sheet, &Notes) -> String,
}

/// What the text says besides the numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Notes {
    /// The command that writes the file again.
    pub command: String,
    /// The error of each node.
    pub errors: Vec<NodeError>,
    /// What was clamped or left out.
    pub remarks: Vec<String>,
}

/// A material exported to a format.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// The text of the file.
    pub text: String,
    /// The error of each node, in the order of the file.
    pub errors: Vec<NodeError>,
    /// What was clamped or left out. The text says it too.
    pub remarks: Vec<String>,
}

/// Where no roughness is written, formats use their default: glTF and Filament 1, USD, Blender and Unreal .5, OpenPBR .3.
const SMOOTH: &str = "roughness is 0, a smooth surface; set your own";

impl Format {
    /// A material in this format. `command` writes the file again.
    ///
    /// # Errors
    /// The format takes no colours of this space.
    pub fn export(
        &self,
        material: &EngineMaterial,
        command: &str,
    ) -> Result<Exported, ExchangeFault> {
        if let Some(space) = material.space.filter(|space| !self.spaces.contains(space)) {
            let allowed: Vec<&str> = self.spaces.iter().map(|space| space.name()).collect();
            return Err(ExchangeFault::Space {
                format: self.name,
                space: space.name(),
                allowed: allowed.join(", "),
            });
        }
        let takes_it = self.has_film && material.film.is_some();
        let is_dielectric = material.body != Body::Conductor;
        if material.subject.has_films() && is_dielectric && !takes_it {
            return Err(ExchangeFault::Filmed {
                name: material.subject.name.clone(),
            });
        }
        let mut sheet = (self.sheet)(material);
        if let Some(index) = material.coat {
            let coat = self.coat_of(index)?;
            sheet.nodes.retain(|node| node.name == coat.node);
            for node in &mut sheet.nodes {
                node.fields.extend((coat.fields)(index));
            }
            sheet.remarks.extend(coat.remark.map(str::to_owned));
        }
        let coat = self.coat.as_ref();
        let error = |node: &Node| NodeError::of(node.name, &node.model, material, coat);
        let notes = Notes {
            command: command.to_owned(),
            errors: sheet.nodes.iter().map(error).collect(),
            remarks: material
                .remarks()
                .chain(sheet.remarks.clone())
                .chain([SMOOTH.to_owned()])
                .collect(),
        };
        let text = (self.text)(material, &sheet, &notes);
        Ok(Exported {
            text,
            errors: notes.errors,
            remarks: notes.remarks,
        })
    }

    /// Its clear coat of this index.
    fn coat_of(&self, index: f64) -> Result<&ClearCoat, ExchangeFault> {
        let named = |wanted: fn(&ClearCoat) -> bool| {
            let formats = super::ALL
                .iter()
                .filter(|one| one.coat.as_ref().is_some_and(wanted));
            formats.map(|one| one.name).collect::<Vec<_>>().join(", ")
        };
        let coat = self.coat.as_ref().ok_or_else(|| ExchangeFault::NoCoat {
            format: self.name,
            allowed: named(|_| true),
        })?;
        match coat.law.only_index() {
            Some(only) if only != index => Err(ExchangeFault::CoatIndex {
                format: self.name,
                index,
                allowed: named(|coat| coat.law.only_index().is_none()),
            }),
            _ => Ok(coat),
        }
    }
}

/// The command as a line.
pub fn regenerate(notes: &Notes) -> String {
    format!("Regenerate: {}", notes.command)
}

/// The lines of the head, without the mark and the command.
pub fn about(format: &Format, material: &EngineMaterial, notes: &Notes) -> Vec<String> {
    let own = &material.subject.material;
    let around = match &material.subject.medium {
        Some((_, medium)) => format!(", in {}", medium.name),
        None => material.coat.map_or_else(String::new, |index| {
            format!(", below a clear coat of {index}")
        }),
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
