//! The files of a flavour, in memory.

use crate::generator::emit::{self, CatalogueRow};
use crate::generator::lut;

use super::flavour::{Flavour, FlavourPage};
use super::view::{AdapterView, view};

/// A file of a flavour, in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct FlavourFile {
    /// Below the flavour's folder.
    pub name: String,
    /// The material of a file that is written for each.
    pub material: Option<String>,
    /// The command that makes it again.
    pub command: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// Commands that make files again, as a user types them.
pub struct Commands<'a> {
    /// All files of the flavour.
    pub all: String,
    /// Those of one material, by its name.
    pub of_material: &'a dyn Fn(&str) -> String,
}

/// What cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A text is refused: a bug.
    #[error(transparent)]
    Emit(#[from] emit::Error),
    /// A table cannot be: a bug.
    #[error(transparent)]
    Table(#[from] lut::Error),
}

/// Materials, and what the reference is that their coefficients were fitted to, in words.
#[derive(Clone, Copy, Debug)]
pub struct Fitted<'a> {
    /// The materials, by method and name.
    pub rows: &'a [CatalogueRow],
    /// The reference.
    pub reference: &'a str,
}

/// The files of a flavour for these materials. Files that are not of one material see all of them, but where the flavour has files for
/// each: then a later run adds materials, and these files show the `example` instead, whatever the run is.
///
/// # Errors
/// A text is refused by its language, or a template by its engine: a bug.
pub fn files(
    flavour: &'static Flavour,
    materials: Fitted,
    example: Fitted,
    commands: &Commands,
) -> Result<Vec<FlavourFile>, Error> {
    let shown = if flavour.is_by_material() {
        example
    } else {
        materials
    };
    let shared = view(flavour, shown.rows, shown.reference, &commands.all)?;
    let mut files = Vec::new();
    for page in flavour.pages.iter().filter(|page| !page.is_of_material()) {
        files.push(file(flavour, page, (None, &commands.all), &shared)?);
    }
    for row in materials.rows.iter().filter(|_| flavour.is_by_material()) {
        let command = (commands.of_material)(&row.name);
        let own = shared.of_material(row, materials.reference, &command);
        for page in flavour.pages.iter().filter(|page| page.is_of_material()) {
            files.push(file(flavour, page, (Some(&row.name), &command), &own)?);
        }
    }
    Ok(files)
}

fn file(
    flavour: &Flavour,
    page: &FlavourPage,
    (material, command): (Option<&str>, &str),
    view: &AdapterView,
) -> Result<FlavourFile, Error> {
    let name = material.map_or_else(|| page.name.to_owned(), |material| page.file_of(material));
    Ok(FlavourFile {
        bytes: emit::text_of_template(page.template, view, &format!("{}/{name}", flavour.name))?,
        name,
        material: material.map(str::to_owned),
        command: command.to_owned(),
    })
}
