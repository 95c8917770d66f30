//! A window of stained glass in a dark wall, seen from inside the room: panes between leads. A unit is a metre.
//!
//! Panes are flat outside and bumpy inside. The normal map holds the bumps, the rounded leads, and the tilt of each pane in its
//! leads.
//!
//! The design is a rose of twelve parts with medallions, and a mosaic between them.
//!
//! The true light is in f64: slabs of glass with two surfaces, and light that is reflected between them.
//!
//! The thickness matters: a ray leaves beside the point where it entered, under another bump or behind a lead, and its tint grows
//! with its path.

use std::sync::LazyLock;

use glam::{DVec2, DVec3, DVec4};

use super::mesh::{Vertex, quad};
use super::texels::Texels;
use crate::physics::optics;
use crate::pictures::scene::light::{Around, Traced, mirrored, refracted};
use crate::pictures::scene::material::OpticalMaterial;
use crate::pictures::scene::texels::{scattered, smooth_noise};

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
    let [paint, normals] = Texels::baked_together([SIDE; 2], |column, row| {
        let place = place(column, row);
        let piece = (place.length() <= ROSE).then(|| piece(place));
        let slope = slope(place, piece.as_ref());
        let normal = DVec3::new(-slope.x, slope.y, 1.0).normalize();
        [paint(place, piece.as_ref()), normal.extend(1.0)]
    });
    Window { paint, normals }
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

const PARTS: f64 = 12.0;
/// The radius of the rose, and of the middle medallion.
const ROSE: f64 = 1.0;
const MIDDLE: f64 = 0.2;
/// The medallions of each part: their distance from the middle, and their radius.
const MEDALLIONS: [[f64; 2]; 2] = [[0.47, 0.088], [0.79, 0.13]];
/// Half the width of the leads between pieces, and of those around medallions.
const LEAD: f64 = 0.0075;
const THICK_LEAD: f64 = 0.012;
/// How far the stone's rim is rounded, and how far the room's light reaches.
const RIM: f64 = 0.08;
const REACH: f64 = 0.7;
/// The hub of a medallion, as a share of its radius.
const HUB: f64 = 0.52;

const RUBY: DVec3 = DVec3::new(0.78, 0.03, 0.04);
const GOLD: DVec3 = DVec3::new(0.95, 0.66, 0.08);
const COBALT: DVec3 = DVec3::new(0.03, 0.12, 0.8);
const AZURE: DVec3 = DVec3::new(0.15, 0.45, 0.92);
const EMERALD: DVec3 = DVec3::new(0.05, 0.55, 0.18);
const VIOLET: DVec3 = DVec3::new(0.35, 0.08, 0.6);
const PEARL: DVec3 = DVec3::new(0.88, 0.9, 0.8);

/// The seeds of the mosaic's pieces of each part: their distance from the middle, and their angle in degrees; and the colours of
/// the piece in parts of even number and of odd.
const SEEDS: [([f64; 2], [DVec3; 2]); 11] = [
    ([0.25, 15.0], [AZURE, AZURE]),
    ([0.32, 0.0], [RUBY, VIOLET]),
    ([0.38, 15.0], [COBALT, COBALT]),
    ([0.52, 15.0], [COBALT, COBALT]),
    ([0.62, 0.0], [GOLD, GOLD]),
    ([0.66, 15.0], [AZURE, AZURE]),
    ([0.80, 15.0], [EMERALD, RUBY]),
    ([0.73, 9.0], [COBALT, COBALT]),
    ([0.73, -9.0], [COBALT, COBALT]),
    ([0.94, 15.0], [VIOLET, VIOLET]),
    ([0.97, 0.0], [AZURE, AZURE]),
];

/// A seed of a part or of a part beside it.
struct Seed {
    place: DVec2,
    /// Its index in [`SEEDS`], and by how many parts it is shifted.
    kind: usize,
    shift: i64,
    /// Twice the distances to all seeds.
    apart: Vec<f64>,
}

