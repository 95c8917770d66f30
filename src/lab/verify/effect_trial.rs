//! A trial of an effect's function: its textures, its points, and the results expected there. Points lie anywhere in the domain,
//! close to the critical angle, and at the ends of the domain.
//!
//! Near the critical angle, and at the edges of texels, the last bit of an argument changes the result by much. So a result is
//! compared with what f64 gives at arguments that differ by some last bits, and at texture coordinates that differ by a step of a
//! sampler's weights, 1/256 of a texel. It may lie anywhere between those. Its error is how far it lies outside.

use std::sync::Arc;

use super::nearest_half;
use crate::generator::emit::{EffectPart, EmittedFunction};
use crate::language::effects::{Argument, Domain};
use crate::language::ir::{
    Checked, Column, CubeTexels, Filter, Param, Texels, Ty, Value, evaluate,
};
use crate::physics::num::each_channel;

/// The number of points of a trial.
const POINTS: usize = 2048;
/// How often arguments are perturbed.
const DISTURBED: usize = 16;
/// By how much: a share of the argument, which is two to four ulp of f32, and one ulp of numbers from 1 to 2. Headers of effects
/// state both.
const RELATIVE: f64 = 1.0 / (1 << 22) as f64;
const ABSOLUTE: f64 = 1.0 / (1 << 23) as f64;
/// Where nothing is promised, a result may be off by this many times the error of f32 here, and by the next figure in addition.
const ROOM: f64 = 2.0;
const LEAST: f64 = 2e-7;
/// A sampler's weights are multiples of 1/256 of a texel.
const WEIGHTS: f64 = 256.0;

/// A function with its points and its texture.
pub struct EffectTrial {
    params: Vec<Param>,
    function: Checked,
    /// The components of each argument, for each point.
    points: Vec<Vec<Vec<f32>>>,
    /// The texels of its two-dimensional texture, row by row, or of the six sides of its cube.
    pub texels: Vec<[f32; 4]>,
}

/// The result of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectOutcome {
    /// How many points there were.
    pub points: usize,
    /// The largest error: absolute, but relative for results above 1.
    pub max_abs: f64,
    /// The arguments of the largest error, and what came.
    pub worst: String,
}

impl EffectTrial {
    /// The trial of a function. Inputs of its method take these sets of values in turn.
    pub fn new(
        emitted: &EmittedFunction,
        part: EffectPart,
        values: &[Vec<(String, [f64; 3])>],
    ) -> EffectTrial {
        let params = emitted.function.params.clone();
        let point = |index: usize| {
            let numbers = params.iter().enumerate().map(|(place, param)| {
                let mut own = part.function.arguments.iter();
                match own.find(|own| own.name == param.name) {
                    Some(argument) => argument_at(argument, index, place),
                    None => input_at(param, index, values),
                }
            });
            let mut numbers: Vec<Vec<f32>> = numbers.collect();
            if (CRITICAL_FROM..CORNERS_FROM).contains(&index) {
                bring_to_critical_angle(&params, part, index, &mut numbers);
            }
            numbers
        };
        EffectTrial {
            texels: texels(&params),
            points: (0..POINTS).map(point).collect(),
            function: emitted.function.clone(),
            params,
        }
    }

    /// The arguments of all points in groups of four numbers, as a program of many arguments takes them.
    pub fn places(&self) -> Vec<[f32; 4]> {
        let mut places = Vec::new();
        for arguments in &self.points {
            for four in arguments.iter().flat_map(|numbers| numbers.chunks(4)) {
                let mut place = [0.0; 4];
                place[..four.len()].copy_from_slice(four);
                places.push(place);
            }
            if arguments.iter().all(Vec::is_empty) {
                places.push([0.0; 4]);
            }
        }
        places
    }

    /// Judges results, one a point.
    pub fn judge(&self, got: &[[f32; 3]]) -> EffectOutcome {
        self.judge_where(got, |_| true)
    }

    /// Judges results where nothing is promised, and gives the allowed error: a little more than twice that of f32 here. Points
    /// where f32 or f64 gives no finite number are left out.
    pub fn judge_without_promise(&self, got: &[[f32; 3]]) -> (EffectOutcome, f64) {
        let (single, meant) = (self.in_single(), self.meant(0));
        let is_known = |point: usize| {
            let meant: [f64; 3] = meant.at(point);
            single[point].iter().all(|x| x.is_finite()) && meant.iter().all(|x| x.is_finite())
        };
        let own = self.judge_where(&single, is_known).max_abs;
        (self.judge_where(got, is_known), ROOM * own + LEAST)
    }

    fn judge_where(&self, got: &[[f32; 3]], is_judged: impl Fn(usize) -> bool) -> EffectOutcome {
        let results: Vec<Value<f64>> = (0..=DISTURBED).map(|round| self.meant(round)).collect();
        let mut outcome = EffectOutcome {
            points: got.len(),
            max_abs: 0.0,
            worst: String::new(),
        };
        for (point, got) in got
            .iter()
            .enumerate()
            .filter(|(point, _)| is_judged(*point))
        {
            let all: Vec<[f64; 3]> = results.iter().map(|result| result.at(point)).collect();
            let outside = each_channel(|i: usize| {
                let values = all.iter().map(|value| value[i]);
                let least = values.clone().fold(f64::INFINITY, f64::min);
                let most = values.fold(f64::NEG_INFINITY, f64::max);
                let got = f64::from(got[i]);
                if got.is_finite() {
                    (least - got).max(got - most).max(0.0)
                } else {
                    f64::INFINITY
                }
            });
            let largest = all[0].iter().fold(1.0, |most, x| f64::max(most, x.abs()));
            let error = outside.into_iter().fold(0.0, f64::max) / largest;
            if error > outcome.max_abs {
                outcome.max_abs = error;
                outcome.worst = self.words(point, *got, all[0]);
            }
        }
        outcome
    }

