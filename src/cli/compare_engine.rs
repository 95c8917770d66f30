//! `compare`: what an engine shows of materials as it ships, with F82-tint, with our functions, and what is true.

use std::path::{Path, PathBuf};

use clap::Args;
use glam::DVec3;
use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::flags::choice::{in_any_case, one_of};
use crate::cli::flags::material::{FilmFlags, MaterialName};
use crate::cli::flags::output::{ReportFlags, file_only};
use crate::cli::output::{Output, Progress, report_beside};
use crate::cli::places::try_files;
use crate::cli::render::environment;
use crate::generator::command_line::{CommandLine, path_again};
use crate::generator::emit::MARK;
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::flavours::{self, Compared, Flavour};
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::generator::request::source::{Loaded, load};
use crate::physics::foreign;
use crate::physics::materials::{Extrapolate, ViewingConditions};
use crate::physics::names::UnknownName;
use crate::physics::spectra::srgb_byte;
use crate::pictures::captioned::{ColourBar, Panel, PanelRow, PanelSheet};
use crate::pictures::plot::shade_bytes;
use crate::pictures::scene::{Difference, Display, Environment, TONE_CURVES, compare};
use crate::pictures::sphere::Sphere;
use crate::pictures::table::text_table;

/// The flags of `compare`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen compare copper platinum gold:coat\n  fresnel-gen compare my_metal.csv --engine godot --environment white -o my_metal.png\n\nEach row of the picture is a material on a smooth sphere: as the engine ships, with F82-tint (OpenPBR, Blender; of dielectrics the law for one index), with the functions of --flavour, and by the exact law over the spectrum. NAME:coat is the material below the engine's clear coat. Differences are CIEDE2000 of what a screen shows, over the sphere's pixels; 1 is just seen by who has both pictures side by side."
)]
pub struct CompareEngineFlags {
    /// Names, or paths of material files, pages or tables; with `:coat` below a clear coat
    #[arg(required = true, value_name = "NAME", value_parser = ShownMaterial::parse)]
    pub names: Vec<ShownMaterial>,
    /// The films on each of them.
    #[command(flatten)]
    pub films: FilmFlags,
    /// The engine, by the name of its adapter
    #[arg(long, value_name = "NAME", default_value = "three", value_parser = one_of("engine", flavours::ALL.iter().copied().filter(|one| one.stock.is_some()), |one: &Flavour| one.name))]
    pub engine: &'static Flavour,
    /// What is mirrored: sky (a sun, posts and a ground), white (a room that is white everywhere), or a picture twice as wide as high, HDR, EXR, PNG or JPEG
    #[arg(long, value_name = "NAME", default_value = SKY)]
    pub environment: PathBuf,
    /// Beyond the measured range: refuse, or hold the last value [default: refuse]
    #[arg(long, value_name = "HOW", value_parser = in_any_case(one_of("extrapolation", Extrapolate::ALL, Extrapolate::name)))]
    pub extrapolate: Option<Extrapolate>,
    /// Pixels a side of each sphere, 64 to 512
    #[arg(long, value_name = "PIXELS", default_value_t = 160)]
    pub size: u32,
    /// The picture, as PNG [default: compare.png]
    #[arg(short = 'o', value_name = "FILE", value_parser = file_only("-o"))]
    pub output: Option<PathBuf>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// A material, below a clear coat or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShownMaterial {
    /// The material.
    pub name: MaterialName,
    /// Whether it lies below the engine's clear coat.
    pub with_coat: bool,
}

/// What stands after the name of a coated material.
const COATED: &str = ":coat";

impl ShownMaterial {
    /// Parses a material's name, with `:coat` or without.
    ///
    /// # Errors
    /// The word is no path, and the catalogue has no such material.
    pub fn parse(word: &str) -> Result<ShownMaterial, UnknownName> {
        let (name, with_coat) = match word.strip_suffix(COATED) {
            Some(name) => (name, true),
            None => (word, false),
        };
        let name = MaterialName::parse(name)?;
        Ok(ShownMaterial { name, with_coat })
    }
}

impl core::fmt::Display for ShownMaterial {
    fn fmt(&self, f: &mut core::fmt::Formatter) -> core::fmt::Result {
        let coat = if self.with_coat { COATED } else { "" };
        write!(f, "{}{coat}", self.name)
    }
}

