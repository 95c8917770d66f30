//! The exact law at its limits, and against double-double.

use super::{brewster_cos, critical_cos};
use crate::numbers::Dd;
use fresnel_gen::physics::num::{Complex, Num};
use fresnel_gen::physics::optics::{Reflectance, conductor, dielectric};

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
                let square = (n - 1.0) * (n + 1.0) - k * k + cos_theta * cos_theta;
                let w = Complex::new(square, 2.0 * n * k).sqrt().modulus();
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
