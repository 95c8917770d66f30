//! The effective index of each channel, which stands for a whole spectrum. Its n and k give the channel's F0 and F82. If no index
//! does, they are those whose curve is nearest over all angles.
//!
//! No index has an F0 above 1 (the red of saturated gold), and the mean of several dielectrics is not quite a dielectric. There
//! the largest absolute difference over the angles is minimised. A dielectric keeps k = 0, so that the cheaper exact law serves
//! it.

use core::cell::LazyCell;

use super::reference_curve::{ReferenceCurve, reference_reflectance};
use crate::language::methods::Light;
use crate::physics::materials::{Channels, Index, MaterialKind};
use crate::physics::num::each_channel;
use crate::physics::optics::{self, COS_82, EffectiveIndex, index_from_f0_f82};

/// The index per channel, and how it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effective {
    /// n and k per channel.
    pub channels: Channels,
    /// How each channel's index was found.
    pub by: [IndexSource; 3],
}

/// How a channel's index was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndexSource {
    /// It is the index itself: the channel is one wavelength.
    Itself,
    /// It has the channel's F0 and F82.
    F0AndF82,
    /// No index has both: its curve is the nearest.
    Nearest,
}

impl IndexSource {
    /// In words.
    pub fn text(self) -> &'static str {
        match self {
            IndexSource::Itself => "one wavelength",
            IndexSource::F0AndF82 => "f0 and f82",
            IndexSource::Nearest => "nearest curve",
        }
    }
}

/// Below this n the exact law loses digits in f32.
const LEAST_N: f64 = 1e-3;
/// The bounds of the search: n up to this in steps of equal ratio, k up to this, denser near 0.
const MOST_N: f64 = 20.0;
const MOST_K: f64 = 60.0;
/// The largest F0 of a dielectric: above it, n would be that of no medium.
const MOST_F0: f64 = 0.9;
/// A dielectric with k below this counts as transparent: k² adds 4 n k²/(n + 1)⁴ to its F0, at most 2.5e-5.
const FAINT_K: f64 = 0.01;
/// The number of equal steps of angle at which curves are compared, including 0 and nearly 90 degrees.
const ANGLES: usize = 60;
/// The same where k is 0 and n alone is searched: past a critical angle there is a cusp to match.
const FINE: usize = 720;
/// Additional cosines close to grazing: 2⁻ⁱ, where a large k has its minimum.
const GRAZING: i32 = 14;
/// Steps of n and of k before a golden section, its sections, and its ratio: (√5 - 1)/2.
const STEPS_N: usize = 20;
const STEPS_K: usize = 48;
const SECTIONS: usize = 24;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The index per channel for a surface in unpolarised light.
pub fn effective(reference: &ReferenceCurve, kind: MaterialKind) -> Effective {
    if let Some(channels) = reference.surface.channels() {
        return Effective {
            channels,
            by: [IndexSource::Itself; 3],
        };
    }
    let transparent = kind == MaterialKind::Dielectric && reference.surface.most_k() < FAINT_K;
    let curve = LazyCell::new(|| curve(reference, if transparent { FINE } else { ANGLES }));
    let at = |c: f64| reference_reflectance(&reference.surface, Light::Unpolarised, c);
    let (f0, f82) = (at(1.0), at(COS_82));
    let each = each_channel(|i| {
        let EffectiveIndex { n, k, exact } = index_from_f0_f82(f0[i], f82[i]);
        if !transparent && exact && n >= LEAST_N {
            return (Index { n, k }, IndexSource::F0AndF82);
        }
        let channel: Vec<(f64, f64)> = curve.iter().map(|(c, r)| (*c, r[i])).collect();
        let index = if transparent {
            nearest_transparent(&channel)
        } else {
            nearest(&channel)
        };
        (index, IndexSource::Nearest)
    });
    Effective {
        channels: Channels::of(each.map(|(index, _)| index)),
        by: each.map(|(_, by)| by),
    }
}

/// Cosines and the reflectance there, clipped to [0, 1]: no index reflects more than 1, so for saturated gold's red an index can
/// follow only the part below 1.
fn curve(reference: &ReferenceCurve, angles: usize) -> Vec<(f64, [f64; 3])> {
    let even = (0..angles).map(|i| i as f64 / angles as f64 * std::f64::consts::FRAC_PI_2);
    let grazing = (2..GRAZING).map(|i| libm::exp2(-f64::from(i)));
    let cosines = even.map(libm::cos).chain(grazing);
    let clipped = |c| reference.at(c).map(|r| r.clamp(0.0, 1.0));
    cosines.map(|c| (c, clipped(c))).collect()
}

/// The index whose curve is nearest, by largest absolute difference: for each k the best n, and of these the best. The valley is
/// long, narrow and not smooth, so n and k are searched separately.
fn nearest(curve: &[(f64, f64)]) -> Index {
    let of = |k: f64, n: f64| Index {
        n: LEAST_N * libm::pow(MOST_N / LEAST_N, n),
        k: MOST_K * k * k,
    };
    let best_n = |k: f64| least(STEPS_N, |n, limit| distance(of(k, n), curve, limit));
    let (k, _) = least(STEPS_K, |k, _| best_n(k).1);
    of(k, best_n(k).0)
}

