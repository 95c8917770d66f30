//! What `plan` reads: frames of a user's renderer, or a scene.

use std::path::{Path, PathBuf};

use crate::materials::{self, ViewingConditions};
use crate::names::UnknownName;
use crate::plan::{FramePixels, MappedMaterial, MaterialIds, PlannedMaterial, read_gbuffer};
use crate::report::plan::Unplanned;
use crate::scene::{Display, TONE_CURVES};

use super::args::PlanFlags;
use super::error::Error;
use super::request::{Materials, Request, Source};
use super::source;

/// Gives one frame after another.
pub type FrameOf<'a> = Box<dyn FnMut(usize) -> Result<FramePixels, Error> + 'a>;

/// What a plan is made of.
pub struct PlanInput<'a> {
    /// The materials, each once, in the order of the frames' pixels.
    pub materials: Vec<PlannedMaterial>,
    /// Materials of the scene that get no function.
    pub unplanned: Vec<Unplanned>,
    /// How the scene is shown, where nothing else is asked for.
    pub display: Display,
    /// How many frames.
    pub frames: usize,
    /// The frames.
    pub frame: FrameOf<'a>,
}

/// Reads what the flags name.
///
/// # Errors
/// A file cannot be read or has a fault, or a material is not there.
pub fn plan_input<'a>(
    flags: &'a PlanFlags,
    viewing: &ViewingConditions,
) -> Result<PlanInput<'a>, Error> {
    of_frames(&flags.gbuffer, flags.materials.as_deref(), viewing)
}

/// Frames of a user's renderer. Each is read when its turn comes, so that one is in memory.
fn of_frames<'a>(
    files: &'a [PathBuf],
    map: Option<&Path>,
    viewing: &ViewingConditions,
) -> Result<PlanInput<'a>, Error> {
    let map = map.expect("clap asks for it beside --gbuffer");
    let ids = MaterialIds::parse(&map.display().to_string(), &source::text(map)?)?;
    let at = |index: usize, what: String| ids.fault(index, what).into();
    let (materials, places) = loaded(&ids.materials, map, viewing, &at)?;
    let count = materials.len();
    let frame = move |index: usize| {
        let file: &PathBuf = &files[index];
        let frame = read_gbuffer(&source::picture(file)?, &ids);
        let frame = frame.map_err(|fault| Error::Usage {
            what: format!("{}: {fault}", file.display()),
        })?;
        Ok(merged(frame, &places, count))
    };
    Ok(PlanInput {
        materials,
        unplanned: Vec::new(),
        display: Display {
            exposure: 0.0,
            curve: TONE_CURVES[0],
        },
        frames: files.len(),
        frame: Box::new(frame),
    })
}

/// Each material once, and for each that the scene names its place among them. Paths are relative to the folder of the scene's file;
/// `fault` says where the file names a material.
fn loaded(
    mapped: &[MappedMaterial],
    file: &Path,
    viewing: &ViewingConditions,
    fault: &dyn Fn(usize, String) -> Error,
) -> Result<(Vec<PlannedMaterial>, Vec<usize>), Error> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let (mut planned, mut places): (Vec<PlannedMaterial>, Vec<usize>) = (Vec::new(), Vec::new());
    for (index, one) in mapped.iter().enumerate() {
        let word = match source::is_path(&one.material) {
            true => folder.join(&one.material).display().to_string(),
            false => one.material.clone(),
        };
        let known = planned.iter().position(|known| known.argument == word);
        places.push(known.unwrap_or(planned.len()));
        if known.is_none() {
            if !source::is_path(&word) && materials::source(&word).is_none() {
                let unknown = UnknownName::new("material", &word, &materials::names());
                return Err(fault(index, unknown.to_string()));
            }
            planned.push(material(word, viewing)?);
        }
    }
    Ok((planned, places))
}

fn material(word: String, viewing: &ViewingConditions) -> Result<PlannedMaterial, Error> {
    let source = match source::is_path(&word) {
        true => Source::File {
            text: source::read(&word)?,
            file: word.clone(),
        },
        false => Source::Named(word.clone()),
    };
    let request = Request {
        materials: Materials::These(vec![source]),
        viewing: viewing.clone(),
        ..Request::default()
    };
    let mut subjects = request.subjects()?.materials();
    Ok(PlannedMaterial {
        argument: word,
        subject: subjects.remove(0),
        is_library_only: false,
    })
}

/// The same frame with the pixels of one material together, whatever the scene calls it.
fn merged(frame: FramePixels, places: &[usize], count: usize) -> FramePixels {
    let mut whole = FramePixels::new(frame.size, count);
    for (pixels, place) in frame.of_material.into_iter().zip(places) {
        whole.of_material[*place].extend(pixels);
    }
    whole
}
