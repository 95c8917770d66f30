//! Physical laws, for all methods that promise them, over media on both sides of 1 and all angles, in f32 as shaders
//! compute: bounds, limits, Brewster's zero, total reflection, reciprocity, k → 0. Here over grids of hard values, in
//! `random` over random ones.

mod catalogue;
mod dips;
pub mod films;
mod law;
mod random;

use fresnel_gen::generator::fit::texels;
use fresnel_gen::language::ir::{Checked, Ty, Value, evaluate};
use fresnel_gen::language::methods::{self, Class, Contract, Method};
use fresnel_gen::physics::num::{Num, Truth};
use fresnel_gen::physics::optics;

const EXACT: [&str; 4] = [
    "conductor_exact",
    "dielectric_exact",
    "dielectric_exact_p",
    "dielectric_exact_s",
];

/// The cosine of Brewster's angle, where R_p = 0 and tan θ = η: 1/√(1 + η²).
pub fn brewster_cos<N: Num>(eta: N) -> N {
    (N::from_f64(1.0) + eta * eta).inverse_sqrt()
}

/// The cosine of the critical angle, where sin θ = η: √(1 − η²). None for η ≥ 1.
pub fn critical_cos<N: Num>(eta: N) -> Option<N> {
    let one = N::from_f64(1.0);
    (eta.less(one) == Truth::Yes).then(|| ((one - eta) * (one + eta)).sqrt())
}

fn cosines() -> Vec<f32> {
    let even = (0..=512).map(|i| i as f32 / 512.0);
    let late = (1..=30).map(|i| f32::powi(0.5, i));
    even.chain(late.clone())
        .chain(late.map(|x| 1.0 - x))
        .collect()
}

/// Runs a library function in f32 on one cosine and channel-wise equal arguments.
pub fn run(function: &Checked, cos_theta: f32, arguments: &[f32]) -> f32 {
    let wide: Vec<f64> = arguments.iter().copied().map(f64::from).collect();
    run_in(function, cos_theta, &wide)
}

/// The same in any kind of number.
pub fn run_in<N: Num>(function: &Checked, cos_theta: N, arguments: &[f64]) -> N {
    let mut values = vec![Value::each(vec![cos_theta])];
    for (param, argument) in function.params.iter().skip(1).zip(arguments) {
        let wide = *argument;
        values.push(match param.ty {
            Ty::Vec3 => Value::rgb([wide; 3]),
            Ty::Texture => Value::Texture(Some(texels(|c| {
                [optics::conductor(1.5, 0.0, c).unpolarised(); 3]
            }))),
            _ => Value::scalar(wide),
        });
    }
    evaluate(function, &values).at(0)[0]
}

/// A library function.
pub fn function(name: &str) -> Checked {
    methods::find(name)
        .expect("it is there")
        .function(false)
        .expect("it is well formed")
}

/// Arguments for a method from a few hard values of each input, in all combinations.
fn arguments(method: &Method) -> Vec<Vec<f32>> {
    method.inputs.iter().fold(vec![Vec::new()], |all, input| {
        all.iter()
            .flat_map(|row| {
                input
                    .tried
                    .iter()
                    .map(move |value| [row.as_slice(), &[*value as f32]].concat())
            })
            .collect()
    })
}

#[test]
fn reflectance_lies_between_zero_and_one_whatever_comes_in() {
    let wild = [
        f32::NEG_INFINITY,
        -1.0,
        -1e-41,
        1.000_000_1,
        2.0,
        f32::INFINITY,
        f32::NAN,
    ];
    for method in methods::ALL
        .iter()
        .filter(|method| method.contract == Contract::Kept)
    {
        let function = method.function(false).expect("it is well formed");
        let takes = |name: &str| method.inputs.iter().position(|input| input.name == name);
        for arguments in arguments(method) {
            let most = takes("f0").map_or(1.0, |i| arguments[i].max(1.0));
            for cos_theta in cosines().into_iter().chain(wild) {
                let f = run(&function, cos_theta, &arguments);
                assert!(
                    (0.0..=most).contains(&f),
                    "{}({cos_theta:e}, {arguments:?}) = {f:e}",
                    method.name
                );
            }
        }
    }
}

#[test]
fn at_ninety_degrees_exact_results_are_exactly_one_or_exactly_zero() {
    for name in EXACT {
        let method = methods::find(name).expect("it is there");
        for arguments in arguments(method) {
            let matched = arguments[0] == 1.0 && arguments.get(1).is_none_or(|k| *k == 0.0);
            let got = run(&function(name), 0.0, &arguments);
            // An extinction that vanishes beside 1 in f32 squared is none: both answers are within rounding of it.
            let vanishing =
                arguments[0] == 1.0 && arguments.get(1).is_some_and(|k| *k > 0.0 && *k < 1e-15);
            assert!(
                got == if matched { 0.0 } else { 1.0 } || vanishing,
                "{name}(0, {arguments:?}) = {got}"
            );
        }
    }
}

