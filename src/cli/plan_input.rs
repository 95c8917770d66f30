//! The input of `plan`: frames of a user's renderer, or a scene.

use std::path::{Path, PathBuf};

use crate::cli::error::Error;
use crate::cli::flags::material::MaterialName;
use crate::cli::plan::PlanFlags;
use crate::generator::output::folder::is_same_file;
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::generator::request::source::{self, same_name};
use crate::generator::request::{Materials, Request};
use crate::physics::foreign::Foreign;
use crate::physics::materials::ViewingConditions;
use crate::pictures::plan::{
    FramePixels, GltfScene, GltfView, MappedMaterial, MaterialIds, PlannedMaterial, SceneFile,
    SceneLight, Unplanned, check_primaries, constant_index, read_gbuffer,
};
use crate::pictures::scene::{Display, Environment, TONE_CURVES};

/// Returns the frame of an index.
pub type FrameOf<'a> = Box<dyn FnMut(usize) -> Result<FramePixels, Error> + 'a>;

/// The input of a plan.
pub struct PlanInput<'a> {
    /// The materials, each once, in the order of the frames' pixels.
    pub materials: Vec<PlannedMaterial>,
    /// Materials of the scene that get no function.
    pub unplanned: Vec<Unplanned>,
    /// What the scene states and this program does not read.
    pub remarks: Vec<String>,
    /// The files that were read in addition to those that flags name.
    pub read: Vec<PathBuf>,
    /// The message for a scene in which no frame shows any of the materials.
    pub nothing_is_seen: String,
    /// How the scene is shown, unless flags say otherwise.
    pub display: Display,
    /// How many frames there are.
    pub frames: usize,
    /// Reads or draws a frame.
    pub frame: FrameOf<'a>,
}

/// The materials of a scene, each once, and for each material that the scene names its index among them.
type LoadedMaterials = (Vec<PlannedMaterial>, Vec<usize>);

impl<'a> PlanInput<'a> {
    /// Frames that are shown as they are, of a scene that also names these files.
    fn new(
        (materials, places): LoadedMaterials,
        files: Vec<PathBuf>,
        nothing_is_seen: String,
        frames: usize,
        mut frame: impl FnMut(usize) -> Result<FramePixels, Error> + 'a,
    ) -> PlanInput<'a> {
        let words = materials.iter().map(|material| &material.argument);
        let own_files = words
            .filter(|word| source::is_path(word))
            .map(PathBuf::from);
        let count = materials.len();
        PlanInput {
            read: own_files.chain(files).collect(),
            materials,
            unplanned: Vec::new(),
            remarks: Vec::new(),
            nothing_is_seen,
            display: Display {
                exposure: 0.0,
                curve: TONE_CURVES[0],
            },
            frames,
            frame: Box::new(move |index| Ok(merged(frame(index)?, &places, count))),
        }
    }
}

/// Reads what the flags name.
///
/// # Errors
/// A file cannot be read or has a fault, or a material does not exist.
pub fn plan_input<'a>(
    flags: &'a PlanFlags,
    viewing: &ViewingConditions,
) -> Result<PlanInput<'a>, Error> {
    let Some(scene) = &flags.scene else {
        return of_frames(flags, viewing);
    };
    let ending = scene.extension().and_then(|ending| ending.to_str());
    let is_gltf = matches!(ending, Some("glb" | "gltf"));
    if !is_gltf && (flags.environment.is_some() || flags.size.is_some()) {
        let why = "--environment and --size are of glTF scenes; a scene file says both itself";
        return Err(Error::usage(why));
    }
    match ending {
        Some("toml") => of_scene_file(flags, scene, viewing),
        _ if is_gltf => of_gltf(flags, scene, viewing),
        _ => {
            let file = crate::physics::foreign::path(&scene);
            let why = format!(
                "`{file}` is no scene by its ending: .toml, .glb or .gltf; frames of a renderer go with --gbuffer"
            );
            Err(Error::usage(why))
        }
    }
}

