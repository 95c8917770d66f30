//! The record of a flavour, and its files in memory.

use super::view::{AdapterView, view};
use crate::generator::emit::{self, AdapterDetail, Artifact, CatalogueRow, Detail, OUTPUT_LICENCE};
use crate::generator::lut::{self, SplitSumAxis};
use crate::language::targets::Finish;

/// A target adapted to one host.
#[derive(Debug)]
#[non_exhaustive]
pub struct Flavour {
    /// Its name, used for its file, for `--flavour`, for its folder, and in the table of `docs/engines.md`.
    pub name: &'static str,
    /// A description in one line.
    pub summary: &'static str,
    /// The host, with the version in which the flavour was tested, or that its documentation describes.
    pub host: &'static str,
    /// The host's documentation of the interfaces that the adapter uses, with a link.
    pub source: &'static str,
    /// How it was tested, in words: run in the host, or compiled and not run. It appears in headers, its README and
    /// `docs/engines.md`.
    pub proof: &'static str,
    /// The targets whose text it contains.
    pub languages: &'static [&'static str],
    /// The split-sum tables that it contains, if any: texels per side, axes of cosine and roughness.
    pub table: Option<(usize, [SplitSumAxis; 2])>,
    /// Its files.
    pub pages: &'static [FlavourPage],
}

/// A file of a flavour.
#[derive(Debug)]
pub struct FlavourPage {
    /// Its name. If it contains `{material}`, there is one file for each material.
    pub name: &'static str,
    /// Its template, in Tera's language. Its data: `flavours/view.rs`.
    pub template: &'static str,
}

/// The placeholder of a material's name in the name of a file.
const MATERIAL: &str = "{material}";

impl FlavourPage {
    /// Whether there is one file for each material.
    pub fn is_of_material(&self) -> bool {
        self.name.contains(MATERIAL)
    }

    /// The name of the file of a material.
    pub fn file_of(&self, material: &str) -> String {
        self.name.replace(MATERIAL, material)
    }
}

impl Flavour {
    /// Whether the flavour has a file of this name in its folder, for this material if it has one.
    pub fn has(&self, name: &str, material: Option<&str>) -> bool {
        self.pages.iter().any(|page| match material {
            Some(material) => page.is_of_material() && page.file_of(material) == name,
            None => !page.is_of_material() && page.name == name,
        })
    }

    /// Whether it has files for each material. Then a run adds to them.
    pub fn is_by_material(&self) -> bool {
        self.pages.iter().any(FlavourPage::is_of_material)
    }
}

/// An error of writing a flavour.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A language refuses a text: a bug.
    #[error(transparent)]
    Emit(#[from] emit::Error),
    /// A table cannot be made: a bug.
    #[error(transparent)]
    Table(#[from] lut::Error),
}

/// Materials, and the reference that their coefficients were fitted to.
#[derive(Clone, Copy, Debug)]
pub struct Fitted<'a> {
    /// The materials, by method and name.
    pub rows: &'a [CatalogueRow],
    /// The reference, in words.
    pub reference: &'a str,
}

/// The files of a flavour for these materials. A file that is not for one material shows all of them. If the flavour also has
/// files for each material, a later run may add materials, so such a file shows the `example` instead, whatever the run. `command`
/// gives the command that makes the file of a material again, or without a material all others.
///
/// # Errors
/// A language refuses a text, or the template engine a template: a bug.
pub fn files(
    flavour: &'static Flavour,
    materials: Fitted,
    example: Fitted,
    command: &dyn Fn(Option<&str>) -> String,
) -> Result<Vec<Artifact>, Error> {
    let shown = if flavour.is_by_material() {
        example
    } else {
        materials
    };
    let all = command(None);
    let shared = view(flavour, shown.rows, shown.reference, &all)?;
    let file = |page: &FlavourPage, material: Option<&str>, view: &AdapterView, command: &str| {
        let name = page.file_of(material.unwrap_or_default());
        let path = format!("{}/{name}", flavour.name);
        let bytes = emit::render_template(page.template, view, Finish::Text, &path)?;
        let detail = Detail::Adapter(AdapterDetail {
            command: command.to_owned(),
            host: flavour.host,
            seen: materials.reference.to_owned(),
            licence: OUTPUT_LICENCE,
        });
        Ok::<_, Error>(Artifact {
            material: material.map(str::to_owned),
            ..Artifact::new(flavour.name, path, bytes, detail)
        })
    };
    let mut files = Vec::new();
    for page in flavour.pages.iter().filter(|page| !page.is_of_material()) {
        files.push(file(page, None, &shared, &all)?);
    }
    for row in materials.rows.iter().filter(|_| flavour.is_by_material()) {
        let command = command(Some(&row.name));
        let own = shared.of_material(row, materials.reference, &command);
        for page in flavour.pages.iter().filter(|page| page.is_of_material()) {
            files.push(file(page, Some(&row.name), &own, &command)?);
        }
    }
    Ok(files)
}
