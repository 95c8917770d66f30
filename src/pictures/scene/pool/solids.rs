//! The solid parts of the pool: where a ray meets them, their triangles, and where the paint of each part lies in the table.

use glam::{DVec2, DVec3, DVec4};

use super::{BASIN_MAX, BASIN_MIN, is_within_sides};
use crate::pictures::scene::mesh::{Vertex, ball_triangles, quad};

/// The court around the basin, in squares of a metre.
const COURT_MIN: DVec2 = DVec2::new(-12.0, -9.0);
const COURT_MAX: DVec2 = DVec2::new(12.0, 6.0);
/// Posts: x, z, and the height of their top.
const POSTS: [[f64; 3]; 4] = [
    [-1.15, 0.35, 0.95],
    [-0.75, -1.5, 0.8],
    [1.75, -2.2, 1.05],
    [0.45, -3.1, 0.9],
];
const POST_RADIUS: f64 = 0.1;
/// The heights between which posts are painted.
const PAINTED: [f64; 2] = [-1.4, 1.1];
/// The top of the garden wall behind the court.
const GARDEN_WALL: f64 = 1.55;
const BALL_CENTRE: DVec3 = DVec3::new(0.8, 0.12, 0.75);
const BALL_RADIUS: f64 = 0.36;
/// Columns of a post, and rows of the ball.
const COLUMNS: usize = 96;
const ROWS: usize = 64;

/// A kind of surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The basin's floor.
    Floor,
    /// A wall of the basin, by its side: -x, +x, -z, +z.
    Wall(usize),
    /// A square of the court.
    Court,
    /// The garden wall.
    Garden,
    /// A post's side.
    Post,
    /// A post's top.
    Top,
    /// The ball.
    Ball,
}

/// All parts.
pub const PARTS: [Part; 10] = [
    Part::Floor,
    Part::Wall(0),
    Part::Wall(1),
    Part::Wall(2),
    Part::Wall(3),
    Part::Garden,
    Part::Court,
    Part::Post,
    Part::Top,
    Part::Ball,
];

/// The size of the table of paint.
pub const TABLE: [usize; 2] = [1024, 1280];

/// Where a ray meets something.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The distance along the ray.
    pub distance: f64,
    /// The part that it meets.
    pub part: Part,
    /// The place within the part, 0 to 1.
    pub at: DVec2,
}

impl Part {
    /// Left, top, width and height of its paint in the table.
    pub fn region(self) -> [usize; 4] {
        match self {
            Part::Floor => [0, 0, 1024, 640],
            Part::Wall(side) => [0, 640 + 72 * side, 1024, 72],
            Part::Post => [0, 928, 256, 352],
            Part::Ball => [256, 928, 512, 256],
            Part::Court => [768, 928, 128, 128],
            Part::Top => [896, 928, 128, 128],
            Part::Garden => [256, 1184, 768, 96],
        }
    }

    /// The texture coordinates of a place in it, from the middle of its first texel to that of its last.
    pub fn uv(self, at: DVec2) -> DVec2 {
        let [left, top, width, height] = self.region().map(|texels| texels as f64);
        let texel = at * DVec2::new(width - 1.0, height - 1.0) + DVec2::new(left, top) + 0.5;
        texel / DVec2::new(TABLE[0] as f64, TABLE[1] as f64)
    }

    /// The position in the world of a place in it, and the normal there; for posts, of the first post.
    pub fn in_world(self, at: DVec2) -> (DVec3, DVec3) {
        let size = BASIN_MAX - BASIN_MIN;
        let along = |share: f64| BASIN_MIN + share * size;
        let y = BASIN_MAX.y - at.y * size.y;
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * at.x);
        let round = DVec3::new(sin, 0.0, -cos);
        let [x, z, top] = POSTS[0];
        match self {
            Part::Floor => {
                let place = DVec3::new(along(at.y).x, BASIN_MIN.y, along(at.x).z);
                (place, DVec3::Y)
            }
            Part::Wall(0) => (DVec3::new(BASIN_MIN.x, y, along(at.x).z), DVec3::X),
            Part::Wall(1) => (DVec3::new(BASIN_MAX.x, y, along(at.x).z), DVec3::NEG_X),
            Part::Wall(2) => (DVec3::new(along(at.x).x, y, BASIN_MIN.z), DVec3::Z),
            Part::Wall(_) => (DVec3::new(along(at.x).x, y, BASIN_MAX.z), DVec3::NEG_Z),
            Part::Court => (DVec3::new(at.x, BASIN_MAX.y, at.y), DVec3::Y),
            Part::Garden => {
                let x = COURT_MIN.x + at.x * (COURT_MAX.x - COURT_MIN.x);
                let y = GARDEN_WALL + at.y * (BASIN_MAX.y - GARDEN_WALL);
                (DVec3::new(x, y, COURT_MIN.y), DVec3::Z)
            }
            Part::Top => (DVec3::new(x, top, z), DVec3::Y),
            Part::Post => {
                let y = PAINTED[1] + at.y * (PAINTED[0] - PAINTED[1]);
                (DVec3::new(x, y, z) + POST_RADIUS * round, round)
            }
            Part::Ball => {
                let (sin_v, cos_v) = libm::sincos(std::f64::consts::PI * at.y);
                let normal = sin_v * round + cos_v * DVec3::Y;
                (BALL_CENTRE + BALL_RADIUS * normal, normal)
            }
        }
    }
}

