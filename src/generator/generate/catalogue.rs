//! The catalogue of fitted coefficients: an array in each language, JSON, a storage buffer, and textures. A run that names
//! neither methods nor materials writes the arrays. A run without flags also writes the files that belong to no language. A run with
//! `--catalogue` writes all of them of its own materials.

use serde::Serialize;

use crate::generator::command_line::CommandLine;
use crate::generator::emit::Artifact;
use crate::generator::emit::{
    self, BufferDetail, CATALOGUE_BUFFER, COEFFICIENT_ORDER, COEFFICIENTS, CatalogueDetail,
    CatalogueMaterial, CatalogueMethod, CatalogueRow, Detail, HALF_BUFFER, Naming, OUTPUT_LICENCE,
    RowOrder,
};
use crate::generator::envelope::{Origin, TOOL, json_text};
use crate::generator::error::{Error, RequestFault};
use crate::generator::generate::{Generated, KeptMethods, Run, generate_beside};
use crate::generator::lut::{CatalogueTexture, CatalogueTextureDetail};
use crate::generator::output::contents::has_no_room_for_mark;
use crate::generator::output::ownership::SHARED;
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Methods, Request, Source};
use crate::language::methods::Method;
use crate::physics::foreign::Foreign;
use crate::physics::spectra::Space;

/// The version of the format of `catalogue.json`. In version 1, coefficients were grouped by channel, in version 2 the fourth numbers were
/// all 1.
const SCHEMA: u32 = 3;

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
    let with_shared = generated.scope.whole;
    add_rows(
        generated,
        &rows,
        RowOrder::ByMethod,
        &reference,
        with_shared,
        request,
    )
}

/// The catalogue of a request's own materials: their rows in the order in which they are named, as arrays of the request's languages and
/// as the files that belong to no language, and the library functions that take these rows. All materials together are in the order of
/// the usual catalogue.
///
/// # Errors
/// A material has no fitted method of four coefficients, or is not known under the request's viewing conditions; or a language refuses a
/// name.
pub fn own_catalogue(request: &Request) -> Result<Generated, Error> {
    let run = Run::new(request)?;
    let subjects: Vec<MaterialInMedium> = run.subjects.iter().map(|(one, _)| one.clone()).collect();
    if subjects.is_empty() {
        let why = "--catalogue wants materials: name them, or all";
        return Err(RequestFault::refused(why.to_owned()).into());
    }
    let subjects_named: Vec<String> = subjects.iter().map(|one| one.name.clone()).collect();
    let (rows, order) = match request.materials {
        Materials::All => {
            let rows = emit::catalogue_rows(&subjects, &request.naming())?;
            (rows, RowOrder::ByMethod)
        }
        _ => (rows_as_named(request, subjects)?, RowOrder::AsGiven),
    };
    let library = Request {
        catalogue: false,
        materials: Materials::None,
        // Both, so that what reads rows compiles whichever materials are in the list.
        methods: Methods::These(vec![Method::FITTED, Method::FITTED_DIELECTRIC]),
        ..request.clone()
    };
    let mut generated = generate_beside(&library, &KeptMethods::new())?;
    let without_row = subjects_named
        .iter()
        .filter(|name| rows.iter().all(|row| row.name != **name));
    let without_row =
        without_row.map(|name| format!("`{name}`, which has no row of four coefficients"));
    generated.refused.extend(without_row);
    generated.provenance = run.provenance();
    generated.left_out.clone_from(&run.left_out);
    let first = run.subjects.first();
    let reference = first.map(|(subject, _)| subject.reference.surface.seen.clone());
    add_rows(
        &mut generated,
        &rows,
        order,
        &reference.unwrap_or_default(),
        true,
        request,
    )?;
    Ok(generated)
}

/// The rows of the materials in the order in which the request names them.
fn rows_as_named(
    request: &Request,
    mut subjects: Vec<MaterialInMedium>,
) -> Result<Vec<CatalogueRow>, Error> {
    let sources = request.materials.sources();
    let named = sources.iter().map(Source::argument);
    let named = named.collect::<Result<Vec<String>, Error>>()?;
    let typed = sources
        .iter()
        .zip(&named)
        .filter(|(source, _)| !source.is_brought_along());
    let typed: Vec<String> = typed.map(|(_, argument)| argument.clone()).collect();
    if let [argument, ..] = twice(&typed, &subjects).as_slice() {
        let name = Foreign(argument);
        let why = format!(
            "`{name}` is named twice: each material has one row, so that those behind it would have other numbers than their places; name it once"
        );
        return Err(RequestFault::refused(why).into());
    }
    let place = |subject: &MaterialInMedium| named.iter().position(|one| *one == subject.argument);
    subjects.sort_by_key(place);
    // `all` means those that have a row.
    let brought = sources
        .iter()
        .zip(&named)
        .filter(|(source, _)| source.is_brought_along());
    let brought: Vec<&String> = brought.map(|(_, argument)| argument).collect();
    let has_row = |one: &MaterialInMedium| !one.has_films() && one.fitted_with_four().is_some();
    subjects.retain(|subject| has_row(subject) || !brought.contains(&&subject.argument));
    emit::rows_in_order(&subjects, &request.naming())?.map_err(|place| {
        let subject = &subjects[place];
        let (name, why) = (Foreign(&subject.name), subject.has_films());
        let why = if why {
            "lies under films, and its fitted method has six coefficients: a row has four"
        } else {
            "has no fitted method of four coefficients: its index is too near to its medium's, as that of a gas, or below it"
        };
        RequestFault::refused(format!("`{name}` {why}; leave it out of --catalogue")).into()
    })
}