/// A scene file, drawn by our rasteriser.
fn of_scene_file<'a>(
    flags: &PlanFlags,
    file: &Path,
    viewing: &ViewingConditions,
) -> Result<PlanInput<'a>, Error> {
    let mut scene = SceneFile::parse(&file.display().to_string(), &source::text(file)?)?;
    scene.space = viewing.integration.space;
    let at = |index: usize, what: String| scene.material_fault(index, what).into();
    let naming = Naming::of(flags, file);
    let materials = loaded(scene.materials(), &naming, viewing, &at)?;
    let mut files = Vec::new();
    let drawn = scene.read(&mut |path| naming.bytes(path, &mut files))?;
    let (nothing, display, frames) = (scene.nothing_is_seen(), scene.display, scene.frames());
    let frame = move |index| Ok(scene.frame(index, &drawn));
    Ok(PlanInput {
        display,
        ..PlanInput::new(materials, files, nothing.to_string(), frames, frame)
    })
}

/// A glTF scene, drawn by our rasteriser.
fn of_gltf<'a>(
    flags: &PlanFlags,
    file: &Path,
    viewing: &ViewingConditions,
) -> Result<PlanInput<'a>, Error> {
    let light = match &flags.environment {
        None => SceneLight::Uniform([1.0; 3]),
        Some(path) => {
            let environment = Environment::read(&source::picture(path)?, viewing.integration.space);
            let environment = environment.map_err(|fault| fault_of(path, fault))?;
            SceneLight::of_environment(environment)
        }
    };
    let view = GltfView {
        size: flags.size.unwrap_or(GLTF_SIZE),
        light,
    };
    let name = file.display().to_string();
    let naming = Naming::of(flags, file);
    let mut files = Vec::new();
    let scene = GltfScene::read(&source::picture(file)?, &view, &mut |path| {
        naming.bytes(path, &mut files)
    });
    let scene = scene.map_err(|fault| fault_of(file, fault))?;
    let at = |_: usize, what: String| Error::usage(format!("{name}: {what}"));
    let materials = loaded(scene.materials(), &naming, viewing, &at)?;
    let (unplanned, remarks) = (scene.unplanned.clone(), scene.remarks.clone());
    let (nothing, frames) = (nothing_planned(&name, &unplanned), scene.frames());
    let frame = move |index| Ok(scene.frame(index));
    Ok(PlanInput {
        unplanned,
        remarks,
        ..PlanInput::new(materials, files, nothing, frames, frame)
    })
}

/// A fault of a file, with the file's name before it.
fn fault_of(file: &Path, fault: impl core::fmt::Display) -> Error {
    Error::usage(format!("{}: {fault}", crate::physics::foreign::path(file)))
}

/// The message for a glTF scene of which no visible material can be planned.
fn nothing_planned(file: &str, unplanned: &[Unplanned]) -> String {
    let reason = |one: &Unplanned| format!("; `{}`: {}", one.name, one.reason);
    let reasons: String = unplanned.iter().map(reason).collect();
    format!("{file}: no frame shows a material that can be planned{reasons}")
}

/// A file that names other files, by paths relative to its folder.
struct Naming<'a> {
    file: &'a Path,
    /// The paths that it may name although they lie elsewhere.
    allowed: Vec<PathBuf>,
}

