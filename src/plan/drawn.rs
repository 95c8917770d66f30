//! Scenes that we draw ourselves: triangles of several materials in one depth buffer, under light from all around.

use crate::raster::{Camera, Mesh, surface_points};

use super::pixels::{FramePixels, ScenePixel};
use super::sky::SceneLight;

/// How a part of a scene looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceLook {
    /// Its material, by the order of the scene's materials. What has none hides what is behind it, and nothing is planned for it.
    pub material: Option<usize>,
    /// Perceptual roughness in [0, 1].
    pub roughness: f32,
    /// All other light of its pixels, before 1 - F multiplies it: in the working space, linear.
    pub other: [f32; 3],
    /// How much of a pixel it covers, above 0 to 1.
    pub coverage: f32,
}

/// A scene, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnScene {
    mesh: Mesh,
    /// The first triangle of each part that has triangles, in ascending order, and its look.
    parts: Vec<(u32, SurfaceLook)>,
    materials: usize,
    light: SceneLight,
}

impl DrawnScene {
    /// A scene that holds nothing yet, of so many materials, or of more once a look names them.
    pub fn new(materials: usize, light: SceneLight) -> DrawnScene {
        DrawnScene {
            mesh: Mesh::default(),
            parts: Vec::new(),
            materials,
            light,
        }
    }

    /// Puts triangles into the scene.
    pub fn add(&mut self, mesh: &Mesh, look: SurfaceLook) {
        let named = look.material.map_or(0, |material| material + 1);
        self.materials = self.materials.max(named);
        if mesh.triangles.is_empty() {
            return;
        }
        let corners = self.mesh.vertices.len() as u32;
        self.parts.push((self.mesh.triangles.len() as u32, look));
        self.mesh.vertices.extend_from_slice(&mesh.vertices);
        let moved = mesh.triangles.iter();
        let moved = moved.map(|triangle| triangle.map(|corner| corners + corner));
        self.mesh.triangles.extend(moved);
    }

    /// How many triangles it holds.
    pub fn triangles(&self) -> usize {
        self.mesh.triangles.len()
    }

    /// All of its triangles.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// What a camera sees. A pixel shows what its centre shows.
    pub fn frame(&self, camera: &Camera) -> FramePixels {
        let mut frame = FramePixels::new(camera.lens.size, self.materials);
        for point in surface_points(&self.mesh, camera) {
            let after = self
                .parts
                .partition_point(|(first, _)| *first <= point.triangle);
            let look = &self.parts[after - 1].1;
            let Some(material) = look.material else {
                continue;
            };
            frame.of_material[material].push(ScenePixel {
                place: point.place,
                cos_theta: point.cos_theta as f32,
                roughness: look.roughness,
                coverage: look.coverage,
                light: self
                    .light
                    .along(point.mirrored(), f64::from(look.roughness)),
                other: look.other,
            });
        }
        frame
    }
}