/// The words that name a material which another word before them names.
fn twice(named: &[String], subjects: &[MaterialInMedium]) -> Vec<String> {
    let is_first = |i: usize| !named[..i].contains(&named[i]);
    // Of two words for one material one is left among the subjects.
    let is_known = |word: &String| subjects.iter().any(|subject| subject.argument == *word);
    let words = (0..named.len()).filter(|i| !is_first(*i) || !is_known(&named[*i]));
    words.map(|i| named[i].clone()).collect()
}

/// Adds the arrays of the run's languages and, if they are wanted, the files that belong to no language.
fn add_rows(
    generated: &mut Generated,
    rows: &[CatalogueRow],
    order: RowOrder,
    reference: &str,
    with_shared: bool,
    request: &Request,
) -> Result<(), Error> {
    for target in request.targets_or_default() {
        let command = command(request, Some(target.name))?;
        let naming = request.naming();
        let file = emit::catalogue_array(target, rows, order, &naming, reference, &command)?;
        generated.artifacts.extend(file);
    }
    if with_shared {
        let files = shared(rows, order, reference, request)?;
        generated.artifacts.extend(files);
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
    let sources = match &request.materials {
        _ if !request.catalogue => Vec::new(),
        Materials::All => vec!["all".to_owned()],
        materials => {
            let sources = materials.sources();
            let words = sources.iter().map(Source::argument);
            words.collect::<Result<_, Error>>()?
        }
    };
    // The files that belong to no language come with each language.
    let all = request.targets.iter().map(|one| one.name);
    let targets: Vec<&str> = match target {
        Some(target) => vec![target],
        None if request.catalogue => all.collect(),
        None => Vec::new(),
    };
    Ok(CommandLine::new(TOOL)
        .list("target", targets)
        .list("material", sources)
        .switch("catalogue", request.catalogue)
        .list("medium", medium)
        .list("prefix", Naming::flag_of_prefix(&request.prefix))
        .list(
            "precision",
            request
                .precision
                .is_half()
                .then(|| request.precision.name()),
        )
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
    first_dielectric: Option<usize>,
    precision: &'static str,
    buffer: BufferDetail,
    half_buffer: Option<BufferDetail>,
    textures: [CatalogueTextureDetail; 2],
    methods: Vec<CatalogueMethod>,
    materials: Vec<CatalogueMaterial<'a>>,
}

/// The files that belong to no language; empty if no material has a fitted method.
fn shared(
    rows: &[CatalogueRow],
    order: RowOrder,
    reference: &str,
    request: &Request,
) -> Result<Vec<Artifact>, Error> {
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    let command = command(request, None)?;
    let is_spectral = request.viewing.wavelengths_nm.is_none();
    let space = is_spectral.then_some(request.viewing.integration.space);
    let is_half = request.precision.is_half();
    let wanted = SHARED.into_iter();
    let wanted = wanted.filter(|(path, _)| is_half || *path != HALF_BUFFER);
    let files = wanted.map(|(path, target)| {
        let texture = CatalogueTexture::ALL.into_iter();
        let mut texture = texture.filter(|texture| texture.file() == path);
        let bytes = match texture.next() {
            Some(texture) => texture.encode(rows, space),
            None if path == CATALOGUE_BUFFER => emit::catalogue_buffer(rows),
            None if path == HALF_BUFFER => emit::half_buffer(rows),
            None => as_json(rows, order, reference, space, request, &command).into_bytes(),
        };
        let detail = Detail::Catalogue(CatalogueDetail {
            command: command.clone(),
            array: None,
            materials: rows.len(),
            rows: has_no_room_for_mark(path).then_some(COEFFICIENTS * rows.len()),
            row_materials: match path == CATALOGUE_BUFFER {
                true => rows.iter().map(|row| row.name.clone()).collect(),
                false => Vec::new(),
            },
            seen: reference.to_owned(),
            licence: OUTPUT_LICENCE,
        });
        Artifact::new(target, path.to_owned(), bytes, detail)
    });
    Ok(files.collect())
}

fn as_json(
    rows: &[CatalogueRow],
    order: RowOrder,
    reference: &str,
    space: Option<Space>,
    request: &Request,
    command: &str,
) -> String {
    let file = CatalogueFile {
        origin: Origin::new(command).with_schema(SCHEMA),
        truth: reference,
        space: space.map(Space::name),
        licence: OUTPUT_LICENCE,
        order: COEFFICIENT_ORDER,
        first_dielectric: (order == RowOrder::ByMethod).then(|| emit::first_dielectric(rows)),
        precision: request.precision.name(),
        buffer: BufferDetail::ENTRY,
        half_buffer: request.precision.is_half().then_some(BufferDetail::HALF),
        textures: CatalogueTexture::ALL.map(|texture| texture.detail(rows)),
        methods: CatalogueMethod::all(rows),
        materials: CatalogueMaterial::all(rows),
    };
    json_text(&file)
}

#[cfg(test)]
mod tests {
    use super::*;
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
