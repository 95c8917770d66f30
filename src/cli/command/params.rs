//! `materials params`: the numbers that an engine wants of a material, as a report or in an engine's own format.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::cli::args::{ParamsFlags, SeenFlags};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::output::folder::is_device;
use crate::generator::request::loaded::{Loaded, load};
use crate::generator::output::write::{OutputFile, try_places_of_ours, write_outputs};
use crate::generator::command_line::CommandLine;
use crate::generator::exchange::{EngineMaterial, Format};
use crate::generator::fit::{MaterialParams, material_params};
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::physics::materials::{self, ViewingConditions};
use crate::physics::spectra::Gamut;
use crate::generator::envelope::SCHEMA;
use crate::cli::params_text::params_text;

use crate::cli::command::materials::medium;
use crate::cli::command::{Output, replaced, report};

#[derive(Serialize)]
struct ParamsReport<'a> {
    schema: u32,
    #[serde(flatten)]
    params: &'a MaterialParams,
}

/// `fresnel-gen materials params NAME`.
pub fn run(flags: &ParamsFlags, json: Option<&Path>) -> Result<Output, Error> {
    match flags.format {
        None => reported(&flags.of, json),
        Some(_) if json.is_some() => Err(RequestFault::conflict(
            "--as writes a format of its own in place of the report; leave --json out",
        )
        .into()),
        Some(format) => exported(flags, format),
    }
}

fn reported(flags: &SeenFlags, json: Option<&Path>) -> Result<Output, Error> {
    let material = load(&flags.name.source()?)?.material;
    let medium = medium(&flags.medium)?;
    let medium = medium.as_ref().map(|medium| &medium.material);
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..flags.viewing.conditions()?
    };
    let params = &material_params(&material, medium, &viewing, &materials::list()?)?;
    let schema = SCHEMA;
    let text = params_text(params, &material, medium);
    report(text, &ParamsReport { schema, params }, json)
}

fn exported(flags: &ParamsFlags, format: &Format) -> Result<Output, Error> {
    let file = flags
        .output
        .as_ref()
        .filter(|file| **file != Path::new("-"));
    let file = file.map(|file| (file, is_device(file)));
    if let Some((file, false)) = file {
        try_places_of_ours(std::slice::from_ref(file), flags.overwrite)?;
    }
    let loaded = load(&flags.of.name.source()?)?;
    let medium = medium(&flags.of.medium)?;
    let viewing = flags.of.viewing.conditions()?;
    let command = CommandLine::new("fresnel-gen materials params")
        .argument(&loaded.argument)
        .list("medium", medium.as_ref().map(|medium| &medium.argument))
        .seen_as(&viewing)
        .list("as", [format.name]);
    let typed = |loaded: Loaded| (loaded.argument, loaded.material);
    let subject = MaterialInMedium::new(
        typed(loaded),
        medium.map(typed),
        &viewing,
        Derivation::default(),
    )?;
    let fault = |fault: crate::generator::exchange::ExchangeFault| {
        RequestFault::conflict(fault.to_string())
    };
    let material = EngineMaterial::new(&subject, &viewing).map_err(fault)?;
    let exported = format
        .export(&material, &String::from(command))
        .map_err(fault)?;
    let mut output = Output {
        remarks: exported.remarks,
        ..Output::default()
    };
    put(
        file,
        exported.text.into_bytes(),
        flags.overwrite,
        &mut output,
    )?;
    Ok(output)
}

/// Into a file, or to stdout. A device is written to.
fn put(
    file: Option<(&PathBuf, bool)>,
    bytes: Vec<u8>,
    overwrite: bool,
    output: &mut Output,
) -> Result<(), Error> {
    match file {
        None => {
            output.stdout = bytes;
            output.is_file = true;
        }
        Some((device, true)) => drop(write_outputs(&[OutputFile::named(device, bytes)])?),
        Some((file, false)) => {
            let old = write_outputs(&[OutputFile::of_report(file, bytes, overwrite)])?;
            output.remarks.extend(replaced(&old));
        }
    }
    Ok(())
}
