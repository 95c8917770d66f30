//! Lookup tables of a run: the materials in them, and their files as a manifest lists them.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::generator::bake::{self, Baked, TableMaterial, usual_request};
use crate::generator::emit::Artifact;
use crate::generator::emit::{Detail, OUTPUT_LICENCE, TableDetail};
use crate::generator::envelope::Report;
use crate::generator::error::{Error, RequestFault};
use crate::generator::generate::Generated;
use crate::generator::lut::TABLES;
use crate::generator::reference::Typed;
use crate::generator::request::source::{Loaded, load, same_name};
use crate::generator::request::{Materials, Source, check_transparent};
use crate::physics::materials::ViewingConditions;

/// The request for lookup tables.
#[derive(Clone, Debug)]
pub struct WantedTables {
    /// The choice of materials.
    pub materials: Materials,
    /// The medium that the light comes from; none for air.
    pub medium: Option<Source>,
    /// The viewing conditions.
    pub viewing: ViewingConditions,
}

/// The materials, sorted by name, each once, and why some that `all` includes are left out.
///
/// # Errors
/// A file or name does not exist, a material is not known at the wavelengths needed, or two have one name.
pub fn table_materials(wanted: &WantedTables) -> Result<(Vec<TableMaterial>, Vec<String>), Error> {
    let medium = wanted.medium.as_ref().map(load).transpose()?;
    if let Some(medium) = &medium {
        check_transparent(&medium.material)?;
    }
    let medium: Option<Typed> = medium.map(|medium| (medium.argument, medium.material));
    let mut ready: BTreeMap<String, (TableMaterial, String)> = BTreeMap::new();
    let mut left_out = Vec::new();
    for source in wanted.materials.sources() {
        let Loaded {
            material,
            argument,
            text,
        } = load(&source)?;
        let found = TableMaterial::new((&argument, &material), medium.as_ref(), &wanted.viewing);
        match (found, source) {
            (Err(fault), Source::BroughtAlong(_)) => left_out.push(fault.why),
            (Err(fault), _) => return Err(fault.into()),
            (Ok(found), _) => match ready.get(&found.name) {
                Some((other, its)) if *its != text => {
                    let words = [&other.argument, &found.argument].map(String::as_str);
                    return Err(same_name(&found.name, words));
                }
                _ => drop(ready.insert(found.name.clone(), (found, text))),
            },
        }
    }
    if let (true, Some(why)) = (ready.is_empty(), left_out.first()) {
        return Err(RequestFault::refused(why).into());
    }
    Ok((
        ready.into_values().map(|(found, _)| found).collect(),
        left_out,
    ))
}

/// Adds the tables of these materials and their atlas to what a run generates, for the functions called `table` to read. The run
/// does not own them: it replaces tables but removes none, since `bake` writes others beside them.
///
/// # Errors
/// A material is not known in the medium or under the viewing conditions.
pub fn add_tables(
    generated: &mut Generated,
    materials: Materials,
    medium: Option<Source>,
    viewing: ViewingConditions,
) -> Result<(), Error> {
    let wanted = WantedTables {
        materials,
        medium,
        viewing,
    };
    let (materials, _) = table_materials(&wanted)?;
    let request = usual_request(materials, &wanted.viewing);
    let baked = bake::bake(&request, &mut |_, _, _| {})?;
    generated
        .artifacts
        .extend(baked.into_iter().flat_map(artifacts));
    generated.artifacts.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(())
}

/// The files of a picture as a manifest lists them, and a file that describes them all.
pub fn artifacts(baked: Baked) -> Vec<Artifact> {
    let description = format!("{TABLES}/{}.json", baked.name);
    let row_materials = baked.row_materials();
    let text = pretty(&Report::new(&baked.command, baked.rows));
    let mut files = baked.files;
    files.push((description.clone(), text.into_bytes()));
    let detail = Detail::Table(TableDetail {
        command: baked.command,
        row_materials,
        description,
        licence: OUTPUT_LICENCE,
    });
    let listed = |(path, bytes)| Artifact {
        method: Some(baked.method.to_owned()),
        material: baked.material.clone(),
        ..Artifact::new(TABLES, path, bytes, detail.clone())
    };
    files.into_iter().map(listed).collect()
}

/// The text of a JSON file.
fn pretty(report: &impl Serialize) -> String {
    serde_json::to_string_pretty(report).expect("a report has only text keys") + "\n"
}
