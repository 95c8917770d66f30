//! What pictures show: convex bodies, as triangles to draw and as what a ray crosses; a pool; a window.

use glam::{DVec2, DVec3, DVec4};

use super::gem::{Facets, brilliant};
use super::pool::Pool;
use super::table::Slot;
use super::texels::Texels;
use super::window::Window;

/// What a picture shows, around the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// The ball of radius 1.
    Ball,
    /// A body with plane facets.
    Gem(Facets),
    /// A pool: what is solid there, and its water.
    Pool(&'static Pool),
    /// A window of stained glass.
    Window(&'static Window),
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

impl Vertex {
    /// Its numbers: position, normal, tangent with the bitangent's sign, texture coordinates.
    pub fn numbers(&self) -> [f32; 12] {
        let (p, n, t, uv) = (self.position, self.normal, self.tangent, self.uv);
        let all = [p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y, t.z, t.w, uv.x, uv.y];
        all.map(|value| value as f32)
    }
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
            Body::Pool(_) => Pool::RADIUS,
            Body::Window(_) => Window::RADIUS,
        }
    }

    /// Where a line crosses a convex body, if it does; the direction is of unit length. Pool and window are not convex.
    pub fn crossing(&self, origin: DVec3, direction: DVec3) -> Option<Crossing> {
        match self {
            Body::Ball => ball(origin, direction),
            Body::Gem(facets) => facets.crossing(origin, direction),
            Body::Pool(_) | Body::Window(_) => None,
        }
    }

    /// Its triangles.
    pub fn triangles(&self) -> Vec<[Vertex; 3]> {
        match self {
            Body::Ball => ball_triangles(ROWS),
            Body::Gem(facets) => facets.triangles(),
            Body::Pool(pool) => pool.solids(),
            Body::Window(window) => window.triangles(),
        }
    }

    /// The triangles of its water.
    pub fn water(&self) -> Vec<[Vertex; 3]> {
        match self {
            Body::Pool(pool) => pool.surface(),
            Body::Ball | Body::Gem(_) | Body::Window(_) => Vec::new(),
        }
    }
}

impl Body {
    /// The tables that belong to it.
    pub fn tables(&self) -> Vec<(Slot, &Texels)> {
        match self {
            Body::Ball | Body::Gem(_) => Vec::new(),
            Body::Pool(pool) => vec![(Slot::Paint, &pool.paint), (Slot::Relief, &pool.normals)],
            Body::Window(window) => vec![
                (Slot::Paint, &window.paint),
                (Slot::Relief, &window.normals),
            ],
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

/// Rectangles between so many circles of latitude, two triangles each.
pub(super) fn ball_triangles(rows: usize) -> Vec<[Vertex; 3]> {
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
