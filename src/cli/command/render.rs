//! `render`: an effect drawn beside its truth.

use std::path::Path;

use crate::cli::args::RenderFlags;
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::request::loaded::load;
use crate::generator::request::{Source, source};
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::lab::gpu::{Device, Wanted};
use crate::physics::materials::{Material, MaterialKind, Surface, ViewingConditions};
use crate::physics::spectra::Space;
use crate::pictures::scene::{self, Display, Environment, Glass, Order};
use crate::generator::envelope::Report;
use crate::cli::render_text::{panels_exr, panels_png, render_text};

use crate::cli::command::{Output, Progress, not_drawn, report_beside, try_files};

/// Pixels a side that a run may ask for, and stops.
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
            crate::physics::foreign::path(&file)
        );
        return Err(RequestFault::conflict(why).into());
    }
    let named = flags.report.json.iter().chain([&file]);
    try_files(&named.map(|file| file.as_path()).collect::<Vec<_>>())?;
    let material = material(flags)?;
    let surface = Surface::new(&material, None, &ViewingConditions::default())?;
    let environment = environment(flags.environment.as_deref())?;
    let device = Device::open(&Wanted::default()).map_err(lacking)?;
    let display = Display {
        exposure: flags.exposure,
        curve: flags.tone_curve,
    };
    let order = Order {
        row: flags.name,
        glass: &Glass::of_surface(&surface),
        environment: &environment,
        is_ldr: flags.ldr,
        size: flags.size,
        display,
    };
    let picture = scene::render(&device, &order, &material.name, progress).map_err(lacking)?;
    let command: String = flags.command_line().into();
    let bytes = match is_exr {
        true => panels_exr(&picture),
        false => panels_png(&picture, &display, &command),
    };
    let drawn = vec![OutputFile::named(&file, bytes.map_err(not_drawn)?)];
    let adapter = device.adapter.to_string();
    let text = render_text(&picture.row, &adapter);
    let json = Report::new(command, vec![picture.row]).with_device(Some(adapter));
    let mut output = report_beside(text, &json, flags.report.json(), drawn)?;
    output.remarks.push(format!(
        "{}: drawn, truth, error",
        crate::physics::foreign::path(&file)
    ));
    Ok(output)
}

fn check(flags: &RenderFlags) -> Result<(), Error> {
    let out_of_range = |flag, value: String, allowed: &str| RequestFault::OutOfRange {
        flag,
        value,
        allowed: allowed.to_owned(),
    };
    if !SIZES.contains(&flags.size) {
        let allowed = "is 16 to 2048 pixels a side";
        return Err(out_of_range("size", flags.size.to_string(), allowed).into());
    }
    if !STOPS.contains(&flags.exposure) {
        let allowed = "is -16 to 16 stops";
        return Err(out_of_range("exposure", flags.exposure.to_string(), allowed).into());
    }
    if flags.ldr && !flags.name.is_under_the_sky() {
        let why = format!(
            "{} has no environment to clamp; leave --ldr out",
            flags.name.name
        );
        return Err(RequestFault::conflict(why).into());
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
                crate::physics::foreign::path(&file)
            ))),
    }
}

/// What the body is made of.
fn material(flags: &RenderFlags) -> Result<Material, Error> {
    let own = || Ok(Source::Named(flags.name.material.to_owned()));
    let named = flags
        .material
        .as_ref()
        .map_or_else(own, |name| name.source())?;
    let material = load(&named)?.material;
    if flags.name.is_transparent() && material.kind != MaterialKind::Dielectric {
        return Err(Error::usage(format!(
                "the material `{}` is a {}; {} wants a dielectric",
                material.name,
                material.kind.name(),
                flags.name.name
            )));
    }
    Ok(material)
}

fn environment(file: Option<&Path>) -> Result<Environment, Error> {
    let Some(file) = file else {
        return Ok(scene::sky());
    };
    let bytes = source::picture(file)?;
    Environment::read(&bytes, Space::Srgb).map_err(|fault| Error::usage(format!("{}: {fault}", crate::physics::foreign::path(file))))
}

fn lacking(why: impl ToString) -> Error {
    Error::lacking(why.to_string())
}
