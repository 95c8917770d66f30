//! Lookup tables of a run: the materials in them, and their files as a manifest lists them.

use std::collections::BTreeMap;

use crate::generator::bake::{self, Baked, TableMaterial, usual_request};
use crate::generator::emit::Artifact;
use crate::generator::emit::{Detail, OUTPUT_LICENCE, TableDetail};
use crate::generator::envelope::{Report, json_text};
use crate::generator::error::{Error, RequestFault};
use crate::generator::generate::Generated;
use crate::generator::lut::TABLES;
use crate::generator::reference::Typed;
use crate::generator::request::source::{Loaded, load, same_name};
use crate::generator::request::{Request, check_transparent};

/// The materials of a request, sorted by name, each once, and why some that `all` includes are left out.
///
/// # Errors
/// A file or name does not exist, a material is not known at the wavelengths needed, or two have one name.
pub fn table_materials(request: &Request) -> Result<(Vec<TableMaterial>, Vec<String>), Error> {
    let medium = request.medium.as_ref().map(load).transpose()?;
    if let Some(medium) = &medium {
        check_transparent(&medium.material)?;
    }
    let medium: Option<Typed> = medium.map(|medium| (medium.argument, medium.material));
    let mut ready: BTreeMap<String, (TableMaterial, String)> = BTreeMap::new();
    let mut left_out = Vec::new();
    for source in request.materials.sources() {
        let Loaded {
            material,
            argument,
            text,
        } = load(&source)?;
        let found = TableMaterial::new((&argument, &material), medium.as_ref(), &request.viewing);
        match found {
            Err(fault) if source.is_brought_along() => left_out.push(fault.why),
            Err(fault) => return Err(fault.into()),
            Ok(found) => match ready.get(&found.name) {
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

/// Adds the tables of a request's materials and their atlas to what a run generates, for the functions called `table` to read. The run
/// does not own them: it replaces tables but removes none, since `bake` writes others beside them.
///
/// # Errors
/// A material is not known in the medium or under the viewing conditions.
pub fn add_tables(generated: &mut Generated, request: &Request) -> Result<(), Error> {
    let (materials, _) = table_materials(request)?;
    let request = usual_request(materials, &request.viewing);
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
    let text = json_text(&Report::new(&baked.command, baked.rows));
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
