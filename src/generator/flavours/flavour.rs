//! What a flavour is: a plain record in a static table.
//!
//! The files of a flavour, in memory.

use super::view::{AdapterView, view};
use crate::generator::emit::{self, CatalogueRow};
use crate::generator::lut::{self, SplitSumAxis};

/// A target dressed for one host.
#[derive(Debug)]
pub struct Flavour {
    /// Its one name: file, `--flavour`, folder, row of the table in `docs/engines.md`.
    pub name: &'static str,
    /// What it is, in one line.
    pub summary: &'static str,
    /// The host, with the version that it was tried in, or that its documentation is of.
    pub host: &'static str,
    /// The host's documentation of what the adapter uses, with a link.
    pub source: &'static str,
    /// What was seen of it, in words: run in the host, or compiled and not run. It stands in headers, its README and `docs/engines.md`.
    pub proof: &'static str,
    /// The targets whose text it holds.
    pub languages: &'static [&'static str],
    /// The split-sum tables that it holds, where it does: texels of a side, axes of cosine and roughness.
    pub table: Option<(usize, [SplitSumAxis; 2])>,
    /// Its files.
    pub pages: &'static [FlavourPage],
}

/// A file of a flavour.
#[derive(Debug)]
pub struct FlavourPage {
    /// Its name; with `{material}` there is one for each material.
    pub name: &'static str,
    /// Its template, in Tera's language. What it sees: `flavours/view.rs`.
    pub template: &'static str,
}

/// What stands for the name of a material in the name of a file.
const MATERIAL: &str = "{material}";

impl FlavourPage {
    /// Whether there is one for each material.
    pub fn is_of_material(&self) -> bool {
        self.name.contains(MATERIAL)
    }

    /// The name of the file of a material.
    pub fn file_of(&self, material: &str) -> String {
        self.name.replace(MATERIAL, material)
    }
}

impl Flavour {
    /// Whether a file of this name, in the flavour's folder, is one of its files, of this material where it has one.
    pub fn has(&self, name: &str, material: Option<&str>) -> bool {
        self.pages.iter().any(|page| match material {
            Some(material) => page.is_of_material() && page.file_of(material) == name,
            None => !page.is_of_material() && page.name == name,
        })
    }

    /// Whether it has files for each material, so that a run adds to them.
    pub fn is_by_material(&self) -> bool {
        self.pages.iter().any(FlavourPage::is_of_material)
    }
}

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
