//! Meshes: triangles with a normal at each corner.

use glam::DVec3;

/// A corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Its position, in metres.
    pub position: DVec3,
    /// The normal of the surface there. Its length does not matter.
    pub normal: DVec3,
}

/// Triangles that share corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The corners.
    pub vertices: Vec<Vertex>,
    /// Three indices of corners each.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The mesh moved and scaled so that its bounding box is centred at the origin and has a longest side of this length.
    #[must_use]
    pub fn with_extent(mut self, extent: f64) -> Mesh {
        let all = || self.vertices.iter().map(|vertex| vertex.position);
        let least = all().fold(DVec3::INFINITY, DVec3::min);
        let most = all().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre = (least + most) / 2.0;
        let side = (most - least).max_element();
        let scale = if side > 0.0 { extent / side } else { 1.0 };
        for vertex in &mut self.vertices {
            vertex.position = scale * (vertex.position - centre);
        }
        self
    }

    /// The distance of the farthest corner from the origin.
    pub fn radius(&self) -> f64 {
        let lengths = self.vertices.iter().map(|vertex| vertex.position.length());
        lengths.fold(0.0, f64::max)
    }

    /// Sets the normals of a smooth surface: at each corner the sum of its triangles' normals, weighted by area.
    pub fn smooth(&mut self) {
        for vertex in &mut self.vertices {
            vertex.normal = DVec3::ZERO;
        }
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|corner| self.vertices[corner as usize].position);
            let normal = (b - a).cross(c - a);
            for corner in triangle {
                self.vertices[*corner as usize].normal += normal;
            }
        }
    }
}
