//! A normal map: dents in a hammered surface, as texels that both the tracer and the device look up.

use glam::DVec3;
use half::f16;

/// A square table of normals in the frame of tangent, bitangent and normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    side: usize,
    /// Rounded to binary16, as the device holds them.
    texels: Vec<[f32; 3]>,
}

const SIDE: usize = 512;
/// Dents around, and from pole to pole.
const DENTS: [f64; 2] = [16.0, 8.0];
impl Relief {
    /// Dents of this steepest slope.
    pub fn hammered(slope: f64) -> Relief {
        let texel = |i: usize| {
            let at = |place: usize| (place as f64 + 0.5) / SIDE as f64;
            let wave = |place: f64, dents: f64| libm::sincos(std::f64::consts::TAU * dents * place);
            let (sin_u, cos_u) = wave(at(i % SIDE), DENTS[0]);
            let (sin_v, cos_v) = wave(at(i / SIDE), DENTS[1]);
            let normal = DVec3::new(slope * sin_u * cos_v, slope * cos_u * sin_v, 1.0);
            let rounded = normal.normalize().to_array();
            rounded.map(|value| f16::from_f64(value).to_f32())
        };
        Relief {
            side: SIDE,
            texels: (0..SIDE * SIDE).map(texel).collect(),
        }
    }

    /// Texels of a side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// The texels, row after row.
    pub fn texels(&self) -> &[[f32; 3]] {
        &self.texels
    }

    /// The normal of the ball of radius 1 where it has this one, in the world.
    pub fn on_ball(&self, normal: DVec3) -> DVec3 {
        let longitude = libm::atan2(normal.x, -normal.z) / std::f64::consts::TAU;
        let latitude = libm::acos(normal.y.clamp(-1.0, 1.0)) / std::f64::consts::PI;
        let mapped = self.sample(longitude, latitude);
        let east = DVec3::new(-normal.z, 0.0, normal.x).normalize_or_zero();
        let beside = normal.cross(east);
        (mapped.x * east + mapped.y * beside + mapped.z * normal).normalize()
    }

    /// Linear between texels; rows repeat.
    fn sample(&self, u: f64, v: f64) -> DVec3 {
        let (x, y) = (u * self.side as f64 - 0.5, v * self.side as f64 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let texel = |x: f64, y: f64| {
            let column = (x as i64).rem_euclid(self.side as i64) as usize;
            let row = y.clamp(0.0, self.side as f64 - 1.0) as usize;
            let [a, b, c] = self.texels[row * self.side + column];
            DVec3::new(a.into(), b.into(), c.into())
        };
        let along = |y: f64| texel(left, y).lerp(texel(left + 1.0, y), x - left);
        along(top).lerp(along(top + 1.0), y - top)
    }
}
