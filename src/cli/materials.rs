//! `materials`: lists with filters, shows a material as text and as a picture. The other subcommands have their own files.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use serde::Serialize;

use crate::cli::compare_materials::CompareFlags;
use crate::cli::error::Error;
use crate::cli::flags::choice::{format_of_engines, one_of};
use crate::cli::flags::material::{FilmFlags, MaterialName, MediumFlags};
use crate::cli::flags::output::ReportFlags;
use crate::cli::flags::viewing::{ViewingFlags, colour};
use crate::cli::output::{Output, Progress, check_places, png, report, report_with_files};
use crate::cli::reflectance::ReflectanceFlags;
use crate::cli::{compare_materials, import, params, reflectance, survey};
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::{Report, SCHEMA};
use crate::generator::error::unknown;
use crate::generator::exchange::Format;
use crate::generator::request::check_transparent;
use crate::generator::request::source::{Loaded, load};
use crate::physics::foreign::{Foreign, one_line};
use crate::physics::materials::{
    self, ConstantIndex, Extrapolate, Material, MaterialKind, ViewingConditions,
};
use crate::physics::names::UnknownName;
use crate::physics::spectra::{FIRST_NM, LAST_NM};
use crate::pictures::material_sheet::material_sheet;
use crate::pictures::table;

/// The flags of `materials`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct MaterialsFlags {
    /// What to do [default: list]
    #[command(subcommand)]
    pub what: Option<MaterialsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is done with materials.
#[derive(Debug, Subcommand)]
pub enum MaterialsCommand {
    /// Name, class, measured range and summary of each
    List(FilterFlags),
    /// All that is known of one, as text, and as a picture; of several, as text
    Show(ShowFlags),
    /// Several beside each other: F0, F82 and differences as a table, and reflectance, n and k as one picture
    #[command(
        after_help = "Examples:\n  fresnel-gen materials compare silver silver_babar silver_jiang --png silver.png\n  fresnel-gen materials compare gold my_gold.csv --wavelengths 450,550,650 --polarised --svg gold.svg"
    )]
    Compare(CompareFlags),
    /// Reflectance by angle and wavelength, unpolarised, s and p, or the reflected colour by angle, as numbers
    #[command(
        after_help = "Examples:\n  fresnel-gen materials reflectance silver silver_babar --angles 0..90:5 --csv silver.csv\n  fresnel-gen materials reflectance gold --wavelengths 400..700:10 --angles 0,45 --csv -"
    )]
    Reflectance(ReflectanceFlags),
    /// The numbers that an engine wants: F0, F82, n and k per channel, averages, and how well they are known
    #[command(
        after_help = "Examples:\n  fresnel-gen materials params gold --space acescg --json -\n  fresnel-gen materials params gold --as materialx -o gold.mtlx"
    )]
    Params(ParamsFlags),
    /// Colours of a metal in air, F0 and F82, turned into its colours under a clear coat
    #[command(
        after_help = "Example:\n  fresnel-gen materials coat --f0 1,.71,.29 --f82 .98,.91,.66 --index 1.5\n\nEach channel takes the n and k that give its F0 and F82, relative to the coat. Where no n and k give both, those of the nearest F82 are taken, and the report says so. Of a measured material `materials params gold --medium 1.5` gives the colours by its spectrum. A shader computes F0 by `--effect coat`."
    )]
    Coat(CoatFlags),
    /// Turn a page of refractiveindex.info or a CSV table into a material file
    #[command(
        after_help = "Example:\n  fresnel-gen materials import main/Au/nk/Johnson.yml --name my_gold -o my_gold.toml"
    )]
    Import(ImportFlags),
    /// Read every page of refractiveindex.info below a folder: what it is, its colour, or why it cannot be used
    #[command(
        after_help = "Example:\n  fresnel-gen materials survey refractiveindex.info-database/database/data --json pages.json"
    )]
    Survey(SurveyFlags),
}

