//! A window of stained glass in a dark wall, seen from inside the room: panes between leads. A unit is a metre.
//!
//! Panes are flat outside and bumpy inside. The normal map holds the bumps, the rounded leads, and the tilt of each pane in its
//! leads.

mod design;
mod truth;

use std::sync::LazyLock;

use glam::{DVec2, DVec3, DVec4};

use super::mesh::{Vertex, quad};
use super::texels::Texels;

/// Texels along a side of the tables.
const SIDE: usize = 1600;
/// Half the width that the tables cover. The wall is black beyond.
const HALF: f64 = 1.9;
/// The middle of the rose.
const CENTRE: DVec2 = DVec2::new(0.0, 0.17);
/// Half the width of the wall.
const WALL: f64 = 4.0;

/// The window with its tables.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// The transmittance of glass along its normal, with 1 in alpha; the reflectance of lead and stone, with 0.
    pub paint: Texels,
    /// The normal map: along the wall to the right, down, and into the room.
    pub normals: Texels,
}

/// The window of the pictures.
pub static WINDOW: LazyLock<Window> = LazyLock::new(|| {
    let place = |column: usize, row: usize| {
        let share = DVec2::new(column as f64 + 0.5, row as f64 + 0.5) / SIDE as f64;
        DVec2::new(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y) * HALF - CENTRE
    };
    let normal = |column, row| {
        let slope = design::slope(place(column, row));
        let normal = DVec3::new(-slope.x, slope.y, 1.0).normalize();
        normal.extend(1.0)
    };
    Window {
        paint: Texels::baked([SIDE; 2], |column, row| design::paint(place(column, row))),
        normals: Texels::baked([SIDE; 2], normal),
    }
});

/// The picture shows a ball of this radius around the origin.
pub const RADIUS: f64 = 1.02;

/// The triangles of the wall.
pub fn triangles() -> Vec<[Vertex; 3]> {
    let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    let corners = corners.map(|(x, y)| WALL * DVec2::new(x, y));
    let places = corners.map(|at| at.x * right() + at.y * DVec3::Y);
    // v grows downward, and cross(normal, tangent) points upward.
    let tangent = right().extend(-1.0);
    quad(places, corners.map(uv), -outward(), tangent).to_vec()
}

/// The direction out of the room: level, toward the sun.
fn outward() -> DVec3 {
    DVec3::new(-0.45, 0.0, 0.4).normalize()
}

/// The direction to the right, as seen from inside the room.
fn right() -> DVec3 {
    outward().cross(DVec3::Y)
}

/// Texture coordinates of a place of the wall, which is given to the right of its middle and up.
fn uv(place: DVec2) -> DVec2 {
    DVec2::new(0.5 + 0.5 * place.x / HALF, 0.5 - 0.5 * place.y / HALF)
}

impl Window {
    /// Its colour at a place.
    fn paint_at(&self, place: DVec2) -> DVec4 {
        self.paint.at(uv(place))
    }

    /// Its normal at a place, in the world.
    fn normal_at(&self, place: DVec2) -> DVec3 {
        let mapped = self.normals.at(uv(place));
        (mapped.x * right() - mapped.y * DVec3::Y - mapped.z * outward()).normalize()
    }
}
