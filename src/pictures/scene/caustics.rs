//! Caustics of a ball: photons drawn through it onto a receiver, and the exact map to compare them with.
//!
//! Light of irradiance 1 falls along -z on the ball of radius 1. The receiver lies below it, square to the light.

use super::body::Body;
use super::frame::{BACK, LightBlock, PHOTONS};
use super::material::OpticalMaterial;
use super::mesh::vertex_numbers;
use super::table::find;
use super::texels::square_means;
use super::text::RowText;
use crate::lab::fault::Fault;
use crate::lab::gpu::{Depth, Device, Draw, Image, Offscreen};
use crate::physics::optics;

/// A window of the receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Its distance below the ball's centre.
    pub below: f64,
    /// Half its width.
    pub half: f64,
    /// Pixels a side.
    pub pixels: u32,
}

/// How photons are gathered on the receiver: entry points of the row's text.
#[derive(Clone, Copy, Debug)]
pub struct Gathering {
    /// The vertex entry point.
    pub vertex: &'static str,
    /// The fragment entry point.
    pub fragment: &'static str,
    /// How many vertices are drawn for this many photons in a row.
    pub vertices: fn(u32) -> u32,
    /// The most samples along a side of a pixel.
    pub finest: u32,
}

/// Triangles between neighbouring photons.
pub const TRIANGLES: Gathering = Gathering {
    vertex: "vs_triangle",
    fragment: "fs_lit",
    vertices: |side| 6 * (side - 1).pow(2),
    finest: 8,
};

/// The photons that are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Photons {
    /// Photons in a row.
    pub side: u32,
    /// Rows and columns of pictures that are averaged. For each picture the light moves by part of a cell.
    pub moves: u32,
}

/// Four pictures of 256 x 256 photons, two by two.
pub const FOUR_PICTURES: Photons = Photons {
    side: PHOTONS,
    moves: 2,
};

/// The receiver is drawn finer than the window: with about this many samples a side, where the gathering allows as many.
const FINE: u32 = 1024;

/// The irradiance of each pixel, and the share of the photons on the ball that land.
///
/// # Errors
/// The device does not draw it.
pub fn caustics(
    device: &Device,
    n: f64,
    window: &Window,
    gathering: Gathering,
    photons: Photons,
) -> Result<(Vec<f64>, f64), Fault> {
    let by = RowText::usual(find("caustics").expect("a row"));
    let text = by.module()?;
    let material = OpticalMaterial::of_index(n);
    let inputs = by.inputs_for(&material);
    let finer = (FINE / window.pixels.max(1)).clamp(1, gathering.finest);
    let pixel = 2.0 * window.half / f64::from(window.pixels);
    let Photons { side, moves } = photons;
    let share = 1.0 / f64::from(moves * moves);
    let offscreen = device.offscreen()?;
    let ball = offscreen.mesh(&vertex_numbers(&Body::Ball.triangles()))?;
    let mut sum = vec![0.0; (window.pixels as usize).pow(2)];
    let mut hits = 0.0;
    for place in 0..moves * moves {
        let part = |i: u32| ((f64::from(i) + 0.5) / f64::from(moves) - 0.5) * 2.0 / f64::from(side);
        let light = LightBlock {
            window: [window.below, window.half],
            widths: [pixel / f64::from(finer), pixel],
            photons: side,
            shift: [part(place % moves), part(place / moves)],
        };
        let block = light.numbers(&material, inputs);
        let uniforms: Vec<u8> = block.into_iter().flat_map(f32::to_ne_bytes).collect();
        let sides = Draw {
            text: &text,
            vertex: "vs_body",
            fragment: "fs_side",
            uniforms: &uniforms,
            images: &[],
            mesh: Ok(&ball),
            targets: &[],
            clears: true,
            depth: Depth::Nearest,
            adds: false,
        };
        let samples = window.pixels * finer;
        let (map, landed) = gathered(&offscreen, &sides, (side, samples), gathering)?;
        for (sum, one) in sum.iter_mut().zip(square_means(&map, finer as usize)) {
            *sum += share * one;
        }
        hits += share * landed;
    }
    Ok((sum, hits))
}