/// The names of environments that are no pictures.
const SKY: &str = "sky";
const WHITE: &str = "white";
/// The file if none is named.
const FILE: &str = "compare.png";
/// How tall a picture may be in pixels, and what a row needs beside its spheres.
const TALLEST: u32 = 15_000;
const ROW: u32 = 100;
const SIZES: std::ops::RangeInclusive<u32> = 64..=512;
/// The brightest colour of a map of differences, in CIEDE2000.
const ERROR_SCALE: f64 = 10.0;
/// A difference of colours that is just seen, in CIEDE2000.
const SEEN: f64 = 1.0;

impl CompareEngineFlags {
    /// The picture's path.
    pub fn file(&self) -> PathBuf {
        self.output.clone().unwrap_or_else(|| FILE.into())
    }

    /// The picture of the environment, if it is a file.
    pub fn environment_file(&self) -> Option<&Path> {
        let is_named = [SKY, WHITE]
            .iter()
            .any(|name| self.environment == Path::new(name));
        (!is_named).then_some(self.environment.as_path())
    }

    /// The paths that it reads.
    pub fn inputs(&self) -> impl Iterator<Item = &Path> {
        let names = self.names.iter().filter_map(|one| one.name.path());
        let paths = names.chain(self.films.paths()).map(Path::new);
        paths.chain(self.environment_file())
    }

    /// The environment as a user would type it again.
    fn environment_again(&self) -> String {
        match self.environment_file() {
            Some(file) => path_again(&file.to_string_lossy()),
            None => self.environment.display().to_string(),
        }
    }

    /// The command that draws this again, without the paths of outputs.
    pub fn command_line(&self) -> CommandLine {
        let environment = self.environment_again();
        let names = self.names.iter();
        names
            .fold(CommandLine::new("compare"), |command, one| {
                command.argument(&one.to_string())
            })
            .each("film", &self.films.film)
            .list(
                "engine",
                (self.engine.name != "three").then_some(self.engine.name),
            )
            .list("environment", (environment != SKY).then_some(environment))
            .list("extrapolate", self.extrapolate.map(Extrapolate::name))
            .number("size", self.size)
    }
}

/// What a report says of a material. Differences are of what a screen shows.
#[derive(Debug, Serialize)]
struct ComparedShown {
    material: String,
    with_coat: bool,
    engine: &'static str,
    environment: String,
    /// The engine as it ships.
    stock: OneWay,
    /// F82-tint, or the law for one index.
    f82: OneWay,
    /// Our adapter.
    fitted: OneWay,
}

/// One way to draw a material.
#[derive(Debug, Serialize)]
struct OneWay {
    /// The formula, in words.
    model: &'static str,
    /// The difference from the truth over the sphere's pixels.
    delta_e2000: Difference,
    /// The share of pixels whose difference is seen.
    seen: f64,
    /// The largest error of a channel of reflectance, over angles.
    max_abs: f64,
}

