//! Fresnel's law, by Snell's law in complex numbers, and its inverse: the index with a given F0 and F82.
//!
//! With m = n + ik and sin²θ = 1 − cos²θ:
//!
//! ```text
//! w   = m cos θt = √(m² − sin²θ)              (Snell: m sin θt = sin θ; Im w ≥ 0)
//! r_s = (cos θ − w) / (cos θ + w)             R_s = |r_s|²
//! r_p = (m² cos θ − w) / (m² cos θ + w)       R_p = |r_p|²
//! ```
//!
//! Source: M. Born, E. Wolf, *Principles of Optics*, 7th edition, Cambridge University Press, 1999, sections 1.5.2
//! (equations 20 and 21), 1.5.4 and 14.2, <https://doi.org/10.1017/CBO9781139644181>.
//!
//! Domain: n ≥ 0, k ≥ 0, |m| ≤ 1e70, 0 ≤ cos θ ≤ 1; not m = 0 at cos θ = 1, where the law has no limit.
//!
//! Error, absolute, for given `n`, `k`, `cos_theta`: below 8ε (ε = 2.2e-16 in `f64`, 1.2e-32 in double-double), except
//! near the critical angle. Where |w| < 0.1 cos θ it is below 3ε cos θ/|w|, and never above about √ε. One rounding of
//! `cos_theta` has as large an effect.
//!
//! # The inverse
//!
//! The index n + ik with R(0°) = F0 and R(81.79°) = F82. With q = √F0:
//!
//! ```text
//! (m − 1)/(m + 1) = q e^(iφ)                  the circle of all m with R(0°) = F0, 0 ≤ φ ≤ π
//! n = (1 − q²) / d,  k = 2 q sin φ / d,       d = (1 − q)² + 4 q sin²(φ/2)
//! F82(φ) = R(cos θ = 1/7)                     unpolarised; increasing in φ; solved by bisection
//! ```
//!
//! Sources: the circle is that of O. Gulbrandsen, *Artist Friendly Metallic Fresnel*, Journal of Computer Graphics
//! Techniques 3(4), 2014, <https://jcgt.org/published/0003/04/03/>: k² = (F0 (n + 1)² − (n − 1)²)/(1 − F0), here with
//! the angle φ in place of n, because it loses no digits where k is small. F82 as the second colour: N. Hoffman,
//! *Fresnel Equations Considered Harmful*, Eurographics Workshop on Material Appearance Modeling, 2019,
//! <https://doi.org/10.2312/mam.20191305>.
//!
//! Branch: there is only one. As φ goes from 0 to π, n falls from (1 + q)/(1 − q), a dielectric, through the metals,
//! to (1 − q)/(1 + q), a dielectric of index below 1. F82 rises monotonically (the first test below), for F0 = 0.04
//! from 0.455 to 1. So the solution is unique and continuous in both colours.
//!
//! Domain: 0 ≤ F0 ≤ [`LARGEST_F0`], and F82 between its values at the two ends. Other pairs give the nearest F82 at
//! the nearest F0, with `exact` false. Error: F0 is matched within 1e-14 and F82 within 1e-12. F82 is even in φ, hence flat
//! at the dielectric end. There an error ε of F82 moves k by about √ε (glass may come back with k = 1e-8).

use super::{COS_82, Reflectance};
use crate::physics::num::{Complex, Num, Truth};

/// Reflectance of the surface of m = n + ik.
///
/// ```
/// use fresnel_gen::physics::optics::conductor;
///
/// let silver = conductor(0.06, 3.6, 1.0).unpolarised();
/// assert!(silver > 0.98);
/// ```
#[inline]
pub fn conductor<N: Num>(n: N, k: N, cos_theta: N) -> Reflectance<N> {
    let zero = N::from_f64(0.0);
    if is_zero(n - N::from_f64(1.0)) && is_zero(k) {
        return Reflectance { s: zero, p: zero };
    }
    let m_squared = Complex::new((n - k) * (n + k), N::from_f64(2.0) * n * k);
    let w = normal_component(n, k, cos_theta).sqrt();
    Reflectance {
        s: power_ratio(Complex::real(cos_theta), w),
        p: power_ratio(m_squared.scale(cos_theta), w),
    }
}

