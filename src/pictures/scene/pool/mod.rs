//! A pool: a tiled basin in a paved court, with posts that stand in the water and a ball that floats. The water's surface is y = 0, and a
//! unit is a metre.
//!
//! The light on tiles, stones and posts is painted on them as radiance by place, the same in all directions. Both the device and
//! the tracer look it up.

mod paint;
mod solids;
mod truth;

use std::sync::LazyLock;

use glam::{DVec2, DVec3, DVec4};

use super::mesh::{Vertex, quad};
use super::texels::Texels;
use truth::Waves;

pub use solids::triangles as solids;

/// The basin: its floor, and the edge of the court.
const BASIN_MIN: DVec3 = DVec3::new(-3.0, -1.4, -4.0);
const BASIN_MAX: DVec3 = DVec3::new(3.0, 0.12, 4.0);

/// Texels along a side of the normal map.
const SIDE: usize = 512;

/// The pool with its tables.
#[derive(Clone, Debug, PartialEq)]
pub struct Pool {
    /// The radiance of all solid parts.
    pub paint: Texels,
    /// The normal map of the waves, over the whole surface.
    pub normals: Texels,
    waves: Waves,
}

/// The pool of the pictures. It is painted once.
pub static POOL: LazyLock<Pool> = LazyLock::new(|| {
    let waves = Waves::new();
    let size = (BASIN_MAX - BASIN_MIN) / SIDE as f64;
    let normal = |column: usize, row: usize| {
        let x = BASIN_MIN.x + (column as f64 + 0.5) * size.x;
        let z = BASIN_MIN.z + (row as f64 + 0.5) * size.z;
        let normal = waves.normal(DVec2::new(x, z));
        DVec4::new(normal.x, normal.z, normal.y, 1.0)
    };
    Pool {
        normals: Texels::baked([SIDE, SIDE], normal),
        paint: paint::paint(&waves),
        waves,
    }
});

/// The picture shows a ball of this radius around the origin.
pub const RADIUS: f64 = 1.9;

/// The triangles of the water's surface without waves, with the texture coordinates of the normal map.
pub fn surface() -> Vec<[Vertex; 3]> {
    let uvs = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let corners = uvs.map(|at| {
        let x = if at.x == 0.0 {
            BASIN_MIN.x
        } else {
            BASIN_MAX.x
        };
        let z = if at.y == 0.0 {
            BASIN_MIN.z
        } else {
            BASIN_MAX.z
        };
        DVec3::new(x, 0.0, z)
    });
    // Across: v grows along +z, and cross(normal, tangent) is -z.
    quad(corners, uvs, DVec3::Y, DVec4::new(1.0, 0.0, 0.0, -1.0)).to_vec()
}

/// Whether a place lies within the sides of the basin, at any height.
fn is_within_sides(place: DVec3) -> bool {
    (BASIN_MIN.x..BASIN_MAX.x).contains(&place.x) && (BASIN_MIN.z..BASIN_MAX.z).contains(&place.z)
}
