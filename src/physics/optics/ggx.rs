//! The directional albedo of a rough surface: the integral of GGX with height-correlated Smith masking over all directions of
//! light, as a sum over half vectors, so that any reflectance can be used in it.
//!
//! ```text
//! E(F) = ∫ F(h·v) D(h) G2(v, l) / (4 (n·v) (n·l)) (n·l) dl = ∫ F(h·v) G2(v, l) / G1(v) D_v(h) dh
//! D(h) = α² / (π ((n·h)² (α² - 1) + 1)²),  D_v(h) = G1(v) max(0, h·v) D(h) / (n·v),  l = 2 (h·v) h - v
//! G1(v) = 1 / (1 + Λ(v)),  G2(v, l) = 1 / (1 + Λ(v) + Λ(l)),  Λ(v) = (√(1 + α² tan² θ_v) - 1) / 2
//! ```
//!
//! Source: D of Walter, Marschner, Li and Torrance, "Microfacet Models for Refraction through Rough Surfaces", EGSR, 2007,
//! <https://doi.org/10.2312/EGWR/EGSR07/195-206>; G2, eq. (99), and D_v of Heitz, "Understanding the Masking-Shadowing Function in
//! Microfacet-Based BRDFs", JCGT 3(2), 2014, <https://jcgt.org/published/0003/02/03/>. Dupuy and Benyoub, "Sampling Visible GGX
//! Normals with Spherical Caps", 2023, <https://arxiv.org/abs/2306.05044>, map D_v to equal areas of a cap: v stretched to
//! v' = (α v_x, α v_y, v_z) of unit length, a direction c on the sphere with c_z > -v'_z, and h = (α (c + v')_xy, (c + v')_z) of unit
//! length. Here c has polar angle t from the normal and azimuth φ from v.
//!
//! Directions l below the surface contribute nothing. So each circle t is reduced to an arc, whose end has a closed form, as have
//! the two t at which arcs begin and end. Between those the integrand is smooth, and Gauss-Legendre quadrature converges quickly.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::physics::num::Legendre;

/// The quadrature rule of the integral.
#[derive(Clone, Debug)]
pub struct Ggx {
    polar: Legendre,
    azimuth: Legendre,
}

impl Default for Ggx {
    /// A rule with errors within 2e-5 at every angle and roughness, for reflectances as steep as (1 - h·v)¹⁴.
    fn default() -> Ggx {
        Ggx::new(24, 16)
    }
}

impl Ggx {
    /// A rule of `polar` circles in each of two pieces, and `azimuth` points on each circle's arc.
    pub fn new(polar: usize, azimuth: usize) -> Ggx {
        Ggx {
            polar: Legendre::new(polar),
            azimuth: Legendre::new(azimuth),
        }
    }

    /// Calls `take` with h·v, in [0, 1], and its weight for each point of the rule: E(F) is the sum of weight times F(h·v).
    /// `cos_v` is n·v in [0, 1]; α is in [0, 1], and 0 is a mirror.
    pub fn each(&self, cos_v: f64, alpha: f64, mut take: impl FnMut(f64, f64)) {
        self.each_lit(cos_v, alpha, |cos_h, _, weight| take(cos_h, weight));
    }

    /// The same with n·l, which is in [0, 1] too, as a second argument before the weight.
    pub fn each_lit(&self, cos_v: f64, alpha: f64, mut take: impl FnMut(f64, f64, f64)) {
        if alpha == 0.0 {
            return take(cos_v, cos_v, 1.0);
        }
        let view = Viewer::new(cos_v, alpha);
        let [first, last] = view.breaks();
        for (from, to) in [(0.0, first), (first, last)] {
            for (x, weight) in self.polar.over(0.0, 1.0).filter(|_| to > from) {
                // Points are denser at both ends, where arcs open and close like a square root.
                let t = from + (to - from) * x * x * (3.0 - 2.0 * x);
                let slope = 6.0 * x * (1.0 - x) * (to - from);
                self.circle(&view, t, weight * slope, &mut take);
            }
        }
    }

