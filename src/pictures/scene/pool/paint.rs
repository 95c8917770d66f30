//! The paint of the pool: what each place reflects of the sun, of the sky, and of the sunlight that waves focus on the floor.
//!
//! Light on the floor is counted photon by photon, as the sun's rays are refracted by the waves. Other parts take the cosine of
//! their normal, without shadows.

use glam::{DVec2, DVec3};

use super::solids::{PARTS, Part, TABLE, hit};
use super::truth::Waves;
use super::{BASIN_MAX, BASIN_MIN};
use crate::physics::num::in_parallel;
use crate::physics::optics;
use crate::pictures::scene::environment::to_sun;
use crate::pictures::scene::light::refracted;
use crate::pictures::scene::texels::{Texels, scattered, smooth_noise};

/// The radiance of white: from the sun at normal incidence, and from the sky.
const SUN: DVec3 = DVec3::new(0.95, 0.9, 0.8);
const SKY: DVec3 = DVec3::new(0.3, 0.36, 0.45);
/// The index of water, and how its path dims the sun's light, of red, green and blue, per metre: Hale and Querry, Applied Optics 12,
/// 1973, <https://doi.org/10.1364/AO.12.000555>, at 610, 550 and 460 nm.
const WATER: f64 = 1.333;
const ABSORPTION: DVec3 = DVec3::new(0.25, 0.045, 0.027);
/// Cells of the floor in which photons are counted, and photons along each side of a cell.
const CELLS: [usize; 2] = [512, 384];
const PHOTONS: usize = 3;
const TILE: f64 = 0.25;
const GROUT: f64 = 0.014;

/// The table of all parts.
pub fn paint(waves: &Waves) -> Texels {
    let light = sun_on_floor(waves);
    Texels::baked(TABLE, |column, row| {
        let within = |part: &Part| {
            let [left, top, width, height] = part.region();
            (left..left + width).contains(&column) && (top..top + height).contains(&row)
        };
        let Some(part) = PARTS.into_iter().find(within) else {
            return DVec3::ZERO.extend(1.0);
        };
        let [left, top, width, height] = part.region();
        let mut sum = DVec3::ZERO;
        for shift in [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)] {
            let at = DVec2::new(
                ((column - left) as f64 + shift.0) / (width - 1) as f64,
                ((row - top) as f64 + shift.1) / (height - 1) as f64,
            );
            sum += radiance(part, at.clamp(DVec2::ZERO, DVec2::ONE), &light);
        }
        (sum / 4.0).extend(1.0)
    })
}

/// The radiance of a place of a part.
fn radiance(part: Part, at: DVec2, light: &Texels) -> DVec3 {
    let (place, normal) = part.in_world(at);
    let depth = (-place.y).max(0.0);
    let sky = SKY * (0.5 + 0.5 * normal.y) * dimmed(depth);
    let gathered = match part {
        Part::Floor => light.at(at).x * to_sun().y,
        _ => normal.dot(to_sun()).max(0.0),
    };
    let sun = SUN * gathered * dimmed(1.2 * depth);
    albedo(part, at, place) * (sky + sun)
}

fn dimmed(path: f64) -> DVec3 {
    (-ABSORPTION * path).exp()
}

fn albedo(part: Part, at: DVec2, place: DVec3) -> DVec3 {
    match part {
        Part::Floor => {
            let to_edge = (place - BASIN_MIN).min(BASIN_MAX - place);
            tile(DVec2::new(place.x, place.z), to_edge.x.min(to_edge.z))
        }
        Part::Wall(side) if place.y < 0.0 => {
            let along = if side < 2 { place.z } else { place.x };
            tile(DVec2::new(along, place.y), 1.0 + place.y)
        }
        Part::Wall(_) | Part::Court => stone(at, part),
        Part::Garden => garden(at, place),
        Part::Post => post(at, place.y),
        Part::Top => DVec3::new(0.85, 0.6, 0.2),
        Part::Ball => ball(at),
    }
}

/// OpticalMaterial tiles in their grout. A dark band lies at a distance from the edge.
fn tile(place: DVec2, to_edge: f64) -> DVec3 {
    let number = (place / TILE).floor();
    let within = place - TILE * number;
    let to_grout = within.min(TILE - within).min_element();
    if to_grout < GROUT / 2.0 {
        return DVec3::new(0.5, 0.56, 0.55);
    }
    let (i, j) = (number.x as i64, number.y as i64);
    let shade = 0.8 + 0.35 * scattered(i, j);
    let is_band = (TILE..2.0 * TILE).contains(&to_edge);
    let colour = if is_band {
        DVec3::new(0.05, 0.14, 0.36)
    } else {
        DVec3::new(0.16, 0.4, 0.44).lerp(DVec3::new(0.07, 0.28, 0.4), scattered(j, i))
    };
    (colour * shade).min(DVec3::splat(0.9))
}

/// Slabs of travertine, with their joints at the edge.
fn stone(at: DVec2, part: Part) -> DVec3 {
    let to_joint = at.min(1.0 - at).min_element();
    let colour = DVec3::new(0.74, 0.67, 0.55);
    if part == Part::Court && to_joint < 0.012 {
        return 0.55 * colour;
    }
    let grain = smooth_noise(at * DVec2::new(9.0, 40.0)) + 0.5 * smooth_noise(at * 90.0);
    colour * (0.82 + 0.12 * grain)
}