/// The nearest hit of a ray; the direction is of unit length.
pub fn hit(origin: DVec3, direction: DVec3) -> Option<Hit> {
    let mut hits = Vec::with_capacity(8);
    for axis in 0..3 {
        let is_low = direction[axis] < 0.0;
        let bound = if is_low { BASIN_MIN } else { BASIN_MAX };
        if axis != 1 || is_low {
            let distance = (bound[axis] - origin[axis]) / direction[axis];
            let place = origin + distance * direction;
            hits.extend(in_basin(axis, is_low, place).map(|on| (distance, on)));
        }
    }
    let distance = (BASIN_MAX.y - origin.y) / direction.y;
    hits.extend(on_court(origin + distance * direction).map(|on| (distance, on)));
    let distance = (COURT_MIN.y - origin.z) / direction.z;
    hits.extend(on_garden_wall(origin + distance * direction).map(|on| (distance, on)));
    hits.extend(
        POSTS
            .into_iter()
            .filter_map(|post| on_post(post, origin, direction)),
    );
    hits.extend(on_ball(origin, direction));
    hits.into_iter()
        .filter(|(distance, _)| *distance > 1e-9 && distance.is_finite())
        .min_by(|one, other| one.0.total_cmp(&other.0))
        .map(|(distance, (part, at))| Hit { distance, part, at })
}

/// A part of the pool, and a place in it.
type PlaceOn = (Part, DVec2);

/// A place on the floor or on a wall.
fn in_basin(axis: usize, is_low: bool, place: DVec3) -> Option<PlaceOn> {
    let share = (place - BASIN_MIN) / (BASIN_MAX - BASIN_MIN);
    let within = |axis: usize| (0.0..=1.0).contains(&share[axis]);
    let side = usize::from(!is_low);
    let on = match axis {
        0 => (Part::Wall(side), DVec2::new(share.z, 1.0 - share.y)),
        1 => (Part::Floor, DVec2::new(share.z, share.x)),
        _ => (Part::Wall(2 + side), DVec2::new(share.x, 1.0 - share.y)),
    };
    (0..3)
        .all(|other| other == axis || within(other))
        .then_some(on)
}

fn on_court(place: DVec3) -> Option<PlaceOn> {
    let at = DVec2::new(place.x, place.z);
    let is_court =
        (COURT_MIN.x..COURT_MAX.x).contains(&at.x) && (COURT_MIN.y..COURT_MAX.y).contains(&at.y);
    (is_court && !is_within_sides(place)).then(|| (Part::Court, at - at.floor()))
}

fn on_garden_wall(place: DVec3) -> Option<PlaceOn> {
    let at = DVec2::new(
        (place.x - COURT_MIN.x) / (COURT_MAX.x - COURT_MIN.x),
        (place.y - GARDEN_WALL) / (BASIN_MAX.y - GARDEN_WALL),
    );
    let is_wall = (0.0..=1.0).contains(&at.x) && (0.0..=1.0).contains(&at.y);
    is_wall.then_some((Part::Garden, at))
}

/// The height of a place of a post, as a share of what is painted.
fn painted(y: f64) -> f64 {
    (PAINTED[1] - y) / (PAINTED[1] - PAINTED[0])
}

