//! The index per channel that stands for a whole spectrum: n and k that give the channel's F0 and F82, or, where no
//! index does, those whose curve comes nearest over all angles.
//!
//! No index has an F0 above 1 (the red of saturated gold), and the mean of several dielectrics is not quite a
//! dielectric. There the largest absolute difference over the angles is minimised: by a grid around the best point so
//! far, again and again finer. A dielectric keeps k = 0, so that the cheaper exact law serves it.

use crate::materials::{Channels, Index, Kind};
use crate::methods::Light;
use crate::optics::{self, index_from_f0_f82};

use super::derive::COS_82;
use super::model_error::{Truth, seen};

/// The index per channel, and how it was come by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effective {
    /// n and k per channel.
    pub channels: Channels,
    /// How each channel's index stands for what is seen.
    pub by: [By; 3],
}

/// How an index stands for a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// It is the index itself: the channel is one wavelength.
    Itself,
    /// It has the channel's F0 and F82.
    F0AndF82,
    /// No index has: its curve is the nearest.
    Nearest,
}

/// Below this n the exact law loses digits in f32.
const LEAST_N: f64 = 1e-3;
/// The box that is searched: n up to here in steps of equal ratio, k up to here.
const MOST_N: f64 = 20.0;
const MOST_K: f64 = 20.0;
/// A dielectric that reflects more has an n that no medium has.
const MOST_F0: f64 = 0.9;
/// A dielectric whose k stays below this is taken as transparent: k² adds 1e-5 to its reflectance at most.
const FAINT_K: f64 = 0.01;
/// Even steps of angle at which curves are compared, 0 and nearly 90 degrees included.
const ANGLES: usize = 60;
/// Half the points of the grid along each side, and how often it is refined, and by how much.
const HALF: i32 = 4;
const ROUNDS: usize = 30;
const FINER: f64 = 0.6;

/// The index per channel for what is seen of a surface in unpolarised light.
pub fn effective(truth: &Truth, kind: Kind) -> Effective {
    if let Some(channels) = truth.surface.channels() {
        return Effective {
            channels,
            by: [By::Itself; 3],
        };
    }
    let transparent = kind == Kind::Dielectric && truth.surface.most_k() < FAINT_K;
    let curve = curve(truth);
    let at = |c: f64| seen(&truth.surface, Light::Unpolarised, c);
    let (f0, f82) = (at(1.0), at(COS_82));
    let each = [0, 1, 2].map(|i| {
        let found = index_from_f0_f82(f0[i], f82[i]);
        if !transparent && found.exact && found.n >= LEAST_N {
            let index = Index {
                n: found.n,
                k: found.k,
            };
            (index, By::F0AndF82)
        } else {
            let channel: Vec<(f64, f64)> = curve.iter().map(|(c, r)| (*c, r[i])).collect();
            if transparent {
                (nearest_transparent(&channel), By::Nearest)
            } else {
                (nearest(&channel), By::Nearest)
            }
        }
    });
    Effective {
        channels: Channels::of(each.map(|(index, _)| index)),
        by: each.map(|(_, by)| by),
    }
}

/// Cosines and what is seen there.
fn curve(truth: &Truth) -> Vec<(f64, [f64; 3])> {
    let cosine = |i: usize| libm::cos(i as f64 / ANGLES as f64 * std::f64::consts::FRAC_PI_2);
    (0..ANGLES)
        .map(|i| (cosine(i), truth.at(cosine(i))))
        .collect()
}

/// The index whose curve is nearest, by largest absolute difference.
fn nearest(curve: &[(f64, f64)]) -> Index {
    search(curve, -HALF..=HALF, |[n, k]| Index {
        n: LEAST_N * libm::pow(MOST_N / LEAST_N, n),
        k: MOST_K * k * k,
    })
}

/// The nearest index without k, on the side of 1 that serves better: in the square root q of F0 around that of the
/// curve, n = (1 + q) / (1 - q), up to twice or half of it.
fn nearest_transparent(curve: &[(f64, f64)]) -> Index {
    let root = curve[0].1.clamp(0.0, MOST_F0).sqrt();
    let of = |root: f64| (1.0 + root) / (1.0 - root);
    let around = |[q, _]: [f64; 2]| (root * libm::exp2(2.0 * q - 1.0)).min(MOST_F0);
    let glass = |n: f64| Index { n, k: 0.0 };
    let above = search(curve, 0..=0, |point| glass(of(around(point))));
    let below = search(curve, 0..=0, |point| glass(1.0 / of(around(point))));
    if distance(below, curve) < distance(above, curve) {
        below
    } else {
        above
    }
}

/// The best index of those that points of the unit square stand for; `along` are the steps of the second coordinate.
fn search(
    curve: &[(f64, f64)],
    along: std::ops::RangeInclusive<i32>,
    index: impl Fn([f64; 2]) -> Index,
) -> Index {
    let mut best = (f64::INFINITY, [0.5, 0.5]);
    let mut reach = 0.5 / f64::from(HALF);
    for _ in 0..ROUNDS {
        let centre = best.1;
        for point in grid(centre, reach, &along) {
            let error = distance(index(point), curve);
            if error < best.0 {
                best = (error, point);
            }
        }
        reach *= FINER;
    }
    index(best.1)
}

/// Points of the unit square around a centre.
fn grid(
    centre: [f64; 2],
    reach: f64,
    along: &std::ops::RangeInclusive<i32>,
) -> impl Iterator<Item = [f64; 2]> {
    let place = move |from: f64, step: i32| (from + f64::from(step) * reach).clamp(0.0, 1.0);
    (-HALF..=HALF).flat_map(move |i| {
        along
            .clone()
            .map(move |j| [place(centre[0], i), place(centre[1], j)])
    })
}

fn distance(index: Index, curve: &[(f64, f64)]) -> f64 {
    let difference =
        |(c, r): &(f64, f64)| (optics::conductor(index.n, index.k, *c).unpolarised() - r).abs();
    curve.iter().map(difference).fold(0.0, f64::max)
}