/// Plaster under a coping, with climbing leaves.
fn garden(at: DVec2, place: DVec3) -> DVec3 {
    let flat = DVec2::new(place.x, place.y);
    if at.y < 0.07 {
        return DVec3::new(0.8, 0.76, 0.68);
    }
    let climbs = smooth_noise(flat * DVec2::new(0.9, 0.7)) + 0.35 * smooth_noise(6.0 * flat);
    if climbs > 0.72 + 0.25 * at.y {
        let leaf = smooth_noise(22.0 * flat);
        return DVec3::new(0.05, 0.14, 0.04).lerp(DVec3::new(0.22, 0.36, 0.1), leaf);
    }
    DVec3::new(0.78, 0.45, 0.25) * (0.8 + 0.2 * smooth_noise(9.0 * flat))
}

/// Stripes that wind around the post, with weed at the water line.
fn post(at: DVec2, y: f64) -> DVec3 {
    let turns = at.x + 2.2 * y;
    let is_white = turns - turns.floor() < 0.5;
    let colour = if is_white {
        DVec3::new(0.86, 0.84, 0.8)
    } else {
        DVec3::new(0.55, 0.05, 0.06)
    };
    let weed = (1.0 - (y + 0.05).abs() / 0.09).clamp(0.0, 1.0) * 0.6;
    colour.lerp(DVec3::new(0.1, 0.16, 0.06), weed)
}

fn ball(at: DVec2) -> DVec3 {
    const WHITE: DVec3 = DVec3::new(0.88, 0.87, 0.84);
    const RED: DVec3 = DVec3::new(0.85, 0.1, 0.08);
    const YELLOW: DVec3 = DVec3::new(0.95, 0.62, 0.05);
    const BLUE: DVec3 = DVec3::new(0.06, 0.22, 0.6);
    match (0.08..0.92).contains(&at.y) {
        true => [RED, WHITE, YELLOW, WHITE, BLUE, WHITE][((at.x * 6.0) as usize).min(5)],
        false => WHITE,
    }
}

/// The sunlight on the floor, relative to that under water without waves or losses at the surface: shadows of what stands in its
/// way, and caustics of the waves.
fn sun_on_floor(waves: &Waves) -> Texels {
    let [along, across] = CELLS;
    let size = BASIN_MAX - BASIN_MIN;
    let row = |row: usize| -> Vec<(DVec2, f64)> {
        let x = BASIN_MIN.x + (row as f64 + 0.5) / (across * PHOTONS) as f64 * size.x;
        let photons = (0..along * PHOTONS).filter_map(|column| {
            let z = BASIN_MIN.z + (column as f64 + 0.5) / (along * PHOTONS) as f64 * size.z;
            landing(waves, DVec2::new(x, z))
        });
        photons.collect()
    };
    let landed = in_parallel(across * PHOTONS, &row, &mut |_, _| {}).concat();
    let mut cells = vec![0.0; along * across];
    for (at, share) in landed {
        let place = (at * DVec2::new(along as f64, across as f64) - 0.5).max(DVec2::ZERO);
        let first = place.floor();
        let between = place - first;
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let column = ((first.x + x) as usize).min(along - 1);
            let cell = ((first.y + y) as usize).min(across - 1) * along + column;
            let weight = (1.0 - (between.x - x).abs()) * (1.0 - (between.y - y).abs());
            cells[cell] += share * weight / (PHOTONS * PHOTONS) as f64;
        }
    }
    // For the width of the sun.
    let cells = blurred(&cells, along, across);
    Texels::baked(CELLS, |column, row| {
        glam::DVec4::splat(cells[row * along + column])
    })
}

/// Where the sun's ray through a place of the surface meets the floor, and the share of it that enters the water.
fn landing(waves: &Waves, place: DVec2) -> Option<(DVec2, f64)> {
    let surface = DVec3::new(place.x, waves.height(place), place.y);
    if hit(surface, to_sun()).is_some() {
        return None;
    }
    let normal = waves.normal(place);
    let r = optics::dielectric(WATER, normal.dot(to_sun())).unpolarised();
    let inside = refracted(-to_sun(), normal, WATER)?;
    let hit = hit(surface, inside)?;
    (hit.part == Part::Floor).then_some((hit.at, 1.0 - r))
}

/// Each cell becomes the mean of nine. At an edge the nearest cells stand in for those beyond it.
fn blurred(cells: &[f64], width: usize, height: usize) -> Vec<f64> {
    let at = |column: i64, row: i64| {
        let column = column.clamp(0, width as i64 - 1) as usize;
        cells[row.clamp(0, height as i64 - 1) as usize * width + column]
    };
    let mean = |i: usize| {
        let (column, row) = ((i % width) as i64, (i / width) as i64);
        let mut sum = 0.0;
        for (x, y) in (-1..=1).flat_map(|x| (-1..=1).map(move |y| (x, y))) {
            sum += at(column + x, row + y);
        }
        sum / 9.0
    };
    (0..cells.len()).map(mean).collect()
}