fn on_post([x, z, top]: [f64; 3], origin: DVec3, direction: DVec3) -> Option<(f64, PlaceOn)> {
    let from = DVec2::new(origin.x - x, origin.z - z);
    let along = DVec2::new(direction.x, direction.z);
    let to_top = (top - origin.y) / direction.y;
    let across = from + to_top * along;
    if direction.y < 0.0 && to_top > 0.0 && across.length() < POST_RADIUS {
        return Some((to_top, (Part::Top, across / (2.0 * POST_RADIUS) + 0.5)));
    }
    let (a, b) = (along.length_squared(), from.dot(along));
    let under = b * b - a * (from.length_squared() - POST_RADIUS * POST_RADIUS);
    let distance = (-b - under.max(0.0).sqrt()) / a;
    let y = origin.y + distance * direction.y;
    let at = || DVec2::new(around(from + distance * along), painted(y));
    let is_post = under > 0.0 && distance > 0.0 && (BASIN_MIN.y..top).contains(&y);
    is_post.then(|| (distance, (Part::Post, at())))
}

fn on_ball(origin: DVec3, direction: DVec3) -> Option<(f64, PlaceOn)> {
    let from = origin - BALL_CENTRE;
    let b = from.dot(direction);
    let under = b * b - from.length_squared() + BALL_RADIUS * BALL_RADIUS;
    let distance = -b - under.max(0.0).sqrt();
    if under <= 0.0 || distance <= 0.0 {
        return None;
    }
    let normal = (from + distance * direction) / BALL_RADIUS;
    let latitude = libm::acos(normal.y.clamp(-1.0, 1.0)) / std::f64::consts::PI;
    let at = DVec2::new(around(DVec2::new(normal.x, normal.z)), latitude);
    Some((distance, (Part::Ball, at)))
}

/// The share of a turn from -z through +x.
fn around(place: DVec2) -> f64 {
    let turn = libm::atan2(place.x, -place.y) / std::f64::consts::TAU;
    if turn < 0.0 { turn + 1.0 } else { turn }
}

/// The triangles of all solid parts.
pub fn triangles() -> Vec<[Vertex; 3]> {
    let mut all = Vec::new();
    let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    for part in PARTS.into_iter().take(6) {
        let corners = square.map(|at| part.in_world(at).0);
        all.extend(flat(part, corners, square));
    }
    for x in COURT_MIN.x as i32..COURT_MAX.x as i32 {
        for z in COURT_MIN.y as i32..COURT_MAX.y as i32 {
            let corner = DVec3::new(x.into(), BASIN_MAX.y, z.into());
            if !is_within_sides(corner) {
                let corners = square.map(|at| corner + DVec3::new(at.x, 0.0, at.y));
                all.extend(flat(Part::Court, corners, square));
            }
        }
    }
    for post in POSTS {
        all.extend(post_triangles(post));
    }
    for triangle in ball_triangles(ROWS) {
        all.push(triangle.map(|vertex| Vertex {
            position: BALL_CENTRE + BALL_RADIUS * vertex.position,
            uv: Part::Ball.uv(vertex.uv),
            ..vertex
        }));
    }
    all
}

fn flat(part: Part, corners: [DVec3; 4], places: [DVec2; 4]) -> [[Vertex; 3]; 2] {
    let (_, normal) = part.in_world(DVec2::ZERO);
    quad(corners, places.map(|at| part.uv(at)), normal, DVec4::ZERO)
}

fn post_triangles([x, z, top]: [f64; 3]) -> Vec<[Vertex; 3]> {
    let mut all = Vec::new();
    let middle = DVec3::new(x, top, z);
    for column in 0..COLUMNS {
        let turns = [column, column + 1].map(|column| column as f64 / COLUMNS as f64);
        let [one, other] = turns.map(|turn| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn);
            DVec3::new(sin, 0.0, -cos)
        });
        let at = |direction: DVec3, y: f64| DVec3::new(x, y, z) + POST_RADIUS * direction;
        let low = BASIN_MIN.y;
        let corners = [at(one, top), at(other, top), at(other, low), at(one, low)];
        let [a, b] = turns;
        let (t, end) = (painted(top), painted(low));
        let places = [(a, t), (b, t), (b, end), (a, end)].map(|(s, t)| DVec2::new(s, t));
        all.extend(flat(Part::Post, corners, places));
        let across = |direction: DVec3| DVec2::new(direction.x, direction.z) / 2.0 + 0.5;
        let corners = [middle, at(one, top), at(other, top), middle];
        let centre = DVec2::splat(0.5);
        let places = [centre, across(one), across(other), centre];
        all.push(flat(Part::Top, corners, places)[0]);
    }
    all
}