/// The seeds of a part and of both parts beside it.
static ALL_SEEDS: LazyLock<Vec<Seed>> = LazyLock::new(|| {
    let mut seeds = Vec::new();
    for shift in -1..=1 {
        for (kind, ([far, angle], _)) in SEEDS.into_iter().enumerate() {
            let turned = f64::to_radians(angle + f64::from(shift) * 360.0 / PARTS);
            seeds.push(Seed {
                place: far * DVec2::from_angle(turned),
                kind,
                shift: i64::from(shift),
                apart: Vec::new(),
            });
        }
    }
    let places: Vec<DVec2> = seeds.iter().map(|seed| seed.place).collect();
    for seed in &mut seeds {
        let apart = places.iter().map(|other| 2.0 * other.distance(seed.place));
        seed.apart = apart.collect();
    }
    seeds
});

/// The piece at a place of the wall.
struct Piece {
    colour: DVec3,
    /// Its number, which seeds what differs from piece to piece.
    number: [i64; 2],
    /// The distance to the middle of the nearest lead, and half that lead's width.
    to_lead: f64,
    half_lead: f64,
}

/// The colour at a place, of which the piece is known where it lies in the rose. Alpha is 1 for glass, 0 for lead and stone.
fn paint(place: DVec2, piece: Option<&Piece>) -> DVec4 {
    let Some(piece) = piece else {
        return stone(place).extend(0.0);
    };
    if piece.to_lead < piece.half_lead {
        let worn = 0.8 + 0.4 * smooth_noise(90.0 * place);
        return (DVec3::new(0.16, 0.17, 0.19) * worn).extend(0.0);
    }
    let [i, j] = piece.number;
    let depth = 0.65 + 0.8 * scattered(i, j);
    let turned = DVec2::from_angle(3.0 * scattered(j, i)).rotate(place);
    let streaks = 0.85 + 0.3 * smooth_noise(turned * DVec2::new(12.0, 45.0));
    let tint = piece.colour.powf(depth * streaks);
    // Paint and grime have gathered along the leads.
    let grime = ((piece.to_lead - piece.half_lead) / 0.012).clamp(0.0, 1.0);
    (tint * (0.55 + 0.45 * grime)).extend(1.0)
}

/// The slope at a place, to the right and up: rounded leads, bumps of glass.
fn slope(place: DVec2, here: Option<&Piece>) -> DVec2 {
    let Some(here) = here else {
        let radius = place.length();
        let rim = ((radius - ROSE) / RIM).min(1.0);
        let rounded = 1.6 * (2.0 * rim - 1.0) * f64::from(u8::from(rim < 1.0));
        return -rounded * place / radius + 0.25 * grain(place);
    };
    if here.to_lead < here.half_lead {
        let step = 1e-4;
        let away = DVec2::new(
            piece(place + DVec2::new(step, 0.0)).to_lead - here.to_lead,
            piece(place + DVec2::new(0.0, step)).to_lead - here.to_lead,
        );
        let share = here.to_lead / here.half_lead;
        return -1.2 * share * away.normalize_or_zero();
    }
    let [i, j] = here.number;
    let tilt = DVec2::new(scattered(i + 7, j), scattered(i, j + 7)) - 0.5;
    let strength = 0.35 + 0.65 * scattered(i + 3, j + 3);
    0.09 * tilt + strength * hammered(place)
}

/// Dimples of about three centimetres: sines in directions a golden angle apart.
fn hammered(place: DVec2) -> DVec2 {
    let mut slope = DVec2::ZERO;
    for i in 0..6 {
        let along = DVec2::from_angle(2.4 * f64::from(i));
        let number = std::f64::consts::TAU / (0.028 + 0.006 * f64::from(i));
        let warp = 1.5 * smooth_noise(14.0 * place + 3.0 * f64::from(i));
        slope += 0.07 * libm::cos(number * along.dot(place) + warp) * along;
    }
    slope
}

/// Roughness of stone.
fn grain(place: DVec2) -> DVec2 {
    let at = |x: f64, y: f64| smooth_noise(60.0 * (place + DVec2::new(x, y)));
    let step = 0.004;
    DVec2::new(
        at(step, 0.0) - at(-step, 0.0),
        at(0.0, step) - at(0.0, -step),
    )
}

