//! Scenes in glTF 2.0, as `.gltf` with its buffers or as one `.glb`.
//!
//! The crate `gltf-json` reads the JSON and checks that every index exists. The contents of buffers are read here ([`container`]),
//! after lengths, strides and counts are checked, so that a file cannot announce more than it has.
//!
//! The catalogue material that stands for a glTF material is the one named in its `extras` (`{"fresnel_gen": "gold"}`). Without
//! it, it is the one of the material's own name, if the catalogue has it. Without that, a non-metal gets the constant index of
//! KHR_materials_ior. By the specification a metal without a name is Schlick's approximation, so there is nothing to compare
//! functions with. Factors and vertex colours are read. Textures are not, which a remark says. Only a metallic factor of
//! exactly 0 makes a non-metal.
//!
//! Source: Khronos, *glTF 2.0 Specification*, 2021, <https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html>, sections 3.6 for
//! buffers, 3.7 for meshes, 3.9 and appendix B for materials, 3.10 for cameras.

mod container;
mod materials;
mod nodes;
mod primitives;

use gltf_json::mesh::Semantic;
use gltf_json::validation::{Checked, Error, Validate};
use gltf_json::{Accessor, Index, Root};

use super::frame::{FramePixels, MappedMaterial};
use super::sky::SceneLight;
use crate::lab::raster::Camera;
use crate::physics::foreign::Foreign;
use crate::physics::user_text::without_mark;
use crate::pictures::plan::frame::{DrawnScene, ReadFile};
use container::{Buffers, Container};
use materials::Looks;
use nodes::cameras;

pub use container::GltfFault;
pub use materials::{Unplanned, constant_index};

/// How a glTF scene is seen.
#[derive(Clone, Debug)]
pub struct GltfView {
    /// Pixels across and down. The vertical field of view is a camera's own.
    pub size: [u32; 2],
    /// The light that surrounds the scene.
    pub light: SceneLight,
}

/// A glTF scene, ready to be drawn.
#[derive(Clone, Debug)]
pub struct GltfScene {
    /// The materials that are seen but not planned, with the reasons.
    pub unplanned: Vec<Unplanned>,
    /// What the file states and this program does not read although it changes the picture.
    pub remarks: Vec<String>,
    scene: DrawnScene,
    /// The file's own. If it has none, 36 turn about its middle.
    cameras: Vec<Camera>,
    materials: Vec<MappedMaterial>,
}

impl GltfScene {
    /// Reads a `.gltf` or `.glb`. `read` gets the path of a buffer's file as the glTF file states it.
    ///
    /// # Errors
    /// The file is no glTF 2.0, an index leads to nothing, a buffer is shorter than it should be, a number is not finite, it
    /// needs an extension that changes its triangles, or it has too many triangles. The fault has its place in the JSON.
    pub fn read(bytes: &[u8], view: &GltfView, read: ReadFile) -> Result<GltfScene, GltfFault> {
        let container = Container::of(bytes)?;
        let root = root(&container)?;
        let buffers = Buffers::read(&root, &container, read)?;
        let nodes = nodes::placed(&root)?;
        let mut looks = Looks::new(&root, &view.light);
        let mut scene = DrawnScene::new(0, view.light.clone());
        primitives::add_parts(&root, &nodes, &buffers, &mut looks, &mut scene)?;
        let mut cameras = cameras(&root, &nodes, view.size)?;
        if cameras.is_empty() {
            cameras = nodes::around(scene.mesh(), view.size);
        }
        Ok(GltfScene {
            unplanned: looks.unplanned,
            remarks: [looks.remarks, nodes::of_scene(&root, view.size)].concat(),
            scene,
            cameras,
            materials: looks.materials,
        })
    }

    /// How many frames it has.
    pub fn frames(&self) -> usize {
        self.cameras.len()
    }

    /// Its materials that can be planned, in the order of [`FramePixels::of_material`].
    pub fn materials(&self) -> &[MappedMaterial] {
        &self.materials
    }

    /// A frame, from 0.
    pub fn frame(&self, index: usize) -> FramePixels {
        self.scene.frame(&self.cameras[index])
    }
}

/// The JSON, with every index checked.
fn root(container: &Container) -> Result<Root, GltfFault> {
    let json =
        without_mark(container.json).map_err(|fault| GltfFault::new("line 1", fault.what))?;
    let root = Root::from_slice(json).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        GltfFault::new(place, format!("no glTF: {error}"))
    })?;
    if !root.asset.version.starts_with("2.") {
        let what = format!("it is {}; version 2.0 is read", root.asset.version);
        return Err(GltfFault::new("asset.version", what));
    }
    if let Some(least) = &root.asset.min_version
        && least != "2.0"
    {
        let what = format!("it is {}; version 2.0 is read", Foreign(least));
        return Err(GltfFault::new("asset.minVersion", what));
    }
    check_positions(&root)?;
    let mut first = None;
    root.validate(&root, gltf_json::Path::new, &mut |path, error| {
        let place = path().to_string().replace("[\"", ".").replace("\"]", "");
        // Extensions are checked against a list of our own, and the bounds of positions are not read.
        let is_read = error != Error::Unsupported
            && !(error == Error::Missing && place.contains(".attributes."));
        if is_read && first.is_none() {
            first = Some((place, error));
        }
    });
    if let Some((place, error)) = first {
        let what = match error {
            Error::IndexOutOfBounds => "the index leads to nothing",
            Error::Missing => "it is missing",
            Error::Oversize => "it is too large for this machine",
            Error::Invalid | Error::Unsupported => "the specification does not allow this value",
        };
        return Err(GltfFault::new(place, what));
    }
    check_extensions(&root)?;
    Ok(root)
}

/// The crate assumes that the accessors of positions exist before it checks any index.
fn check_positions(root: &Root) -> Result<(), GltfFault> {
    for (i, mesh) in root.meshes.iter().enumerate() {
        for (j, primitive) in mesh.primitives.iter().enumerate() {
            let positions = primitive
                .attributes
                .get(&Checked::Valid(Semantic::Positions));
            let is_there = |index: &Index<Accessor>| index.value() < root.accessors.len();
            if !positions.is_none_or(is_there) {
                let place = format!("meshes[{i}].primitives[{j}].attributes.POSITION");
                return Err(GltfFault::new(place, "the index leads to nothing"));
            }
        }
    }
    Ok(())
}

fn check_extensions(root: &Root) -> Result<(), GltfFault> {
    for (i, name) in root.extensions_required.iter().enumerate() {
        // These change the look of surfaces, which the catalogue's materials replace.
        let is_harmless = [
            "KHR_materials_",
            "KHR_texture_",
            "EXT_texture_",
            "MSFT_texture_",
            "KHR_lights_",
        ];
        if !is_harmless.iter().any(|start| name.starts_with(start)) {
            let what = format!(
                "the file needs the extension `{name}`, which is not read; export it without"
            );
            return Err(GltfFault::new(format!("extensionsRequired[{i}]"), what));
        }
    }
    Ok(())
}
