//! The scene file as TOML states it, with the place of every value that can be wrong, and the check that its values lie within their
//! limits.

use std::collections::HashMap;
use std::fmt;
use std::marker::PhantomData;

use glam::DVec3;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use toml::Spanned;

use super::super::frame::MappedMaterial;
use super::{Light, Object, SceneFile, Shape};
use crate::lab::raster::{Body, Camera, Lens, rotated};
use crate::physics::materials;
use crate::physics::names::UnknownName;
use crate::physics::spectra::Space;
use crate::physics::user_text::{FileFault, FileText};
use crate::pictures::plan::frame::{MOST_FRAMES, SurfaceLook};
use crate::pictures::scene::{Display, TONE_CURVES, ToneCurve};

/// The largest coordinate along each axis, and the largest size, in metres.
pub const FARTHEST: f64 = 1e6;
/// The smallest size, in metres.
const SMALLEST: f64 = 1e-6;
/// The largest finite number of binary16, which environments hold.
const BRIGHTEST: f64 = 65504.0;
/// The least and the most pixels along a side of a frame.
const SIDES: [u32; 2] = [16, 4096];
/// Pixels of a frame whose size is not stated.
const USUAL_SIZE: [u32; 2] = [512, 512];
/// The name of a plane among the bodies.
const PLANE: &str = "plane";

type Read<T> = Result<T, FileFault>;

impl SceneFile {
    /// Reads a scene file. `file` is only for messages.
    ///
    /// # Errors
    /// The text is not TOML, a key is missing or unknown, a value lies outside its limits, or the catalogue has no such material.
    pub fn parse(file: &str, text: &str) -> Read<SceneFile> {
        let place = FileText { file, text };
        let raw: RawScene = toml::from_str(text).map_err(|error| place.toml_fault(&error))?;
        let size = place.size(raw.size.as_ref())?;
        let mut scene = SceneFile {
            display: Display {
                exposure: place.or(raw.exposure.as_ref(), "exposure", [-64.0, 64.0], 0.0)?,
                curve: place.tone(raw.tone.as_ref())?,
            },
            space: Space::default(),
            cameras: Vec::new(),
            file: file.to_owned(),
            text: text.to_owned(),
            camera_at: raw.camera.0.first().map_or(0, |camera| camera.span().start),
            light: place.light(&raw.light)?,
            objects: Vec::new(),
            materials: Vec::new(),
            materials_at: Vec::new(),
        };
        for camera in &raw.camera.0 {
            scene.cameras.extend(place.cameras(camera, size)?);
            if scene.cameras.len() > MOST_FRAMES {
                let what = format!("the cameras up to here have more than {MOST_FRAMES} frames");
                return Err(place.fault(camera.span().start, what));
            }
        }
        let mut known = HashMap::new();
        for object in &raw.object.0 {
            let material = scene.material(object.get_ref(), &mut known, &place)?;
            scene.objects.push(place.object(object, material)?);
        }
        for (is_empty, key) in [
            (scene.cameras.is_empty(), "camera"),
            (scene.objects.is_empty(), "object"),
        ] {
            if is_empty {
                return Err(place.fault(0, format!("`{key}` is empty; a scene has one or more")));
            }
        }
        Ok(scene)
    }

    /// The index of an object's material among all materials. A new material is appended.
    fn material(
        &mut self,
        object: &RawObject,
        known: &mut HashMap<MappedMaterial, usize>,
        place: &FileText,
    ) -> Read<usize> {
        let material = object.material.get_ref();
        let is_path = material.contains(['.', '/', '\\']);
        if !is_path && materials::source(material).is_none() {
            return Err(place.unknown("material", &object.material, &materials::names()));
        }
        place.legible("material", &object.material)?;
        if let Some(name) = &object.name {
            place.legible("name", name)?;
        }
        let name = object.name.as_ref().unwrap_or(&object.material);
        let mapped = MappedMaterial {
            name: name.get_ref().clone(),
            material: material.clone(),
        };
        let next = self.materials.len();
        let index = *known.entry(mapped.clone()).or_insert(next);
        if index == next {
            self.materials.push(mapped);
            self.materials_at.push(object.material.span().start);
        }
        Ok(index)
    }
}

