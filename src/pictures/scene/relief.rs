//! A normal map: dents in a hammered surface, as texels that both the tracer and the device look up.

use glam::{DVec2, DVec3};

use super::texels::Texels;

/// A square table of normals in the frame of tangent, bitangent and normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    normals: Texels,
}

const SIDE: usize = 512;
/// Dents around, and from pole to pole.
const DENTS: [f64; 2] = [16.0, 8.0];

impl Relief {
    /// Dents of this steepest slope.
    pub fn hammered(slope: f64) -> Relief {
        let normal = |column: usize, row: usize| {
            let at = |place: usize| (place as f64 + 0.5) / SIDE as f64;
            let wave = |place: f64, dents: f64| libm::sincos(std::f64::consts::TAU * dents * place);
            let (sin_u, cos_u) = wave(at(column), DENTS[0]);
            let (sin_v, cos_v) = wave(at(row), DENTS[1]);
            let normal = DVec3::new(slope * sin_u * cos_v, slope * cos_u * sin_v, 1.0);
            normal.normalize().extend(1.0)
        };
        Relief {
            normals: Texels::baked([SIDE, SIDE], normal),
        }
    }

    /// The table.
    pub fn normals(&self) -> &Texels {
        &self.normals
    }

    /// The normal of the ball of radius 1 where it has this one, in the world.
    pub fn on_ball(&self, normal: DVec3) -> DVec3 {
        let longitude = libm::atan2(normal.x, -normal.z) / std::f64::consts::TAU;
        let latitude = libm::acos(normal.y.clamp(-1.0, 1.0)) / std::f64::consts::PI;
        let mapped = self.normals.at_around(DVec2::new(longitude, latitude));
        let east = DVec3::new(-normal.z, 0.0, normal.x).normalize_or_zero();
        let beside = normal.cross(east);
        (mapped.x * east + mapped.y * beside + mapped.z * normal).normalize()
    }
}
