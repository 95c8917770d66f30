//! `scene-error`: the error of methods in pictures of an object.

use std::path::PathBuf;

use glam::DVec3;

use crate::cli::args::{Choice, SceneErrorFlags};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::request::{Materials, Request, source};
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::emit::MARK;
use crate::generator::fit::values_for_material;
use crate::generator::reference::MaterialInMedium;
use crate::lab::raster::{Body, Camera, Frame, Lens, Mesh, Painted, SceneErrorRow, Shown, Turntable, draw, mesh_of_obj, rendered_error, shown};
use crate::language::ir::Checked;
use crate::language::methods::Method;
use crate::physics::materials::{FileFault, ViewingConditions};
use crate::physics::num::in_parallel;
use crate::generator::envelope::Report;
use crate::cli::scene_error_text::{painted_exr, painted_png, scene_error_text};

use crate::cli::command::{Output, Progress, not_drawn, report_beside, try_places};

/// The longest side of a mesh's box, in metres.
const EXTENT: f64 = 1.0;
const FRAMES: std::ops::RangeInclusive<usize> = 1..=720;
const FIELDS_OF_VIEW: std::ops::RangeInclusive<f64> = 1.0..=170.0;

/// A method that describes a material, as its function.
struct Pair<'a> {
    subject: &'a MaterialInMedium,
    method: &'static Method,
    function: Checked,
}

/// Draws, and compares.
pub fn run(flags: &SceneErrorFlags, progress: Progress) -> Result<Output, Error> {
    check(flags)?;
    let viewing = flags.viewing.conditions()?;
    let subjects = subjects(flags, &viewing)?;
    let (pairs, left_out) = pairs(flags, &subjects);
    if pairs.is_empty() {
        return Err(RequestFault::NothingToDo {
            work: "compare",
            why: "no such method for these materials",
        }
        .into());
    }
    let places = places(flags, &pairs);
    try_places(flags.report.json(), places.first().map(PathBuf::as_path))?;
    try_places_of_ours(&places, flags.pictures.overwrite)?;
    let mesh = mesh(flags)?;
    let cameras = cameras(flags, &mesh)?;
    let shown = shown(&mesh, &cameras, &mut |done, whole| {
        progress(done, whole, "frames");
    });
    if shown.pixels == 0 {
        let why = "no pixel shows the object: a larger --size or a nearer --eye would";
        return Err(RequestFault::conflict(why).into());
    }
    let rows = rows(flags, &viewing, &shown, &pairs, progress);
    let command: String = flags.command_line(&viewing).into();
    let drawn = match flags.pictures.folder() {
        Some(_) => pictures(flags, &viewing, &draw(&mesh, &cameras[0]), &pairs)?,
        None => Vec::new(),
    };
    let folder = flags.pictures.folder();
    let said = folder.map(|folder| {
        format!(
            "{}: {} pictures",
            crate::physics::foreign::path(folder),
            drawn.len()
        )
    });
    let (text, json) = (scene_error_text(&rows), Report::new(command, rows));
    let mut output = report_beside(text, &json, flags.report.json(), drawn)?;
    output.remarks.splice(0..0, left_out);
    output.remarks.extend(said);
    Ok(output)
}

fn check(flags: &SceneErrorFlags) -> Result<(), Error> {
    let out_of_range = |flag, value: String, allowed: &str| RequestFault::OutOfRange {
        flag,
        value,
        allowed: allowed.to_owned(),
    };
    if flags.object.is_none() && flags.mesh.is_none() {
        let names: Vec<&str> = Body::ALL.iter().map(|body| body.name).collect();
        let what = format!(
            "name the object that is drawn: {}, or an OBJ file with --mesh FILE; `fresnel-gen scene-error --help` has an example",
            names.join(", ")
        );
        return Err(Error::usage(what));
    }
    if !FRAMES.contains(&flags.frames) {
        return Err(out_of_range("frames", flags.frames.to_string(), "is 1 to 720").into());
    }
    if !FIELDS_OF_VIEW.contains(&flags.fov) {
        return Err(out_of_range("fov", flags.fov.to_string(), "is 1 to 170 degrees").into());
    }
    Ok(())
}

fn subjects(
    flags: &SceneErrorFlags,
    viewing: &ViewingConditions,
) -> Result<Vec<MaterialInMedium>, Error> {
    let materials = flags.materials.materials()?;
    if materials == Materials::None {
        return Err(RequestFault::NoMaterial {
            why: "an error in a picture is of materials; `none` leaves nothing to draw",
        }
        .into());
    }
    let request = Request {
        materials,
        medium: flags.medium.source()?,
        viewing: viewing.clone(),
        ..Request::default()
    };
    Ok(request.subjects()?.materials())
}

/// Each material with each method that describes it, and what is left out.
fn pairs<'a>(
    flags: &SceneErrorFlags,
    subjects: &'a [MaterialInMedium],
) -> (Vec<Pair<'a>>, Vec<String>) {
    let (mut pairs, mut left_out) = (Vec::new(), Vec::new());
    for subject in subjects {
        for method in methods(flags, subject) {
            let function = method.specialise(&values_for_material(subject, method));
            match function {
                Ok(function) if subject.is_described_by(method) => pairs.push(Pair {
                    subject,
                    method,
                    function,
                }),
                _ => left_out.push(format!(
                    "left out: {} does not describe {}",
                    method.name, subject.name
                )),
            }
        }
    }
    (pairs, left_out)
}