/// [`conductor`] in `f64` for unpolarised light, to the bit, without a branch: in a loop over wavelengths a compiler takes several
/// at a time.
///
/// ```
/// use fresnel_gen::physics::optics::{conductor, unpolarised};
///
/// assert_eq!(unpolarised(0.06, 3.6, 0.3), conductor(0.06, 3.6, 0.3).unpolarised());
/// ```
#[inline]
pub fn unpolarised(n: f64, k: f64, cos_theta: f64) -> f64 {
    let squared = Complex::new((n - k) * (n + k), 2.0 * n * k);
    let w = root(normal_component(n, k, cos_theta));
    let s = power_ratio(Complex::real(cos_theta), w);
    let p = power_ratio(squared.scale(cos_theta), w);
    let is_nothing = (n - 1.0 == 0.0) & (k == 0.0);
    0.5 * choose(is_nothing, 0.0, s + p)
}

/// [`Complex::sqrt`] to the bit, without a branch.
#[inline]
pub(super) fn root(z: Complex<f64>) -> Complex<f64> {
    let (real, imaginary) = (z.re.abs(), z.im.abs());
    let large = choose(real > imaginary, real, imaginary);
    let ratio = choose(real > imaginary, imaginary, real) / large;
    let modulus = choose(large == 0.0, large, large * (1.0 + ratio * ratio).sqrt());
    let large = (0.5 * (modulus + real)).sqrt();
    let small = choose(large == 0.0, 0.0, 0.5 * z.im / large);
    let (is_left, is_below) = (z.re < 0.0, z.im < 0.0);
    Complex::new(
        choose(is_left, choose(is_below, -small, small), large),
        choose(is_left, choose(is_below, -large, large), small),
    )
}

#[inline]
fn choose(condition: bool, yes: f64, no: f64) -> f64 {
    if condition { yes } else { no }
}

/// Reflectance of the surface between two transparent media; `eta` = n_t/n_i > 0.
///
/// ```
/// use fresnel_gen::physics::optics::dielectric;
///
/// let glass: f64 = dielectric(1.5, 1.0).unpolarised();
/// assert!((glass - 0.04).abs() < 1e-12);
/// ```
#[inline]
pub fn dielectric<N: Num>(eta: N, cos_theta: N) -> Reflectance<N> {
    conductor(eta, N::from_f64(0.0), cos_theta)
}

/// R at cos θ = 1: ((n − 1)² + k²) / ((n + 1)² + k²).
///
/// ```
/// use fresnel_gen::physics::optics::normal_incidence;
///
/// let diamond: f64 = normal_incidence(2.42, 0.0);
/// assert!((diamond - 0.1724).abs() < 1e-4);
/// ```
#[inline]
pub fn normal_incidence<N: Num>(n: N, k: N) -> N {
    power_ratio(Complex::real(N::from_f64(1.0)), Complex::new(n, k))
}

/// w² = m² − sin²θ.
///
/// At large angles it is computed as (m² − 1) + cos²θ, which keeps the digits of n near 1. At small ones it is computed
/// as m² − sin²θ, which keeps those of a small m.
#[inline]
pub(super) fn normal_component<N: Num>(n: N, k: N, cos_theta: N) -> Complex<N> {
    let one = N::from_f64(1.0);
    let cos_squared = cos_theta * cos_theta;
    let real = if cos_squared.less(N::from_f64(0.5)) == Truth::Yes {
        (n - one) * (n + one) - k * k + cos_squared
    } else {
        (n - k) * (n + k) - (one - cos_theta) * (one + cos_theta)
    };
    Complex::new(real, N::from_f64(2.0) * n * k)
}

/// |(a − b)/(a + b)|². As a ratio of two squares it is exactly 1 for real a and imaginary b, and for a = 0.
#[inline]
pub(super) fn power_ratio<N: Num>(a: Complex<N>, b: Complex<N>) -> N {
    (a - b).norm_sqr() / (a + b).norm_sqr()
}

