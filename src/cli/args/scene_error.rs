//! The flags of `scene-error`.

use std::path::PathBuf;

use clap::Args;

use crate::generator::command_line::{CommandLine, path_again};
use crate::lab::raster::{Body, Turntable};
use crate::language::methods::Method;
use crate::physics::materials::ViewingConditions;

use crate::cli::args::choice::{Choice, method_or_all, one_of};
use crate::cli::args::output::file_only;
use crate::cli::args::viewing::numbers;
use crate::cli::args::{GamutFlags, MaterialFlags, MediumFlags, PictureFlags, ReportFlags};

/// The flags of `scene-error`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Names, paths of material files, or all [default: gold, platinum, water, diamond]")),
    mut_arg("out_dir", |arg| arg.help("Draw the first frame into this folder: reference, each method and the difference magnified 8 times as PNG, reference and cos θ as EXR")),
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
    /// The command that reports this again under these viewing conditions, without places of outputs.
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
            .list("medium", &self.medium.medium)
            .seen_as(viewing)
    }
}

/// A place in metres.
fn place(word: &str) -> Result<[f64; 3], String> {
    const FARTHEST: f64 = 1e6;
    let numbers = numbers(word)?;
    let Ok(three) = <[f64; 3]>::try_from(numbers.as_slice()) else {
        let count = numbers.len();
        return Err(format!(
            "it has {count} numbers; it wants x, y and z in metres, such as 0,0,-2"
        ));
    };
    // NaN is within no limits.
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
