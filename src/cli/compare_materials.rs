//! `materials compare`: materials beside each other, as a table and as one picture.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::material::SeveralFlags;
use crate::cli::flags::viewing::NumberList;
use crate::cli::materials::{PNG_SCALE, medium};
use crate::cli::output::{Output, check_places, csv_records, png, report_with_files};
use crate::cli::places::try_files;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Report;
use crate::physics::foreign::{self, Foreign, one_line};
use crate::physics::materials::{
    ComparedMaterial, ComparedRow, Material, comparable, compared_rows,
};
use crate::pictures::material_sheet::{ShownReflectance, comparison_sheet};
use crate::pictures::table;

/// The flags of `materials compare`.
#[derive(Args, Debug)]
#[command(mut_arg("names", |arg| arg.num_args(2..)))]
pub struct CompareFlags {
    /// The materials.
    #[command(flatten)]
    pub of: SeveralFlags,
    /// Draw reflectance against angle at these wavelengths in nm, such as 450,550 [default: red, green and blue]
    #[arg(long, value_name = "NM", value_parser = NumberList::wavelengths)]
    pub wavelengths: Option<NumberList>,
    /// Draw s and p too
    #[arg(long)]
    pub polarised: bool,
    /// Draw reflectance, n and k as SVG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Draw them as PNG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
    /// Write the table as CSV to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

/// The most wavelengths that are drawn: four rows of panels.
const MOST_DRAWN: usize = 12;

/// `fresnel-gen materials compare NAME NAME...`.
pub fn run(flags: &CompareFlags, json: Option<&Path>) -> Result<Output, Error> {
    let (svg_file, png_file) = (flags.svg.as_deref(), flags.png.as_deref());
    let csv = flags.csv.as_deref();
    let places = [svg_file, png_file, csv, json];
    check_places("--svg, --png, --csv and --json", &places)?;
    try_files(&places.into_iter().flatten().collect::<Vec<_>>())?;
    let shown = shown(flags)?;
    let loaded = flags.of.loaded()?;
    let medium = medium(&flags.of.medium)?;
    let viewing = flags.of.colour.conditions()?;
    let command = |words: &str, picture: &[&str]| -> String {
        let command = flags.of.command(words, &loaded, medium.as_ref());
        let command = match &flags.wavelengths {
            Some(nm) if !picture.is_empty() => command.number("wavelengths", &nm.word),
            _ => command,
        };
        let is_polarised = flags.polarised && !picture.is_empty();
        let command = command.switch("polarised", is_polarised).seen_as(&viewing);
        let draw = |command: CommandLine, ending: &&str| {
            command.list(ending, [format!("comparison.{ending}")])
        };
        picture.iter().fold(command, draw).into()
    };
    let materials: Vec<Material> = loaded.iter().map(|one| one.material.clone()).collect();
    let around = medium.as_ref().map(|medium| &medium.material);
    let all = comparable(&materials, around, &viewing)?;
    let rows = compared_rows(&all, viewing.integration.space);
    let sheet = |ending: &str| {
        let command = command("fresnel-gen materials compare", &[ending]);
        comparison_sheet(&all, around, viewing.beyond, &shown, &command).map_err(Error::usage)
    };
    let mut files = Vec::new();
    if let Some(file) = svg_file {
        files.push((file, sheet("svg")?.into_bytes()));
    }
    if let Some(file) = png_file {
        files.push((file, png(&sheet("png")?, PNG_SCALE)?));
    }
    let drawn: Vec<&Path> = files.iter().map(|(file, _)| *file).collect();
    files.extend(csv.map(|file| (file, csv_of(&rows).into_bytes())));
    let text = text(&rows, &all);
    let report = Report::new(command("materials compare", &[]), rows);
    let mut output = report_with_files(text, &report, json, files)?;
    for one in &all {
        if let Some(held) = one.surface.extrapolation() {
            let name = Foreign(&one.material.name);
            output.remarks.push(format!("{name}: {held}"));
        }
    }
    let drawn = drawn.into_iter().filter(|file| *file != Path::new("-"));
    let drawn = drawn.map(|file| format!("{}: drawn", foreign::path(file)));
    output.remarks.extend(drawn);
    Ok(output)
}

/// What is drawn of reflectance. Flags that only a picture follows want one.
fn shown(flags: &CompareFlags) -> Result<ShownReflectance, Error> {
    let wavelengths = flags.wavelengths.as_ref();
    let wavelengths_nm = wavelengths.map_or(Vec::new(), |nm| nm.values.clone());
    let is_drawn = flags.svg.is_some() || flags.png.is_some();
    if !is_drawn && (flags.polarised || wavelengths.is_some()) {
        return Err(Error::usage(
            "--wavelengths and --polarised are of the picture; add --png FILE or --svg FILE. Numbers at wavelengths: `materials reflectance`",
        ));
    }
    if wavelengths_nm.len() > MOST_DRAWN {
        return Err(Error::usage(format!(
            "--wavelengths has {}; at most {MOST_DRAWN} are drawn, each in a panel of its own",
            wavelengths_nm.len()
        )));
    }
    Ok(ShownReflectance {
        wavelengths_nm,
        polarised: flags.polarised,
    })
}

fn text(rows: &[ComparedRow], all: &[ComparedMaterial]) -> String {
    let head = [
        "material",
        "year",
        "F0 red",
        "green",
        "blue",
        "F82 red",
        "green",
        "blue",
        "largest difference",
        "at",
        "channel",
        "Delta E 2000",
    ];
    let cells = |row: &ComparedRow| {
        let mut cells = vec![
            row.material.clone(),
            row.year.map_or(String::new(), |year| year.to_string()),
        ];
        let colours = row.f0.iter().chain(&row.f82);
        cells.extend(colours.map(|value| format!("{value:.4}")));
        if let Some(apart) = &row.from_first {
            let colour = apart.delta_e2000;
            cells.extend([
                format!("{:.4}", apart.max_abs),
                format!("{}°", apart.angle_deg),
                apart.channel.to_owned(),
                colour.map_or(String::new(), |colour| format!("{colour:.2}")),
            ]);
        }
        cells
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let seen = all.first().map_or("", |first| first.surface.seen.as_str());
    let reason = rows.iter().find_map(|row| row.from_first.as_ref()?.reason);
    let first = rows.first().map_or("", |row| row.material.as_str());
    let mut lines = vec![
        seen.to_owned(),
        String::new(),
        table::text_table(&head, &cells),
        format!(
            "Largest difference: of a channel from {}, at any angle. Delta E 2000: of the colours at 0 degrees{}",
            Foreign(first),
            reason.map_or(".".to_owned(), |reason| format!(", none here: {reason}."))
        ),
        String::new(),
    ];
    for row in rows {
        let source = format!("{}. {}", row.summary, row.source);
        lines.push(format!(
            "{}: {}",
            Foreign(&row.material),
            one_line(source.trim())
        ));
    }
    lines.join("\n") + "\n"
}

fn csv_of(rows: &[ComparedRow]) -> String {
    let head = [
        "material",
        "year",
        "f0_red",
        "f0_green",
        "f0_blue",
        "f82_red",
        "f82_green",
        "f82_blue",
        "max_abs",
        "angle_deg",
        "channel",
        "delta_e2000",
        "source",
    ];
    let record = |row: &ComparedRow| {
        let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
        let mut cells = vec![
            row.material.clone(),
            row.year.map_or(String::new(), |year| year.to_string()),
        ];
        cells.extend(row.f0.iter().chain(&row.f82).map(f64::to_string));
        let apart = row.from_first.as_ref();
        cells.extend([
            number(apart.map(|apart| apart.max_abs)),
            number(apart.map(|apart| apart.angle_deg)),
            apart.map_or("", |apart| apart.channel).to_owned(),
            number(apart.and_then(|apart| apart.delta_e2000)),
            one_line(&row.source),
        ]);
        cells
    };
    let head = head.map(str::to_owned).to_vec();
    csv_records([head].into_iter().chain(rows.iter().map(record)))
}
