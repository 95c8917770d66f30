//! The bodies that pictures show: convex bodies, as triangles to draw and as crossings for rays; a pool; a window.

use glam::DVec3;

use super::gem::{Crossing, GEM};
use super::mesh::{Vertex, ball_triangles};
use super::pool::{self, POOL};
use super::texels::{Slot, Texels};
use super::window::{self, WINDOW};

/// The body of a picture, around the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// The ball of radius 1.
    Ball,
    /// The brilliant.
    Gem,
    /// The pool: its solid parts and its water.
    Pool,
    /// The window of stained glass.
    Window,
}

/// Rows of triangles from pole to pole. There are twice as many columns around.
const ROWS: usize = 256;

impl Body {
    /// The body in words.
    pub fn name(self) -> &'static str {
        match self {
            Body::Ball => "ball",
            Body::Gem => "gem",
            Body::Pool => "pool",
            Body::Window => "window",
        }
    }

    /// The radius of the ball around the origin that holds it.
    pub fn radius(self) -> f64 {
        match self {
            Body::Ball => 1.0,
            Body::Gem => GEM.radius(),
            Body::Pool => pool::RADIUS,
            Body::Window => window::RADIUS,
        }
    }

    /// Where a line crosses a convex body, if it does; the direction is of unit length. Pool and window are not convex.
    pub fn crossing(self, origin: DVec3, direction: DVec3) -> Option<Crossing> {
        match self {
            Body::Ball => ball(origin, direction),
            Body::Gem => GEM.crossing(origin, direction),
            Body::Pool | Body::Window => None,
        }
    }

    /// Its triangles.
    pub fn triangles(self) -> Vec<[Vertex; 3]> {
        match self {
            Body::Ball => ball_triangles(ROWS),
            Body::Gem => GEM.triangles(),
            Body::Pool => pool::solids(),
            Body::Window => window::triangles(),
        }
    }

    /// The triangles of its water.
    pub fn water(self) -> Vec<[Vertex; 3]> {
        match self {
            Body::Pool => pool::surface(),
            Body::Ball | Body::Gem | Body::Window => Vec::new(),
        }
    }

    /// The tables that belong to it.
    pub fn tables(self) -> Vec<(Slot, &'static Texels)> {
        let (paint, normals) = match self {
            Body::Ball | Body::Gem => return Vec::new(),
            Body::Pool => (&POOL.paint, &POOL.normals),
            Body::Window => (&WINDOW.paint, &WINDOW.normals),
        };
        vec![(Slot::Paint, paint), (Slot::Relief, normals)]
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