/// Whether x is 0, by way of `f64`: [`Num::less`] answers no for a NaN.
#[inline]
fn is_zero<N: Num>(x: N) -> bool {
    x.to_f64() == 0.0
}

/// F0 is clamped to this. At 1 the circle is the line n = 0, and only an infinite index has F82 < 1.
pub const LARGEST_F0: f64 = 0.999_999;

/// The given colours count as matched if F82 differs by no more.
const EXACT_WITHIN: f64 = 1e-12;

/// Halvings of [0, π] in the bisection: more than it takes to resolve every φ near 0 that changes F82 in its last place.
const HALVINGS: u32 = 100;

/// An index that gives two reflectances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectiveIndex {
    /// Refractive index.
    pub n: f64,
    /// Extinction coefficient, ≥ 0.
    pub k: f64,
    /// Whether it gives the requested reflectances. Otherwise it gives the nearest ones that some index gives.
    pub exact: bool,
}

/// The n and k ≥ 0 with normal-incidence reflectance `f0` and unpolarised reflectance `f82` at cos θ = 1/7.
///
/// ```
/// use fresnel_gen::physics::optics::{COS_82, conductor, index_from_f0_f82, normal_incidence};
///
/// let f82 = conductor(0.2, 3.0, COS_82).unpolarised();
/// let found = index_from_f0_f82(normal_incidence(0.2, 3.0), f82);
/// assert!((found.n - 0.2).abs() < 1e-6 && (found.k - 3.0).abs() < 1e-6);
/// ```
pub fn index_from_f0_f82(f0: f64, f82: f64) -> EffectiveIndex {
    // Not `clamp`: a NaN becomes 0.
    let reachable_f0 = if f0 > 0.0 { f0.min(LARGEST_F0) } else { 0.0 };
    let (n, k) = on_circle(reachable_f0, phase_of(reachable_f0, f82));
    let exact = reachable_f0 == f0 && (reflectance_82(n, k) - f82).abs() <= EXACT_WITHIN;
    EffectiveIndex { n, k, exact }
}

