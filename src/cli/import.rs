//! `materials import`: turns a page or table into a material file.

use std::path::Path;

use crate::cli::error::Error;
use crate::cli::materials::{ImportFlags, material_record};
use crate::cli::output::{Output, report};
use crate::cli::places::try_places;
use crate::generator::output::folder;
use crate::generator::output::write::{OutputFile, write_outputs};
use crate::generator::request::source::read;
use crate::language::methods;
use crate::physics::foreign::{self, one_line};
use crate::physics::materials::{Material, name_fault, page};
use crate::physics::spectra::{FIRST_NM, LAST_NM, OBSERVED_NM};

/// `fresnel-gen materials import PAGE`. The JSON is that of `materials show`.
pub fn run(flags: &ImportFlags, json: Option<&Path>) -> Result<Output, Error> {
    let file = flags
        .output
        .as_deref()
        .filter(|file| *file != Path::new("-"));
    if file.is_none() && json == Some(Path::new("-")) {
        let why = "the material file and the JSON both go to stdout; write one of them to a file, with -o or --json";
        return Err(Error::usage(why));
    }
    try_places(json, file)?;
    let fault = |name: &String| {
        let why = name_fault(name)?;
        Some(format!("--name: `{name}` is no name: {why}"))
    };
    if let Some(what) = flags.name.as_ref().and_then(fault) {
        return Err(Error::usage(what));
    }
    let text = read(&flags.page)?;
    let found = page(&flags.page, &text).ok_or_else(|| Error::usage(format!("`{}` ends in none of .yml, .csv, .tsv, .txt: a page of refractiveindex.info or a table is wanted", flags.page)))??;
    let own = found.material(flags.name.as_deref())?;
    let whole = Material {
        kind: flags.class.unwrap_or(own.kind),
        ..own
    };
    let mut output = Output::default();
    let material = visible(&whole, &mut output);
    if let Some(method) = methods::find(&material.name) {
        let what = format!(
            "the material has the name of the method `{}`; give another with --name",
            method.name
        );
        return Err(Error::usage(what));
    }
    let toml = material.to_toml();
    if let Some(what) = material.limits_fault() {
        let what = format!("{}: no material file can hold this: {what}", flags.page);
        return Err(Error::usage(what));
    }
    if !material.note.is_empty() {
        output
            .remarks
            .push(format!("{}: {}", material.name, one_line(&material.note)));
    }
    let text = match file {
        Some(file) => {
            write_material(file, &toml)?;
            String::new()
        }
        None => toml,
    };
    let reported = report(text, &material_record(&material), json)?;
    Ok(Output {
        stdout: reported.stdout,
        is_file: reported.is_file,
        ..output
    })
}

/// Writes the material file. A user may have edited an existing file, so one with other contents is kept.
fn write_material(file: &Path, toml: &str) -> Result<(), Error> {
    if folder::is_plain_file(file) && folder::read(file)?.is_some_and(|old| old != toml.as_bytes())
    {
        let what = format!(
            "{} is there, and is not what this page comes to; remove it, or choose another -o",
            foreign::path(&file)
        );
        return Err(Error::usage(what));
    }
    write_outputs(&[OutputFile::new(file, toml)])?;
    Ok(())
}

/// The visible part of a material that is known over all of it.
fn visible(whole: &Material, output: &mut Output) -> Material {
    let (from, to) = OBSERVED_NM;
    if !whole.covers(FIRST_NM, LAST_NM) {
        let (first, last) = whole.range_nm();
        let unit = if first > 10.0 * LAST_NM {
            ". Are these nanometres, in a column named um?"
        } else {
            ""
        };
        output.remarks.push(format!(
            "{}: known from {first} to {last} nm only; functions want {FIRST_NM} to {LAST_NM} nm{unit}",
            whole.name
        ));
        return whole.clone();
    }
    let cut = whole.trimmed(from, to);
    if cut != *whole {
        let what = format!("{}: rows beyond {from} to {to} nm are left out", whole.name);
        output.remarks.push(what);
    }
    cut
}
