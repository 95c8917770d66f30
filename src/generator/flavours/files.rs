//! The files of a flavour.

use super::flavour::{Error, Flavour, FlavourPage};
use super::view::{AdapterView, view};
use crate::generator::emit::{self, AdapterDetail, Artifact, CatalogueRow, Detail, OUTPUT_LICENCE};
use crate::language::targets::Finish;

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
    let file = |name: String,
                page: &FlavourPage,
                material: Option<&str>,
                view: &AdapterView,
                command: &str| {
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
    for (name, page, host) in flavour.shared_pages() {
        files.push(file(name, page, None, &shared.of_host(host), &all)?);
    }
    for row in materials.rows.iter().filter(|_| flavour.is_by_material()) {
        let command = command(Some(&row.name));
        let own = shared.of_material(row, materials.reference, &command);
        for page in flavour.pages.iter().filter(|page| page.is_of_material()) {
            files.push(file(
                page.file_of(&row.name),
                page,
                Some(&row.name),
                &own,
                &command,
            )?);
        }
    }
    Ok(files)
}