/// Draws materials by an engine.
pub fn run(flags: &CompareEngineFlags, progress: Progress) -> Result<Output, Error> {
    if !SIZES.contains(&flags.size) {
        return Err(RequestFault::OutOfRange {
            flag: "size",
            value: flags.size.to_string(),
            allowed: "is 64 to 512 pixels a side".to_owned(),
        }
        .into());
    }
    let most = TALLEST / (flags.size + ROW);
    if flags.names.len() > most as usize {
        return Err(Error::usage(format!(
            "{} materials do not fit into one picture; at this --size {most} do",
            flags.names.len()
        )));
    }
    let file = check_place(flags)?;
    let viewing = ViewingConditions {
        beyond: flags.extrapolate.unwrap_or_default(),
        ..ViewingConditions::default()
    };
    let environment = surroundings(flags)?;
    let mut all = Vec::new();
    for (done, shown) in flags.names.iter().enumerate() {
        progress(done as u64, flags.names.len() as u64, "materials");
        let subject = subject(flags, shown, &viewing)?;
        let compared = Compared::new(flags.engine, &subject, &viewing, shown.with_coat);
        let compared = compared.map_err(|fault| Error::usage(fault.to_string()))?;
        all.push((subject.name, shown.with_coat, compared));
    }
    let sphere = Sphere::new(flags.size, &environment);
    let drawn: Vec<(PanelRow, ComparedShown)> = all
        .iter()
        .enumerate()
        .map(|(place, one)| drawn(flags, &sphere, one, place == 0))
        .collect();
    let (rows, shown): (Vec<PanelRow>, Vec<ComparedShown>) = drawn.into_iter().unzip();
    let is_told = sphere.lights().any(|light| (0.02..=4.0).contains(&light.y));
    let command: String = flags.command_line().into();
    let sheet = PanelSheet {
        heading: format!("{} and the truth", flags.engine.host),
        about: format!(
            "A smooth sphere mirrors {}. Numbers: ΔE₀₀ on average, and what 99 % of the sphere's pixels stay below; 1 is just seen.",
            match flags.environment_file() {
                Some(_) => "the picture of the command".to_owned(),
                None if flags.environment == Path::new(WHITE) => "a white room".to_owned(),
                None => "a sky with its sun".to_owned(),
            }
        ),
        size: [flags.size; 2],
        rows,
        bar: Some(ColourBar {
            title: "difference of colours from the truth, ΔE₀₀".to_owned(),
            most: ERROR_SCALE,
        }),
        foot: format!("fresnel-gen {command}"),
    };
    let about: String = format!("{MARK}: {command}")
        .chars()
        .map(|c| if c.is_ascii() { c } else { '?' })
        .collect();
    let bytes = sheet.png(about).map_err(Error::usage)?;
    let text = comparison_text(&shown, flags.engine);
    let picture = match flags.output {
        Some(_) => OutputFile::named(&file, bytes),
        None => OutputFile::of_report(&file, bytes, false),
    };
    let mut output = report_beside(
        text,
        &Report::new(command, shown),
        flags.report.json(),
        vec![picture],
    )?;
    if !is_told {
        let remark =
            "the environment is black or brighter than white throughout: it shows no difference";
        output.remarks.push(remark.to_owned());
    }
    output
        .remarks
        .push(format!("{}: drawn", foreign::path(&file)));
    Ok(output)
}

/// The picture's place, if it may be written.
fn check_place(flags: &CompareEngineFlags) -> Result<PathBuf, Error> {
    let file = flags.file();
    let ending = file.extension().and_then(|ending| ending.to_str());
    if ending.map(str::to_lowercase).as_deref() != Some("png") {
        let file = foreign::path(&file);
        return Err(Error::usage(format!(
            "-o {file}: the picture's name ends in .png"
        )));
    }
    if flags.output.is_none() && try_places_of_ours(std::slice::from_ref(&file), false).is_err() {
        return Err(Error::usage(format!(
            "{FILE} lies here, and this program did not write it; name the picture's file with -o"
        )));
    }
    let named = flags.report.json.iter().chain([&file]);
    try_files(&named.map(PathBuf::as_path).collect::<Vec<_>>())?;
    Ok(file)
}

fn surroundings(flags: &CompareEngineFlags) -> Result<Environment, Error> {
    if flags.environment == Path::new(WHITE) {
        return Ok(Environment::baked(2, |_| DVec3::ONE));
    }
    environment(flags.environment_file())
}

fn subject(
    flags: &CompareEngineFlags,
    shown: &ShownMaterial,
    viewing: &ViewingConditions,
) -> Result<MaterialInMedium, Error> {
    let Loaded {
        argument, material, ..
    } = load(&flags.films.on(shown.name.source()?)?)?;
    Ok(MaterialInMedium::new(
        (argument, material),
        None,
        viewing,
        Derivation::default(),
    )?)
}

