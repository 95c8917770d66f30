//! `materials params`: the parameters of a material for an engine, as a report or in an engine's own format. Also
//! `materials coat`: the colours of a surface under a clear coat.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::materials::{CoatFlags, ParamsFlags, SeenFlags, medium};
use crate::cli::output::{Output, report};
use crate::cli::places::replaced;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::{Report, SCHEMA};
use crate::generator::error::RequestFault;
use crate::generator::exchange::{EngineMaterial, Format};
use crate::generator::fit::{
    CoatedRow, ColourErrors, GreyTint, MaterialParams, MeasuredSpread, material_params, rounded_up,
};
use crate::generator::output::folder::is_device;
use crate::generator::output::write::{OutputFile, try_places_of_ours, write_outputs};
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::generator::request::source::Loaded;
use crate::physics::foreign::one_line;
use crate::physics::materials::{self, Material, ViewingConditions};
use crate::physics::spectra::Gamut;
use crate::pictures::table;

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
        Some(_) if json.is_some() => Err(Error::usage(
            "--as writes a format of its own in place of the report; leave --json out",
        )),
        Some(format) => exported(flags, format),
    }
}

fn reported(flags: &SeenFlags, json: Option<&Path>) -> Result<Output, Error> {
    let material = flags.loaded()?.material;
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
    let loaded = flags.of.loaded()?;
    let medium = medium(&flags.of.medium)?;
    let viewing = flags.of.viewing.conditions()?;
    let command = CommandLine::new("fresnel-gen materials params")
        .argument(&loaded.argument)
        .each("film", loaded.material.film_arguments())
        .list("medium", medium.as_ref().map(|medium| &medium.argument))
        .seen_as(&viewing)
        .list("as", [format.name])
        .list("coat", flags.coat);
    let typed = |loaded: Loaded| (loaded.argument, loaded.material);
    let subject = MaterialInMedium::new(
        typed(loaded),
        medium.map(typed),
        &viewing,
        Derivation::default(),
    )?;
    let fault =
        |fault: crate::generator::exchange::ExchangeFault| RequestFault::refused(fault.to_string());
    let material = match &flags.coat {
        Some(coat) => EngineMaterial::below_coat(&subject, &viewing, coat.value()),
        None => EngineMaterial::new(&subject, &viewing),
    };
    let material = material.map_err(fault)?;
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

/// Writes into a file or to stdout. A device file is written to directly.
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

/// The parameters of a material in a medium, and how accurately each is known.
pub fn params_text(
    of_material: &MaterialParams,
    material: &Material,
    medium: Option<&Material>,
) -> String {
    let params = &of_material.params;
    let rows = [
        remarked_cells("F0", params.f0, "at 0 degrees"),
        remarked_cells("F82", params.f82, "at 81.79 degrees"),
        remarked_cells(
            "F82 tint",
            params.f82_tint,
            "F82 over Schlick's value there",
        ),
        remarked_cells("F90", params.f90, "at 90 degrees"),
        remarked_cells("average", params.average, "hemispherical reflectance"),
        remarked_cells("reflectivity", params.reflectivity, "Gulbrandsen's r"),
        remarked_cells("edge tint", params.edge_tint, "Gulbrandsen's g"),
        remarked_cells("n", params.n, &params.nk_by.join(", ")),
        remarked_cells("k", params.k, ""),
    ];
    let mut lines = vec![
        format!("{}: {}", material.name, one_line(&material.summary)),
        of_material.truth.clone(),
    ];
    lines.extend(of_material.remark.map(str::to_owned));
    lines.extend(medium.map(|medium| format!("in {}: n and k are relative to it", medium.name)));
    let held = of_material.extrapolated.iter();
    lines.extend(held.map(|held| format!("extrapolated: {held}")));
    lines.push(String::new());
    lines.push(table::text_table(&["", "red", "green", "blue", ""], &rows));
    let number =
        |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value:.5}"));
    lines.push(format!(
        "its own index at the d line {}, Abbe number {}",
        number(of_material.ior_d),
        number(of_material.abbe)
    ));
    lines.push(grey_tint_line(&of_material.grey_f82_tint));
    lines.extend(of_material.colour_error.iter().flat_map(colour_error_lines));
    lines.extend(spread_lines(&of_material.spread));
    lines.join("\n") + "\n"
}

