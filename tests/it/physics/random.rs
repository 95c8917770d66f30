//! The laws over random inputs. A failure prints the inputs, shrunk; the seed is a constant.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::EXACT;
use super::run;
use super::run_in;
use fresnel_gen::language::ir::Checked;
use fresnel_gen::language::methods::{self, Contract, Input, Method};
use fresnel_gen::physics::num::ulp_distance;
use fresnel_gen::physics::optics;

/// Every library function, built once.
static FUNCTIONS: LazyLock<BTreeMap<&str, Checked>> = LazyLock::new(|| {
    let built = |method: &&'static Method| (method.name, super::function(method.name));
    methods::ALL.iter().map(built).collect()
});

/// The methods that keep the contract and take numbers only.
static KEPT: LazyLock<Vec<&'static Method>> = LazyLock::new(|| {
    let kept = |method: &&&Method| method.contract == Contract::Kept && !method.is_textured();
    methods::ALL.iter().filter(kept).copied().collect()
});

/// What unfused f32 may be off.
const ULP: f64 = 16.0;

pub fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn single(name: &str, cos_theta: f32, arguments: &[f32]) -> f32 {
    run(&FUNCTIONS[name], cos_theta, arguments)
}

fn double(name: &str, cos_theta: f64, arguments: &[f64]) -> f64 {
    run_in(&FUNCTIONS[name], cos_theta, arguments)
}

/// Even in the logarithm.
fn spread(low: f64, high: f64) -> impl Strategy<Value = f32> {
    (0.0..=1.0).prop_map(move |share| (low * libm::pow(high / low, share)) as f32)
}

/// Even, and dense at both ends.
fn cosine() -> impl Strategy<Value = f32> {
    let late = || (0.0f64..24.0).prop_map(|power| libm::exp2(-power) as f32);
    prop_oneof![
        3 => 0.0f32..=1.0,
        2 => late(),
        2 => late().prop_map(|less| 1.0 - less),
        1 => Just(0.0f32),
        1 => Just(1.0f32),
    ]
}

/// A value of an input between the ends of what it is tried with, from two shares in [0, 1]: the ends come often. Over several
/// powers of ten it is even in its logarithm.
fn value(input: &Input, share: f64, pick: f64) -> f32 {
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::MAX, f64::MIN), |(low, high), x| {
            (low.min(x), high.max(x))
        })
    };
    let (low, high) = ends(&mut input.tried.iter().copied());
    let positive = |x: &f64| *x > 1e-12;
    let (least, _) = ends(&mut input.tried.iter().copied().filter(positive));
    let inner = if low >= 0.0 && high > 1e3 * least {
        least * libm::pow(high / least, share)
    } else {
        low + (high - low) * share
    };
    (if pick < 0.1 {
        low
    } else if pick > 0.9 {
        1.0
    } else {
        inner
    }) as f32
}

/// n and k of anything, from glass to metal; seldom without absorption.
fn medium() -> impl Strategy<Value = (f32, f32)> {
    let k = prop_oneof![1 => Just(0.0f32), 4 => spread(1e-6, 13.0)];
    (spread(0.05, 12.0), k)
}

proptest! {
    #![proptest_config(config(20_000))]

    /// More light than came in, or less than none, within the domain of a method.
    #[test]
    fn reflectance_lies_between_zero_and_one(
        which in 0..KEPT.len(), shares in prop::array::uniform16((0.0..=1.0, 0.0..=1.0)), cos_theta in cosine(),
    ) {
        let method = KEPT[which];
        let given = method.inputs.iter().zip(shares);
        let arguments: Vec<f32> = given.map(|(input, (share, pick))| value(input, share, pick)).collect();
        let f0 = method.inputs.iter().position(|input| input.raises_limit);
        let most = f0.map_or(1.0, |place| arguments[place].max(1.0));
        let f = single(method.name, cos_theta, &arguments);
        prop_assert!((0.0..=most).contains(&f), "{}({cos_theta:e}, {arguments:?}) = {f:e}", method.name);
        let wide: Vec<f64> = arguments.iter().copied().map(f64::from).collect();
        let f = double(method.name, f64::from(cos_theta), &wide);
        prop_assert!((0.0..=f64::from(most)).contains(&f), "{} in f64: {f:e}", method.name);
    }
}

