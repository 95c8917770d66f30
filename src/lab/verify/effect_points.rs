//! The points of a trial of an effect's function, and its textures: anywhere in the domain, close to the critical angle, and at the ends.

use std::sync::Arc;

use crate::generator::emit::EffectPart;
use crate::language::effects::{Argument, Domain};
use crate::language::ir::{CubeTexels, Filter, Param, Texels, Ty};
use super::nearest_half;

/// Of these, from this one on, arguments come from the ends of their domains: axes, zero vectors, grazing and opposite directions.
pub(super) const CORNERS_FROM: usize = 1536;
/// From this one on, up to the corners, indices are such that light arrives close to the critical angle.
pub(super) const CRITICAL_FROM: usize = 1280;
/// Texels of a row of the trial's textures.
pub const TEXELS: usize = 16;

/// A number from 0 to 1 that looks random, by place in two sequences: multiples of square roots of primes, without their whole parts.
pub(super) fn share(index: usize, dimension: usize) -> f64 {
    const PRIMES: [f64; 24] = [
        2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0, 41.0, 43.0, 47.0, 53.0,
        59.0, 61.0, 67.0, 71.0, 73.0, 79.0, 83.0, 89.0,
    ];
    let root = PRIMES[dimension % PRIMES.len()].sqrt();
    ((index + 1) as f64 * root).fract()
}

/// The numbers of an argument at a point: anywhere in its domain, or at an end of it.
pub(super) fn argument_at(argument: &Argument, index: usize, place: usize) -> Vec<f32> {
    let is_corner = index >= CORNERS_FROM;
    let pick = |count: usize, dimension: usize| {
        (share(index, 5 * place + dimension) * count as f64) as usize % count
    };
    match (argument.domain, argument.ty) {
        (Domain::UnitLength, _) if is_corner => corner_direction(pick(12, 0)),
        (Domain::UnitLength, _) => direction(share(index, 2 * place), share(index, 2 * place + 1)),
        (Domain::Within(least, most), ty) => (0..ty.channels())
            .map(|component| {
                let inner = least + (most - least) * share(index, 3 * place + component);
                let near_zero = (1e-4 * inner).clamp(least, most);
                let zero = 0.0_f64.clamp(least, most);
                let ends = [least, most, (least + most) / 2.0, zero, near_zero, inner];
                (if is_corner {
                    ends[pick(6, component)]
                } else {
                    inner
                }) as f32
            })
            .collect(),
        (Domain::Whole, Ty::Mat4) => CAMERA.to_vec(),
        (Domain::Whole, Ty::Vec4) => {
            let flipped = [0.45, -0.4, 0.48, 0.53];
            let upright = [0.5, 0.55, 0.52, 0.47];
            (if index.is_multiple_of(2) {
                upright
            } else {
                flipped
            })
            .to_vec()
        }
        (Domain::Whole, _) => Vec::new(),
    }
}

/// Gives an index, where the function takes one and two directions, a value near the sine of the angle between these: total reflection
/// begins there.
pub(super) fn bring_to_critical_angle(
    params: &[Param],
    part: EffectPart,
    index: usize,
    numbers: &mut [Vec<f32>],
) {
    let own = |name: &str| part.function.arguments.iter().find(|own| own.name == name);
    let is_direction =
        |param: &&Param| own(&param.name).is_some_and(|own| own.domain == Domain::UnitLength);
    let places = params.iter().zip(numbers.iter());
    let directions: Vec<&Vec<f32>> = places
        .filter(|(param, _)| is_direction(param))
        .map(|(_, numbers)| numbers)
        .collect();
    let [one, other, ..] = directions.as_slice() else {
        return;
    };
    let cosine: f32 = one.iter().zip(other.iter()).map(|(a, b)| a * b).sum();
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let near = 1.0 + (2.0 * share(index, 1) - 1.0) as f32 * 10_f32.powi(-(index as i32 % 6) - 1);
    for (param, numbers) in params.iter().zip(numbers) {
        if ["eta", "etas"].contains(&param.name.as_str()) {
            numbers.fill((sine * near).clamp(0.4, 2.5));
        }
    }
}