/// Which materials are listed.
#[derive(Args, Debug, Default)]
pub struct FilterFlags {
    /// Only metal, semiconductor or dielectric
    #[arg(long, value_name = "NAME", value_parser = class())]
    pub class: Option<MaterialKind>,
    /// Only measurements of this substance, such as gold
    #[arg(long, value_name = "NAME")]
    pub substance: Option<String>,
    /// Only those whose name, summary or source holds this text
    #[arg(long, value_name = "TEXT")]
    pub search: Option<String>,
    /// Only those known over the whole visible spectrum
    #[arg(long)]
    pub full: bool,
}

/// The flags of `materials show`.
#[derive(Args, Debug)]
pub struct ShowFlags {
    /// Which material, and how it is looked at.
    #[command(flatten)]
    pub of: SeenFlags,
    /// More of them, under the same films, as text and JSON
    #[arg(value_name = "NAME", value_parser = MaterialName::parse)]
    pub more: Vec<MaterialName>,
    /// Draw n, k, reflectance and colour as SVG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Draw them as PNG into this file, or `-` for stdout
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
}

/// Which material, and how it is looked at.
#[derive(Args, Debug)]
pub struct SeenFlags {
    /// A name, or the path of a material file, page or table
    #[arg(value_parser = MaterialName::parse)]
    pub name: MaterialName,
    /// The films on it.
    #[command(flatten)]
    pub films: FilmFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How it is looked at.
    #[command(flatten)]
    pub viewing: ViewingFlags,
}

impl SeenFlags {
    /// The material under its films.
    pub fn loaded(&self) -> Result<Loaded, Error> {
        Ok(load(&self.films.on(self.name.source()?)?)?)
    }
}

/// The flags of `materials params`.
#[derive(Args, Debug)]
pub struct ParamsFlags {
    /// Which material, and how it is looked at.
    #[command(flatten)]
    pub of: SeenFlags,
    /// Write the numbers for an engine or a tool: openpbr, materialx, gltf, usd, blender, unreal, filament
    #[arg(long = "as", value_name = "FORMAT", value_parser = format_of_engines())]
    pub format: Option<&'static Format>,
    /// A clear coat of this index on a metal: the base below it, and the coat itself; with --as blender, filament, gltf, materialx, openpbr
    #[arg(long, value_name = "N", requires = "format", value_parser = index, allow_negative_numbers = true)]
    pub coat: Option<ConstantIndex>,
    /// Write that file here, or `-` for stdout [default: stdout]
    #[arg(short = 'o', value_name = "FILE", requires = "format")]
    pub output: Option<PathBuf>,
    /// Also replace a file that fresnel-gen did not write
    #[arg(long, requires = "output")]
    pub overwrite: bool,
}

/// The flags of `materials coat`.
#[derive(Args, Debug)]
pub struct CoatFlags {
    /// Reflectance in air at 0 degrees, three numbers from 0 to 1
    #[arg(long, value_name = "R,G,B", value_parser = colour)]
    pub f0: [f64; 3],
    /// Reflectance in air at 81.79 degrees (cos θ = 1/7), likewise
    #[arg(long, value_name = "R,G,B", value_parser = colour)]
    pub f82: [f64; 3],
    /// The coat's refractive index, from 1 to 10
    #[arg(long, value_name = "N", default_value = "1.5", value_parser = index, allow_negative_numbers = true)]
    pub index: ConstantIndex,
}

