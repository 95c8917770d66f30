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
    let (materials, places) = loaded(scene.materials(), &naming, viewing, &at)?;
    let mut read = material_files(&materials);
    let drawn = scene.read(&mut |path| naming.bytes(path, &mut read))?;
    let (count, display, frames) = (materials.len(), scene.display, scene.frames());
    Ok(PlanInput {
        materials,
        unplanned: Vec::new(),
        remarks: Vec::new(),
        read,
        nothing_is_seen: scene.nothing_is_seen().to_string(),
        display,
        frames,
        frame: Box::new(move |index| Ok(merged(scene.frame(index, &drawn), &places, count))),
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
            SceneLight::of_environment(environment.map_err(|fault| {
                Error::usage(format!("{}: {fault}", crate::physics::foreign::path(&path)))
            })?)
        }
    };
    let view = GltfView {
        size: flags.size.unwrap_or(GLTF_SIZE),
        light,
    };
    let name = file.display().to_string();
    let naming = Naming::of(flags, file);
    let mut read = Vec::new();
    let scene = GltfScene::read(&name, &source::picture(file)?, &view, &mut |path| {
        naming.bytes(path, &mut read)
    });
    let scene = scene.map_err(|fault| Error::usage(fault.to_string()))?;
    let at = |_: usize, what: String| Error::usage(format!("{name}: {what}"));
    let (materials, places) = loaded(scene.materials(), &naming, viewing, &at)?;
    let (count, frames) = (materials.len(), scene.frames());
    Ok(PlanInput {
        materials,
        unplanned: scene.unplanned.clone(),
        remarks: scene.remarks.clone(),
        read,
        nothing_is_seen: nothing_planned(&name, &scene.unplanned),
        display: AS_IT_IS,
        frames,
        frame: Box::new(move |index| Ok(merged(scene.frame(index), &places, count))),
    })
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

/// The paths of the materials that are files.
fn material_files(materials: &[PlannedMaterial]) -> Vec<PathBuf> {
    let words = materials.iter().map(|material| &material.argument);
    words
        .filter(|word| source::is_path(word))
        .map(PathBuf::from)
        .collect()
}

/// No exposure and no tone curve.
const AS_IT_IS: Display = Display {
    exposure: 0.0,
    curve: TONE_CURVES[0],
};
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
    let (materials, places) = loaded(&ids.materials, &Naming::of(flags, map), viewing, &at)?;
    let (count, read) = (materials.len(), material_files(&materials));
    let (frames, space) = (files.len(), viewing.integration.space);
    let frame = move |index: usize| {
        let file = files[index];
        let bytes = source::picture(file)?;
        let frame = check_primaries(&bytes, space).and_then(|()| read_gbuffer(&bytes, &ids));
        let frame = frame.map_err(|fault| {
            Error::usage(format!("{}: {fault}", crate::physics::foreign::path(&file)))
        })?;
        Ok(merged(frame, &places, count))
    };
    Ok(PlanInput {
        materials,
        unplanned: Vec::new(),
        remarks: Vec::new(),
        read,
        nothing_is_seen: format!(
            "no frame shows a material of {}",
            crate::physics::foreign::path(&map)
        ),
        display: AS_IT_IS,
        frames,
        frame: Box::new(frame),
    })
}

/// Each material once, and for each material of the scene its index among them. `fault` gives the place where the file names a
/// material.
fn loaded(
    mapped: &[MappedMaterial],
    naming: &Naming,
    viewing: &ViewingConditions,
    fault: &dyn Fn(usize, String) -> Error,
) -> Result<(Vec<PlannedMaterial>, Vec<usize>), Error> {
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