fn methods(flags: &SceneErrorFlags, subject: &MaterialInMedium) -> Vec<&'static Method> {
    if flags.method.is_empty() {
        let names = subject.default_methods().into_iter();
        return names.filter_map(crate::language::methods::find).collect();
    }
    Choice::methods(&flags.method)
}

/// The object, in the origin.
fn mesh(flags: &SceneErrorFlags) -> Result<Mesh, Error> {
    let Some(file) = &flags.mesh else {
        let body = flags.object.expect("clap asks for an object or a mesh");
        return Ok(body.mesh());
    };
    let text = source::mesh(file)?;
    let mesh = mesh_of_obj(&text).map_err(|fault| FileFault {
        file: file.display().to_string(),
        line: fault.line,
        column: 1,
        what: fault.what,
    })?;
    Ok(mesh.with_extent(EXTENT))
}

fn cameras(flags: &SceneErrorFlags, mesh: &Mesh) -> Result<Vec<Camera>, Error> {
    let lens = Lens {
        size: flags.size,
        vertical_degrees: flags.fov,
    };
    let Some(eye) = flags.eye.map(DVec3::from_array) else {
        let turntable = Turntable {
            frames: flags.frames,
            lens,
            ..Turntable::THESIS
        };
        return Ok(turntable.cameras());
    };
    let radius = mesh.radius();
    if eye.length() <= radius {
        return Err(RequestFault::OutOfRange {
            flag: "eye",
            value: format!("{:.3} m from the object's centre", eye.length()),
            allowed: format!("is farther away than {radius:.3} m, the object's farthest corner"),
        }
        .into());
    }
    Ok(vec![Camera::looking(eye, DVec3::ZERO, lens)])
}

fn rows(
    flags: &SceneErrorFlags,
    viewing: &ViewingConditions,
    shown: &Shown,
    pairs: &[Pair],
    progress: Progress,
) -> Vec<SceneErrorRow> {
    let named = flags.mesh.as_ref().map(|file| file.display().to_string());
    let object = named.or(flags.object.map(|body| body.name.to_owned()));
    let object = object.unwrap_or_default();
    let view = flags.eye.map_or("turntable", |_| "fixed");
    let luminance = viewing.integration.space.rgb_to_xyz().row(1).to_array();
    let row = |i: usize| {
        let pair = &pairs[i];
        let reference = pair.subject.truth_for(pair.method);
        let error = rendered_error(&shown.histogram, &pair.function, &reference);
        let names = [pair.subject.name.as_str(), pair.method.name];
        SceneErrorRow::new(&object, view, shown, names, &error, luminance)
    };
    in_parallel(pairs.len(), &row, &mut |done, whole| {
        progress(done, whole, "errors");
    })
}

/// The places of all pictures, which [`pictures`] fills in this order.
fn places(flags: &SceneErrorFlags, pairs: &[Pair]) -> Vec<PathBuf> {
    let Some(folder) = flags.pictures.folder() else {
        return Vec::new();
    };
    let mut places = vec![folder.join("angles.exr")];
    for of_subject in pairs.chunk_by(|a, b| a.subject.name == b.subject.name) {
        let material = of_subject[0].subject.name.as_str();
        let methods = of_subject.iter().flat_map(|pair| {
            let name = pair.method.name;
            [format!("{name}.png"), format!("{name}_difference.png")]
        });
        let usual = ["reference.png", "reference.exr"].map(str::to_owned);
        let names = usual.into_iter().chain(methods);
        places.extend(names.map(|name| folder.join(format!("{material}_{name}"))));
    }
    places
}

/// Draws the first frame.
fn pictures(
    flags: &SceneErrorFlags,
    viewing: &ViewingConditions,
    frame: &Frame,
    pairs: &[Pair],
) -> Result<Vec<OutputFile>, Error> {
    let command: String = flags.command_line(viewing).into();
    let about: String = format!("{MARK}: {command}")
        .chars()
        .map(|c| if c.is_ascii() { c } else { '?' })
        .collect();
    let space = Some(viewing.integration.space).filter(|_| viewing.wavelengths_nm.is_none());
    let mut made = vec![painted_exr(&Painted::angles(frame), None, &about)];
    for of_subject in pairs.chunk_by(|a, b| a.subject.name == b.subject.name) {
        let subject = of_subject[0].subject;
        let reference = Painted::reference(frame, &subject.reference);
        made.push(painted_png(&reference, &about));
        made.push(painted_exr(&reference, space, &about));
        for pair in of_subject {
            let truth = pair.subject.truth_for(pair.method);
            let drawn = Painted::function(frame, &pair.function, &truth);
            made.push(painted_png(&drawn, &about));
            made.push(painted_png(&drawn.difference(&reference), &about));
        }
    }
    let made = made.into_iter().collect::<Result<Vec<_>, String>>();
    let made = made.map_err(not_drawn)?;
    let places = places(flags, pairs).into_iter().zip(made);
    let overwrite = flags.pictures.overwrite;
    let file = |(path, bytes)| OutputFile::of_report(path, bytes, overwrite);
    Ok(places.map(file).collect())
}
