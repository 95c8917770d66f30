//! `scene-error`: the error of methods in pictures of an object.

use std::path::PathBuf;

use clap::Args;
use glam::DVec3;

use crate::cli::error::Error;
use crate::cli::flags::choice::{Choice, method_or_all, one_of};
use crate::cli::flags::material::{MaterialFlags, MediumFlags};
use crate::cli::flags::output::{PictureFlags, ReportFlags, file_only};
use crate::cli::flags::viewing::{GamutFlags, numbers};
use crate::cli::output::{Output, Progress, report_beside};
use crate::cli::places::{refuse_read, try_places};
use crate::generator::command_line::{CommandLine, path_again};
use crate::generator::emit::MARK;
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::fit::values_for_material;
use crate::generator::lut::{Depth, Format, Picture, TableAxis};
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request, source};
use crate::lab::raster::{
    Body, Camera, Frame, Lens, Mesh, Painted, SceneErrorRow, Shown, Turntable, draw, mesh_of_obj,
    rendered_error, shown,
};
use crate::language::ir::Checked;
use crate::language::methods::Method;
use crate::physics::foreign::Foreign;
use crate::physics::materials::ViewingConditions;
use crate::physics::num::in_parallel;
use crate::physics::spectra::{Space, ciede2000, srgb_byte, xyz_to_lab};
use crate::physics::user_text::FileFault;
use crate::pictures::captioned::{ColourBar, Panel, PanelRow, PanelSheet};
use crate::pictures::plot::shade_bytes;
use crate::pictures::table::{short_number, text_table};

/// The flags of `scene-error`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Names, paths of material files, or all [default: gold, platinum, water, diamond]")),
    mut_arg("out_dir", |arg| arg.help("Draw the first frame into this folder: each method beside the exact law and their difference as PNG, the exact law and cos θ as EXR")),
    after_help = "Examples:\n  fresnel-gen scene-error cube --material gold\n  fresnel-gen scene-error relief --method schlick,fitted --out-dir pictures\n  fresnel-gen scene-error --mesh statue.obj --eye 0,1,-3 --material platinum --json -\n\nThe error of a picture is the mean over its pixels and three channels of |f - F| / F, then over frames with equal weight. Pixels count whose centre lies in the silhouette. Objects: cube (flat faces), relief (a sphere with bumps), sphere; each 1 m wide, and a mesh is scaled to that."
)]
pub struct SceneErrorFlags {
    /// The object: cube, relief or sphere; or a mesh with --mesh
    #[arg(value_name = "OBJECT", value_parser = one_of("object", Body::ALL, |body: &Body| body.name), conflicts_with = "mesh")]
    pub object: Option<&'static Body>,
    /// In place of an object a mesh: an OBJ file of up to 4000000 triangles
    #[arg(long, value_name = "FILE", value_parser = file_only("--mesh"))]
    pub mesh: Option<PathBuf>,
    /// Frames of the turntable, one degree each about (1, 1, 1) from 2 m, 1 to 720
    #[arg(long, value_name = "N", default_value_t = Turntable::THESIS.frames, conflicts_with = "eye")]
    pub frames: usize,
    /// In place of the turntable a fixed camera here, in metres, that looks at the object's centre
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    pub eye: Option<[f64; 3]>,
    /// Pixels across and down, each 16 to 2048
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = size)]
    pub size: [u32; 2],
    /// Vertical field of view in degrees, 1 to 170
    #[arg(long, value_name = "DEGREES", default_value_t = Turntable::THESIS.lens.vertical_degrees)]
    pub fov: f64,
    /// Methods, see `fresnel-gen methods` [default: those that a material's file holds]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// The folder of the pictures.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl SceneErrorFlags {
    /// The command that makes this report again under these viewing conditions, without the paths of outputs.
    pub fn command_line(&self, viewing: &ViewingConditions) -> CommandLine {
        let usual = Turntable::THESIS;
        let [width, height] = self.size;
        let size = (self.size != usual.lens.size).then(|| format!("{width}x{height}"));
        let fov = (self.fov != usual.lens.vertical_degrees).then_some(self.fov);
        let frames = (self.frames != usual.frames).then_some(self.frames);
        let command = CommandLine::new("scene-error");
        let command = match self.object {
            Some(body) => command.argument(body.name),
            None => command,
        };
        command
            .list(
                "mesh",
                self.mesh
                    .iter()
                    .map(|file| path_again(&file.to_string_lossy())),
            )
            .list("frames", frames)
            .list("eye", self.eye.iter().flatten())
            .list("size", size)
            .list("fov", fov)
            .list("method", &self.method)
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
            .list("medium", &self.medium.medium)
            .seen_as(viewing)
    }
}