impl<'a> Naming<'a> {
    fn of(flags: &PlanFlags, file: &'a Path) -> Naming<'a> {
        let allowed = flags.allow.iter().chain(flags.inputs());
        Naming {
            file,
            allowed: allowed.cloned().collect(),
        }
    }

    /// Resolves a path that the file names.
    fn path(&self, path: &str) -> Result<PathBuf, String> {
        let whole = self.file.parent().unwrap_or(Path::new("")).join(path);
        source::check_below(self.file, &whole, &self.allowed)?;
        Ok(whole)
    }

    /// The bytes of a file that it names. The file's path is appended to `read`.
    fn bytes(&self, path: &str, read: &mut Vec<PathBuf>) -> Result<Vec<u8>, String> {
        let whole = self.path(path)?;
        let bytes = source::picture(&whole).map_err(|error| error.to_string());
        read.push(whole);
        bytes
    }
}

/// Pixels of a glTF scene's frames, unless flags say otherwise.
const GLTF_SIZE: [u32; 2] = [640, 480];

/// Frames of a user's renderer. Each is read when it is needed, so that only one is in memory.
fn of_frames<'a>(
    flags: &'a PlanFlags,
    viewing: &ViewingConditions,
) -> Result<PlanInput<'a>, Error> {
    let files: Vec<&PathBuf> = flags.frames().collect();
    let map = flags.materials.as_deref();
    let map = map.expect("clap asks for it beside --gbuffer");
    let ids = MaterialIds::parse(&map.display().to_string(), &source::text(map)?)?;
    let at = |index: usize, what: String| ids.fault(index, what).into();
    let materials = loaded(&ids.materials, &Naming::of(flags, map), viewing, &at)?;
    let nothing = format!(
        "no frame shows a material of {}",
        crate::physics::foreign::path(map)
    );
    let (frames, space) = (files.len(), viewing.integration.space);
    let frame = move |index: usize| {
        let file: &Path = files[index];
        let bytes = source::picture(file)?;
        let frame = check_primaries(&bytes, space).and_then(|()| read_gbuffer(&bytes, &ids));
        frame.map_err(|fault| fault_of(file, fault))
    };
    Ok(PlanInput::new(
        materials,
        Vec::new(),
        nothing,
        frames,
        frame,
    ))
}

/// Each material once, and for each material of the scene its index among them. `fault` gives the place where the file names a
/// material.
fn loaded(
    mapped: &[MappedMaterial],
    naming: &Naming,
    viewing: &ViewingConditions,
    fault: &dyn Fn(usize, String) -> Error,
) -> Result<LoadedMaterials, Error> {
    let (mut planned, mut places): (Vec<PlannedMaterial>, Vec<usize>) = (Vec::new(), Vec::new());
    for (index, one) in mapped.iter().enumerate() {
        let word = if source::is_path(&one.material) {
            let path = naming.path(&one.material);
            let path =
                path.map_err(|why| fault(index, format!("`{}`: {why}", Foreign(&one.material))))?;
            path.display().to_string()
        } else {
            one.material.clone()
        };
        let is_it = |known: &PlannedMaterial| {
            let are_paths = [&word, &known.argument].map(|word| source::is_path(word)) == [true; 2];
            known.argument == word
                || are_paths && is_same_file(known.argument.as_ref(), word.as_ref())
        };
        let known = planned.iter().position(is_it);
        let place = known.unwrap_or(planned.len());
        places.push(place);
        if known.is_none() {
            let new = material(word, viewing, &|what| fault(index, what))?;
            let is_namesake = |known: &&PlannedMaterial| known.subject.name == new.subject.name;
            if let Some(other) = planned.iter().find(is_namesake) {
                let words = [&other.argument, &new.argument].map(String::as_str);
                return Err(same_name(&new.subject.name, words).into());
            }
            planned.push(new);
        }
        if !planned[place].names.contains(&one.name) {
            planned[place].names.push(one.name.clone());
        }
    }
    Ok((planned, places))
}

/// A material by its word: a path, a name of the catalogue, or a constant index.
fn material(
    word: String,
    viewing: &ViewingConditions,
    fault: &dyn Fn(String) -> Error,
) -> Result<PlannedMaterial, Error> {
    if let Some(material) = constant_index(&word) {
        let typed = (word.clone(), material);
        return Ok(PlannedMaterial {
            subject: MaterialInMedium::new(typed, None, viewing, Derivation::default())?,
            argument: word,
            names: Vec::new(),
            is_library_only: true,
        });
    }
    let name = MaterialName::parse(&word).map_err(|unknown| fault(unknown.to_string()))?;
    let request = Request {
        materials: Materials::These(vec![name.source()?]),
        viewing: viewing.clone(),
        ..Request::default()
    };
    let mut subjects = request.subjects()?.materials();
    Ok(PlannedMaterial {
        argument: word,
        names: Vec::new(),
        subject: subjects.remove(0),
        is_library_only: false,
    })
}

/// The same frame with the pixels of a material merged, under whichever names the scene has for it.
fn merged(frame: FramePixels, places: &[usize], count: usize) -> FramePixels {
    let mut whole = FramePixels::new(frame.size, count);
    for (pixels, place) in frame.of_material.into_iter().zip(places) {
        whole.of_material[*place].extend(pixels);
    }
    whole
}