/// The flags of `materials import`.
#[derive(Args, Debug)]
pub struct ImportFlags {
    /// The page (.yml) or table (.csv)
    pub page: String,
    /// The material's name [default: made of the file's path]
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// metal, semiconductor or dielectric [default: guessed from n and k]
    #[arg(long, value_name = "NAME", value_parser = class())]
    pub class: Option<MaterialKind>,
    /// Write the material file here, or `-` for stdout [default: stdout]
    #[arg(short = 'o', value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// The flags of `materials survey`.
#[derive(Args, Debug)]
pub struct SurveyFlags {
    /// A folder of pages, or one page
    pub folder: PathBuf,
    /// How they are looked at.
    #[command(flatten)]
    pub viewing: ViewingFlags,
}

/// The parser of a class's name.
fn class() -> impl Fn(&str) -> Result<MaterialKind, UnknownName> + Clone {
    one_of("class", MaterialKind::ALL, MaterialKind::name)
}

/// The parser of a coat's index.
fn index(word: &str) -> Result<ConstantIndex, String> {
    let wanted = || "a coat's index is a number from 1 to 10, such as 1.5".to_owned();
    let index = ConstantIndex::parse(word).ok_or_else(wanted)?;
    index.map_err(|_| wanted())
}

/// `fresnel-gen materials`.
pub fn run(flags: &MaterialsFlags, progress: Progress) -> Result<Output, Error> {
    let json = flags.report.json();
    match &flags.what {
        None => list(&FilterFlags::default(), json),
        Some(MaterialsCommand::List(filter)) => list(filter, json),
        Some(MaterialsCommand::Show(show)) => shown(show, json),
        Some(MaterialsCommand::Compare(flags)) => compare_materials::run(flags, json),
        Some(MaterialsCommand::Reflectance(flags)) => reflectance::run(flags, json),
        Some(MaterialsCommand::Params(params)) => params::run(params, json),
        Some(MaterialsCommand::Coat(coat)) => params::run_coat(coat, json),
        Some(MaterialsCommand::Import(import)) => import::run(import, json),
        Some(MaterialsCommand::Survey(survey)) => survey::run(survey, json, progress),
    }
}

fn list(filter: &FilterFlags, json: Option<&Path>) -> Result<Output, Error> {
    let mut all = materials::list()?;
    check_substance(filter, &all)?;
    for stack in materials::stacks().into_iter().filter_map(materials::find) {
        all.push(stack?);
    }
    // A stack is of no class: what lies below says little of it.
    let is_of = |m: &Material| {
        let of_class = |kind| m.kind == kind && m.films.is_empty();
        filter.class.is_none_or(of_class)
    };
    let wanted = |m: &&Material| is_of(m) && admits(filter, m);
    let chosen: Vec<&Material> = all.iter().filter(wanted).collect();
    let rows: Vec<Vec<String>> = chosen.iter().map(|m| row(m)).collect();
    let text = table::text_table(&["name", "class", "known in nm", "summary"], &rows);
    let rows: Vec<MaterialRow> = chosen.iter().map(|m| MaterialRow::new(m)).collect();
    let full = Report::new("materials list", rows);
    report(text, &full, json)
}

/// Refuses a substance that no material has: it is a typo.
fn check_substance(filter: &FilterFlags, all: &[Material]) -> Result<(), Error> {
    let mut substances: Vec<&str> = all.iter().map(|m| m.substance.as_str()).collect();
    substances.sort_unstable();
    substances.dedup();
    match &filter.substance {
        Some(name) if !substances.contains(&name.as_str()) => {
            Err(unknown("substance", name, &substances).into())
        }
        _ => Ok(()),
    }
}

fn admits(filter: &FilterFlags, m: &Material) -> bool {
    let holds = |text: &String| {
        let all = [&m.name, &m.summary, &m.reference, &m.page, &m.conditions];
        let text = text.to_lowercase();
        all.iter().any(|field| field.to_lowercase().contains(&text))
    };
    filter
        .substance
        .as_ref()
        .is_none_or(|name| m.substance == *name)
        && filter.search.as_ref().is_none_or(holds)
        && (!filter.full || is_full(m))
}

fn is_full(m: &Material) -> bool {
    m.rgb_nm.is_none() && m.covers(FIRST_NM, LAST_NM)
}

fn range(m: &Material) -> String {
    let (from, to) = m.range_nm();
    match m.rgb_nm {
        Some(rgb) => rgb.map(|nm| nm.to_string()).join(", "),
        None => format!("{from:.0} to {to:.0}"),
    }
}

fn row(m: &Material) -> Vec<String> {
    vec![
        m.name.clone(),
        m.class_name().to_owned(),
        range(m),
        m.summary.clone(),
    ]
}

fn origin(m: &Material) -> String {
    format!("{}. {}", m.reference, m.link)
}

/// A material of a list.
#[derive(Serialize)]
struct MaterialRow<'a> {
    name: &'a str,
    summary: &'a str,
    source: String,
    class: &'static str,
    /// The films on it, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    films: Option<String>,
    substance: &'a str,
    recommended: bool,
    licence: &'a str,
    page: &'a str,
    from_nm: f64,
    to_nm: f64,
    full: bool,
    rgb_nm: Option<[f64; 3]>,
}

