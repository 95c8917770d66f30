//! The triangles of all meshes, in world space.

use glam::{DAffine3, DVec3};
use gltf_json::material::AlphaMode;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};

use super::container::{Buffers, GltfFault, MOST_ELEMENTS};
use super::materials::Looks;
use super::nodes::PlacedNode;
use crate::lab::raster::{MOST_TRIANGLES, Mesh, Vertex};
use crate::pictures::plan::frame::{DrawnScene, Tints};

/// The largest coordinate along each axis, in metres.
const FARTHEST: f64 = 1e6;

/// Adds the triangles of each primitive to the scene.
///
/// # Errors
/// An accessor is malformed, a number is not finite or too large, or there are too many triangles.
pub fn add_parts(
    root: &Root,
    nodes: &[PlacedNode],
    buffers: &Buffers,
    looks: &mut Looks,
    scene: &mut DrawnScene,
) -> Result<(), GltfFault> {
    // The counts so far, of triangles and of accessor elements.
    let (mut triangles, mut elements) = (0, 0);
    for node in nodes {
        let Some(index) = node.node.mesh.map(|mesh| mesh.value()) else {
            continue;
        };
        for (i, primitive) in root.meshes[index].primitives.iter().enumerate() {
            let place = format!("meshes[{index}].primitives[{i}]");
            let Some(corners) = Corners::of(primitive, &place) else {
                continue;
            };
            let Some(look) = looks.of(primitive.material)? else {
                continue;
            };
            elements += corners.elements(buffers)?;
            if elements > 2 * MOST_ELEMENTS {
                let what = format!(
                    "the scene up to here has more than {} elements",
                    2 * MOST_ELEMENTS
                );
                return Err(GltfFault::new(place, what));
            }
            let mesh = corners.read(buffers, node)?;
            triangles += mesh.triangles.len();
            if triangles > MOST_TRIANGLES {
                let what = format!("the scene up to here has more than {MOST_TRIANGLES} triangles");
                return Err(GltfFault::new(place, what));
            }
            let tints = corners.tints(buffers, alpha_mode(root, primitive), mesh.vertices.len())?;
            scene.add(&mesh, look, tints);
        }
    }
    match triangles {
        0 => Err(GltfFault::new("meshes", "the scene has no triangle")),
        _ => Ok(()),
    }
}

fn alpha_mode(root: &Root, primitive: &Primitive) -> AlphaMode {
    let material = primitive.material;
    let mode = material.map(|material| root.materials[material.value()].alpha_mode);
    match mode {
        Some(Checked::Valid(mode)) => mode,
        _ => AlphaMode::Opaque,
    }
}

/// The accessors of a primitive's corners.
struct Corners {
    place: String,
    mode: Mode,
    positions: Index<Accessor>,
    normals: Option<Index<Accessor>>,
    colours: Option<Index<Accessor>>,
    indices: Option<Index<Accessor>>,
}

impl Corners {
    /// `None` where the primitive has no triangles (points and lines) or no positions.
    fn of(primitive: &Primitive, place: &str) -> Option<Corners> {
        let Checked::Valid(mode) = primitive.mode else {
            return None;
        };
        let is_area = matches!(
            mode,
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
        );
        let attribute = |wanted| primitive.attributes.get(&Checked::Valid(wanted)).copied();
        Some(Corners {
            place: place.to_owned(),
            mode,
            positions: attribute(Semantic::Positions).filter(|_| is_area)?,
            normals: attribute(Semantic::Normals),
            colours: attribute(Semantic::Colors(0)),
            indices: primitive.indices,
        })
    }

    fn place_of(&self, what: &str) -> String {
        format!("{}.{what}", self.place)
    }

    /// The number of elements that its accessors announce.
    fn elements(&self, buffers: &Buffers) -> Result<usize, GltfFault> {
        let parts = [
            (Some(self.positions), "attributes.POSITION"),
            (self.normals, "attributes.NORMAL"),
            (self.colours, "attributes.COLOR_0"),
            (self.indices, "indices"),
        ];
        let mut sum = 0;
        for (index, what) in parts {
            if let Some(index) = index {
                sum += buffers.count(index, &self.place_of(what))?;
            }
        }
        Ok(sum)
    }