/// Blocks around the rose. The room lights them less the farther away they are; the panes beside them light them too.
fn stone(place: DVec2) -> DVec3 {
    let radius = place.length();
    let far = (radius - ROSE) / REACH;
    let lit = (1.0 - far).clamp(0.0, 1.0);
    let blocks = 2.0 * PARTS;
    let turn = place.to_angle() / std::f64::consts::TAU * blocks;
    let to_joint = (turn - turn.round()).abs() * std::f64::consts::TAU * radius / blocks;
    let is_joint = radius > ROSE + RIM && to_joint < 0.004;
    let mottled = 0.75 + 0.3 * smooth_noise(24.0 * place) + 0.2 * smooth_noise(110.0 * place);
    // No medallion reaches as far as these panes.
    let mut panes = DVec3::ZERO;
    for turned in [-0.06, 0.0, 0.06] {
        let beside = DVec2::from_angle(turned).rotate(place / radius);
        let (local, number) = in_part((ROSE - 0.06) * beside);
        panes += nearest_seed(local).0.colour(number) / 3.0;
    }
    let light = DVec3::splat(1.5 * lit * lit) + 5.0 * libm::exp(-(radius - ROSE) / 0.045) * panes;
    let colour = DVec3::new(0.8, 0.74, 0.66) * mottled * light;
    if is_joint { 0.45 * colour } else { colour }
}

/// The piece at a place of the rose.
fn piece(place: DVec2) -> Piece {
    let radius = place.length();
    let rim = [(ROSE - radius).abs(), THICK_LEAD];
    if radius < MIDDLE {
        return medallion(place, MIDDLE, 8.0, [0, 0], [GOLD, RUBY]).with(rim);
    }
    let (local, number) = in_part(place);
    let colours = [[EMERALD, GOLD], [RUBY, PEARL]];
    let mut outside = [radius - MIDDLE, THICK_LEAD];
    for (i, [far, size]) in MEDALLIONS.into_iter().enumerate() {
        let from = local - DVec2::new(far, 0.0);
        if from.length() < size {
            let id = [100 + i as i64, number];
            return medallion(from, size, 6.0, id, colours[i]).with(rim);
        }
        outside[0] = f64::min(outside[0], from.length() - size);
    }
    mosaic(local, number).with(outside).with(rim)
}

/// A place turned into the first part, and the number of its own part.
fn in_part(place: DVec2) -> (DVec2, i64) {
    let width = std::f64::consts::TAU / PARTS;
    let part = (place.to_angle() / width).round();
    let local = DVec2::from_angle(-part * width).rotate(place);
    (local, (part as i64).rem_euclid(PARTS as i64))
}

impl Piece {
    /// The piece with another lead, given the distance to it and half its width.
    fn with(self, [to_lead, half_lead]: [f64; 2]) -> Piece {
        if to_lead - half_lead >= self.to_lead - self.half_lead {
            return self;
        }
        Piece {
            to_lead,
            half_lead,
            ..self
        }
    }
}

/// A hub and petals around it.
fn medallion(from: DVec2, size: f64, petals: f64, id: [i64; 2], colours: [DVec3; 2]) -> Piece {
    let radius = from.length();
    let to_hub = (radius - HUB * size).abs();
    let turn = from.to_angle() / std::f64::consts::TAU * petals;
    let is_hub = radius < HUB * size;
    let to_side = (turn - turn.round()).abs() * std::f64::consts::TAU * radius / petals;
    let petal = if is_hub { -1 } else { turn.floor() as i64 };
    let piece = Piece {
        colour: colours[usize::from(!is_hub)],
        number: [id[0] * 16 + petal, id[1]],
        to_lead: to_hub,
        half_lead: LEAD,
    };
    let piece = piece.with([size - radius, THICK_LEAD]);
    if is_hub {
        piece
    } else {
        piece.with([to_side, LEAD])
    }
}

/// The mosaic's piece with the nearest seed. Its lead runs where two seeds are equally near.
fn mosaic(local: DVec2, part: i64) -> Piece {
    let (seed, least) = nearest_seed(local);
    let mut to_lead = f64::INFINITY;
    for (other, apart) in ALL_SEEDS.iter().zip(&seed.apart) {
        if *apart > 2e-9 {
            let square = local.distance_squared(other.place);
            to_lead = to_lead.min((square - least) / apart);
        }
    }
    Piece {
        colour: seed.colour(part),
        number: [seed.kind as i64, seed.part(part)],
        to_lead,
        half_lead: LEAD,
    }
}

/// The seed nearest to a place of the first part, and the square of its distance.
fn nearest_seed(local: DVec2) -> (&'static Seed, f64) {
    let seeds = &*ALL_SEEDS;
    let (mut nearest, mut least) = (&seeds[0], f64::INFINITY);
    for seed in seeds {
        let square = local.distance_squared(seed.place);
        if square < least {
            (nearest, least) = (seed, square);
        }
    }
    (nearest, least)
}