/// A row of the picture, and of the report. Only the first row has titles.
fn drawn(
    flags: &CompareEngineFlags,
    sphere: &Sphere,
    (name, with_coat, compared): &(String, bool, Compared),
    is_first: bool,
) -> (PanelRow, ComparedShown) {
    let display = Display {
        exposure: 0.0,
        curve: TONE_CURVES[0],
    };
    let truth = sphere.drawn(&compared.truth);
    let counts = sphere.is_whole();
    let way = |model: &'static str, curve: &[[f64; 3]]| {
        let radiance = sphere.drawn(curve);
        let (map, delta_e2000) = compare(&radiance, &truth, &counts, &display);
        let counted = || map.iter().zip(&counts).filter(|(_, counts)| **counts);
        let seen = counted().filter(|(apart, _)| **apart > SEEN).count();
        let pairs = curve.iter().zip(&compared.truth);
        let apart = pairs.flat_map(|(a, b)| [0, 1, 2].map(|i| (a[i] - b[i]).abs()));
        let one = OneWay {
            model,
            delta_e2000,
            seen: seen as f64 / counted().count().max(1) as f64,
            max_abs: apart.fold(0.0, f64::max),
        };
        (one, radiance, map)
    };
    let (stock, stock_drawn, stock_map) = way(compared.stock_model, &compared.stock);
    let (f82, f82_drawn, _) = way(compared.f82_model, &compared.f82);
    let (fitted, fitted_drawn, fitted_map) = way(compared.method, &compared.ours);
    let on_white = |colours: Vec<[u8; 3]>| -> Vec<[u8; 3]> {
        let pairs = colours.into_iter().zip(&sphere.coverage);
        let over = |(colour, share): ([u8; 3], &f64)| {
            colour.map(|byte| (share * f64::from(byte) + (1.0 - share) * 255.0).round() as u8)
        };
        pairs.map(over).collect()
    };
    let colour = |(radiance, share): (&DVec3, &f64)| {
        // A pixel at the rim holds what the sphere shows there.
        display
            .shown(*radiance / share.max(1e-9))
            .to_array()
            .map(srgb_byte)
    };
    let shown =
        |radiance: &[DVec3]| on_white(radiance.iter().zip(&sphere.coverage).map(colour).collect());
    let map = |map: &[f64]| {
        on_white(
            map.iter()
                .map(|apart| shade_bytes(apart / ERROR_SCALE))
                .collect(),
        )
    };
    let words = |way: &OneWay| {
        format!(
            "{}, 99 % below {}",
            number(way.delta_e2000.mean),
            number(way.delta_e2000.p99)
        )
    };
    let mut panels = vec![
        Panel::new("as it ships", shown(&stock_drawn), words(&stock)),
        Panel::new("F82-tint", shown(&f82_drawn), words(&f82)),
        Panel::new("with fresnel-gen", shown(&fitted_drawn), words(&fitted)),
        Panel::new("truth", shown(&truth), String::new()),
        Panel::new("error as it ships", map(&stock_map), String::new()),
        Panel::new("error with fresnel-gen", map(&fitted_map), String::new()),
    ];
    if !is_first {
        panels.iter_mut().for_each(|panel| panel.title.clear());
    }
    let coat = if *with_coat {
        " below a clear coat"
    } else {
        ""
    };
    let row = PanelRow {
        name: format!("{}{coat}", name.replace('_', " ")),
        panels,
    };
    let shown = ComparedShown {
        material: name.clone(),
        with_coat: *with_coat,
        engine: flags.engine.name,
        environment: flags.environment_again(),
        stock,
        f82,
        fitted,
    };
    (row, shown)
}

/// A difference of colours with the digits that are worth reading.
fn number(difference: f64) -> String {
    if difference < 0.095 {
        format!("{difference:.2}")
    } else {
        format!("{difference:.1}")
    }
}

/// A line for each material, and the advice.
fn comparison_text(rows: &[ComparedShown], engine: &Flavour) -> String {
    let head = [
        "material",
        "as it ships",
        "99 %",
        "seen",
        "F82-tint",
        "99 %",
        "fresnel-gen",
        "99 %",
        "worth it?",
    ];
    let cells: Vec<Vec<String>> = rows
        .iter()
        .map(|row| {
            let coat = if row.with_coat { COATED } else { "" };
            let both = |way: &OneWay| [way.delta_e2000.mean, way.delta_e2000.p99].map(number);
            let [stock, f82, fitted] = [&row.stock, &row.f82, &row.fitted].map(both);
            let seen = format!("{:.0} %", 100.0 * row.stock.seen);
            let mut cells = vec![format!("{}{coat}", row.material)];
            cells.extend(stock);
            cells.push(seen);
            cells.extend(f82);
            cells.extend(fitted);
            cells.push(advice(row).to_owned());
            cells
        })
        .collect();
    format!(
        "{}: differences from the truth on a sphere, CIEDE2000 (1 is just seen): the mean and what 99 % of its pixels stay below; seen: the pixels above 1\n\n{}",
        engine.host,
        text_table(&head, &cells)
    )
}

/// Whether our functions are worth their place.
fn advice(row: &ComparedShown) -> &'static str {
    let (stock, fitted) = (&row.stock, &row.fitted);
    if stock.delta_e2000.p99 < SEEN {
        "no: nobody sees a difference"
    } else if 2.0 * fitted.delta_e2000.mean > stock.delta_e2000.mean {
        "no: it is no nearer to the truth"
    } else if stock.delta_e2000.mean < SEEN / 2.0 {
        "hardly: at the rim alone"
    } else if stock.seen < 0.5 {
        "where the surface is seen obliquely"
    } else {
        "yes"
    }
}
