//! The Fresnel law, by Snell's law in complex numbers. With m = n + ik and sin²θ = 1 − cos²θ:
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
//! near the critical angle: where |w| < 0.1 cos θ it is below 3ε cos θ/|w|, and never above about √ε. One rounding of
//! `cos_theta` does as much.

use super::Reflectance;
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

/// The cosine of Brewster's angle, where R_p = 0 and tan θ = η: 1/√(1 + η²).
///
/// ```
/// use fresnel_gen::physics::optics::{brewster_cos, dielectric};
///
/// let reflected: f64 = dielectric(1.5, brewster_cos(1.5)).p;
/// assert!(reflected < 1e-12);
/// ```
#[inline]
pub fn brewster_cos<N: Num>(eta: N) -> N {
    (N::from_f64(1.0) + eta * eta).inverse_sqrt()
}

/// The cosine of the critical angle, where sin θ = η: √(1 − η²). None for η ≥ 1.
///
/// ```
/// use fresnel_gen::physics::optics::critical_cos;
///
/// let inside: f64 = critical_cos(0.5).expect("light leaves the denser medium");
/// assert!((inside - 0.75f64.sqrt()).abs() < 1e-12);
/// assert_eq!(critical_cos(1.5), None);
/// ```
#[inline]
pub fn critical_cos<N: Num>(eta: N) -> Option<N> {
    let one = N::from_f64(1.0);
    (eta.less(one) == Truth::Yes).then(|| ((one - eta) * (one + eta)).sqrt())
}

/// w² = m² − sin²θ.
///
/// At large angles as (m² − 1) + cos²θ, which keeps the digits of n near 1; at small ones as m² − sin²θ, which
/// keeps those of a small m.
#[inline]
fn normal_component<N: Num>(n: N, k: N, cos_theta: N) -> Complex<N> {
    let one = N::from_f64(1.0);
    let cos_squared = cos_theta * cos_theta;
    let real = if cos_squared.less(N::from_f64(0.5)) == Truth::Yes {
        (n - one) * (n + one) - k * k + cos_squared
    } else {
        (n - k) * (n + k) - (one - cos_theta) * (one + cos_theta)
    };
    Complex::new(real, N::from_f64(2.0) * n * k)
}

/// |(a − b)/(a + b)|². Taken as a ratio of two squares, it is exactly 1 for real a and imaginary b, and for a = 0.
#[inline]
fn power_ratio<N: Num>(a: Complex<N>, b: Complex<N>) -> N {
    (a - b).norm_sqr() / (a + b).norm_sqr()
}

/// Through `f64`, because it must also be right where a comparison with a NaN says no.
#[inline]
fn is_zero<N: Num>(x: N) -> bool {
    x.to_f64() == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::num::Dd;

    #[test]
    fn exactly_one_past_the_critical_angle_and_at_grazing() {
        let one = Reflectance { s: 1.0, p: 1.0 };
        for eta in [0.1, 0.5, 1.0 / 1.5, 0.999] {
            let critical = critical_cos(eta).expect("eta is below 1");
            for share in [0.0, 0.1, 0.5, 0.9, 0.999] {
                assert_eq!(dielectric(eta, share * critical), one, "{eta} {share}");
            }
            assert!(dielectric(eta, 1.001 * critical).unpolarised() < 1.0);
        }
        for (n, k) in [
            (1.0, 1e-300),
            (1.5, 0.0),
            (0.2, 3.0),
            (0.0, 0.0),
            (1.0 + 1e-7, 0.0),
        ] {
            assert_eq!(conductor(n, k, 0.0), one, "{n} {k}");
        }
        assert_eq!(critical_cos(1.0), None);
    }

    #[test]
    fn nothing_is_reflected_between_equal_media() {
        for cos_theta in [0.0, 1e-300, 0.3, 1.0] {
            assert_eq!(dielectric(1.0, cos_theta).unpolarised(), 0.0);
            assert_eq!(
                dielectric(Dd::from(1.0), Dd::from(cos_theta)).s,
                Dd::from(0.0)
            );
        }
        assert!(dielectric(f64::NAN, 0.5).s.is_nan());
        assert!(conductor(1.0, f64::NAN, 0.5).s.is_nan());
    }

    #[test]
    fn nothing_is_reflected_at_brewsters_angle() {
        for eta in [0.4, 0.7, 1.33, 2.42, 50.0] {
            let eta = Dd::from(eta);
            assert!(dielectric(eta, brewster_cos(eta)).p.to_f64() < 1e-60);
        }
    }

    #[test]
    fn f64_agrees_with_double_double_away_from_the_critical_angle() {
        let mut worst: f64 = 0.0;
        for n in [1e-4, 0.3, 1.0 - 1e-7, 1.0, 1.0 + 1e-7, 1.5, 50.0] {
            for k in [0.0, 1e-300, 1e-7, 0.1, 3.0, 1000.0] {
                for cos_theta in [1e-8, 1e-5, 1e-3, 0.02, 0.2, 0.6, 0.9, 0.9999, 1.0] {
                    let w = normal_component(n, k, cos_theta).sqrt().modulus();
                    if w < 0.1 * cos_theta {
                        continue;
                    }
                    let exact = conductor(Dd::from(n), Dd::from(k), Dd::from(cos_theta));
                    let rounded = conductor(n, k, cos_theta);
                    let s_error = (exact.s - Dd::from(rounded.s)).abs().to_f64();
                    let p_error = (exact.p - Dd::from(rounded.p)).abs().to_f64();
                    worst = worst.max(s_error).max(p_error);
                }
            }
        }
        assert!(worst < 8.0 * f64::EPSILON, "worst {worst:e}");
    }

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
}