impl FileText<'_> {
    fn unknown(&self, kind: &'static str, name: &Spanned<String>, known: &[&str]) -> FileFault {
        let unknown = UnknownName::new(kind, name.get_ref(), known);
        self.fault(name.span().start, unknown.to_string())
    }

    fn number(&self, value: &Spanned<f64>, key: &str, [low, high]: [f64; 2]) -> Read<f64> {
        let number = *value.get_ref();
        // NaN fails every range.
        if (low..=high).contains(&number) {
            return Ok(number);
        }
        let what = format!("`{key}` is {number}; it must lie between {low} and {high}");
        Err(self.fault(value.span().start, what))
    }

    fn or(
        &self,
        value: Option<&Spanned<f64>>,
        key: &str,
        limits: [f64; 2],
        usual: f64,
    ) -> Read<f64> {
        value.map_or(Ok(usual), |value| self.number(value, key, limits))
    }

    fn vector(&self, value: &RawVector, key: &str, limits: [f64; 2]) -> Read<DVec3> {
        let mut numbers = [0.0; 3];
        for (number, value) in numbers.iter_mut().zip(value) {
            *number = self.number(value, key, limits)?;
        }
        Ok(DVec3::from_array(numbers))
    }

    fn position(&self, value: &RawVector, key: &str) -> Read<DVec3> {
        self.vector(value, key, [-FARTHEST, FARTHEST])
    }

    fn colour(&self, value: &RawVector, key: &str) -> Read<[f32; 3]> {
        let colour = self.vector(value, key, [0.0, BRIGHTEST])?;
        Ok(colour.to_array().map(|channel| channel as f32))
    }

    /// Refuses a name that is empty or holds control characters, which a terminal would obey.
    fn legible(&self, key: &str, text: &Spanned<String>) -> Read<()> {
        let word = text.get_ref();
        if !word.trim().is_empty() && !word.chars().any(materials::is_hidden) {
            return Ok(());
        }
        let what =
            format!("`{key}` is empty or holds a control character; it wants a line of plain text");
        Err(self.fault(text.span().start, what))
    }

    fn size(&self, raw: Option<&[Spanned<i64>; 2]>) -> Read<[u32; 2]> {
        let mut size = USUAL_SIZE;
        let [low, high] = SIDES;
        for (side, value) in size.iter_mut().zip(raw.into_iter().flatten()) {
            let number = *value.get_ref();
            if !(i64::from(low)..=i64::from(high)).contains(&number) {
                let what =
                    format!("`size` has a side of {number} pixels; sides have {low} to {high}");
                return Err(self.fault(value.span().start, what));
            }
            *side = number as u32;
        }
        Ok(size)
    }

    fn tone(&self, raw: Option<&Spanned<String>>) -> Read<ToneCurve> {
        let Some(raw) = raw else {
            return Ok(TONE_CURVES[0]);
        };
        let mut curves = TONE_CURVES.into_iter();
        let found = curves.find(|curve| curve.name == raw.get_ref());
        let names = TONE_CURVES.map(|curve| curve.name);
        found.ok_or_else(|| self.unknown("tone curve", raw, &names))
    }

    fn light(&self, raw: &Spanned<RawLight>) -> Read<Light> {
        match (&raw.get_ref().uniform, &raw.get_ref().environment) {
            (Some(colour), None) => Ok(Light::Uniform(self.colour(colour, "uniform")?)),
            (None, Some(path)) => {
                self.legible("environment", path)?;
                Ok(Light::Environment(path.clone()))
            }
            _ => {
                let what = "`light` wants one of `uniform` and `environment`";
                Err(self.fault(raw.span().start, what.to_owned()))
            }
        }
    }

    fn cameras(&self, spanned: &Spanned<RawCamera>, size: [u32; 2]) -> Read<Vec<Camera>> {
        let raw = spanned.get_ref();
        let eye = self.position(&raw.eye, "eye")?;
        let at = raw.at.as_ref();
        let at = at.map_or(Ok(DVec3::ZERO), |at| self.position(at, "at"))?;
        if (eye - at).length() < SMALLEST {
            let what = format!("`eye` and `at` are less than {SMALLEST} m apart");
            return Err(self.fault(raw.eye[0].span().start, what));
        }
        let lens = |vertical_degrees| Lens {
            size,
            vertical_degrees,
        };
        let camera = match (&raw.orthographic, &raw.vertical_degrees) {
            (Some(height), None) => {
                let height = self.number(height, "orthographic", [SMALLEST, FARTHEST])?;
                let axes = Camera::looking(eye, at, lens(1.0)).axes;
                // Parallel rays do not depend on the eye's place along the axis.
                Camera::orthographic(at, axes, height, size)
            }
            (None, Some(degrees)) => {
                let degrees = self.number(degrees, "vertical_degrees", [0.01, 170.0])?;
                Camera::looking(eye, at, lens(degrees))
            }
            _ => {
                let what = "`camera` wants one of `orthographic` and `vertical_degrees`";
                return Err(self.fault(spanned.span().start, what.to_owned()));
            }
        };
        match &raw.turntable {
            None => Ok(vec![camera]),
            Some(turntable) => self.turned(turntable, &camera, at),
        }
    }

    /// The frames of a camera that turns about a place.
    fn turned(&self, raw: &Spanned<RawTurntable>, camera: &Camera, at: DVec3) -> Read<Vec<Camera>> {
        let raw = raw.get_ref();
        let frames = *raw.frames.get_ref();
        if !(1..=MOST_FRAMES as i64).contains(&frames) {
            let what = format!("`frames` is {frames}; it must lie between 1 and {MOST_FRAMES}");
            return Err(self.fault(raw.frames.span().start, what));
        }
        let axis = match &raw.axis {
            None => DVec3::Y,
            Some(axis) => {
                let vector = self.position(axis, "axis")?;
                let unit = vector.try_normalize();
                let what = || "`axis` has no direction".to_owned();
                unit.ok_or_else(|| self.fault(axis[0].span().start, what()))?
            }
        };
        let whole = 360.0 / frames as f64;
        let step = self.or(
            raw.step_degrees.as_ref(),
            "step_degrees",
            [-360.0, 360.0],
            whole,
        )?;
        let turn = |frame: i64| turned(camera, at, axis, frame as f64 * step);
        Ok((0..frames).map(turn).collect())
    }

    fn object(&self, spanned: &Spanned<RawObject>, material: usize) -> Read<Object> {
        let raw = spanned.get_ref();
        let shape = self.shape(spanned)?;
        if let (Shape::Plane, Some(extent)) = (shape.get_ref(), &raw.extent) {
            let what = "a plane has no end, so that it has no `extent`";
            return Err(self.fault(extent.span().start, what.to_owned()));
        }
        let extent = raw.extent.as_ref();
        let at = raw.at.as_ref();
        let other = raw.other.as_ref();
        let unit = [0.0, 1.0];
        Ok(Object {
            shape,
            look: SurfaceLook {
                material: Some(material),
                roughness: self.or(raw.roughness.as_ref(), "roughness", unit, 0.0)? as f32,
                other: other.map_or(Ok([0.0; 3]), |other| self.colour(other, "other"))?,
                // The smallest share that eight bits of alpha can tell from zero.
                coverage: self.or(raw.coverage.as_ref(), "coverage", [1.0 / 256.0, 1.0], 1.0)?
                    as f32,
                is_one_sided: false,
            },
            extent: extent
                .map(|extent| self.number(extent, "extent", [SMALLEST, FARTHEST]))
                .transpose()?,
            at: at.map(|at| self.position(at, "at")).transpose()?,
        })
    }

    fn shape(&self, spanned: &Spanned<RawObject>) -> Read<Spanned<Shape>> {
        let raw = spanned.get_ref();
        match (&raw.body, &raw.mesh) {
            (Some(body), None) => {
                let mut bodies = Body::ALL.into_iter();
                let shape = match bodies.find(|known| known.name == body.get_ref()) {
                    Some(found) => Shape::Body(found),
                    None if body.get_ref() == PLANE => Shape::Plane,
                    None => {
                        let names = Body::ALL.iter().map(|body| body.name);
                        let names: Vec<&str> = names.chain([PLANE]).collect();
                        return Err(self.unknown("body", body, &names));
                    }
                };
                Ok(Spanned::new(body.span(), shape))
            }
            (None, Some(path)) => {
                self.legible("mesh", path)?;
                let shape = Shape::Mesh(path.get_ref().clone());
                Ok(Spanned::new(path.span(), shape))
            }
            _ => {
                let what = "an object wants one of `body` and `mesh`";
                Err(self.fault(spanned.span().start, what.to_owned()))
            }
        }
    }
}

