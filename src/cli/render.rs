//! `render`: draws an effect beside its truth.

use std::path::{Path, PathBuf};

use clap::Args;
use glam::DVec3;

use crate::cli::error::Error;
use crate::cli::flags::choice::one_of;
use crate::cli::flags::material::{FilmFlags, MaterialName};
use crate::cli::flags::output::{ReportFlags, file_only};
use crate::cli::output::{Output, Progress, report_beside};
use crate::cli::places::try_files;
use crate::generator::command_line::{CommandLine, path_again};
use crate::generator::emit::MARK;
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::fit::values_for_material;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::generator::request::Source;
use crate::generator::request::source::{self, Loaded, load};
use crate::lab::gpu::{Device, Wanted};
use crate::physics::foreign;
use crate::physics::materials::{Material, MaterialKind, ViewingConditions};
use crate::physics::spectra::{Space, srgb_byte};
use crate::pictures::captioned::{ColourBar, Panel, PanelRow, PanelSheet};
use crate::pictures::plot::{capital, shade_bytes};
use crate::pictures::scene::{
    self, Difference, Display, Environment, OpticalMaterial, Picture, PictureRequest, RenderRow,
    RenderedRow, RowText, TONE_CURVES, ToneCurve,
};

/// The flags of `render`.
#[derive(Args, Debug)]
#[command(after_help = after_help())]
pub struct RenderFlags {
    /// Which effect: see below
    #[arg(value_name = "NAME", value_parser = one_of("picture", scene::ALL, |row: &RenderRow| row.name))]
    pub name: &'static RenderRow,
    /// Pixels a side of each panel, 16 to 2048
    #[arg(long, value_name = "PIXELS", default_value_t = 512)]
    pub size: u32,
    /// The picture: .png as it is shown, .exr as linear radiance [default: NAME.png]
    #[arg(short = 'o', value_name = "FILE", value_parser = file_only("-o"))]
    pub output: Option<PathBuf>,
    /// Brighter by so many stops, -16 to 16
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub exposure: f64,
    /// What keeps bright things apart: none, aces, reinhard
    #[arg(long, value_name = "NAME", default_value = "none", value_parser = one_of("tone curve", TONE_CURVES, |curve| curve.name))]
    pub tone_curve: ToneCurve,
    /// What the body is made of: a name, or the path of a material file [default: the picture's own]
    #[arg(long, value_name = "NAME", value_parser = MaterialName::parse)]
    pub material: Option<MaterialName>,
    /// The film where it is thickest.
    #[command(flatten)]
    pub films: FilmFlags,
    /// What is around it: a picture twice as wide as high, HDR, EXR, PNG or JPEG [default: a sky of ours]
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,
    /// Draw with the environment clamped to white, as a picture of 8 bits is; the truth keeps its range
    #[arg(long)]
    pub ldr: bool,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl RenderFlags {
    /// The picture's path.
    pub fn file(&self) -> PathBuf {
        let usual = || PathBuf::from(format!("{}.png", self.name.name));
        self.output.clone().unwrap_or_else(usual)
    }

    /// The command that draws this again, without the paths of outputs.
    pub fn command_line(&self) -> CommandLine {
        let number = |value: f64| (value != 0.0).then_some(value);
        let curve = self.tone_curve.name;
        let environment = self.environment.iter();
        let environment = environment.map(|file| path_again(&file.to_string_lossy()));
        CommandLine::new("render")
            .argument(self.name.name)
            .number("size", self.size)
            .list("exposure", number(self.exposure))
            .list("tone-curve", (curve != "none").then_some(curve))
            .list("material", &self.material)
            .each("film", &self.films.film)
            .list("environment", environment)
            .switch("ldr", self.ldr)
    }
}

fn after_help() -> String {
    let width = scene::ALL.iter().map(|row| row.name.len());
    let width = width.max().unwrap_or(0);
    let line = |row: &RenderRow| format!("  {:width$}  {}\n", row.name, row.summary);
    let names: String = scene::ALL.iter().map(line).collect();
    format!(
        "Names:\n{names}\nExamples:\n  fresnel-gen render double_refraction -o ball.png\n  fresnel-gen render double_refraction --material sf11 --size 256 --tone-curve aces --json -\n\nThe picture has three panels: what the effect draws, what a ray tracer in f64 sees, and their difference (CIEDE2000, with a bar that says how far its colours go). Exit codes: 0 done, 2 wrong input, 3 something is missing here."
    )
}

/// The limits of a run: pixels a side, and stops of exposure.
const SIZES: std::ops::RangeInclusive<u32> = 16..=2048;
const STOPS: std::ops::RangeInclusive<f64> = -16.0..=16.0;

/// Draws.
pub fn run(flags: &RenderFlags, progress: Progress) -> Result<Output, Error> {
    check(flags)?;
    let file = flags.file();
    let is_exr = is_exr(&file)?;
    if flags.output.is_none() && try_places_of_ours(std::slice::from_ref(&file), false).is_err() {
        let why = format!(
            "{} lies here, and this program did not write it; name the picture's file with -o",
            foreign::path(&file)
        );
        return Err(Error::usage(why));
    }
    let named = flags.report.json.iter().chain([&file]);
    try_files(&named.map(|file| file.as_path()).collect::<Vec<_>>())?;
    let subject = subject(flags)?;
    let row = flags.name;
    let surface = &subject.reference.surface;
    let material = match row.film {
        Some(_) => OpticalMaterial::under_a_film(surface, subject.material.films[0].thickness_nm),
        None => OpticalMaterial::of_surface(surface),
    };
    let values = row
        .film
        .map(|_| values_for_material(&subject, RowText::usual(row).method));
    let environment = environment(flags.environment.as_deref())?;
    let device = Device::open(&Wanted::default()).map_err(lacking)?;
    let display = Display {
        exposure: flags.exposure,
        curve: flags.tone_curve,
    };
    let request = PictureRequest {
        row,
        material: &material,
        material_name: &subject.name,
        values: values.as_ref(),
        environment: &environment,
        is_ldr: flags.ldr,
        size: flags.size,
        display,
    };
    let picture = scene::render(&device, &request, progress).map_err(lacking)?;
    let command: String = flags.command_line().into();
    let bytes = if is_exr {
        panels_exr(&picture)
    } else {
        panels_png(&picture, &display, &command)
    };
    let drawn = vec![OutputFile::named(&file, bytes.map_err(Error::usage)?)];
    let adapter = device.adapter.to_string();
    let text = render_text(&picture.row, &adapter);
    let json = Report::new(command, vec![picture.row]).with_device(Some(adapter));
    let mut output = report_beside(text, &json, flags.report.json(), drawn)?;
    output
        .remarks
        .push(format!("{}: drawn, truth, error", foreign::path(&file)));
    Ok(output)
}

fn check(flags: &RenderFlags) -> Result<(), Error> {
    let out_of_range = |flag, value: String, allowed: &str| RequestFault::OutOfRange {
        flag,
        value,
        allowed: allowed.to_owned(),
    };
    let (size, exposure) = (flags.size, flags.exposure);
    if !SIZES.contains(&size) {
        return Err(out_of_range("size", size.to_string(), "is 16 to 2048 pixels a side").into());
    }
    if !STOPS.contains(&exposure) {
        return Err(out_of_range("exposure", exposure.to_string(), "is -16 to 16 stops").into());
    }
    if flags.ldr && !flags.name.is_under_the_sky() {
        let name = flags.name.name;
        let why = format!("{name} has no environment to clamp; leave --ldr out");
        return Err(Error::usage(why));
    }
    Ok(())
}

/// Whether the file is OpenEXR; it is PNG otherwise.
fn is_exr(file: &Path) -> Result<bool, Error> {
    let ending = file.extension().and_then(|ending| ending.to_str());
    match ending.map(str::to_lowercase).as_deref() {
        Some("exr") => Ok(true),
        Some("png") => Ok(false),
        _ => Err(Error::usage(format!(
            "-o {}: the picture's name ends in .png or .exr",
            foreign::path(&file)
        ))),
    }
}

/// The body's material, in air.
fn subject(flags: &RenderFlags) -> Result<MaterialInMedium, Error> {
    let row = flags.name;
    let source = match &flags.material {
        Some(name) => flags.films.on(name.source()?)?,
        None if flags.films.film.is_empty() => row.source(),
        None => flags.films.on(Source::Named(row.material.to_owned()))?,
    };
    let Loaded {
        argument, material, ..
    } = load(&source)?;
    check_material(row, &material)?;
    let viewing = ViewingConditions::default();
    let typed = (argument, material);
    let subject = MaterialInMedium::new(typed, None, &viewing, Derivation::default())?;
    if row.film.is_some() {
        check_film(row, &subject)?;
    }
    Ok(subject)
}

/// Refuses what a row cannot show.
fn check_material(row: &'static RenderRow, material: &Material) -> Result<(), Error> {
    if let (None, Some(films)) = (row.film, material.films_in_words()) {
        return Err(Error::usage(format!(
            "the material `{}` is under films ({films}), and {} is drawn of a bare material; thin_film and soap_film show films",
            material.name, row.name
        )));
    }
    if row.film.is_none() && row.is_transparent() && material.kind != MaterialKind::Dielectric {
        return Err(Error::usage(format!(
            "the material `{}` is a {}; {} wants a dielectric",
            material.name,
            material.kind.name(),
            row.name
        )));
    }
    Ok(())
}

/// Refuses what is not under one clear film, and for a film that hangs free what lies on anything but air.
fn check_film(row: &'static RenderRow, subject: &MaterialInMedium) -> Result<(), Error> {
    let name = &subject.name;
    if !subject.is_described_by(RowText::usual(row).method) {
        let why = format!(
            "{} shows one clear film (k below .05), and `{name}` is not under one; name a film and its thickest place, such as --material {} --film {}",
            row.name,
            row.material,
            row.film.unwrap_or_default()
        );
        return Err(Error::usage(why));
    }
    if row.is_transparent() && !scene::hangs_free(&subject.reference.surface) {
        let why = format!(
            "{} shows a film that hangs free, and `{name}` lies on something; take thin_film for it, or --material air",
            row.name
        );
        return Err(Error::usage(why));
    }
    Ok(())
}

/// The picture of the surroundings, or the default sky.
pub(super) fn environment(file: Option<&Path>) -> Result<Environment, Error> {
    let Some(file) = file else {
        return Ok(scene::sky());
    };
    let bytes = source::picture(file)?;
    Environment::read(&bytes, Space::Srgb)
        .map_err(|fault| Error::usage(format!("{}: {fault}", foreign::path(file))))
}

fn lacking(why: impl ToString) -> Error {
    Error::lacking(why.to_string())
}

/// The facts about a picture, a line each.
pub fn render_text(row: &RenderedRow, adapter: &str) -> String {
    let error = |of: Difference| format!("mean {:.2}, 99th percentile {:.2}", of.mean, of.p99);
    let size = format!("{0} x {0} pixels", row.size);
    let size = match row.samples {
        1 => size,
        samples => format!("{size} of {samples} samples"),
    };
    let body = match row.film_nm {
        Some(nm) => format!(
            "{} of {}, 0 nm at its top to {nm} nm at its bottom",
            row.body, row.material
        ),
        None => format!("{} of {}, n {:.4}", row.body, row.material, row.n),
    };
    let mut lines = vec![
        ("effect", row.effect.to_owned()),
        ("body", body),
        ("size", size),
        ("drawn by", adapter.to_owned()),
        ("error", format!("{}: {}", row.metric, error(row.error))),
    ];
    if let (Some(l1), Some(energy)) = (row.l1, row.energy) {
        let light = format!("relative L1 {}, energy {}", percent(l1), percent(energy));
        lines.push(("light", light));
    }
    let own = error(row.own_error) + ", against light that goes as far as the effect follows it";
    lines.push(("own paths", own));
    if row.searches {
        lines.push(("search", searched(row)));
    }
    if let Some(leaks) = row.leaks {
        let samples = format!("{leaks} samples show what lies on the other side of the water");
        lines.push(("leaks", samples));
    }
    lines.push(("wrong", row.wrong.to_owned()));
    let line = |(name, value): &(&str, String)| format!("{name:11}{value}\n");
    lines.iter().map(line).collect()
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

/// The results of the search for the second surface.
fn searched(row: &RenderedRow) -> String {
    format!(
        "{} hits, {} misses; {} reflected totally inside, {} in truth; {} falsely, {} missed",
        percent(row.hits),
        percent(row.misses),
        percent(row.total),
        percent(row.true_total),
        percent(row.false_total),
        percent(row.missed_total)
    )
}

/// The three panels with their titles as PNG, in sRGB; the bar says how far the error map goes.
///
/// # Errors
/// The picture cannot be encoded; the text says why.
pub fn panels_png(picture: &Picture, display: &Display, about: &str) -> Result<Vec<u8>, String> {
    let row = &picture.row;
    let shown = |radiance: &DVec3| display.shown(*radiance).to_array().map(srgb_byte);
    let colours = |radiance: &[DVec3]| radiance.iter().map(shown).collect();
    let map = picture.map.iter();
    let error = row.error;
    let most = ColourBar::end_for(error.p99.max(1.0));
    let words = format!(
        "{} on average, 99 % of pixels below {}",
        number(error.mean),
        number(error.p99)
    );
    let what = match row.film_nm {
        Some(nm) => format!("{} of {}, up to {nm} nm", row.body, row.material),
        None => format!("{} of {}", row.body, row.material),
    };
    let sheet = PanelSheet {
        heading: format!(
            "{}: {what}",
            capital(&row.effect.replace('_', " ").replace("f0", "F0"))
        ),
        about: String::new(),
        size: [row.size; 2],
        rows: vec![PanelRow {
            name: String::new(),
            panels: vec![
                Panel::new(
                    "drawn by the effect",
                    colours(&picture.drawn),
                    String::new(),
                ),
                Panel::new("truth", colours(&picture.truth), String::new()),
                Panel::new(
                    "difference",
                    map.map(|error| shade_bytes(error / most)).collect(),
                    words,
                ),
            ],
        }],
        bar: Some(ColourBar {
            title: "difference of colours, ΔE₀₀: 1 is just seen".to_owned(),
            most,
        }),
        foot: format!("fresnel-gen {about}"),
    };
    sheet.png(format!("{MARK}: {about}"))
}

/// A difference of colours with as many digits as are worth reading.
fn number(difference: f64) -> String {
    if difference < 9.95 {
        format!("{difference:.1}")
    } else {
        format!("{difference:.0}")
    }
}

/// The three panels side by side as OpenEXR in binary32: radiance, radiance, and the error in all three channels.
///
/// # Errors
/// The picture cannot be encoded; the text says why.
pub fn panels_exr(picture: &Picture) -> Result<Vec<u8>, String> {
    let radiance = |colour: &DVec3| colour.as_vec3().to_array();
    let pixels = panels(picture, radiance, |error| [*error as f32; 3]);
    let size = picture.row.size as usize;
    let channel = |(i, name): (usize, &'static str)| {
        let samples = pixels.iter().map(|pixel| pixel[i]).collect();
        exr::prelude::AnyChannel::new(name, exr::prelude::FlatSamples::F32(samples))
    };
    let channels = ["R", "G", "B"].into_iter().enumerate().map(channel);
    let channels = exr::prelude::AnyChannels::sort(channels.collect());
    let image = exr::prelude::Image::from_channels((3 * size, size), channels);
    let mut bytes = std::io::Cursor::new(Vec::new());
    let writer = exr::prelude::WritableImage::write(&image).non_parallel();
    writer
        .to_buffered(&mut bytes)
        .map_err(|why| why.to_string())?;
    Ok(bytes.into_inner())
}

/// The pixels of the picture, its truth and its error side by side, row by row.
fn panels<T>(picture: &Picture, colour: impl Fn(&DVec3) -> T, error: impl Fn(&f64) -> T) -> Vec<T> {
    let size = picture.row.size as usize;
    let mut pixels = Vec::with_capacity(3 * size * size);
    for y in 0..size {
        let row = y * size..(y + 1) * size;
        pixels.extend(picture.drawn[row.clone()].iter().map(&colour));
        pixels.extend(picture.truth[row.clone()].iter().map(&colour));
        pixels.extend(picture.map[row].iter().map(&error));
    }
    pixels
}