proptest! {
    #![proptest_config(config(2_000))]

    /// A curve that begins elsewhere than at the reflectance of a surface seen from above.
    #[test]
    fn at_normal_incidence_it_is_f0((n, k) in medium()) {
        let (wide_n, wide_k) = (f64::from(n), f64::from(k));
        let absorbing = optics::normal_incidence(wide_n, wide_k);
        let got = double("conductor_exact", 1.0, &[wide_n, wide_k]);
        // τ of a small n keeps its last digits to 1e-16 of 1, and n² is that much smaller.
        let near = 1e-15 * (1.0 + 1.0 / wide_n.powi(2));
        prop_assert!((got - absorbing).abs() <= near, "conductor_exact({n}, {k}): {got:e} {absorbing:e}");
        let clear = optics::normal_incidence(wide_n, 0.0);
        for name in ["dielectric_exact", "dielectric_exact_p", "dielectric_exact_s"] {
            let got = double(name, 1.0, &[wide_n]);
            prop_assert!((got - clear).abs() <= near, "{name}({n}): {got:e} {clear:e}");
        }
        if n >= 0.25 {
            let ulp = ulp_distance(single("conductor_exact", 1.0, &[n, k]), absorbing);
            prop_assert!(ulp <= ULP, "conductor_exact({n}, {k}): {ulp} ulp");
            let ulp = ulp_distance(single("dielectric_exact", 1.0, &[n]), clear);
            prop_assert!(ulp <= ULP, "dielectric_exact({n}): {ulp} ulp");
        }
    }

    /// A colour that an artist asked for and does not get.
    #[test]
    fn at_normal_incidence_it_is_the_f0_that_was_given(f0 in 0.0f32..=1.05, other in 0.0f32..=1.05) {
        for name in ["schlick", "schlick_f90", "f82_tint", "hoffman_f82"] {
            let f = single(name, 1.0, &[f0, other]);
            // Those that follow a second colour are limited to 1.
            let want = if name.contains("82") { f0.min(1.0) } else { f0 };
            prop_assert_eq!(f, want, "{}({}, {})", name, f0, other);
        }
        // An F82 above F0 means an index that nothing has.
        for (name, other) in [("conductor_artistic", other), ("conductor_from_f0_f82", 0.9 * f0.min(1.0) * other.min(1.0))] {
            let (f, want) = (single(name, 1.0, &[f0, other]), f0.min(0.999));
            prop_assert!((f - want).abs() < 2e-6, "{name}({f0}, {other}) = {f}");
        }
    }

    /// A dark seam along every silhouette.
    #[test]
    fn at_ninety_degrees_everything_is_reflected((n, k) in medium()) {
        for name in EXACT {
            let arguments = if name == "conductor_exact" { vec![n, k] } else { vec![n] };
            let wide: Vec<f64> = arguments.iter().copied().map(f64::from).collect();
            let matched = n == 1.0 && (k == 0.0 || arguments.len() == 1);
            prop_assert_eq!(single(name, 0.0, &arguments), if matched { 0.0 } else { 1.0 }, "{}", name);
            prop_assert_eq!(double(name, 0.0, &wide), if matched { 0.0 } else { 1.0 }, "{} in f64", name);
        }
    }

    /// A polarising filter that would not darken anything.
    #[test]
    fn brewsters_angle_has_no_p_reflection_whatever_the_index(eta in spread(0.25, 12.0)) {
        let brewster = super::brewster_cos(f64::from(eta));
        // Within something denser the angle lies beside the critical one.
        let steep = 1.0 + f64::from(eta).powi(-4);
        let f = double("dielectric_exact_p", brewster, &[f64::from(eta)]);
        prop_assert!(f < 1e-28 * steep, "eta {eta}: {f:e} in f64");
        let f = single("dielectric_exact_p", brewster as f32, &[eta]);
        prop_assert!(f64::from(f) < 1e-12 * steep, "eta {eta}: {f:e}");
    }

    /// Glass that is brighter from within than from without: energy out of nothing, or lost.
    #[test]
    fn both_sides_of_any_surface_reflect_alike(eta in spread(1.0001, 12.0), cos_theta in spread(1e-6, 1.0)) {
        let (eta, outside) = (f64::from(eta), f64::from(cos_theta));
        let sine2 = (1.0 - outside) * (1.0 + outside) / (eta * eta);
        let inside = (1.0 - sine2).sqrt();
        // Within, grazing light lies at the critical angle, where the root of a rounding remains.
        let near = 1e-13 + 1e-15 * eta.powi(3) / (outside * inside);
        for name in ["dielectric_exact", "dielectric_exact_p", "dielectric_exact_s"] {
            let [without, within] = [double(name, outside, &[eta]), double(name, inside, &[1.0 / eta])];
            prop_assert!((without - within).abs() <= near, "{name}({eta}, {outside}): {without:e} {within:e}");
        }
    }

    /// A seam where an absorbing material fades into a clear one.
    #[test]
    fn as_k_vanishes_the_conductor_becomes_the_dielectric(
        n in spread(1.05, 12.0), k in spread(1e-9, 1e-3), cos_theta in cosine(),
    ) {
        let (wide, c) = (f64::from(n), f64::from(cos_theta));
        let clear = double("dielectric_exact", c, &[wide]);
        // |r(n + ik)|² has no first power of k while r(n) is real.
        let w2 = (wide - 1.0) * (wide + 1.0) + c * c;
        let most = 10.0 * (wide * f64::from(k) / w2).powi(2) + 1e-14;
        let absorbing = double("conductor_exact", c, &[wide, f64::from(k)]);
        prop_assert!((absorbing - clear).abs() <= most, "n {n}, k {k:e}, cos {c}: {absorbing:e} {clear:e}");
        let (clear, absorbing) = (single("dielectric_exact", cos_theta, &[n]), single("conductor_exact", cos_theta, &[n, k]));
        let apart = f64::from((absorbing - clear).abs());
        prop_assert!(apart <= most + 1e-6, "n {n}, k {k:e}, cos {c}: {absorbing} {clear}");
    }

    /// The same within something denser, where total reflection is frustrated by the root of k at the most.
    #[test]
    fn as_k_vanishes_total_reflection_becomes_total(
        n in spread(0.25, 0.999), k in spread(1e-9, 1e-3), cos_theta in cosine(),
    ) {
        let (wide, c) = (f64::from(n), f64::from(cos_theta));
        let critical = super::critical_cos(wide).unwrap_or(1.0);
        let most = 10.0 * (2.0 * wide * f64::from(k)).sqrt() / (wide * wide * critical);
        let clear = double("dielectric_exact", c, &[wide]);
        let absorbing = double("conductor_exact", c, &[wide, f64::from(k)]);
        prop_assert!((absorbing - clear).abs() <= most, "n {n}, k {k:e}, cos {c}: {absorbing:e} {clear:e}");
    }

    /// A metal that becomes duller the more it absorbs.
    #[test]
    fn absorption_makes_a_surface_brighter_from_above(n in spread(0.05, 12.0), k in spread(1e-6, 12.0), more in spread(1e-3, 1.0)) {
        let wide = f64::from(n);
        let [less_k, more_k] = [f64::from(k), f64::from(k) * (1.0 + f64::from(more))];
        let [less, greater] = [less_k, more_k].map(|k| double("conductor_exact", 1.0, &[wide, k]));
        prop_assert!(greater >= less - 1e-14 / wide, "n {n}, k {less_k} to {more_k}: {less:e} {greater:e}");
        if k > 0.01 {
            prop_assert!(greater > less, "n {n}, k {less_k} to {more_k}: {less:e} {greater:e}");
        }
        let [less, greater] = [k, more_k as f32].map(|k| single("conductor_exact", 1.0, &[n, k]));
        let digits = 1e-6 * (1.0 + 1.0 / n);
        prop_assert!(greater >= less - digits, "n {n}, k {less_k} to {more_k}: {less} {greater}");
    }
}
