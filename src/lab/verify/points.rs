//! The cosines at which code is tried: edges, even in angle, even in cosine, logarithmic at both ends, and random from a constant
//! seed. The worst inputs found so far are kept for ever in two files, a line each, with how they were found.

use serde::Deserialize;

use crate::generator::fit::values;
use crate::generator::reference::Derivation;
use crate::language::ir::Ty;
use crate::language::methods::Method;
use crate::physics::materials::Channels;
use crate::physics::records;

/// The seed of the random points.
const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// Mantissas that are tried with every exponent: zero, the smallest, one third, all bits set.
const FRACTIONS: [u32; 4] = [0, 1, 0x2A_AAAA, 0x7F_FFFF];
/// The bits of 1 and of infinity.
const ONE: u32 = 0x3F80_0000;
const INFINITY: u32 = 0x7F80_0000;
/// The sign bit.
const SIGN: u32 = 1 << 31;
/// Bit patterns of NaN: the quiet one of most devices, signalling ones, all bits set.
const NANS: [u32; 5] = [
    0x7FC0_0000,
    0x7FC0_0001,
    0x7F80_0001,
    0x7FBF_FFFF,
    0x7FFF_FFFF,
];
/// How many f32 there are from 0 to 1.
pub const WITHIN: u64 = 0x3F80_0001;

/// The share of these cosines in all f32 from 0 to 1.
pub fn share(cosines: &[f32]) -> f64 {
    let is_within = |c: &&f32| c.is_sign_positive() && **c <= 1.0;
    cosines.iter().filter(is_within).count() as f64 / WITHIN as f64
}

/// Cosines outside [0, 1]: every exponent of both signs, the neighbours of 1, both infinities, NaN with several payloads. Shaders
/// do get such: rounding gives 1 + 1 ulp, a back side gives -1.
pub fn beyond() -> Vec<f32> {
    let of_exponent = |exponent: u32| FRACTIONS.map(|fraction| exponent << 23 | fraction);
    let sizes = (0..255).flat_map(of_exponent).chain([INFINITY]);
    let above = sizes.clone().filter(|bits| *bits > ONE);
    let near = (1..=10).map(|step| ONE + step);
    let below = sizes.chain([ONE + 1]).map(|bits| SIGN | bits);
    let nans = NANS.into_iter().flat_map(|bits| [bits, SIGN | bits]);
    let all = near.chain(above).chain(below).chain(nans);
    all.map(f32::from_bits).collect()
}

/// About `count` cosines in [0, 1], sorted, each once.
pub fn cosines(count: usize) -> Vec<f32> {
    cosines_around(count, &[])
}

/// As [`cosines`], and these cosines with their ten neighbours on both sides.
pub fn cosines_around(count: usize, limits: &[f32]) -> Vec<f32> {
    let share = count / 5;
    let even = |i: usize| i as f64 / share as f64;
    let mut points: Vec<f32> = [0.0, 1.0, 1.0 / 7.0, f32::MIN_POSITIVE, 1e-41]
        .iter()
        .chain(limits)
        .flat_map(|limit| around(*limit))
        .collect();
    points.extend((0..=share).map(|i| libm::cos(even(i) * std::f64::consts::FRAC_PI_2) as f32));
    points.extend((0..=share).map(|i| even(i) as f32));
    points.extend((0..=share).map(|i| libm::exp2(-30.0 * even(i)) as f32));
    points.extend((0..=share).map(|i| (1.0 - libm::exp2(-24.0 * even(i))) as f32));
    let mut random = Random(SEED);
    points.extend((0..share).map(|_| random.unit() as f32));
    points.retain(|c| (0.0..=1.0).contains(c));
    points.sort_by(f32::total_cmp);
    points.dedup();
    points
}

/// The special cosines of a medium of index `n`: where total reflection begins, and Brewster's angle.
pub fn limits(n: f64) -> [f32; 2] {
    let critical = (1.0 - n * n).max(0.0).sqrt();
    let brewster = 1.0 / (1.0 + n * n).sqrt();
    [critical as f32, brewster as f32]
}

/// A number and its ten neighbours on both sides.
fn around(x: f32) -> impl Iterator<Item = f32> {
    (-10..=10).map(move |step| f32::from_bits(x.to_bits().saturating_add_signed(step)))
}

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA, 2014,
/// <https://doi.org/10.1145/2660193.2660195>): small, seeded, the same everywhere.
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// The next number, uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

static LIBRARY: &str = include_str!("../../../data/worst-cases/library-code-error.csv");
static SPECIALISED: &str = include_str!("../../../data/worst-cases/specialised-code-error.csv");

/// A line of the library functions' record.
#[derive(Deserialize)]
struct WorstMedium {
    method: String,
    n: f64,
    k: f64,
    cos_theta: f64,
}

/// A line of the specialised functions' record.
#[derive(Deserialize)]
struct WorstCosine {
    method: String,
    cos_theta: f32,
}

/// The cosines at which the specialised functions of a method were worst, whatever the material.
pub fn worst_cosines(method: &'static Method) -> impl Iterator<Item = f32> {
    let rows: Vec<WorstCosine> = records::rows(SPECIALISED);
    let own = rows.into_iter().filter(|row| row.method == method.name);
    own.map(|row| row.cos_theta)
}

/// The worst inputs of a method's library function: the values of its arguments, in f32, and the cosine.
pub fn worst_cases(method: &'static Method) -> impl Iterator<Item = (Vec<[f32; 3]>, f32)> {
    worst_media(method).map(|(channels, cos_theta)| (arguments(method, &channels), cos_theta))
}

/// The worst inputs of a method's library function: the media and the cosine.
pub fn worst_media(method: &'static Method) -> impl Iterator<Item = (Channels, f32)> {
    let rows: Vec<WorstMedium> = records::rows(LIBRARY);
    let own = rows.into_iter().filter(|row| row.method == method.name);
    own.map(|row| {
        let channels = Channels {
            n: [row.n; 3],
            k: [row.k; 3],
        };
        (channels, row.cos_theta as f32)
    })
}

fn arguments(method: &Method, channels: &Channels) -> Vec<[f32; 3]> {
    let values = values(method, channels, &Derivation::default());
    let numbers = method.inputs.iter().filter(|input| input.ty != Ty::Texture);
    numbers
        .map(|input| values[input.name].map(|value| value as f32))
        .collect()
}