/// The φ at which F82 is nearest to `f82`: the end of the circle when it lies beyond.
fn phase_of(f0: f64, f82: f64) -> f64 {
    let below = |phase: f64| {
        let (n, k) = on_circle(f0, phase);
        reflectance_82(n, k) < f82
    };
    let (mut low, mut high) = (0.0, std::f64::consts::PI);
    if !below(low) {
        return low;
    }
    if below(high) {
        return high;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// (n, k) at φ on the circle of reflectance `f0`.
fn on_circle(f0: f64, phase: f64) -> (f64, f64) {
    let q = f0.sqrt();
    // `libm`, because the platform's own sine may differ in the last place. The sine of the nearest number to π is
    // not 0, and k must be.
    let (sine_half, cosine_half) = libm::sincos(0.5 * phase);
    let cosine_half = if phase < std::f64::consts::PI {
        cosine_half
    } else {
        0.0
    };
    let d = (1.0 - q) * (1.0 - q) + 4.0 * q * sine_half * sine_half;
    let n = (1.0 - q) * (1.0 + q) / d;
    (n, 4.0 * q * sine_half * cosine_half / d)
}

fn reflectance_82(n: f64, k: f64) -> f64 {
    conductor(n, k, COS_82).unpolarised()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_is_the_law_at_cos_one() {
        for (n, k) in [
            (1.5, 0.0),
            (0.2, 3.0),
            (1e-10, 0.0),
            (2.5, 4.4),
            (1.0, 1e-300),
        ] {
            let expected = normal_incidence(n, k);
            let law = conductor(n, k, 1.0);
            assert!((law.s - expected).abs() < 1e-15, "{n} {k}");
            assert!((law.p - expected).abs() < 1e-15, "{n} {k}");
        }
    }

    #[test]
    fn the_law_without_branches_is_the_law_to_the_bit() {
        let parts = [0.0, 1e-300, 1e-9, 0.2, 0.7, 1.0, 1.33, 1.5, 2.4, 7.9, 1e9];
        for n in parts.into_iter().filter(|n| *n > 0.0) {
            for k in parts {
                for i in 0..=400 {
                    let cos_theta = f64::from(i) / 400.0;
                    let want = conductor(n, k, cos_theta).unpolarised();
                    let got = unpolarised(n, k, cos_theta);
                    assert_eq!(got.to_bits(), want.to_bits(), "{n} {k} {cos_theta}");
                }
            }
        }
    }

    const F0: [f64; 12] = [
        1e-6, 1e-4, 0.01, 0.02, 0.04, 0.1, 0.2, 0.5, 0.7, 0.9, 0.99, LARGEST_F0,
    ];

    #[test]
    fn reflectance_at_82_degrees_rises_with_the_phase() {
        for f0 in F0 {
            let steps = (0..=4000).map(|i| std::f64::consts::PI * f64::from(i) / 4000.0);
            let values: Vec<f64> = steps
                .map(|phase| on_circle(f0, phase))
                .map(|(n, k)| reflectance_82(n, k))
                .collect();
            let falls = values
                .windows(2)
                .map(|pair| pair[0] - pair[1])
                .fold(0.0, f64::max);
            assert!(falls < 1e-15, "{f0}: falls by {falls:e}");
        }
    }

    #[test]
    fn finds_the_index_of_known_materials() {
        let mut worst: f64 = 0.0;
        for (n, k) in [
            (1.39, 1.72),
            (0.23, 3.94),
            (2.49, 4.44),
            (0.05, 3.0),
            (4.1, 0.05),
            (3.0, 3.3),
            (1.6, 7.9),
        ] {
            let found = index_from_f0_f82(normal_incidence(n, k), reflectance_82(n, k));
            assert!(found.exact);
            worst = worst
                .max((found.n - n).abs() / n)
                .max((found.k - k).abs() / k);
        }
        assert!(worst < 1e-9, "worst relative error {worst:e}");
    }

    #[test]
    fn meets_every_reachable_pair() {
        let mut worst: (f64, f64) = (0.0, 0.0);
        for f0 in F0 {
            let ends = [0.0, std::f64::consts::PI].map(|phase| {
                let (n, k) = on_circle(f0, phase);
                reflectance_82(n, k)
            });
            for i in 0..=200 {
                let f82 = ends[0] + (ends[1] - ends[0]) * f64::from(i) / 200.0;
                let found = index_from_f0_f82(f0, f82);
                assert!(found.exact && found.k >= 0.0, "{f0} {f82} {found:?}");
                worst.0 = worst.0.max((normal_incidence(found.n, found.k) - f0).abs());
                worst.1 = worst.1.max((reflectance_82(found.n, found.k) - f82).abs());
            }
        }
        assert!(worst.0 < 1e-14 && worst.1 < 1e-12, "F0 and F82: {worst:?}");
    }

    #[track_caller]
    fn check_unreachable(f0: f64, f82: f64, n: f64) {
        let found = index_from_f0_f82(f0, f82);
        assert!(!found.exact);
        assert!((found.n - n).abs() < 1e-9 * n, "{found:?}");
        assert_eq!(found.k, 0.0);
    }

    #[test]
    fn unreachable_pairs_give_the_nearest_end() {
        check_unreachable(0.04, 0.3, 1.5);
        check_unreachable(0.04, 1.1, 2.0 / 3.0);
        check_unreachable(0.04, f64::NAN, 1.5);
        check_unreachable(0.0, 0.5, 1.0);
        check_unreachable(-0.1, 0.0, 1.0);
        let beyond = index_from_f0_f82(1.06, 0.999_999_5);
        assert!(!beyond.exact && beyond.n.is_finite() && beyond.k > 0.0);
        assert!((normal_incidence(beyond.n, beyond.k) - LARGEST_F0).abs() < 1e-14);
        assert!(index_from_f0_f82(0.0, 0.0).exact);
    }
}