impl MaterialRow<'_> {
    fn new(m: &Material) -> MaterialRow<'_> {
        let (from_nm, to_nm) = m.range_nm();
        MaterialRow {
            name: &m.name,
            summary: &m.summary,
            source: origin(m),
            class: m.class_name(),
            films: m.films_in_words(),
            substance: &m.substance,
            recommended: m.is_recommended(),
            licence: &m.licence,
            page: &m.page,
            from_nm,
            to_nm,
            full: is_full(m),
            rgb_nm: m.rgb_nm,
        }
    }
}

/// A material with its data: wavelength, n and k.
#[derive(Serialize)]
pub(super) struct MaterialRecord<'a> {
    #[serde(flatten)]
    row: MaterialRow<'a>,
    schema: u32,
    conditions: &'a str,
    note: &'a str,
    data: Vec<[f64; 3]>,
    /// Why rows of the measurement are missing here.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    left_out: Vec<String>,
}

fn shown(flags: &ShowFlags, json: Option<&Path>) -> Result<Output, Error> {
    let places = [flags.svg.as_deref(), flags.png.as_deref(), json];
    check_places("--svg, --png and --json", &places)?;
    let loaded = flags.of.loaded()?;
    let record = material_record(&loaded.material);
    if !flags.more.is_empty() {
        return several_shown(loaded, flags, json);
    }
    let files = drawn(flags, &loaded)?;
    let named = files.iter().map(|(file, _)| *file);
    let named = named.filter(|file| *file != Path::new("-"));
    let remarks: Vec<String> = named
        .map(|file| format!("{}: drawn", crate::physics::foreign::path(file)))
        .collect();
    let output = report_with_files(text(&loaded.material), &record, json, files)?;
    Ok(Output { remarks, ..output })
}

/// Several materials, one below the other.
fn several_shown(first: Loaded, flags: &ShowFlags, json: Option<&Path>) -> Result<Output, Error> {
    if flags.svg.is_some() || flags.png.is_some() {
        return Err(Error::usage(
            "--svg and --png draw one material; `fresnel-gen materials compare` draws several in one picture",
        ));
    }
    let mut all = vec![first.material];
    for name in &flags.more {
        all.push(load(&flags.of.films.on(name.source()?)?)?.material);
    }
    let records: Vec<MaterialRecord> = all.iter().map(material_record).collect();
    let texts: Vec<String> = all.iter().map(text).collect();
    report(
        texts.join("\n"),
        &Report::new("materials show", records),
        json,
    )
}

/// The pictures of the material that were requested, each with its path.
fn drawn<'a>(flags: &'a ShowFlags, loaded: &Loaded) -> Result<Vec<(&'a Path, Vec<u8>)>, Error> {
    let medium = medium(&flags.of.medium)?;
    let viewing = flags.of.viewing.conditions()?;
    if flags.svg.is_none() && flags.png.is_none() {
        return Ok(Vec::new());
    }
    let around = medium.as_ref().map(|medium| &medium.material);
    let sheet = |picture| {
        let command = command(loaded, medium.as_ref(), &viewing, picture);
        material_sheet(&loaded.material, around, &viewing, &command).map_err(Error::usage)
    };
    let svg = flags.svg.as_ref().map(|_| sheet("svg")).transpose()?;
    let bytes = flags
        .png
        .as_ref()
        .map(|_| png(&sheet("png")?, PNG_SCALE))
        .transpose()?;
    let pictures = [
        (&flags.svg, svg.map(String::into_bytes)),
        (&flags.png, bytes),
    ];
    let placed = pictures
        .into_iter()
        .filter_map(|(file, bytes)| Some((file.as_deref()?, bytes?)));
    Ok(placed.collect())
}

