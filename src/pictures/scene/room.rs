//! A room around a scene: a box with painted walls, exact from any place, and as a cube map from one. Also the normal map of a
//! hammered surface, as texels that both the tracer and the device look up.

use glam::{DVec2, DVec3};

use super::texels::Texels;

/// The lower corner of the room.
pub const ROOM_MIN: DVec3 = DVec3::new(-3.5, -1.5, -4.0);
/// The upper corner of the room.
pub const ROOM_MAX: DVec3 = DVec3::new(3.0, 3.0, 4.0);
/// Where the cube map is taken: neither the room's centre nor the ball's.
pub const CUBE_CENTRE: DVec3 = DVec3::new(0.5, 0.8, 0.3);

/// Radiance at a place inside along a direction. It finds the nearest wall ahead, axis by axis.
pub fn room_radiance(place: DVec3, direction: DVec3) -> DVec3 {
    let mut nearest = (f64::INFINITY, 0);
    for axis in 0..3 {
        let slope = direction[axis];
        let wall = if slope > 0.0 { ROOM_MAX } else { ROOM_MIN };
        let distance = (wall[axis] - place[axis]) / slope;
        if slope != 0.0 && distance < nearest.0 {
            nearest = (distance, axis);
        }
    }
    let (distance, axis) = nearest;
    wall_colour(place + distance * direction, axis, direction[axis] > 0.0)
}

/// Squares of different colours on all walls, and a bright window in the ceiling.
fn wall_colour(place: DVec3, axis: usize, is_high: bool) -> DVec3 {
    let (a, b) = (place[(axis + 1) % 3], place[(axis + 2) % 3]);
    if axis == 1 && is_high && a.abs() < 1.0 && b.abs() < 1.0 {
        return DVec3::splat(4.0);
    }
    let is_light = ((a * 1.5).floor() + (b * 1.5).floor()).rem_euclid(2.0) == 0.0;
    let colour = match (axis, is_high) {
        (0, false) => DVec3::new(0.7, 0.15, 0.1),
        (0, true) => DVec3::new(0.1, 0.55, 0.15),
        (1, false) => DVec3::new(0.45, 0.35, 0.25),
        (1, true) => DVec3::new(0.8, 0.8, 0.75),
        (_, false) => DVec3::new(0.15, 0.3, 0.7),
        (_, true) => DVec3::new(0.7, 0.6, 0.1),
    };
    colour * if is_light { 1.0 } else { 0.35 }
}

/// The six faces of the cube map in their order, with this many texels a side, each the mean of four samples.
pub fn room_cube(side: usize) -> Vec<[f32; 4]> {
    let texel = |i: usize| {
        let (face, rest) = (i / (side * side), i % (side * side));
        let (column, row) = ((rest % side) as f64, (rest / side) as f64);
        let place = |at: f64, shift: f64| 2.0 * (at + shift) / side as f64 - 1.0;
        let mut sum = DVec3::ZERO;
        for (x, y) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
            let direction = towards(face, place(column, x), place(row, y));
            sum += room_radiance(CUBE_CENTRE, direction);
        }
        let mean = sum / 4.0;
        [mean.x as f32, mean.y as f32, mean.z as f32, 1.0]
    };
    (0..6 * side * side).map(texel).collect()
}

/// The direction of a face's texel, as graphics APIs define it: +x, -x, +y, -y, +z, -z.
fn towards(face: usize, s: f64, t: f64) -> DVec3 {
    match face {
        0 => DVec3::new(1.0, -t, -s),
        1 => DVec3::new(-1.0, -t, s),
        2 => DVec3::new(s, 1.0, t),
        3 => DVec3::new(s, -1.0, -t),
        4 => DVec3::new(s, -t, 1.0),
        _ => DVec3::new(-s, -t, -1.0),
    }
}

/// A square table of normals in the frame of tangent, bitangent and normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    /// The normals.
    pub normals: Texels,
}

const SIDE: usize = 512;
/// The number of dents around, and from pole to pole.
const DENTS: [f64; 2] = [16.0, 8.0];

impl Relief {
    /// Dents with this steepest slope.
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

    /// The dented normal of the ball of radius 1 in the world, where its smooth normal is this.
    pub fn on_ball(&self, normal: DVec3) -> DVec3 {
        let longitude = libm::atan2(normal.x, -normal.z) / std::f64::consts::TAU;
        let latitude = libm::acos(normal.y.clamp(-1.0, 1.0)) / std::f64::consts::PI;
        let mapped = self.normals.at_around(DVec2::new(longitude, latitude));
        let east = DVec3::new(-normal.z, 0.0, normal.x).normalize_or_zero();
        let beside = normal.cross(east);
        (mapped.x * east + mapped.y * beside + mapped.z * normal).normalize()
    }
}