    /// The points on the arc of one circle.
    fn circle(&self, view: &Viewer, t: f64, weight: f64, take: &mut impl FnMut(f64, f64, f64)) {
        let circle = (libm::sin(t), libm::cos(t));
        let Some((from, to)) = view.arc(circle) else {
            return;
        };
        // Both halves of a circle are alike, so π of azimuth counts for 2 π. The cap's area is 2 π (1 + v'_z).
        let share = weight * circle.0 / (PI * (1.0 + view.up));
        for (azimuth, part) in self.azimuth.over(from, to) {
            let (cos_h, light, shadowing) = view.seen(circle, azimuth);
            let cosines = [cos_h, light].map(|c| c.clamp(0.0, 1.0));
            take(cosines[0], cosines[1], share * part * shadowing);
        }
    }
}

/// The viewer: v = (s, 0, c), and v' = (along, 0, up).
struct Viewer {
    alpha: f64,
    s: f64,
    c: f64,
    along: f64,
    up: f64,
}

impl Viewer {
    fn new(c: f64, alpha: f64) -> Viewer {
        let s = (1.0 - c * c).max(0.0).sqrt();
        let length = (alpha * alpha * s * s + c * c).sqrt();
        Viewer {
            alpha,
            s,
            c,
            along: alpha * s / length,
            up: c / length,
        }
    }

    /// The polar angles at which circles begin to dip below the horizon, and at which nothing of them is left above it. In the
    /// plane of incidence, l lies on the horizon when h bisects it and v, and v' + c bisects v' and c.
    fn breaks(&self) -> [f64; 2] {
        let (angle, stretched) = (
            libm::atan2(self.s, self.c),
            libm::atan2(self.along, self.up),
        );
        let half = |horizon: f64| libm::atan(libm::tan(0.5 * (angle + horizon)) / self.alpha);
        let ahead = 2.0 * half(FRAC_PI_2) - stretched;
        let behind = stretched - 2.0 * half(-FRAC_PI_2);
        let end = libm::acos(-self.up);
        [ahead.min(behind), ahead.max(behind)].map(|t| t.clamp(0.0, end))
    }

    /// The azimuths of a circle, from 0 to π, for which l lies above the surface: n·l is a positive number times `a + b cos φ`.
    fn arc(&self, (sin_t, cos_t): (f64, f64)) -> Option<(f64, f64)> {
        let (alpha, up) = (self.alpha, cos_t + self.up);
        let b = 2.0 * alpha * sin_t * (self.s * up - self.c * alpha * self.along);
        let flat = sin_t * sin_t + self.along * self.along;
        let a = 2.0 * (self.s * alpha * self.along + self.c * up) * up
            - self.c * (alpha * alpha * flat + up * up);
        if a >= b.abs() {
            Some((0.0, PI))
        } else if a <= -b.abs() {
            None
        } else if b > 0.0 {
            Some((0.0, libm::acos(-a / b)))
        } else {
            Some((libm::acos(-a / b), PI))
        }
    }

    /// h·v, n·l and G2/G1.
    fn seen(&self, (sin_t, cos_t): (f64, f64), azimuth: f64) -> (f64, f64, f64) {
        let (sin_a, cos_a) = libm::sincos(azimuth);
        let along = self.alpha * (sin_t * cos_a + self.along);
        let across = self.alpha * sin_t * sin_a;
        let up = cos_t + self.up;
        let length = (along * along + across * across + up * up).sqrt();
        let cos_h = (self.s * along + self.c * up) / length;
        let light = 2.0 * cos_h * up / length - self.c;
        (cos_h, light, self.shadowing(light))
    }