/// The nearest index with k = 0, above or below 1, whichever is better. It is searched in the square root q of F0, n = (1 + q) /
/// (1 - q), from half the curve's q to twice that.
fn nearest_transparent(curve: &[(f64, f64)]) -> Index {
    let root = curve[0].1.clamp(0.0, MOST_F0).sqrt();
    let q = |share: f64| (root * libm::exp2(2.0 * share - 1.0)).min(MOST_F0);
    let above = |share: f64| (1.0 + q(share)) / (1.0 - q(share));
    let error = |n: f64, limit: f64| distance(Index { n, k: 0.0 }, curve, limit);
    let (glass, glass_error) = least(STEPS_N, |share, limit| error(above(share), limit));
    let (gas, gas_error) = least(STEPS_N, |share, limit| error(1.0 / above(share), limit));
    let n = if gas_error < glass_error {
        1.0 / above(gas)
    } else {
        above(glass)
    };
    Index { n, k: 0.0 }
}

/// The place in [0, 1] where a function has its minimum, and its value: the best of equal steps, then a golden section between
/// its neighbours. The function also receives a limit: if its value exceeds the limit, it may return any number above it.
fn least(steps: usize, f: impl Fn(f64, f64) -> f64) -> (f64, f64) {
    let at = |i: usize| i as f64 / steps as f64;
    let (mut best, mut value) = (0, f64::INFINITY);
    for i in 0..=steps {
        let here = f(at(i), value);
        if here < value {
            (best, value) = (i, here);
        }
    }
    let (mut low, mut high) = (at(best.saturating_sub(1)), at((best + 1).min(steps)));
    for _ in 0..SECTIONS {
        let [left, right] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let left_value = f(left, f64::INFINITY);
        if left_value <= f(right, left_value) {
            high = right;
        } else {
            low = left;
        }
    }
    let middle = 0.5 * (low + high);
    let found = (middle, f(middle, value));
    if found.1 <= value {
        found
    } else {
        (at(best), value)
    }
}

/// The largest difference between an index's curve and this one, or one above the limit. Eight points at a time have no branch
/// between them, so that a compiler takes several at once.
fn distance(index: Index, curve: &[(f64, f64)], limit: f64) -> f64 {
    let mut largest: f64 = 0.0;
    for points in curve.chunks(8) {
        let mut differences = [0.0; 8];
        for (difference, (cos_theta, reflectance)) in differences.iter_mut().zip(points) {
            *difference = (optics::unpolarised(index.n, index.k, *cos_theta) - reflectance).abs();
        }
        largest = differences.into_iter().fold(largest, f64::max);
        if largest > limit {
            break;
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::{self, Surface, ViewingConditions};

    fn reference(name: &str) -> (ReferenceCurve, MaterialKind) {
        let material = materials::find(name).expect("it is there");
        let material = material.expect("it is good");
        let surface = Surface::new(&material, None, &ViewingConditions::default());
        let surface = surface.expect("it is full");
        let reference = ReferenceCurve::new(surface, Light::Unpolarised);
        (reference, material.kind)
    }

    /// No index is nearer, neither of a dense grid around it nor of a coarse grid over all bounds.
    #[test]
    fn the_nearest_index_is_the_nearest() {
        for (name, channel) in [
            ("gold", 0),
            ("gold_mcpeak", 0),
            ("copper_babar", 0),
            ("water", 1),
        ] {
            let (reference, kind) = reference(name);
            let found = effective(&reference, kind);
            assert_eq!(found.by[channel], IndexSource::Nearest, "{name}");
            let curve = curve(&reference, ANGLES).into_iter();
            let curve: Vec<(f64, f64)> = curve.map(|(c, r)| (c, r[channel])).collect();
            let error = |n, k| distance(Index { n, k }, &curve, f64::INFINITY);
            let (n, k) = (found.channels.n[channel], found.channels.k[channel]);
            let own = error(n, k);
            let glass = kind == MaterialKind::Dielectric;
            for i in -50..=50 {
                for j in -50..=50 {
                    let moved = |value: f64, steps: i32| value * (1.0 + f64::from(steps) * 2e-4);
                    let near = error(moved(n, i), moved(k, j));
                    let far_k = if glass { 0.0 } else { 0.6 * f64::from(j + 51) };
                    let far = error(0.002 * libm::pow(2e3, f64::from(i + 50) / 100.0), far_k);
                    let least = near.min(far);
                    assert!(least > own - 1e-5, "{name}: {least} is less than {own}");
                }
            }
        }
    }

    /// A curve made from an index gives that index back.
    #[test]
    fn grey_media_come_back() {
        for (n, k, kind) in [
            (1.5, 0.0, MaterialKind::Dielectric),
            (0.2, 3.5, MaterialKind::Metal),
            (4.0, 0.1, MaterialKind::Semiconductor),
        ] {
            let (mut reference, _) = reference("silver");
            reference.surface.indices.fill(Index { n, k });
            let reference = ReferenceCurve::new(reference.surface, Light::Unpolarised);
            let found = effective(&reference, kind);
            for i in 0..3 {
                let apart = (found.channels.n[i] - n).abs() / n + (found.channels.k[i] - k).abs();
                assert!(apart < 1e-6, "{found:?}");
            }
        }
    }

    /// 2 ∫ R cos θ d(cos θ): 1 for a mirror, and known in closed form for glass (Walsh 1926; n = 1.5: .0918).
    #[test]
    fn averages_are_hemispherical() {
        let (reference, _) = reference("silver");
        let of = |index: Index| {
            let mut surface = reference.surface.clone();
            surface.indices.fill(index);
            ReferenceCurve::new(surface, Light::Unpolarised).average()[1]
        };
        let mirror = of(Index { n: 1.0, k: 1e9 });
        assert!((mirror - 1.0).abs() < 1e-6, "{mirror}");
        let glass = of(Index { n: 1.5, k: 0.0 });
        assert!((glass - 0.0918).abs() < 5e-5, "{glass}");
    }
}
