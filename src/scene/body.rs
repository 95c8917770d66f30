//! Convex bodies, as triangles to draw and as what a ray crosses.

use glam::{DVec2, DVec3, DVec4};

use super::gem::{Facets, brilliant};

/// A convex body around the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// The ball of radius 1.
    Ball,
    /// A body with plane facets.
    Gem(Facets),
}

/// Where a line enters a convex body and where it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// How far it is to the entry, and the normal there.
    pub entry: (f64, DVec3),
    /// How far it is to the exit, and the normal there, out of the body.
    pub exit: (f64, DVec3),
}

/// A vertex of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is.
    pub position: DVec3,
    /// Out of the body.
    pub normal: DVec3,
    /// Along growing u, and the sign of the bitangent.
    pub tangent: DVec4,
    /// Texture coordinates.
    pub uv: DVec2,
}

/// Rows of triangles from pole to pole, and half the columns around.
const ROWS: usize = 256;

impl Body {
    /// The gem of the pictures.
    pub fn gem() -> Body {
        Body::Gem(brilliant())
    }

    /// The radius of a ball around the origin that holds it.
    pub fn radius(&self) -> f64 {
        match self {
            Body::Ball => 1.0,
            Body::Gem(facets) => facets.radius(),
        }
    }

    /// Where a line crosses it, if it does; the direction is of unit length.
    pub fn crossing(&self, origin: DVec3, direction: DVec3) -> Option<Crossing> {
        match self {
            Body::Ball => ball(origin, direction),
            Body::Gem(facets) => facets.crossing(origin, direction),
        }
    }

    /// Its triangles.
    pub fn triangles(&self) -> Vec<[Vertex; 3]> {
        match self {
            Body::Ball => ball_triangles(),
            Body::Gem(facets) => facets.triangles(),
        }
    }
}

fn ball(origin: DVec3, direction: DVec3) -> Option<Crossing> {
    let along = -origin.dot(direction);
    let nearest = origin + along * direction;
    let under = 1.0 - nearest.length_squared();
    let half = (under > 0.0).then(|| under.sqrt())?;
    let at = |distance: f64| (distance, (origin + distance * direction).normalize());
    Some(Crossing {
        entry: at(along - half),
        exit: at(along + half),
    })
}

/// Rectangles between circles of latitude, two triangles each.
fn ball_triangles() -> Vec<[Vertex; 3]> {
    let columns = 2 * ROWS;
    let at = |row: usize, column: usize| {
        let uv = DVec2::new(column as f64 / columns as f64, row as f64 / ROWS as f64);
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
    let mut triangles = Vec::with_capacity(2 * ROWS * columns);
    for row in 0..ROWS {
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