impl Seed {
    /// The number of its part, seen from this one.
    fn part(&self, part: i64) -> i64 {
        (part + self.shift).rem_euclid(PARTS as i64)
    }

    /// Its colour, seen from this part.
    fn colour(&self, part: i64) -> DVec3 {
        SEEDS[self.kind].1[(self.part(part) % 2) as usize]
    }
}

/// The thickness of the glass.
const THICKNESS: f64 = 0.006;
/// How many times light is followed from the front to the back.
const MOST_TURNS: usize = 8;
const LEAST: f64 = 1e-5;

impl Window {
    /// What a ray from the eye shows: with all reflections between both surfaces, and by refraction alone in glass without
    /// thickness.
    pub fn seen(
        &self,
        glass: &OpticalMaterial,
        around: Around,
        eye: DVec3,
        direction: DVec3,
    ) -> Traced {
        let distance = -eye.dot(outward()) / direction.dot(outward());
        let place = eye + distance * direction;
        let at = DVec2::new(place.dot(right()), place.y);
        if distance <= 0.0 || at.abs().max_element() > WALL {
            return Traced::beside(around.radiance(eye, direction));
        }
        let (paint, normal) = (self.paint_at(at), self.normal_at(at));
        if paint.w < 0.5 {
            return Traced::beside(paint.truncate() * room(normal));
        }
        let n = glass.n.y;
        let r = optics::dielectric(n, (-direction.dot(normal)).clamp(0.0, 1.0)).unpolarised();
        let reflection = r * room(mirrored(direction, normal));
        let [all, once] = match refracted(direction, normal, n) {
            Some(inside) => self.inside(at, inside, n, around),
            None => [DVec3::ZERO; 2],
        };
        Traced {
            colour: reflection + (1.0 - r) * all,
            own: reflection + (1.0 - r) * once,
            is_body: true,
            is_total: false,
        }
    }

    /// The radiance along a ray in the glass from its front: by all paths, and by what leaves at first as if the glass had no
    /// thickness.
    fn inside(&self, mut at: DVec2, mut direction: DVec3, n: f64, around: Around) -> [DVec3; 2] {
        let (mut all, mut once, mut left) = (DVec3::ZERO, DVec3::ZERO, DVec3::ONE);
        for turn in 0..MOST_TURNS {
            let cosine = direction.dot(outward());
            if cosine <= 1e-6 {
                break;
            }
            left *= self.paint_at(at).truncate().powf(1.0 / cosine);
            at += across(direction, cosine);
            let r = optics::dielectric(1.0 / n, cosine.min(1.0)).unpolarised();
            if let Some(out) = refracted(direction, -outward(), 1.0 / n) {
                let light = left * (1.0 - r) * around.radiance(DVec3::ZERO, out);
                if turn == 0 {
                    once = light;
                }
                if self.is_glass(at) {
                    all += light;
                }
            }
            left *= r;
            direction = mirrored(direction, outward());
            if left.max_element() < LEAST || !self.is_glass(at) {
                break;
            }
            left *= self.paint_at(at).truncate().powf(1.0 / cosine);
            at += across(direction, cosine);
            if !self.is_glass(at) {
                break;
            }
            let normal = self.normal_at(at);
            let cosine = direction.dot(normal).clamp(0.0, 1.0);
            let r = optics::dielectric(1.0 / n, cosine).unpolarised();
            if let Some(out) = refracted(direction, -normal, 1.0 / n) {
                all += left * (1.0 - r) * room(out);
            }
            left *= r;
            direction = mirrored(direction, normal);
        }
        [all, once]
    }

    fn is_glass(&self, at: DVec2) -> bool {
        self.paint_at(at).w >= 0.5
    }
}

/// How far a ray moves along the wall between the two surfaces.
fn across(direction: DVec3, cosine: f64) -> DVec2 {
    THICKNESS / cosine * DVec2::new(direction.dot(right()), direction.y)
}

/// The light in the room by direction: the windows light the floor.
fn room(direction: DVec3) -> DVec3 {
    DVec3::new(0.055, 0.048, 0.04) * (1.2 - 0.8 * direction.y)
}
