//! A pool: a tiled basin in a paved court, with posts that stand in the water and a ball that floats. The water's surface is y = 0, and a
//! unit is a metre.
//!
//! The light on tiles, stones and posts is painted on them as radiance by place, the same in all directions. Both the device and
//! the tracer look it up.

mod paint;
mod solids;
mod truth;

use std::sync::OnceLock;

use glam::{DVec2, DVec3, DVec4};

use super::body::Vertex;
use super::texels::Texels;
use truth::Waves;

pub use solids::quad;

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
pub fn pool() -> &'static Pool {
    static POOL: OnceLock<Pool> = OnceLock::new();
    POOL.get_or_init(|| {
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
    })
}

impl Pool {
    /// The picture shows a ball of this radius around the origin.
    pub const RADIUS: f64 = 1.9;

    /// The triangles of all solid parts.
    pub fn solids(&self) -> Vec<[Vertex; 3]> {
        solids::triangles()
    }

    /// The triangles of the water's surface without waves, with the texture coordinates of the normal map.
    pub fn surface(&self) -> Vec<[Vertex; 3]> {
        let (min, max) = (BASIN_MIN, BASIN_MAX);
        let corners = [
            (min.x, min.z),
            (max.x, min.z),
            (max.x, max.z),
            (min.x, max.z),
        ];
        let corners = corners.map(|(x, z)| DVec3::new(x, 0.0, z));
        let uvs = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        // Across: v grows along +z, and cross(normal, tangent) is -z.
        quad(corners, uvs, DVec3::Y, DVec4::new(1.0, 0.0, 0.0, -1.0)).to_vec()
    }
}