/// The numbers of an input of the method at a point.
pub(super) fn input_at(
    param: &Param,
    index: usize,
    values: &[Vec<(String, [f64; 3])>],
) -> Vec<f32> {
    let set = values.get(index % values.len().max(1));
    let found = set.and_then(|set| set.iter().find(|(name, _)| *name == param.name));
    let value = found.map_or([1.5; 3], |(_, value)| *value);
    if param.ty.is_sampled() {
        return Vec::new();
    }
    value[..param.ty.channels()]
        .iter()
        .map(|x| *x as f32)
        .collect()
}

fn direction(height: f64, turn: f64) -> Vec<f32> {
    let z = 2.0 * height - 1.0;
    let radius = (1.0 - z * z).sqrt();
    let angle = std::f64::consts::TAU * turn;
    [radius * angle.cos(), radius * angle.sin(), z]
        .map(|x| x as f32)
        .to_vec()
}

/// No direction, both ways along each axis, and some that graze an axis.
fn corner_direction(which: usize) -> Vec<f32> {
    const NEARLY: f32 = 1e-4;
    let directions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
        [0.0, NEARLY, 1.0],
        [0.0, -NEARLY, 1.0],
        [NEARLY, 0.0, -1.0],
        [0.6, 0.0, -0.8],
        [-0.0, 0.6, 0.8],
    ];
    directions[which].to_vec()
}

/// A camera about three units before the world's centre that sees 60 degrees, turned by .2 about its height, column by column: depth from .5
/// to 10, as Vulkan and WebGPU have it. No two of its numbers that a function reads are alike.
const CAMERA: [f32; 16] = [
    1.697_526,
    -0.1,
    0.209_125,
    0.198_669_3, //
    0.02,
    1.732_050_8,
    0.03,
    0.02, //
    0.344_102,
    0.05,
    -1.031_650_5,
    -0.980_066_6, //
    -0.4,
    0.3,
    2.631_579,
    3.0,
];

/// What the trial's texture holds: numbers that grow smoothly across it, in alpha 1 within a circle and 0 without; of a cube
/// distances between 1 and 2, different along each axis.
pub(super) fn texels(params: &[Param]) -> Vec<[f32; 4]> {
    let half = |x: f64| nearest_half(x as f32);
    let place = |i: usize| 2.0 * (i as f64 + 0.5) / TEXELS as f64 - 1.0;
    let texture = params.iter().find(|param| param.ty.is_sampled());
    match texture.map(|param| param.ty) {
        Some(Ty::Texture) => (0..TEXELS * TEXELS)
            .map(|at| {
                let (x, y) = (place(at % TEXELS), place(at / TEXELS));
                let squared = 1.0 - x * x - y * y;
                if squared > 0.0 {
                    [half(x), half(y), half(-squared.sqrt()), 1.0]
                } else {
                    [0.0; 4]
                }
            })
            .collect(),
        Some(_) => (0..6 * TEXELS * TEXELS)
            .map(|at| {
                let (side, row, column) = (at / TEXELS / TEXELS, at / TEXELS % TEXELS, at % TEXELS);
                let [x, y, z] = cube(&[]).direction(side, column as f64, row as f64);
                let parts = [x, y, z].map(f64::abs);
                let least = parts.into_iter().fold(f64::INFINITY, f64::min);
                let most = parts.into_iter().fold(0.0, f64::max);
                // Where three sides of a cube meet, filters differ: all is alike there.
                let varied = ((0.8 - least / most) / 0.3).clamp(0.0, 1.0);
                let distance = 1.5 + varied * (0.3 * x - 0.2 * y + 0.1 * z) / most;
                [half(distance), 0.0, 0.0, 1.0]
            })
            .collect(),
        None => Vec::new(),
    }
}

pub(super) fn flat(texels: &[[f32; 4]]) -> Texels {
    let alpha: Arc<[f32]> = texels.iter().map(|texel| texel[3]).collect();
    Texels {
        width: TEXELS,
        texels: texels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect(),
        alpha: Some(alpha),
        filter: Filter::Linear,
    }
}

pub(super) fn cube(texels: &[[f32; 4]]) -> CubeTexels {
    CubeTexels {
        size: TEXELS,
        texels: texels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect(),
    }
}