/// The irradiance at this many samples a side of the receiver, and the share of the photons on the ball that land. `sides` draws
/// positions and normals of the side of the ball that is nearest to the light.
fn gathered(
    offscreen: &Offscreen,
    sides: &Draw,
    (photons, samples): (u32, u32),
    gathering: Gathering,
) -> Result<(Vec<f64>, f64), Fault> {
    let target = |side: u32| offscreen.target(side, side);
    let pair = |side: u32| Ok::<_, Fault>([target(side)?, target(side)?]);
    let (front, back) = (pair(photons)?, pair(BACK)?);
    for (side, depth) in [(&front, Depth::Nearest), (&back, Depth::Farthest)] {
        offscreen.draw(&Draw {
            targets: &[&side[0], &side[1]],
            depth,
            ..*sides
        })?;
    }
    let nothing = offscreen.upload([1, 1, 1], &[[0.0; 4]])?;
    let landed = pair(photons)?;
    offscreen.draw(&Draw {
        vertex: "vs_cover",
        fragment: "fs_photon",
        images: &[&nothing, &front[0], &front[1], &back[0], &back[1]],
        mesh: Err(3),
        targets: &[&landed[0], &landed[1]],
        depth: Depth::Unused,
        ..*sides
    })?;
    let map = target(samples)?;
    offscreen.draw(&Draw {
        vertex: gathering.vertex,
        fragment: gathering.fragment,
        images: &[&nothing, &landed[0], &landed[1], &back[0], &back[1]],
        mesh: Err((gathering.vertices)(photons)),
        targets: &[&map],
        depth: Depth::Unused,
        adds: true,
        ..*sides
    })?;
    let count = |image: &Image| -> Result<f64, Fault> {
        let texels = offscreen.read(image)?;
        Ok(texels.iter().filter(|texel| texel[3] > 0.0).count() as f64)
    };
    let hits = count(&landed[0])? / count(&front[0])?.max(1.0);
    let map = offscreen.read(&map)?;
    Ok((map.iter().map(|sample| sample[0].into()).collect(), hits))
}

/// The rings of the ball's disc, and the samples on an eighth of each. Where rings land far apart, they are split so that at
/// least this many lie in a pixel.
const RINGS: usize = 8000;
const PLACES: usize = 1024;
const TO_A_PIXEL: f64 = 16.0;
/// The fraction of a turn whose multiples are spread most evenly.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The exact map: rings of light follow Snell's and Fresnel's laws to where they land.
pub fn exact_caustics(n: f64, window: &Window) -> Vec<f64> {
    let side = window.pixels as usize;
    let pixel = 2.0 * window.half / side as f64;
    let mut map = vec![0.0; side * side];
    let eighth = std::f64::consts::FRAC_PI_4;
    for (count, (height, width)) in rings(n, window, pixel).into_iter().enumerate() {
        let Some((radius, share)) = landing(n, height, window.below) else {
            continue;
        };
        let flux = share * 2.0 * std::f64::consts::PI * height * width;
        let each = flux / (8 * PLACES) as f64 / (pixel * pixel);
        // Neighbouring rings have their samples at different angles.
        let turn = (count as f64 * GOLDEN).fract();
        for place in 0..PLACES {
            let (sin, cos) = libm::sincos((place as f64 + turn) / PLACES as f64 * eighth);
            let place = |along: f64| ((along * radius + window.half) / pixel).floor();
            for (x, y) in [(cos, sin), (sin, cos)] {
                for (x, y) in [(x, y), (-x, y), (x, -y), (-x, -y)] {
                    let (x, y) = (place(x), place(y));
                    if (0.0..side as f64).contains(&x) && (0.0..side as f64).contains(&y) {
                        map[y as usize * side + x as usize] += each;
                    }
                }
            }
        }
    }
    map
}

/// The middle and the width of each ring of the ball's disc.
fn rings(n: f64, window: &Window, pixel: f64) -> Vec<(f64, f64)> {
    let mut rings = Vec::new();
    for ring in 0..RINGS {
        let end = |i: usize| i as f64 / RINGS as f64;
        let radius = |height: f64| landing(n, height, window.below).map(|(radius, _)| radius);
        let spread = match (radius(end(ring)), radius(end(ring + 1))) {
            (Some(inner), Some(outer)) => (outer - inner).abs(),
            _ => 0.0,
        };
        let parts = (spread / pixel * TO_A_PIXEL).clamp(1.0, 1024.0).ceil();
        let width = 1.0 / RINGS as f64 / parts;
        let middle = |part: usize| end(ring) + (part as f64 + 0.5) * width;
        rings.extend((0..parts as usize).map(|part| (middle(part), width)));
    }
    rings
}

/// How far from the axis light lands that enters at this distance from it, and the share of the light that is left.
fn landing(n: f64, height: f64, below: f64) -> Option<(f64, f64)> {
    let (theta_i, theta_t) = (libm::asin(height), libm::asin(height / n));
    // The exit's azimuth is that of the entry plus the angle that the chord spans.
    let exit = theta_i + std::f64::consts::PI - 2.0 * theta_t;
    let (x, z) = (libm::sin(exit), libm::cos(exit));
    let turned = 2.0 * (theta_i - theta_t);
    let (sin, cos) = libm::sincos(turned);
    let drop = below + z;
    (cos > 1e-3 && drop > 0.0).then(|| {
        let r = optics::dielectric(n, libm::cos(theta_i)).unpolarised();
        ((x - sin / cos * drop).abs(), (1.0 - r) * (1.0 - r))
    })
}

/// The sum of absolute differences as a share of the exact map's sum, and the drawn sum as a share of it.
pub fn caustic_error(drawn: &[f64], exact: &[f64]) -> (f64, f64) {
    let sum: f64 = exact.iter().sum();
    let apart = drawn.iter().zip(exact).map(|(a, b)| (a - b).abs());
    (apart.sum::<f64>() / sum, drawn.iter().sum::<f64>() / sum)
}
