//! The pixels of a frame that show a scene's materials, whichever renderer drew them.
//!
//! Also scenes that this program draws itself: triangles of several materials in one depth buffer, under light from all around.

use super::sky::SceneLight;
use crate::lab::raster::{Camera, Mesh, SurfacePoint, surface_points_of};

/// A pixel that shows a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScenePixel {
    /// Its index in the frame, row by row from the top left.
    pub place: u32,
    /// The cosine between the normal and the direction to the camera, in [0, 1].
    pub cos_theta: f32,
    /// Perceptual roughness in [0, 1]: α is its square.
    pub roughness: f32,
    /// The share of the pixel that the material covers, above 0 to 1.
    pub coverage: f32,
    /// Incoming light along the mirrored direction, which F multiplies. It is linear, in the working space, and not negative.
    pub light: [f32; 3],
    /// All other light of the pixel, before 1 - F multiplies it: the body's own lit colour, or what is seen through it.
    pub other: [f32; 3],
}

impl ScenePixel {
    /// A mirror seen straight on in white light.
    pub const MIRROR_IN_WHITE: ScenePixel = ScenePixel {
        place: 0,
        cos_theta: 1.0,
        roughness: 0.0,
        coverage: 1.0,
        light: [1.0; 3],
        other: [0.0; 3],
    };
}

/// The pixels of a frame, by material, whichever renderer drew them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FramePixels {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The pixels of each material, in the order of the scene's materials; each in scan order.
    pub of_material: Vec<Vec<ScenePixel>>,
}

impl FramePixels {
    /// A frame of this many materials that shows nothing yet.
    pub fn new(size: [u32; 2], materials: usize) -> FramePixels {
        FramePixels {
            size,
            of_material: vec![Vec::new(); materials],
        }
    }
}

/// A material of a scene, and the catalogue material that stands for it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MappedMaterial {
    /// What the scene calls it.
    pub name: String,
    /// A name of the catalogue, or the path of a material's file as the scene's file states it.
    pub material: String,
}

/// The most frames of a scene.
pub const MOST_FRAMES: usize = 720;

/// Reads a file that a scene names, by its path as the scene states it, or says why it cannot.
pub type ReadFile<'a> = &'a mut dyn FnMut(&str) -> Result<Vec<u8>, String>;

/// How a part of a scene looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceLook {
    /// The index of its material in the scene. A part without one hides what is behind it, and nothing is planned for it.
    pub material: Option<usize>,
    /// Perceptual roughness in [0, 1].
    pub roughness: f32,
    /// All other light of its pixels, before 1 - F multiplies it: in the working space, linear.
    pub other: [f32; 3],
    /// The share of a pixel that it covers, above 0 to 1.
    pub coverage: f32,
    /// Whether it is seen only from the side where the corners of its triangles run counter-clockwise.
    pub is_one_sided: bool,
}

/// Factors of other light and of coverage at each corner: red, green, blue, alpha, linear.
pub type Tints = Vec<[f32; 4]>;

/// A scene, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnScene {
    mesh: Mesh,
    /// The first triangle of each part that has triangles, in ascending order, and its look.
    parts: Vec<(u32, SurfaceLook)>,
    /// The tints of a part, with the index of the part's first corner. In the order of corners; parts without tints are left out.
    tints: Vec<(usize, Tints)>,
    materials: usize,
    light: SceneLight,
}

impl DrawnScene {
    /// An empty scene of this many materials, or of more once a look names them.
    pub fn new(materials: usize, light: SceneLight) -> DrawnScene {
        DrawnScene {
            mesh: Mesh::default(),
            parts: Vec::new(),
            tints: Vec::new(),
            materials,
            light,
        }
    }

    /// Adds triangles to the scene, with tints of their corners if they have any.
    pub fn add(&mut self, mesh: &Mesh, look: SurfaceLook, tints: Option<Tints>) {
        let named = look.material.map_or(0, |material| material + 1);
        self.materials = self.materials.max(named);
        if mesh.triangles.is_empty() {
            return;
        }
        self.tints
            .extend(tints.map(|tints| (self.mesh.vertices.len(), tints)));
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

    /// What a camera sees. A pixel shows what lies at its centre.
    pub fn frame(&self, camera: &Camera) -> FramePixels {
        let mut frame = FramePixels::new(camera.lens.size, self.materials);
        let is_one_sided = |triangle| self.look(triangle).is_one_sided;
        for point in surface_points_of(&self.mesh, camera, &is_one_sided) {
            let look = self.look(point.triangle);
            let Some(material) = look.material else {
                continue;
            };
            let [red, green, blue, alpha] = self.tint(&point);
            let coverage = look.coverage * alpha;
            if coverage <= 0.0 {
                continue;
            }
            let [r, g, b] = look.other;
            frame.of_material[material].push(ScenePixel {
                place: point.place,
                cos_theta: point.cos_theta as f32,
                roughness: look.roughness,
                coverage,
                light: self
                    .light
                    .along(point.mirrored(), f64::from(look.roughness)),
                other: [r * red, g * green, b * blue],
            });
        }
        frame
    }

    fn look(&self, triangle: u32) -> &SurfaceLook {
        let after = self.parts.partition_point(|(first, _)| *first <= triangle);
        &self.parts[after - 1].1
    }

    /// The tint interpolated at a point of a triangle; 1 where its part has none.
    fn tint(&self, point: &SurfacePoint) -> [f32; 4] {
        let corners = self.mesh.triangles[point.triangle as usize].map(|corner| corner as usize);
        let after = self
            .tints
            .partition_point(|(first, _)| *first <= corners[0]);
        let of_part = after.checked_sub(1).map(|part| &self.tints[part]);
        let of_corner = |corner: usize| {
            let (first, tints) = of_part?;
            tints.get(corner - first)
        };
        let [Some(a), Some(b), Some(c)] = corners.map(of_corner) else {
            return [1.0; 4];
        };
        let mixed = |i: usize| {
            let all = [a[i], b[i], c[i]].map(f64::from);
            (all[0] * point.weights[0] + all[1] * point.weights[1] + all[2] * point.weights[2])
                as f32
        };
        [0, 1, 2, 3].map(|i| mixed(i).clamp(0.0, 1.0))
    }
}