/// A position in metres.
fn place(word: &str) -> Result<[f64; 3], String> {
    const FARTHEST: f64 = 1e6;
    let numbers = numbers(word)?;
    let Ok(three) = <[f64; 3]>::try_from(numbers.as_slice()) else {
        let count = numbers.len();
        return Err(format!(
            "it has {count} numbers; it wants x, y and z in metres, such as 0,0,-2"
        ));
    };
    // NaN fails every range.
    match three.iter().find(|x| !(-FARTHEST..=FARTHEST).contains(*x)) {
        Some(x) => Err(format!("it has {x}; a place lies within a million metres")),
        None => Ok(three),
    }
}

/// Pixels across and down.
pub(super) fn size(word: &str) -> Result<[u32; 2], String> {
    const SIDES: std::ops::RangeInclusive<u32> = 16..=2048;
    let sides = word.split_once('x').map(|(width, height)| [width, height]);
    let sides = sides.map(|sides| sides.map(|side| side.parse::<u32>().ok()));
    match sides {
        Some([Some(width), Some(height)]) if SIDES.contains(&width) && SIDES.contains(&height) => {
            Ok([width, height])
        }
        _ => Err(format!(
            "`{}` is not two sides of 16 to 2048 pixels, such as 640x480",
            crate::physics::foreign::Foreign(word)
        )),
    }
}

/// The longest side of a mesh's box, in metres.
const EXTENT: f64 = 1.0;
const FRAMES: std::ops::RangeInclusive<usize> = 1..=720;
const FIELDS_OF_VIEW: std::ops::RangeInclusive<f64> = 1.0..=170.0;

/// A method that describes a material, and its function.
struct Pair<'a> {
    subject: &'a MaterialInMedium,
    method: &'static Method,
    function: Checked,
}

/// Draws the pictures and compares them.
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
    let drawn = places.iter().map(PathBuf::as_path);
    refuse_read(flags.mesh.iter().map(PathBuf::as_path), drawn)?;
    let mesh = mesh(flags)?;
    let cameras = cameras(flags, &mesh)?;
    let shown = shown(&mesh, &cameras, &mut |done, whole| {
        progress(done, whole, "frames");
    });
    if shown.pixels == 0 {
        let why = "no pixel shows the object: a larger --size or a nearer --eye would";
        return Err(Error::usage(why));
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
        return Err(Error::usage(
            "an error in a picture is of materials; `none` leaves nothing to draw",
        ));
    }
    let request = Request {
        materials,
        medium: flags.medium.source()?,
        viewing: viewing.clone(),
        ..Request::default()
    };
    Ok(request.subjects()?.materials())
}