    fn read(&self, buffers: &Buffers, node: &PlacedNode) -> Result<Mesh, GltfFault> {
        let place = self.place_of("attributes.POSITION");
        let positions = buffers.vectors(self.positions, &place)?;
        // Without normals faces are flat (section 3.7.2.1); the rasteriser draws corners without a normal so.
        let mut normals = vec![DVec3::ZERO; positions.len()];
        if let Some(index) = self.normals {
            let place = self.place_of("attributes.NORMAL");
            normals = buffers.vectors(index, &place)?;
            if normals.len() != positions.len() {
                let what = format!("{} normals of {} corners", normals.len(), positions.len());
                return Err(GltfFault::new(place, what));
            }
        }
        let corners = positions.iter().zip(&normals);
        let vertices: Vec<Vertex> = corners
            .map(|(position, normal)| in_world(&node.into_world, *position, *normal))
            .collect();
        let is_near = |vertex: &Vertex| {
            vertex.position.is_finite() && vertex.position.abs().max_element() <= FARTHEST
        };
        if let Some(at) = vertices.iter().position(|vertex| !is_near(vertex)) {
            let what = format!("node {} takes corner {at} beyond {FARTHEST} m", node.index);
            return Err(GltfFault::new(place, what));
        }
        let mut triangles = self.triangles(buffers, vertices.len())?;
        // A mirroring transform reverses the winding (section 3.7.4).
        if node.into_world.matrix3.determinant() < 0.0 {
            triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
        Ok(Mesh {
            vertices,
            triangles,
        })
    }

    /// The factors of COLOR_0 on the base colour at each corner. Alpha is 1 unless the material blends.
    fn tints(
        &self,
        buffers: &Buffers,
        mode: AlphaMode,
        corners: usize,
    ) -> Result<Option<Tints>, GltfFault> {
        let Some(index) = self.colours else {
            return Ok(None);
        };
        let place = self.place_of("attributes.COLOR_0");
        let mut tints = buffers.colours(index, &place)?;
        if tints.len() != corners {
            let what = format!("{} colours of {corners} corners", tints.len());
            return Err(GltfFault::new(place, what));
        }
        if mode == AlphaMode::Mask && tints.iter().any(|tint| tint[3] < 1.0) {
            let what = "its alpha cuts parts out of the surface (alphaMode MASK), which is not read; export it without";
            return Err(GltfFault::new(place, what));
        }
        if mode == AlphaMode::Opaque {
            tints.iter_mut().for_each(|tint| tint[3] = 1.0);
        }
        Ok(Some(tints))
    }

    fn triangles(&self, buffers: &Buffers, corners: usize) -> Result<Vec<[u32; 3]>, GltfFault> {
        let order = match self.indices {
            None => (0..corners as u32).collect(),
            Some(index) => {
                let place = self.place_of("indices");
                let order = buffers.indices(index, &place)?;
                if let Some(beyond) = order.iter().find(|index| **index as usize >= corners) {
                    let what =
                        format!("index {beyond} leads to nothing: there are {corners} corners");
                    return Err(GltfFault::new(place, what));
                }
                order
            }
        };
        let [first, ..] = order.as_slice() else {
            return Ok(Vec::new());
        };
        self.check_whole(order.len())?;
        Ok(match self.mode {
            // Every other triangle has the opposite winding (section 3.7.2.1).
            Mode::TriangleStrip => (order.windows(3).enumerate())
                .map(|(i, w)| match i % 2 {
                    0 => [w[0], w[1], w[2]],
                    _ => [w[0], w[2], w[1]],
                })
                .collect(),
            Mode::TriangleFan => order[1..]
                .windows(2)
                .map(|w| [*first, w[0], w[1]])
                .collect(),
            _ => order.as_chunks::<3>().0.to_vec(),
        })
    }

    /// Refuses a count of corners or indices that does not make whole triangles (section 3.7.2.1).
    fn check_whole(&self, count: usize) -> Result<(), GltfFault> {
        let is_whole = match self.mode {
            Mode::Triangles => count.is_multiple_of(3),
            _ => count >= 3,
        };
        if is_whole {
            return Ok(());
        }
        let (what, place) = match self.indices {
            Some(_) => ("indices", "indices"),
            None => ("corners", "attributes.POSITION"),
        };
        let wanted = match self.mode {
            Mode::Triangles => "three for each triangle",
            _ => "three at least",
        };
        let what = format!("{count} {what} make no whole triangles; there must be {wanted}");
        Err(GltfFault::new(self.place_of(place), what))
    }
}

/// A corner in world space. Normals are transformed by the matrix's cofactors, which need no inverse.
fn in_world(into_world: &DAffine3, position: DVec3, normal: DVec3) -> Vertex {
    let [x, y, z] = [
        into_world.matrix3.x_axis,
        into_world.matrix3.y_axis,
        into_world.matrix3.z_axis,
    ];
    let turned = y.cross(z) * normal.x + z.cross(x) * normal.y + x.cross(y) * normal.z;
    Vertex {
        position: into_world.transform_point3(position),
        normal: turned.normalize_or_zero(),
    }
}
