//! The design of the window: a rose of twelve parts with medallions, and a mosaic between them.

use glam::{DVec2, DVec3, DVec4};

use crate::pictures::scene::texels::{scattered, smooth_noise};

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

/// The piece at a place of the wall.
struct Piece {
    colour: DVec3,
    /// Its number, which seeds what differs from piece to piece.
    number: [i64; 2],
    /// The distance to the middle of the nearest lead, and half that lead's width.
    to_lead: f64,
    half_lead: f64,
}

/// The colour at a place. Alpha is 1 for glass, 0 for lead and stone.
pub fn paint(place: DVec2) -> DVec4 {
    let radius = place.length();
    if radius > ROSE {
        return stone(place).extend(0.0);
    }
    let piece = piece(place);
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
pub fn slope(place: DVec2) -> DVec2 {
    let radius = place.length();
    if radius > ROSE {
        let rim = ((radius - ROSE) / RIM).min(1.0);
        let rounded = 1.6 * (2.0 * rim - 1.0) * f64::from(u8::from(rim < 1.0));
        return -rounded * place / radius + 0.25 * grain(place);
    }
    let here = piece(place);
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
    let mut panes = DVec3::ZERO;
    for turned in [-0.06, 0.0, 0.06] {
        let beside = DVec2::from_angle(turned).rotate(place / radius);
        panes += piece((ROSE - 0.06) * beside).colour / 3.0;
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
    let width = std::f64::consts::TAU / PARTS;
    let part = (place.to_angle() / width).round();
    let local = DVec2::from_angle(-part * width).rotate(place);
    let number = (part as i64).rem_euclid(PARTS as i64);
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
    let mut seeds = Vec::with_capacity(3 * SEEDS.len());
    for shift in -1..=1 {
        for (i, ([far, angle], _)) in SEEDS.into_iter().enumerate() {
            let turned = f64::to_radians(angle + f64::from(shift) * 360.0 / PARTS);
            let seed = far * DVec2::from_angle(turned);
            seeds.push((seed, i, i64::from(shift)));
        }
    }
    let square = |seed: &DVec2| local.distance_squared(*seed);
    let nearest = seeds
        .iter()
        .min_by(|a, b| square(&a.0).total_cmp(&square(&b.0)));
    let &(seed, kind, shift) = nearest.expect("there are seeds");
    let mut to_lead = f64::INFINITY;
    for (other, ..) in &seeds {
        let apart = other.distance(seed);
        if apart > 1e-9 {
            to_lead = to_lead.min((square(other) - square(&seed)) / (2.0 * apart));
        }
    }
    let part = (part + shift).rem_euclid(PARTS as i64);
    Piece {
        colour: SEEDS[kind].1[(part % 2) as usize],
        number: [kind as i64, part],
        to_lead,
        half_lead: LEAD,
    }
}
