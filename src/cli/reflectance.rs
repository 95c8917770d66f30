//! `materials reflectance`: the reflectance of materials by angle and wavelength, or its colour by angle, as rows for a user's own
//! plots.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::flags::material::SeveralFlags;
use crate::cli::flags::viewing::NumberList;
use crate::cli::materials::medium;
use crate::cli::output::{Output, check_places, csv_text, report_with_files};
use crate::cli::places::try_files;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Report;
use crate::generator::request::source::Loaded;
use crate::physics::foreign::Foreign;
use crate::physics::materials::{
    AtWavelength, Material, ReflectanceRow, ReflectedColour, Surface, ViewingConditions,
    reflectance_rows, reflected_colours,
};
use crate::physics::spectra::Gamut;
use crate::pictures::table;

/// The flags of `materials reflectance`.
#[derive(Args, Debug)]
pub struct ReflectanceFlags {
    /// The materials.
    #[command(flatten)]
    pub of: SeveralFlags,
    /// Angles of incidence in degrees: a list such as 0,30,60, or a range with its step
    #[arg(long, value_name = "ANGLES", default_value = "0..90:1", value_parser = NumberList::angles, allow_negative_numbers = true)]
    pub angles: NumberList,
    /// Reflectance at these wavelengths in nm, unpolarised, s and p, such as 400..700:10 or 450,550 [default: red, green and blue]
    #[arg(long, value_name = "NM", value_parser = NumberList::wavelengths, conflicts_with_all = ["space", "illuminant", "observer", "adaptation", "step"])]
    pub wavelengths: Option<NumberList>,
    /// Write the rows as CSV to this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

/// The most rows of a run: a hundred megabytes of text.
const MOST_ROWS: usize = 1_000_000;

/// `fresnel-gen materials reflectance NAME...`.
pub fn run(flags: &ReflectanceFlags, json: Option<&Path>) -> Result<Output, Error> {
    let csv = flags.csv.as_deref();
    check_places("--csv and --json", &[csv, json])?;
    try_files(&csv.into_iter().chain(json).collect::<Vec<_>>())?;
    let materials = flags.of.loaded()?;
    let medium = medium(&flags.of.medium)?;
    let viewing = flags.of.colour.conditions()?;
    let at_each = flags.wavelengths.as_ref().map_or(1, |nm| nm.values.len());
    let count = materials.len() * flags.angles.values.len() * at_each;
    if count > MOST_ROWS {
        return Err(Error::usage(format!(
            "{count} rows are wanted; at most {MOST_ROWS} are allowed: take fewer angles or wavelengths"
        )));
    }
    let command = flags
        .of
        .command("materials reflectance", &materials, medium.as_ref())
        .number("angles", &flags.angles.word);
    let command = match &flags.wavelengths {
        Some(nm) => command.number("wavelengths", &nm.word),
        None => command,
    };
    let command = command.seen_as(&viewing);
    let run = Run {
        materials,
        medium: medium.map(|medium| medium.material),
        command,
        csv,
        json,
    };
    match &flags.wavelengths {
        Some(nm) => run.by_wavelength(&flags.angles.values, &nm.values, &viewing),
        None => run.by_colour(&flags.angles.values, &viewing),
    }
}

/// What is asked of which materials, and where it goes.
struct Run<'a> {
    materials: Vec<Loaded>,
    medium: Option<Material>,
    command: CommandLine,
    csv: Option<&'a Path>,
    json: Option<&'a Path>,
}

impl Run<'_> {
    fn by_wavelength(
        self,
        angles: &[f64],
        nm: &[f64],
        viewing: &ViewingConditions,
    ) -> Result<Output, Error> {
        let (medium, beyond) = (self.medium.as_ref(), viewing.beyond);
        let (mut rows, mut held) = (Vec::new(), Vec::new());
        for Loaded { material, .. } in &self.materials {
            rows.extend(reflectance_rows(material, medium, beyond, angles, nm)?);
            held.push(AtWavelength::extrapolation(material, medium, nm));
        }
        let cells = |row: &ReflectanceRow| {
            let start = [row.material.clone(), row.angle_deg.to_string()];
            let numbers = [row.r_s, row.r_p, row.r].map(decimals);
            let nm = row.wavelength_nm.to_string();
            start.into_iter().chain([nm]).chain(numbers).collect()
        };
        let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
        let head = ["material", "angle", "nm", "R s", "R p", "R"];
        self.written(table::text_table(&head, &cells), rows, held)
    }

    fn by_colour(self, angles: &[f64], viewing: &ViewingConditions) -> Result<Output, Error> {
        let viewing = ViewingConditions {
            gamut: Gamut::Keep,
            ..viewing.clone()
        };
        let (mut rows, mut held, mut seen) = (Vec::new(), Vec::new(), Vec::new());
        for Loaded { material, .. } in &self.materials {
            let surface = Surface::new(material, self.medium.as_ref(), &viewing)?;
            rows.extend(reflected_colours(&material.name, &surface, angles));
            held.push(surface.extrapolation());
            if !seen.contains(&surface.seen) {
                seen.push(surface.seen);
            }
        }
        let cells = |row: &ReflectedColour| {
            let start = [row.material.clone(), row.angle_deg.to_string()];
            let numbers = [row.red, row.green, row.blue].map(decimals);
            start.into_iter().chain(numbers).collect()
        };
        let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
        let head = ["material", "angle", "red", "green", "blue"];
        let seen: String = seen.iter().map(|seen| format!("{seen}\n")).collect();
        self.written(
            format!("{seen}\n{}", table::text_table(&head, &cells)),
            rows,
            held,
        )
    }

    /// The rows where they are wanted, and remarks on what was held beyond the range of each material.
    fn written<T: Serialize>(
        self,
        text: String,
        rows: Vec<T>,
        held: Vec<Option<String>>,
    ) -> Result<Output, Error> {
        let csv = self.csv.map(|file| (file, csv_text(&rows).into_bytes()));
        // Who has the rows in a file needs no table of them.
        let text = match self.csv {
            Some(file) if file != Path::new("-") => {
                format!(
                    "{}: {} rows",
                    crate::physics::foreign::path(file),
                    rows.len()
                )
            }
            _ => text,
        };
        let report = Report::new(self.command, rows);
        let mut output = report_with_files(text, &report, self.json, Vec::from_iter(csv))?;
        let each = self.materials.iter().zip(held);
        let remarks = each
            .filter_map(|(one, held)| Some(format!("{}: {}", Foreign(&one.material.name), held?)));
        output.remarks.extend(remarks);
        Ok(output)
    }
}

/// A reflectance for people.
fn decimals(value: f64) -> String {
    // Adding zero turns a negative zero into a positive one.
    format!("{:.6}", value + 0.0)
}
