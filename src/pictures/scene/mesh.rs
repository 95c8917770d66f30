//! Triangles to draw, as the device takes them.

use glam::{DVec2, DVec3, DVec4};

/// A vertex of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Its position.
    pub position: DVec3,
    /// The outward normal.
    pub normal: DVec3,
    /// Along growing u, and the sign of the bitangent.
    pub tangent: DVec4,
    /// Texture coordinates.
    pub uv: DVec2,
}

/// The numbers of each vertex: position, normal, tangent with the bitangent's sign, texture coordinates.
pub fn vertex_numbers(triangles: &[[Vertex; 3]]) -> Vec<[f32; 12]> {
    let numbers = |vertex: &Vertex| {
        let (p, n, t, uv) = (vertex.position, vertex.normal, vertex.tangent, vertex.uv);
        let all = [p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y, t.z, t.w, uv.x, uv.y];
        all.map(|value| value as f32)
    };
    triangles.iter().flatten().map(numbers).collect()
}

/// A ball as quads between this many circles of latitude, two triangles each.
pub fn ball_triangles(rows: usize) -> Vec<[Vertex; 3]> {
    let columns = 2 * rows;
    let at = |row: usize, column: usize| {
        let uv = DVec2::new(column as f64 / columns as f64, row as f64 / rows as f64);
        let (sin_v, cos_v) = libm::sincos(std::f64::consts::PI * uv.y);
        let (sin_u, cos_u) = libm::sincos(std::f64::consts::TAU * uv.x);
        let normal = DVec3::new(sin_u * sin_v, cos_v, -cos_u * sin_v);
        Vertex {
            position: normal,
            normal,
            tangent: DVec4::new(cos_u, 0.0, sin_u, 1.0),
            uv,
        }
    };
    let mut triangles = Vec::with_capacity(2 * rows * columns);
    for row in 0..rows {
        for column in 0..columns {
            let corners = [
                at(row, column),
                at(row, column + 1),
                at(row + 1, column),
                at(row + 1, column + 1),
            ];
            triangles.push([corners[0], corners[1], corners[2]]);
            triangles.push([corners[2], corners[1], corners[3]]);
        }
    }
    triangles
}

/// A rectangle, by its corners in order.
pub fn quad(
    corners: [DVec3; 4],
    uvs: [DVec2; 4],
    normal: DVec3,
    tangent: DVec4,
) -> [[Vertex; 3]; 2] {
    let corner = |i: usize| Vertex {
        position: corners[i],
        normal,
        tangent,
        uv: uvs[i],
    };
    [[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(corner))
}