#[test]
fn past_the_critical_angle_everything_is_reflected() {
    for eta in [0.05f32, 0.5, 0.7, 0.99] {
        let critical = critical_cos(f64::from(eta)).expect("eta is below 1") as f32;
        for cos_theta in cosines().into_iter().filter(|c| *c < critical * 0.999_999) {
            for name in [
                "dielectric_exact",
                "dielectric_exact_s",
                "dielectric_exact_p",
            ] {
                assert_eq!(
                    run(&function(name), cos_theta, &[eta]),
                    1.0,
                    "{name}({cos_theta}, {eta})"
                );
            }
            assert_eq!(
                run(&function("conductor_exact"), cos_theta, &[eta, 0.0]),
                1.0,
                "conductor ({cos_theta}, {eta})"
            );
        }
    }
}

#[test]
fn brewsters_angle_has_no_p_reflection() {
    for eta in [0.5f32, 1.2, 1.5, 2.4] {
        let brewster = brewster_cos(f64::from(eta)) as f32;
        let f = run(&function("dielectric_exact_p"), brewster, &[eta]);
        assert!(f < 1e-12, "eta {eta}: {f:e}");
    }
}

#[test]
fn both_sides_of_a_surface_reflect_alike() {
    for eta in [1.1f32, 1.5, 2.4] {
        for cos_theta in cosines() {
            let sin2_t = (1.0 - f64::from(cos_theta).powi(2)) / f64::from(eta).powi(2);
            let inside = (1.0 - sin2_t).sqrt();
            let from_outside = f64::from(run(&function("dielectric_exact"), cos_theta, &[eta]));
            let from_inside = optics::dielectric(1.0 / f64::from(eta), inside).unpolarised();
            assert!(
                (from_outside - from_inside).abs() < 1e-6,
                "eta {eta}, cos {cos_theta}"
            );
        }
    }
}

#[test]
fn polarisations_average_to_the_unpolarised() {
    for eta in [0.6f64, 1.0001, 1.5, 2.4] {
        for cos_theta in cosines().into_iter().map(f64::from) {
            let value = |name: &str| {
                let values = [Value::<f64>::scalar(cos_theta), Value::rgb([eta; 3])];
                evaluate(&function(name), &values).at(0)[0]
            };
            let reference = optics::dielectric(eta, cos_theta);
            assert!(
                (value("dielectric_exact_s") - reference.s).abs() < 1e-7,
                "s, eta {eta}, cos {cos_theta}"
            );
            assert!(
                (value("dielectric_exact_p") - reference.p).abs() < 1e-7,
                "p, eta {eta}, cos {cos_theta}"
            );
            assert!(
                (value("dielectric_exact") - reference.unpolarised()).abs() < 1e-7,
                "eta {eta}, cos {cos_theta}"
            );
        }
    }
}

#[test]
fn a_conductor_without_absorption_is_the_dielectric() {
    for eta in [0.6f32, 1.0001, 1.5, 2.4] {
        for (cos_theta, k) in cosines()
            .into_iter()
            .flat_map(|c| [0.0f32, 1e-41, 1e-12].map(|k| (c, k)))
        {
            let dielectric = run(&function("dielectric_exact"), cos_theta, &[eta]);
            let conductor = run(&function("conductor_exact"), cos_theta, &[eta, k]);
            let critical = critical_cos(f64::from(eta)).unwrap_or(-1.0);
            // The law itself is ill-conditioned around the critical angle.
            let tolerance = if (f64::from(cos_theta) - critical).abs() < 1e-2 {
                2e-2
            } else {
                2e-6
            };
            assert!(
                (dielectric - conductor).abs() < tolerance,
                "eta {eta}, k {k:e}, cos {cos_theta}: {dielectric} {conductor}"
            );
        }
    }
}

#[test]
fn dielectric_methods_say_the_same_in_both_forms() {
    for method in methods::ALL
        .iter()
        .filter(|method| method.has_scalar_form())
    {
        let (colour, scalar) = (
            method.function(false).expect("good"),
            method.function(true).expect("good"),
        );
        assert_ne!(method.class, Class::Metal);
        for arguments in arguments(method) {
            for cos_theta in [0.0, 0.1, 0.5, 1.0] {
                let (a, b) = (
                    run(&colour, cos_theta, &arguments),
                    run(&scalar, cos_theta, &arguments),
                );
                assert!(
                    a == b || a.is_nan() && b.is_nan(),
                    "{}({cos_theta}, {arguments:?})",
                    method.name
                );
            }
        }
    }
}