    /// What f32 gives at the points.
    pub fn in_single(&self) -> Vec<[f32; 3]> {
        let arguments: Vec<Value<f32>> = self.arguments(0, |x| x as f32);
        let result = evaluate(&self.function, &arguments);
        (0..self.points.len()).map(|i| result.at(i)).collect()
    }

    /// What f64 gives at perturbed arguments. Round 0 leaves them as they are.
    fn meant(&self, round: usize) -> Value<f64> {
        evaluate(&self.function, &self.arguments(round, |x| x))
    }

    fn arguments<N: Copy>(&self, round: usize, number: impl Fn(f64) -> N) -> Vec<Value<N>> {
        let column = |place: usize, component: usize| {
            let values = self.points.iter().enumerate().map(|(point, arguments)| {
                let value = f64::from(arguments[place][component]);
                let seed = (point * 37 + place) * 17 + component;
                number(self.disturbed(place, component, value, round, seed))
            });
            Column::Each(values.collect())
        };
        let argument = |(place, param): (usize, &Param)| match param.ty {
            Ty::Texture => Value::Texture(Some(flat(&self.texels))),
            Ty::Cube => Value::Cube(Some(cube(&self.texels))),
            Ty::Vec3 => Value::Rgb([0, 1, 2].map(|component| column(place, component))),
            Ty::Scalar | Ty::Bool => Value::Scalar(column(place, 0)),
            ty => Value::Many((0..ty.channels()).map(|c| column(place, c)).collect()),
        };
        self.params.iter().enumerate().map(argument).collect()
    }

    /// An argument of a round, off by some last bits; where a texture is read, also by a step of its weights.
    fn disturbed(
        &self,
        place: usize,
        component: usize,
        value: f64,
        round: usize,
        seed: usize,
    ) -> f64 {
        if round == 0 {
            return value;
        }
        let sign = 2.0 * share(seed, round) - 1.0;
        let last_bits = value.abs() * RELATIVE + ABSOLUTE * f64::from(value != 0.0);
        let reads = self.params.iter().find(|param| param.ty.is_sampled());
        let texel = match (reads, self.params[place].ty) {
            (Some(_), Ty::Vec2) => 1.0 / TEXELS as f64,
            (Some(_), Ty::Vec4) if component >= 2 => 1.0 / TEXELS as f64,
            _ => 0.0,
        };
        value + sign * (last_bits + texel / WEIGHTS)
    }

    fn words(&self, point: usize, got: [f32; 3], want: [f64; 3]) -> String {
        let arguments = self.params.iter().zip(&self.points[point]);
        let given = arguments.filter(|(_, numbers)| !numbers.is_empty());
        let given = given.map(|(param, numbers)| format!("{} = {numbers:?}", param.name));
        let given: Vec<String> = given.collect();
        format!("at {} it is {got:?}, expected {want:?}", given.join(", "))
    }
}

/// From this point on, arguments come from the ends of their domains: axes, zero vectors, grazing and opposite directions.
const CORNERS_FROM: usize = 1536;
/// From this point on, up to the corners, indices are chosen so that light arrives close to the critical angle.
const CRITICAL_FROM: usize = 1280;
/// Texels of a row of the trial's textures.
pub const TEXELS: usize = 16;

/// A quasi-random number from 0 to 1: the fractional part of a multiple of the square root of a prime, by place in two sequences.
fn share(index: usize, dimension: usize) -> f64 {
    const PRIMES: [f64; 24] = [
        2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0, 41.0, 43.0, 47.0, 53.0,
        59.0, 61.0, 67.0, 71.0, 73.0, 79.0, 83.0, 89.0,
    ];
    let root = PRIMES[dimension % PRIMES.len()].sqrt();
    ((index + 1) as f64 * root).fract()
}

/// The numbers of an argument at a point: anywhere in its domain, or at an end of it.
fn argument_at(argument: &Argument, index: usize, place: usize) -> Vec<f32> {
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

/// Sets the index of a function that takes one and two directions to a value near the sine of the angle between these, where total
/// reflection begins.
fn bring_to_critical_angle(
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
fn input_at(param: &Param, index: usize, values: &[Vec<(String, [f64; 3])>]) -> Vec<f32> {
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

/// A camera's matrix, column by column: about three units in front of the world's centre, a field of view of 60 degrees, turned
/// by .2 about the vertical, depth from .5 to 10 as in Vulkan and WebGPU. No two of its numbers that a function reads are alike.
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

/// The texels of the trial's texture: numbers that grow smoothly across it, with alpha 1 inside a circle and 0 outside. Those of
/// a cube are distances between 1 and 2, different along each axis.
fn texels(params: &[Param]) -> Vec<[f32; 4]> {
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
                // Where three sides of a cube meet, filters differ, so the texels are constant there.
                let varied = ((0.8 - least / most) / 0.3).clamp(0.0, 1.0);
                let distance = 1.5 + varied * (0.3 * x - 0.2 * y + 0.1 * z) / most;
                [half(distance), 0.0, 0.0, 1.0]
            })
            .collect(),
        None => Vec::new(),
    }
}

fn flat(texels: &[[f32; 4]]) -> Texels {
    let alpha: Arc<[f32]> = texels.iter().map(|texel| texel[3]).collect();
    Texels {
        width: TEXELS,
        texels: texels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect(),
        alpha: Some(alpha),
        filter: Filter::Linear,
    }
}

fn cube(texels: &[[f32; 4]]) -> CubeTexels {
    CubeTexels {
        size: TEXELS,
        texels: texels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect(),
    }
}