fn grey_tint_line(grey: &GreyTint) -> String {
    format!(
        "one F82 tint for all channels {:.5}: error at most {} (at {:.2} degrees), Schlick's {}",
        grey.tint,
        rounded_up(grey.max_abs),
        libm::acos(grey.worst_cos).to_degrees(),
        rounded_up(grey.schlick_max_abs)
    )
}

fn channel_cells(name: &str, values: [f64; 3]) -> Vec<String> {
    let numbers = values.map(|value| format!("{value:.5}"));
    [name.to_owned()].into_iter().chain(numbers).collect()
}

fn remarked_cells(name: &str, values: [f64; 3], remark: &str) -> Vec<String> {
    let mut cells = channel_cells(name, values);
    cells.push(remark.to_owned());
    cells
}

fn colour_error_lines(errors: &ColourErrors) -> [String; 4] {
    let rows = errors.rows.iter().map(|row| {
        let cells = row.delta_e2000.map(|error| format!("{error:.2}"));
        [row.illuminant.clone()].into_iter().chain(cells).collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    [
        String::new(),
        "Colour error of three channels in place of a spectrum: Delta E 2000 after 1, 2 and 3 bounces under another light.".to_owned(),
        "No function of three channels avoids it. Under the light that the functions are made for, one bounce has no colour error: only the model error is seen.".to_owned(),
        table::text_table(&["light", "1", "2", "3"], &rows),
    ]
}

fn spread_lines(spread: &MeasuredSpread) -> Vec<String> {
    if spread.others.is_empty() {
        return Vec::new();
    }
    let others = spread.others.iter();
    let mut rows: Vec<Vec<String>> = others
        .map(|other| channel_cells(&other.name, other.f0))
        .collect();
    rows.push(channel_cells("least of all", spread.f0_min));
    rows.push(channel_cells("most of all", spread.f0_max));
    vec![
        "How well it is known: F0 by the other measurements".to_owned(),
        table::text_table(&["", "red", "green", "blue"], &rows),
    ]
}

/// `fresnel-gen materials coat --f0 R,G,B --f82 R,G,B`.
pub fn run_coat(flags: &CoatFlags, json: Option<&Path>) -> Result<Output, Error> {
    let row = CoatedRow::new(flags.f0, flags.f82, flags.index.value());
    let command = CommandLine::new("materials coat")
        .list("f0", flags.f0)
        .list("f82", flags.f82)
        .list("index", [flags.index]);
    let text = coated_text(&row);
    report(text, &Report::new(command, vec![row]), json)
}

/// The numbers of each channel, and a note where no index gives the colours.
pub fn coated_text(row: &CoatedRow) -> String {
    // An index that gives neither colour belongs to no material. Only the JSON has it.
    let index_cells = |name: &str, values: [f64; 3]| {
        let mut shown = remarked_cells(name, values, "in air");
        for (cell, exact) in shown[1..].iter_mut().zip(row.exact) {
            if !exact {
                *cell = "none".to_owned();
            }
        }
        shown
    };
    let rows = [
        remarked_cells("F0", row.f0, "in air"),
        remarked_cells("F82", row.f82, "in air"),
        remarked_cells("F0 in coat", row.f0_in_coat, "relative to the coat"),
        remarked_cells(
            "F82 in coat",
            row.f82_in_coat,
            "at 81.79 degrees within the coat",
        ),
        index_cells("n", row.n),
        index_cells("k", row.k),
    ];
    let mut lines = vec![
        format!("under a coat of index {}", row.index),
        String::new(),
        table::text_table(&["", "red", "green", "blue", ""], &rows),
    ];
    let channels = ["red", "green", "blue"].into_iter().zip(row.exact);
    let nearest: Vec<&str> = channels
        .filter(|(_, exact)| !exact)
        .map(|(name, _)| name)
        .collect();
    if !nearest.is_empty() {
        lines.push(format!(
            "No index gives F0 and F82 of {}: what is shown in the coat follows from the nearest F82 that an index gives with an F0 of at most .999999.",
            nearest.join(" and ")
        ));
    }
    lines.join("\n").trim_end().to_owned() + "\n"
}