/// Each material with each method that describes it, and the remarks on what is left out.
fn pairs<'a>(
    flags: &SceneErrorFlags,
    subjects: &'a [MaterialInMedium],
) -> (Vec<Pair<'a>>, Vec<String>) {
    let (mut pairs, mut left_out) = (Vec::new(), Vec::new());
    for subject in subjects {
        for method in methods(flags, subject) {
            let function = method.at(&values_for_material(subject, method));
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

/// The object, centred at the origin.
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

/// The paths of all pictures, which [`pictures`] fills in this order.
fn places(flags: &SceneErrorFlags, pairs: &[Pair]) -> Vec<PathBuf> {
    let Some(folder) = flags.pictures.folder() else {
        return Vec::new();
    };
    let mut places = vec![folder.join("angles.exr")];
    for of_subject in pairs.chunk_by(|a, b| a.subject.name == b.subject.name) {
        let material = of_subject[0].subject.name.as_str();
        let methods = of_subject
            .iter()
            .map(|pair| format!("{}.png", pair.method.name));
        let names = ["reference.exr".to_owned()].into_iter().chain(methods);
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
        made.push(painted_exr(&reference, space, &about));
        for pair in of_subject {
            let truth = pair.subject.truth_for(pair.method);
            let drawn = Painted::function(frame, &pair.function, &truth);
            let names = [pair.subject.name.as_str(), pair.method.name];
            made.push(sheet_png(
                names,
                &drawn,
                &reference,
                space,
                (&command, &about),
            ));
        }
    }
    let made = made.into_iter().collect::<Result<Vec<_>, String>>();
    let made = made.map_err(Error::usage)?;
    let places = places(flags, pairs).into_iter().zip(made);
    let overwrite = flags.pictures.overwrite;
    let file = |(path, bytes)| OutputFile::of_report(path, bytes, overwrite);
    Ok(places.map(file).collect())
}

/// The errors, a line each.
fn scene_error_text(rows: &[SceneErrorRow]) -> String {
    let Some(first) = rows.first() else {
        return String::new();
    };
    let (object, view) = (Foreign(&first.object), first.view);
    let head = format!(
        "{object}, {view}: {} frames, {} pixels. Mean relative error against the exact law in per cent, over pixels, then frames\n\n",
        first.frames, first.pixels
    );
    let columns = [
        "material",
        "method",
        "red",
        "green",
        "blue",
        "mean",
        "by luminance",
        "max abs",
        "at",
    ];
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    head + &text_table(&columns, &cells)
}

fn cells(row: &SceneErrorRow) -> Vec<String> {
    let errors = row.mean_rel.map_or([f64::NAN; 5], |errors| {
        [
            errors.red,
            errors.green,
            errors.blue,
            errors.mean,
            errors.by_luminance,
        ]
    });
    let error = |error: f64| {
        if error.is_nan() {
            "not defined".to_owned()
        } else {
            format!("{error:.3}")
        }
    };
    let angle = libm::acos(row.worst_cos).to_degrees();
    let names = [row.material.clone(), row.method.clone()].into_iter();
    let last = [short_number(row.max_abs), format!("{angle:.1}°")];
    names.chain(errors.map(error)).chain(last).collect()
}

/// A method's picture beside that of the exact law, and their difference, as PNG in sRGB; or why it cannot be encoded. `about` is ASCII.
fn sheet_png(
    [material, method]: [&str; 2],
    drawn: &Painted,
    reference: &Painted,
    space: Option<Space>,
    (command, about): (&str, &str),
) -> Result<Vec<u8>, String> {
    let shown = |picture: &Painted| {
        picture
            .pixels
            .iter()
            .map(|pixel| pixel.map(srgb_byte))
            .collect()
    };
    let apart = drawn.difference(reference);
    let most = ColourBar::end_for(apart.iter().copied().fold(0.0, f64::max));
    let map = apart
        .iter()
        .map(|apart| shade_bytes(apart / most))
        .collect();
    let words = match space {
        Some(space) => format!(
            "{:.2} ΔE₀₀ on average, in white light",
            mean_of_colours(drawn, reference, space)
        ),
        None => String::new(),
    };
    let sheet = PanelSheet {
        heading: format!("{material} by {method}"),
        about: "Reflectance of each pixel, as in a room that is white everywhere.".to_owned(),
        size: drawn.size,
        rows: vec![PanelRow {
            name: String::new(),
            panels: vec![
                Panel::new(method, shown(drawn), String::new()),
                Panel::new("exact law", shown(reference), String::new()),
                Panel::new("difference", map, words),
            ],
        }],
        bar: Some(ColourBar {
            title: "largest difference of a channel, in reflectance".to_owned(),
            most,
        }),
        foot: format!("fresnel-gen {command}"),
    };
    sheet.png(about.to_owned())
}

/// The mean CIEDE2000 between two pictures, over pixels that show the object.
fn mean_of_colours(one: &Painted, other: &Painted, space: Space) -> f64 {
    let lab = |pixel: &[f64; 3]| {
        xyz_to_lab(
            space.rgb_to_xyz() * DVec3::from_array(*pixel),
            space.white(),
        )
    };
    let pairs = one.pixels.iter().zip(&other.pixels);
    let shown = pairs.filter(|(_, truth)| **truth != [0.0; 3]);
    let apart: Vec<f64> = shown.map(|(a, b)| ciede2000(lab(a), lab(b))).collect();
    apart.iter().sum::<f64>() / apart.len().max(1) as f64
}

/// A picture as OpenEXR in binary32, linear, with the colour space of its channels where they have one; or why it cannot be encoded.
fn painted_exr(picture: &Painted, space: Option<Space>, about: &str) -> Result<Vec<u8>, String> {
    let texels = picture.pixels.iter();
    let texture = Picture {
        name: String::new(),
        axis: TableAxis::Cos,
        depth: Depth::Float,
        scale: 1.0,
        width: picture.size[0] as usize,
        rows: vec![String::new(); picture.size[1] as usize],
        texels: texels
            .map(|pixel| pixel.map(|value| value as f32))
            .collect(),
        alpha: None,
        space,
        about: vec![about.to_owned()],
    };
    let encoded = Format::ExrFloat.encode(&texture);
    encoded.map_err(|why| why.to_string())
}
