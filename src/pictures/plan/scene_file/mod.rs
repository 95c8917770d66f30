//! The scene file: a scene that this program draws itself, as TOML.
//!
//! ```toml
//! exposure = 0.0                # stops; 1 doubles. May be left out
//! tone = "none"                 # none, aces or reinhard. May be left out
//! size = [512, 512]             # pixels across and down. May be left out
//! [camera]                      # or several [[camera]]: a frame each
//! orthographic = 2.0            # the height of what it sees, in metres; or:
//! # vertical_degrees = 45.0     # its vertical field of view
//! eye = [0, 0, 2.5]             # metres; y points up
//! at = [0, 0, 0]                # what it looks at. May be left out: the origin
//! # turntable = { frames = 36, axis = [0, 1, 0], step_degrees = 10 }   # the camera turns about `at`, a frame each
//! [light]
//! uniform = [1.0, 1.0, 1.0]     # the same from everywhere, linear, in the working space; or:
//! # environment = "sky.exr"     # EXR, HDR, PNG or JPEG, twice as wide as high, -z in the middle
//! [[object]]
//! body = "sphere"               # sphere, cube, relief, plane (y = at[1], without end); or mesh = "statue.obj"
//! material = "gold"             # a name of the catalogue, or the path of a material's file
//! # What follows may be left out:
//! name = "statue"               # what the scene calls it: the material's name. Objects of one material share a function
//! roughness = 0.0               # perceptual
//! other = [0.5, 0.1, 0.05]      # all other light of its pixels, before 1 - F: black
//! extent = 2.0                  # its longest side in metres: 1 for a body; a mesh keeps its own
//! at = [0, 0, 0]                # the centre of its box: the origin for a body; a mesh keeps its own
//! coverage = 1.0                # how much of a pixel it covers
//! ```
//!
//! Paths are relative to the file. Environments are sampled in the direction that a mirror shows ([`super::sky`]).

mod assets;
mod check;

use glam::DVec3;
use toml::Spanned;

use super::frame::{FramePixels, MappedMaterial};
use crate::lab::raster::{Body, Camera};
use crate::physics::spectra::Space;
use crate::physics::user_text::FileFault;
use crate::pictures::plan::frame::{DrawnScene, SurfaceLook};
use crate::pictures::scene::Display;

/// A scene that this program draws itself.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// How its pictures are shown.
    pub display: Display,
    /// The working space, into which environments are brought; sRGB unless it is changed.
    pub space: Space,
    /// A frame each.
    pub cameras: Vec<Camera>,
    file: String,
    text: String,
    /// The offset of the first camera in the text.
    camera_at: usize,
    light: Light,
    objects: Vec<Object>,
    materials: Vec<MappedMaterial>,
    /// The offset where each material is first named.
    materials_at: Vec<usize>,
}

#[derive(Clone, Debug)]
enum Light {
    Uniform([f32; 3]),
    Environment(Spanned<String>),
}

/// The source of an object's triangles.
#[derive(Clone, Debug)]
enum Shape {
    Body(&'static Body),
    Plane,
    /// The path of a mesh.
    Mesh(String),
}

#[derive(Clone, Debug)]
struct Object {
    shape: Spanned<Shape>,
    look: SurfaceLook,
    extent: Option<f64>,
    at: Option<DVec3>,
}

impl SceneFile {
    /// How many frames it has.
    pub fn frames(&self) -> usize {
        self.cameras.len()
    }

    /// Its materials, in the order of [`FramePixels::of_material`].
    pub fn materials(&self) -> &[MappedMaterial] {
        &self.materials
    }

    /// A frame, counted from 0, of a scene whose files were read ([`SceneFile::read`]).
    pub fn frame(&self, index: usize, scene: &DrawnScene) -> FramePixels {
        scene.frame(&self.cameras[index])
    }

    /// A fault at the place where a material is named: its file cannot be read.
    pub fn material_fault(&self, material: usize, what: String) -> FileFault {
        self.fault(self.materials_at[material], what)
    }

    /// The fault of a scene in which no frame shows anything.
    pub fn nothing_is_seen(&self) -> FileFault {
        let what = "no frame shows anything of an object; is the camera turned away, or too near?";
        self.fault(self.camera_at, what.to_owned())
    }

    fn fault(&self, offset: usize, what: String) -> FileFault {
        FileFault::at(&self.file, &self.text, offset, what)
    }
}
