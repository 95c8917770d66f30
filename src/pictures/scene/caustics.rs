//! Caustics of a ball: photons drawn through it onto a receiver, and the exact map to compare them with.
//!
//! Light of irradiance 1 falls along -z on the ball of radius 1. The receiver lies below it, square to the light.

use super::body::{Body, Vertex};
use super::draw::DrawFault;
use super::frame::{BACK, LightBlock, PHOTONS};
use super::glass::Glass;
use super::table::find;
use super::text::RowText;
use crate::lab::gpu::{Depth, Device, Draw, Image, Mesh, Offscreen};
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

/// How photons are gathered on the receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gathering {
    /// Triangles between neighbouring photons.
    Triangles,
    /// A smooth spot for each photon.
    Splats,
    /// A count in the pixel where each photon lands.
    Points,
}

/// The photons that are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Photons {
    /// Photons in a row.
    pub side: u32,
    /// Rows and columns of pictures that are averaged. For each picture the light moves by part of a cell.
    pub moves: u32,
}

/// One picture of 256 x 256 photons.
pub const ONE_PICTURE: Photons = Photons {
    side: PHOTONS,
    moves: 1,
};

/// Four such pictures, two by two.
pub const FOUR_PICTURES: Photons = Photons {
    side: PHOTONS,
    moves: 2,
};

/// Triangles are drawn finer than the window: with about this many samples a side, and at most this many times as fine.
const FINE: u32 = 1024;
const FINEST: u32 = 8;

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
) -> Result<(Vec<f64>, f64), DrawFault> {
    let row = find("caustics").expect("a row");
    let by = RowText::usual(row);
    let text = by.module();
    let text = text.map_err(|fault| DrawFault::Text(fault.to_string()))?;
    let finer = match gathering {
        Gathering::Triangles => (FINE / window.pixels.max(1)).clamp(1, FINEST),
        Gathering::Splats | Gathering::Points => 1,
    };
    let mut sum = vec![0.0; (window.pixels as usize).pow(2)];
    let mut hits = 0.0;
    let moves = photons.moves;
    let share = 1.0 / f64::from(moves * moves);
    let offscreen = device.offscreen()?;
    let triangles = Body::Ball.triangles().concat();
    let vertices: Vec<_> = triangles.iter().map(Vertex::numbers).collect();
    let mut light = Light {
        ball: offscreen.mesh(&vertices)?,
        offscreen,
        text: &text,
        side: photons.side,
        uniforms: Vec::new(),
    };
    for place in 0..moves * moves {
        let part = |i: u32| {
            ((f64::from(i) + 0.5) / f64::from(moves) - 0.5) * 2.0 / f64::from(photons.side)
        };
        let shift = [part(place % moves), part(place / moves)];
        light.uniforms = uniforms(n, window, &by, finer, (photons.side, shift));
        let (map, landed) = light.gathered(window, gathering, finer)?;
        for (sum, one) in sum.iter_mut().zip(map) {
            *sum += share * one;
        }
        hits += share * landed;
    }
    Ok((sum, hits))
}

struct Light<'a> {
    offscreen: Offscreen,
    ball: Mesh,
    text: &'a str,
    /// Photons in a row.
    side: u32,
    uniforms: Vec<u8>,
}

impl Light<'_> {
    /// The irradiance of each pixel, and the share of the photons on the ball that land.
    fn gathered(
        &self,
        window: &Window,
        gathering: Gathering,
        finer: u32,
    ) -> Result<(Vec<f64>, f64), DrawFault> {
        let front = self.side(self.side, Depth::Nearest)?;
        let back = self.side(BACK, Depth::Farthest)?;
        let nothing = self.offscreen.upload([1, 1, 1], &[[0.0; 4]])?;
        let photons = self.pair(self.side)?;
        let reads = [&nothing, &front[0], &front[1], &back[0], &back[1]];
        let all = ("vs_cover", "fs_photon", 3);
        self.draw(all, &reads, &[&photons[0], &photons[1]], false)?;
        let (vertex, fragment, count) = match gathering {
            Gathering::Triangles => ("vs_triangle", "fs_lit", (self.side - 1).pow(2)),
            Gathering::Splats => ("vs_splat", "fs_splat", self.side.pow(2)),
            Gathering::Points => ("vs_point", "fs_lit", self.side.pow(2)),
        };
        let side = window.pixels * finer;
        let map = self.offscreen.target(side, side)?;
        let reads = [&nothing, &photons[0], &photons[1], &back[0], &back[1]];
        self.draw((vertex, fragment, 6 * count), &reads, &[&map], true)?;
        let read = |image: &Image| self.offscreen.read(image);
        let (entered, landed) = (read(&front[0])?, read(&photons[0])?);
        let count = |of: &[[f32; 4]]| of.iter().filter(|texel| texel[3] > 0.0).count() as f64;
        let hits = count(&landed) / count(&entered).max(1.0);
        Ok((means(&read(&map)?, side as usize, finer as usize), hits))
    }

    fn pair(&self, side: u32) -> Result<[Image; 2], DrawFault> {
        let target = || self.offscreen.target(side, side);
        Ok([target()?, target()?])
    }

    /// Positions and normals of the side of the ball that is nearest to the light, or farthest from it.
    fn side(&self, side: u32, depth: Depth) -> Result<[Image; 2], DrawFault> {
        let targets = self.pair(side)?;
        self.offscreen.draw(&Draw {
            text: self.text,
            vertex: "vs_body",
            fragment: "fs_side",
            uniforms: &self.uniforms,
            images: &[],
            mesh: Ok(&self.ball),
            targets: &[&targets[0], &targets[1]],
            clears: true,
            depth,
            adds: false,
        })?;
        Ok(targets)
    }

    fn draw(
        &self,
        (vertex, fragment, vertices): (&str, &str, u32),
        images: &[&Image],
        targets: &[&Image],
        adds: bool,
    ) -> Result<(), DrawFault> {
        self.offscreen.draw(&Draw {
            text: self.text,
            vertex,
            fragment,
            uniforms: &self.uniforms,
            images,
            mesh: Err(vertices),
            targets,
            clears: true,
            depth: Depth::Unused,
            adds,
        })?;
        Ok(())
    }
}

/// The bytes of the uniform block.
fn uniforms(
    n: f64,
    window: &Window,
    by: &RowText,
    finer: u32,
    (photons, shift): (u32, [f64; 2]),
) -> Vec<u8> {
    let glass = Glass::of_index(n);
    let pixel = 2.0 * window.half / f64::from(window.pixels);
    let light = LightBlock {
        window: [window.below, window.half],
        widths: [pixel / f64::from(finer), pixel],
        photons,
        shift,
    };
    let block = light.numbers(&glass, by.inputs_for(&glass));
    block.into_iter().flat_map(f32::to_ne_bytes).collect()
}

/// The mean of each pixel's samples.
fn means(samples: &[[f32; 4]], side: usize, finer: usize) -> Vec<f64> {
    let pixels = side / finer;
    let pixel = |i: usize| {
        let (x, y) = (i % pixels * finer, i / pixels * finer);
        let rows = (y..y + finer).flat_map(|y| &samples[y * side + x..][..finer]);
        rows.map(|sample| f64::from(sample[0])).sum::<f64>() / (finer * finer) as f64
    };
    (0..pixels * pixels).map(pixel).collect()
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
