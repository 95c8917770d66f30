//! The catalogue of fitted coefficients: an array in each language, JSON, a storage buffer, and textures. A run that names
//! neither methods nor materials writes the arrays. A run without flags also writes the files that belong to no language.

use serde::Serialize;

use crate::generator::command_line::CommandLine;
use crate::generator::emit::Artifact;
use crate::generator::emit::{
    self, BufferDetail, CATALOGUE_BUFFER, COEFFICIENT_ORDER, COEFFICIENTS, CatalogueDetail,
    CatalogueMaterial, CatalogueMethod, CatalogueRow, Detail, Naming, OUTPUT_LICENCE,
};
use crate::generator::envelope::{Origin, TOOL, json_text};
use crate::generator::error::Error;
use crate::generator::generate::Generated;
use crate::generator::lut::{CatalogueTexture, CatalogueTextureDetail};
use crate::generator::output::ownership::SHARED;
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request, Source};
use crate::physics::spectra::Space;

/// The version of the format of `catalogue.json`. In version 1, coefficients were grouped by channel.
const SCHEMA: u32 = 2;

/// Adds the arrays of the run's languages, and in a run without flags the files that belong to no language. The run owns all of
/// them.
///
/// # Errors
/// A material is not known under the request's viewing conditions, or a language refuses a name.
pub fn add_catalogue(generated: &mut Generated, request: &Request) -> Result<(), Error> {
    let (rows, reference) = match recorded_rows(request) {
        Some(rows) => (rows, request.viewing.reference_in_words()),
        None => derived_rows(request)?,
    };
    for target in request.targets_or_default() {
        let command = command(request, Some(target.name))?;
        let file = emit::catalogue_array(target, &rows, &request.naming(), &reference, &command)?;
        generated.artifacts.extend(file);
    }
    if generated.scope.whole {
        generated
            .artifacts
            .extend(shared(&rows, &reference, request)?);
        let targets = SHARED.map(|(_, target)| target.to_owned());
        generated.scope.targets.extend(targets);
    }
    generated.artifacts.sort_by(|a, b| a.path.cmp(&b.path));
    generated.scope.shared = true;
    Ok(())
}

/// The materials that are known under the request's viewing conditions. Those known only at three wavelengths have no spectrum.
fn subjects(request: &Request) -> Result<Vec<MaterialInMedium>, Error> {
    let mut subjects = request.subjects()?.materials();
    let of_spectra = request.viewing.wavelengths_nm.is_none();
    subjects.retain(|subject| !of_spectra || subject.material.rgb_nm.is_none());
    Ok(subjects)
}

fn recorded_rows(request: &Request) -> Option<Vec<CatalogueRow>> {
    match request.medium {
        None => emit::recorded_catalogue(&request.viewing),
        Some(_) => None,
    }
}

/// The rows of a request and the reference in words, derived from the spectra. The words are the same for all materials. Where an
/// index is held constant beyond its range, its row says so.
///
/// # Errors
/// A material is not known under the request's viewing conditions.
pub fn derived_rows(request: &Request) -> Result<(Vec<CatalogueRow>, String), Error> {
    let request = Request {
        materials: Materials::All,
        ..request.clone()
    };
    let subjects = subjects(&request)?;
    let rows = emit::catalogue_rows(&subjects, &request.naming())?;
    let first = subjects.first();
    let reference = first.map(|subject| subject.reference.surface.seen.clone());
    Ok((rows, reference.unwrap_or_default()))
}

/// The command that writes a target's array with its part of the tree, or all arrays.
fn command(request: &Request, target: Option<&str>) -> Result<String, Error> {
    let medium = request.medium.as_ref();
    let medium = medium.map(Source::argument).transpose()?;
    Ok(CommandLine::new(TOOL)
        .list("target", target)
        .list("medium", medium)
        .list("prefix", Naming::flag_of_prefix(&request.prefix))
        .seen_as(&request.viewing)
        .into())
}

/// `catalogue.json`: the viewing conditions, the files with the same numbers, the methods, and the materials with their
/// coefficients.
#[derive(Serialize)]
struct CatalogueFile<'a> {
    #[serde(flatten)]
    origin: Origin,
    truth: &'a str,
    space: Option<&'static str>,
    licence: &'static str,
    order: &'static str,
    first_dielectric: usize,
    buffer: BufferDetail,
    textures: [CatalogueTextureDetail; 2],
    methods: Vec<CatalogueMethod>,
    materials: Vec<CatalogueMaterial<'a>>,
}

/// The files that belong to no language; empty if no material has a fitted method.
fn shared(
    rows: &[CatalogueRow],
    reference: &str,
    request: &Request,
) -> Result<Vec<Artifact>, Error> {
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    let command = command(request, None)?;
    let is_spectral = request.viewing.wavelengths_nm.is_none();
    let space = is_spectral.then_some(request.viewing.integration.space);
    let files = SHARED.map(|(path, target)| {
        let texture = CatalogueTexture::ALL.into_iter();
        let mut texture = texture.filter(|texture| texture.file() == path);
        let bytes = match texture.next() {
            Some(texture) => texture.encode(rows, space),
            None if path == CATALOGUE_BUFFER => emit::catalogue_buffer(rows),
            None => as_json(rows, reference, space, &command).into_bytes(),
        };
        let detail = Detail::Catalogue(CatalogueDetail {
            command: command.clone(),
            array: None,
            materials: rows.len(),
            rows: (path == CATALOGUE_BUFFER).then_some(COEFFICIENTS * rows.len()),
            seen: reference.to_owned(),
            licence: OUTPUT_LICENCE,
        });
        Artifact::new(target, path.to_owned(), bytes, detail)
    });
    Ok(files.into())
}

fn as_json(rows: &[CatalogueRow], reference: &str, space: Option<Space>, command: &str) -> String {
    let file = CatalogueFile {
        origin: Origin::new(command).with_schema(SCHEMA),
        truth: reference,
        space: space.map(Space::name),
        licence: OUTPUT_LICENCE,
        order: COEFFICIENT_ORDER,
        first_dielectric: emit::first_dielectric(rows),
        buffer: BufferDetail::ENTRY,
        textures: CatalogueTexture::ALL.map(|texture| texture.detail(rows)),
        methods: CatalogueMethod::all(rows),
        materials: CatalogueMaterial::all(rows),
    };
    json_text(&file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::request::Methods;
    use crate::language::methods::Method;
    use crate::language::targets::Target;
    use crate::physics::num::Precision;

    #[test]
    fn a_run_that_selects_nothing_writes_it() {
        let usual = Request::new;
        assert!(usual().selects_nothing());
        assert!(usual().target(Target::GLES).selects_nothing());
        assert!(!usual().method(Method::FITTED).selects_nothing());
        assert!(!usual().material("gold").selects_nothing());
        assert!(!usual().precision(Precision::F16).selects_nothing());
        let all = Request {
            methods: Methods::All,
            ..usual()
        };
        assert!(!all.selects_nothing());
    }
}