/// A camera turned by an angle about an axis through a place.
fn turned(camera: &Camera, at: DVec3, axis: DVec3, degrees: f64) -> Camera {
    let turn = |vector| rotated(vector, axis, degrees.to_radians());
    Camera {
        eye: at + turn(camera.eye - at),
        axes: camera.axes.map(turn),
        ..*camera
    }
}

/// Three numbers, each with its place.
type RawVector = [Spanned<f64>; 3];

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct RawScene {
    exposure: Option<Spanned<f64>>,
    tone: Option<Spanned<String>>,
    size: Option<[Spanned<i64>; 2]>,
    camera: OneOrMany<RawCamera>,
    light: Spanned<RawLight>,
    object: OneOrMany<RawObject>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCamera {
    orthographic: Option<Spanned<f64>>,
    vertical_degrees: Option<Spanned<f64>>,
    eye: RawVector,
    at: Option<RawVector>,
    turntable: Option<Spanned<RawTurntable>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTurntable {
    frames: Spanned<i64>,
    axis: Option<RawVector>,
    step_degrees: Option<Spanned<f64>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct RawLight {
    uniform: Option<RawVector>,
    environment: Option<Spanned<String>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct RawObject {
    name: Option<Spanned<String>>,
    body: Option<Spanned<String>>,
    mesh: Option<Spanned<String>>,
    material: Spanned<String>,
    roughness: Option<Spanned<f64>>,
    other: Option<RawVector>,
    extent: Option<Spanned<f64>>,
    at: Option<RawVector>,
    coverage: Option<Spanned<f64>>,
}

/// `[camera]` or several `[[camera]]`, each with its place. An untagged enum would lose the places and the messages.
struct OneOrMany<T>(Vec<Spanned<T>>);

enum TableOrArray<T> {
    One(T),
    Many(Vec<Spanned<T>>),
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMany<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<OneOrMany<T>, D::Error> {
        let whole = Spanned::<TableOrArray<T>>::deserialize(deserializer)?;
        let span = whole.span();
        Ok(OneOrMany(match whole.into_inner() {
            TableOrArray::One(one) => vec![Spanned::new(span, one)],
            TableOrArray::Many(all) => all,
        }))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for TableOrArray<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<TableOrArray<T>, D::Error> {
        deserializer.deserialize_any(Either(PhantomData))
    }
}

struct Either<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Either<T> {
    type Value = TableOrArray<T>;

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("a table or an array of tables")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TableOrArray<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(TableOrArray::One)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<TableOrArray<T>, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(TableOrArray::Many)
    }
}