    /// G2/G1 = (1 + Λ(v)) / (1 + Λ(v) + Λ(l)), each Λ multiplied by its cosine, which may be 0.
    fn shadowing(&self, light: f64) -> f64 {
        if light <= 0.0 {
            return 0.0;
        }
        let squared = self.alpha * self.alpha;
        let root = |c: f64| (c * c + squared * (1.0 - c * c).max(0.0)).sqrt();
        let viewer = light * (self.c + root(self.c));
        viewer / (viewer + self.c * (root(light) - light))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(rule: &Ggx, cos_v: f64, alpha: f64, f: impl Fn(f64) -> f64) -> f64 {
        let mut sum = 0.0;
        rule.each(cos_v, alpha, |cos_h, weight| sum += weight * f(cos_h));
        sum
    }

    /// With α = 1 and v = n: D is 1/π, l = 2 (n·h)² - 1, G2 = 2 l/(1 + l), and ∫ G2 dl/2 = 1 - ln 2.
    #[test]
    fn it_is_what_can_be_integrated_by_hand() {
        let got = integral(&Ggx::default(), 1.0, 1.0, |_| 1.0);
        assert!((got - (1.0 - std::f64::consts::LN_2)).abs() < 1e-7, "{got}");
        assert_eq!(integral(&Ggx::default(), 0.3, 0.0, |c| c), 0.3);
        // At 90 degrees nothing is lost: all l lie above the surface, and G2/G1 is 1.
        for alpha in [1e-6, 0.0025, 0.3, 1.0] {
            let got = integral(&Ggx::default(), 0.0, alpha, |_| 1.0);
            assert!((got - 1.0).abs() < 1e-5, "{alpha}: {got}");
        }
    }

    #[test]
    fn the_usual_rule_is_as_near_as_it_says() {
        let (usual, fine) = (Ggx::default(), Ggx::new(96, 64));
        for i in 0..=20 {
            for alpha in [1e-6, 0.0025, 0.01, 0.04, 0.16, 0.5, 1.0] {
                let cos_v = (f64::from(i) / 20.0).powi(4);
                for power in [0, 1, 7, 14] {
                    let of = |rule| integral(rule, cos_v, alpha, |c| (1.0 - c).powi(power));
                    let (got, want) = (of(&usual), of(&fine));
                    let where_ = (cos_v, alpha, power);
                    assert!((got - want).abs() < 2e-5, "{where_:?}: {got} {want}");
                    assert!(got <= 1.0 + 2e-5, "{where_:?}: {got}");
                }
            }
        }
    }

    /// The definition, over half vectors distributed by D: tan² θ_h = α² u / (1 - u) for u uniform in [0, 1].
    fn by_definition(cos_v: f64, alpha: f64, f: impl Fn(f64) -> f64) -> f64 {
        const STEPS: (usize, usize) = (3000, 600);
        let lambda = |c: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - c * c) / (c * c)).sqrt() - 1.0);
        let sin_v = (1.0 - cos_v * cos_v).sqrt();
        let mut sum = 0.0;
        for i in 0..STEPS.0 {
            let u = (i as f64 + 0.5) / STEPS.0 as f64;
            let up = 1.0 / (1.0 + alpha * alpha * u / (1.0 - u)).sqrt();
            for j in 0..STEPS.1 {
                let azimuth = PI * (j as f64 + 0.5) / STEPS.1 as f64;
                let cos_h = sin_v * (1.0 - up * up).sqrt() * azimuth.cos() + cos_v * up;
                let light = 2.0 * cos_h * up - cos_v;
                if cos_h > 0.0 && light > 0.0 {
                    let g2 = 1.0 / (1.0 + lambda(cos_v) + lambda(light));
                    sum += f(cos_h) * g2 * cos_h / (cos_v * up);
                }
            }
        }
        sum / (STEPS.0 * STEPS.1) as f64
    }

    #[test]
    fn it_is_the_integral_of_its_definition() {
        for (cos_v, alpha) in [
            (1.0, 0.04),
            (0.9, 1.0),
            (0.5, 0.25),
            (0.1, 0.01),
            (0.02, 0.5),
        ] {
            let f = |c: f64| 0.1 + 0.9 * (1.0 - c).powi(5);
            let want = by_definition(cos_v, alpha, f);
            let got = integral(&Ggx::default(), cos_v, alpha, f);
            // This number of steps errs by 1.3e-4 at worst, eight times as many by 8e-6.
            assert!((got - want).abs() < 2e-4, "{cos_v} {alpha}: {got} {want}");
        }
    }
}
