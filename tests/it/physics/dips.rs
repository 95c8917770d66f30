//! Where reflectance falls before it rises to 1: metals, and dielectrics of a large index.
//!
//! Near normal incidence the terms of R_s and R_p in θ² cancel, and that of their mean in θ⁴ has the sign of `4 η - 1 - η²`. So F of a
//! dielectric falls first where η is above 2 + √3 = 3.732, or below 2 - √3, which is the same surface from within.

use proptest::prelude::*;

use super::function;
use super::random::config;
use crate::stated::{check_stated, stated};
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::physics::optics;

/// By how much the exact law of a dielectric falls below F0; 0 where it does not.
fn dip(eta: f64) -> f64 {
    let law = |c: f64| optics::dielectric(eta, c).unpolarised();
    below(law(1.0), cosines().map(law))
}

/// The same of the method that computes it.
fn dip_of_method(eta: f64) -> f64 {
    let arguments = [Value::each(cosines().collect()), Value::rgb([eta; 3])];
    let given = evaluate::<f64>(&function("dielectric_exact"), &arguments);
    let last = cosines().count() - 1;
    below(given.at(last)[0], (0..=last).map(|i| given.at(i)[0]))
}

fn cosines() -> impl Iterator<Item = f64> {
    (0..=20_000).map(|i| f64::from(i) / 20_000.0)
}

fn below(f0: f64, curve: impl Iterator<Item = f64>) -> f64 {
    curve.map(|f| f0 - f).fold(0.0, f64::max)
}

#[test]
fn a_dielectric_dips_from_an_index_of_two_and_the_root_of_three_on() {
    for eta in [1.5, 3.0, 3.7, 3.73] {
        for eta in [eta, 1.0 / eta] {
            assert!(dip(eta) < 1e-14 && dip_of_method(eta) < 1e-14, "{eta}");
        }
    }
    for (eta, least) in [(3.74, 2.3e-6), (3.8, 1.59e-4), (4.0, 2.22e-3)] {
        for eta in [eta, 1.0 / eta] {
            for found in [dip(eta), dip_of_method(eta)] {
                assert!((found / least - 1.0).abs() < 0.02, "{eta}: {found:e}");
            }
        }
    }
}

proptest! {
    #![proptest_config(config(200))]

    /// A smooth rise where the law falls first, or a dip where there is none; from outside and from within.
    #[test]
    fn a_dielectric_dips_where_its_index_is_large(eta in 1.0f64..12.0) {
        let least = 2.0 + 3.0_f64.sqrt();
        prop_assume!((eta - least).abs() > 0.005);
        for found in [eta, 1.0 / eta].map(dip) {
            prop_assert_eq!(found > 1e-8, eta > least, "eta {}: {:e}", eta, found);
            prop_assert!(!(1e-14..=1e-8).contains(&found), "eta {eta}: {found:e}");
        }
    }

    /// Light in the plane of incidence falls to 0 at Brewster's angle, whatever the index, and light across it never falls.
    #[test]
    fn p_falls_to_zero_and_s_rises(eta in 1.01f64..12.0) {
        for eta in [eta, 1.0 / eta] {
            let brewster = super::brewster_cos(eta);
            prop_assert!(optics::dielectric(eta, brewster).p < 1e-20, "{eta}");
            let at = |i: u32| optics::dielectric(eta, f64::from(i) / 1000.0);
            for (steeper, flatter) in (1..=1000).map(|i| (at(i), at(i - 1))) {
                prop_assert!(flatter.s >= steeper.s - 1e-14, "{eta}");
            }
        }
    }
}

/// The mean of three channels of metals falls to this at this angle in degrees, to two digits.
const LEAST: [(&str, f64, f64); 4] = [
    ("aluminium", 0.8726, 79.26),
    ("chromium", 0.5246, 71.02),
    ("copper", 0.6907, 50.06),
    ("platinum", 0.6039, 71.14),
];

/// Metals are darkest before grazing, which Schlick's approximation of the same F0 is not: it is never darker than F0.
#[test]
fn metals_are_darkest_before_grazing() {
    let names = LEAST.map(|(name, _, _)| name);
    for (subject, (name, least, degrees)) in crate::subjects(&names).iter().zip(LEAST) {
        assert_eq!(subject.name, name);
        let mean = |c: f64| subject.reference.at(c).iter().sum::<f64>() / 3.0;
        let at = (0..9000).map(|i| f64::from(i) / 100.0);
        let found = at.map(|degrees| (mean(optics::cosine(degrees)), degrees));
        let darkest = found.min_by(|a, b| a.0.total_cmp(&b.0)).expect("angles");
        let is_near = (darkest.0 - least).abs() < 6e-5 && (darkest.1 - degrees).abs() < 0.2;
        assert!(is_near, "{name}: {darkest:?}, not {least} at {degrees}");
        assert!(darkest.0 < mean(1.0) - 0.001, "{name}: {}", mean(1.0));
    }
}

/// The page of errors in pictures: Schlick's platinum is brighter than the law by so much at the most, and darker nowhere.
#[test]
fn schlicks_platinum_is_too_bright_by_what_the_page_says() {
    let platinum = &crate::subjects(&["platinum"])[0];
    let f0 = platinum.reference.at(1.0);
    let over = |i: u32| {
        let c = f64::from(i) / 1000.0;
        let law = platinum.reference.at(c);
        [0, 1, 2].map(|i| f0[i] + (1.0 - f0[i]) * (1.0 - c).powi(5) - law[i])
    };
    let all: Vec<f64> = (0..=1000).flat_map(over).collect();
    let most = all.iter().copied().fold(0.0, f64::max);
    assert!(all.iter().all(|over| *over > -1e-12));
    let figure = format!("{most:.2}").replacen("0.", ".", 1);
    check_stated(vec![stated(
        "docs/scene-error.md",
        "by up to\n",
        " of the light",
        figure,
    )]);
}