/// Pixels of the PNG for each unit of the SVG, sharp on today's screens.
pub(super) const PNG_SCALE: f32 = 2.0;

/// The command that draws it again as `svg` or `png`, without the output's path.
fn command(
    loaded: &Loaded,
    medium: Option<&Loaded>,
    viewing: &ViewingConditions,
    picture: &str,
) -> String {
    CommandLine::new("fresnel-gen materials show")
        .argument(&loaded.argument)
        .each("film", loaded.material.film_arguments())
        .list("medium", medium.map(|medium| &medium.argument))
        .seen_as(viewing)
        .list(picture, [format!("{}.{picture}", loaded.material.name)])
        .into()
}

/// A medium by its name or file. It must be transparent.
pub fn medium(flags: &MediumFlags) -> Result<Option<Loaded>, Error> {
    let medium = flags.source()?;
    let medium = medium.map(|medium| load(&medium)).transpose()?;
    if let Some(medium) = &medium {
        check_transparent(&medium.material)?;
    }
    Ok(medium)
}

fn text(m: &Material) -> String {
    let field = |name: &str, value: &str| {
        // A note may have several lines.
        let value: Vec<String> = value.lines().map(one_line).collect();
        let line = format!("{name:12}{}", value.join("\n          | "));
        (!value.is_empty()).then_some(line)
    };
    let mut lines = vec![format!("{}: {}", Foreign(&m.name), one_line(&m.summary))];
    let films = m.films_in_words().unwrap_or_default();
    let fields = [
        ("films", films.as_str()),
        ("class", m.class_name()),
        ("substance", &m.substance),
        ("known in nm", &range(m)),
        ("reference", &m.reference),
        ("link", &m.link),
        ("page", &m.page),
        ("licence", &m.licence),
        ("conditions", &m.conditions),
        ("note", &m.note),
    ];
    lines.extend(fields.iter().filter_map(|(name, value)| field(name, value)));
    lines.push(String::new());
    if !m.films.is_empty() {
        lines.push("n and k of what lies below the films:".to_owned());
    }
    let (samples, left_out) = samples(m);
    let rows: Vec<Vec<String>> = samples
        .into_iter()
        .map(|sample| sample.map(|value| value.to_string()).to_vec())
        .collect();
    lines.push(table::text_table(&["nm", "n", "k"], &rows));
    lines.extend(
        left_out
            .iter()
            .map(|why| format!("left out: {}", one_line(why))),
    );
    lines.join("\n")
}

pub(super) fn material_record(m: &Material) -> MaterialRecord<'_> {
    let (data, left_out) = samples(m);
    MaterialRecord {
        row: MaterialRow::new(m),
        schema: SCHEMA,
        conditions: &m.conditions,
        note: &m.note,
        data,
        left_out,
    }
}

/// Wavelength, n and k wherever either was measured; for a formula, every 10 nm of the visible range. Also the reasons why there
/// is no index at others of these wavelengths.
fn samples(m: &Material) -> (Vec<[f64; 3]>, Vec<String>) {
    let (from, to) = m.range_nm();
    let mut places: Vec<f64> = m.measured_nm();
    if places.is_empty() {
        places = (36..=83).map(|tens| f64::from(tens) * 10.0).collect();
    }
    places.retain(|nm| (from..=to).contains(nm));
    let (mut known, mut left_out) = (Vec::new(), Vec::new());
    for nm in places {
        match m.index(nm, Extrapolate::Refuse) {
            Ok(index) => known.push([nm, index.n, index.k]),
            Err(why) => left_out.push(why),
        }
    }
    (known, left_out)
}
