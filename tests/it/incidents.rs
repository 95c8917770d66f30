//! What went wrong elsewhere: each test writes out a formula as it was published or shipped, shows its fault, and
//! shows that ours has none at the same inputs. Textbook methods are left out: they have these faults, and say so.
//!
//! Not here, because they are no faults of a Fresnel formula: the NaN of smooth metals in half precision in Godot
//! (godotengine/godot #110207, roughness 0), a² of GGX below the smallest half (mrdoob/three.js #8349).

use crate::physics::{function, run};
use fresnel_gen::physics::num::{Half, Num};
use fresnel_gen::physics::optics;

/// Our library function in unfused f32.
fn ours(method: &str, cos_theta: f32, arguments: &[f32]) -> f32 {
    run(&function(method), cos_theta, arguments)
}

#[track_caller]
fn near(got: f32, want: f32, within: f32) {
    assert!((got - want).abs() <= within, "{got}, expected {want}");
}

/// `pow` as GPUs compute it.
fn pow(x: f32, y: f32) -> f32 {
    libm::exp2f(y * libm::log2f(x))
}

/// Schlick's approximation with `pow`, as nearly everyone writes it.
fn schlick(f0: f32, v_dot_h: f32) -> f32 {
    f0 + (1.0 - f0) * pow(1.0 - v_dot_h, 5.0)
}

/// The power as Karis and Lagarde's Gaussian.
fn gaussian(f0: f32, c: f32) -> f32 {
    f0 + (1.0 - f0) * libm::exp2f((-5.55473 * c - 6.98316) * c)
}

/// The g-form of Cook and Torrance as printed.
fn g_form(eta: f32, c: f32) -> f32 {
    let g = (eta * eta - 1.0 + c * c).sqrt();
    let (s, p) = ((g - c) / (g + c), (c * (g + c) - 1.0) / (c * (g - c) + 1.0));
    0.5 * s * s * (1.0 + p * p)
}

/// Reflectance at normal incidence from n and k².
fn facing(n: f32, k2: f32) -> f32 {
    ((n - 1.0) * (n - 1.0) + k2) / ((n + 1.0) * (n + 1.0) + k2)
}

/// LYGIA, `schlick(vec3 f0, float f90, float VoH)`, before that Filament (google/filament #1029): F0 where the weight of
/// grazing light belongs, so that half of F0 is lost and grazing incidence reflects too much.
#[test]
fn lygia_mixed_up_f0_and_the_weight() {
    let published = |f0: f32, f90: f32, c: f32| {
        let weight = pow(1.0 - c, 5.0);
        weight + f0 * (f90 - weight)
    };
    near(published(0.01, 0.495, 1.0), 0.00495, 1e-6);
    near(published(0.01, 0.495, 0.0), 0.995, 1e-3);
    assert_eq!(ours("schlick_f90", 1.0, &[0.01, 0.495]), 0.01);
    near(ours("schlick_f90", 0.0, &[0.01, 0.495]), 0.495, 1e-7);
}

/// MaterialX, a thin film over Schlick (its PR #2892 saw the darkness): each polarisation gets half of F, and their sum is
/// halved again, so that a film that is not there halves the reflectance. We have no thin film; what one is made of is
/// tried: an interface that is not there, polarisations whose mean is the whole, and the sum over the film.
#[test]
fn materialx_halved_what_lies_below_a_film_that_is_not_there() {
    let airy = |above: f32, below: f32| {
        let through = 1.0 - above;
        above + through * through * below / (1.0 - above * below)
    };
    let f = schlick(0.8, 0.999_999);
    let each = airy(0.0, 0.5 * f);
    near(0.5 * (each + each), 0.4, 1e-5);
    for c in [0.0f32, 0.01, 0.3, 0.7, 1.0] {
        let film = ours("dielectric_exact", c, &[1.0]);
        assert_eq!(film, 0.0, "at {c}");
        let [s, p, whole] = [
            "dielectric_exact_s",
            "dielectric_exact_p",
            "dielectric_exact",
        ]
        .map(|method| airy(film, ours(method, c, &[1.5])));
        near(0.5 * (s + p), whole, 2e-7);
        assert_eq!(whole, ours("dielectric_exact", c, &[1.5]), "at {c}");
    }
}

/// MaterialX, the formula for conductors that its PR #843 dropped and its OSL kept, Cycles and pbrt-v2 before: wrong as k
/// tends to 0, by .099 for glass at 79 degrees.
#[test]
fn the_old_formula_for_conductors_is_wrong_without_absorption() {
    let published = |n: f32, k: f32, c: f32| {
        let (m2, nc) = (n * n + k * k, 2.0 * n * c);
        let p2 = (m2 * c * c - nc + 1.0) / (m2 * c * c + nc + 1.0);
        let s2 = (m2 - nc + c * c) / (m2 + nc + c * c);
        0.5 * (p2 + s2)
    };
    let c = optics::cosine(79.0) as f32;
    let law = optics::dielectric(1.5, f64::from(c)).unpolarised() as f32;
    near((published(1.5, 0.0, c) - law).abs(), 0.099, 2e-3);
    near(ours("conductor_exact", c, &[1.5, 0.0]), law, 1e-7);
    near(ours("conductor_exact", c, &[1.5, 1e-20]), law, 1e-7);
}

/// OpenPBR #256: the F82-tint model turns negative for tints below .52, to -.127.
#[test]
fn the_tint_of_adobe_turns_reflectance_negative() {
    let published = |f0: f32, tint: f32, c: f32| {
        let at_82 = f0 + (1.0 - f0) * pow(6.0 / 7.0, 5.0);
        let b = at_82 * (1.0 - tint) / (1.0 / 7.0 * pow(6.0 / 7.0, 6.0));
        f0 + (1.0 - f0) * pow(1.0 - c, 5.0) - b * c * pow(1.0 - c, 6.0)
    };
    assert!(published(0.0, 0.0, 0.2) < -0.09);
    assert_eq!(ours("f82_tint", 0.2, &[0.0, 0.0]), 0.0);
    near(
        ours("f82_tint", 0.2, &[0.6, 0.8]),
        published(0.6, 0.8, 0.2),
        1e-6,
    );
}

/// Unity, `GetIorN` and `getIorK2` (Gulbrandsen's pair): the edge tint runs the other way, and k² takes (f0 - 1)² for
/// (n - 1)², so that a facing mirror of .9 reflects .981 and one of .5 reflects .624.
#[test]
fn unity_took_another_index_from_gulbrandsens_pair() {
    let published = |f0: f32, edge: f32| {
        let (least, root) = ((1.0 - f0) / (1.0 + f0), f0.sqrt());
        let n = least + ((1.0 + root) / (1.0 - root) - least) * edge;
        let k2 = ((n + 1.0) * (n + 1.0) * f0 - (f0 - 1.0) * (f0 - 1.0)) / (1.0 - f0);
        facing(n, k2)
    };
    near(published(0.9, 0.0), 0.981, 1e-3);
    near(published(0.5, 0.5), 0.624, 1e-3);
    for edge in [0.0, 0.5, 1.0] {
        near(ours("conductor_artistic", 1.0, &[0.9, edge]), 0.9, 1e-6);
        near(ours("conductor_artistic", 1.0, &[0.5, edge]), 0.5, 1e-6);
    }
    // 0 is the most that n can be: without absorption, as the paper has it.
    let glass = optics::dielectric(1.5, 0.2).unpolarised() as f32;
    near(ours("conductor_artistic", 0.2, &[0.04, 0.0]), glass, 1e-6);
}

/// Unity, `F_FresnelDielectric`: past the critical angle its root is a NaN, and `1 - saturate(1 - F)` is to make 1 of it.
/// That holds where `saturate` makes 0 of a NaN, as in HLSL; GLSL, WGSL and fast arithmetic in MSL promise nothing.
#[test]
fn unity_relies_on_a_saturated_nan() {
    let passed_on = |x: f32| if x.is_nan() { x } else { x.clamp(0.0, 1.0) };
    let published = |eta, c, saturate: fn(f32) -> f32| 1.0 - saturate(1.0 - g_form(eta, c));
    assert_eq!(published(0.7, 0.5, Num::saturate), 1.0, "in HLSL");
    assert!(published(0.7, 0.5, passed_on).is_nan(), "elsewhere");
    for method in [
        "dielectric_exact",
        "dielectric_exact_s",
        "dielectric_exact_p",
    ] {
        assert_eq!(ours(method, 0.5, &[0.7]), 1.0);
    }
    assert_eq!(ours("conductor_exact", 0.5, &[0.7, 0.0]), 1.0);
}

/// Index-matched media at 90 degrees: a NaN in MaterialX and Falcor, 1 in pbrt and Cycles, 0 in Mitsuba and Adobe.
/// Bevy's reflections that remain at an index of 1 (bevyengine/bevy #24552) are the same edge. It is 0 here: nothing is there.
#[test]
fn an_interface_that_is_not_there_was_a_nan_at_ninety_degrees() {
    let pbrt = |eta: f32, c: f32| {
        let sine2 = (1.0 - c * c) / (eta * eta);
        if sine2 >= 1.0 { 1.0 } else { g_form(eta, c) }
    };
    assert!(g_form(1.0, 0.0).is_nan());
    assert_eq!(pbrt(1.0, 0.0), 1.0);
    for c in [0.0, 1e-41, 1e-20, 0.5, 1.0] {
        for method in [
            "dielectric_exact",
            "dielectric_exact_s",
            "dielectric_exact_p",
        ] {
            assert_eq!(ours(method, c, &[1.0]), 0.0, "{method} at {c}");
        }
        assert_eq!(ours("conductor_exact", c, &[1.0, 0.0]), 0.0, "at {c}");
    }
}

/// Falcor #378: the function turned eta over on the far side, and so did its caller: twice is not at all, and total
/// reflection is lost. Ours never turns it over; a cosine below 0 counts as 90 degrees.
#[test]
fn falcor_turned_the_index_over_twice() {
    let published = |eta: f32, c: f32| {
        if c < 0.0 {
            g_form(1.0 / eta, -c)
        } else {
            g_form(eta, c)
        }
    };
    let (eta, within): (f32, f32) = (1.5, -0.5);
    assert!(published(1.0 / eta, within) < 0.1);
    assert_eq!(ours("dielectric_exact", -within, &[1.0 / eta]), 1.0);
    assert_eq!(
        ours("dielectric_exact", within, &[eta]),
        ours("dielectric_exact", 0.0, &[eta])
    );
}

/// three.js PR #12141: the power as a Gaussian does not reach F0, so that the inverse by a fifth power is none.
#[test]
fn a_gaussian_does_not_reach_f0() {
    assert!(gaussian(0.0, 1.0) > 1.6e-4);
    assert_eq!(ours("schlick", 1.0, &[0.0]), 0.0);
}

/// The methods with a power of 1 - c that begin at F0, with their arguments for an F0 of .04.
const POWERS: [(&str, &[f32]); 6] = [
    ("schlick", &[0.04]),
    ("schlick_f90", &[0.04, 1.0]),
    ("schlick_generalised", &[0.04, 1.0, 5.0]),
    ("empirical", &[0.04, 0.96, 5.0]),
    ("f82_tint", &[0.04, 0.8]),
    ("hoffman_f82", &[0.04, 0.6]),
];

/// `pow(1 - VoH, 5)` with VoH = 1 + 1 ulp is a NaN, and bloom makes a black rectangle of one pixel: levy-street/
/// world-of-claudecraft #2790, scenejs #387, mrdoob/three.js #5626 and #4862, playcanvas/engine #8438 (WGSL and GLSL).
#[test]
fn one_ulp_above_one_is_a_nan_in_a_power() {
    for c in [1.0f32.next_up(), 1.000_000_2, 1.5] {
        assert!(schlick(0.04, c).is_nan(), "at {c}");
        for (method, arguments) in POWERS {
            assert_eq!(ours(method, c, arguments), 0.04, "{method} at {c}");
        }
    }
}

/// A pack of shaders clamps the base of F_AdobeF82: normals kept as RGBA16F have a dot product of up to 1.0005 with themselves, and
/// every pixel that faces the viewer was a NaN.
#[test]
fn a_normal_rounded_to_half_is_longer_than_one() {
    let half = |x: f64| Half::from_f64(x).to_f64() as f32;
    let facing = (0..1000).map(|i| {
        let (sine, cosine) = libm::sincos(f64::from(i) * 1e-3);
        let (x, y) = (half(sine), half(cosine));
        x * x + y * y
    });
    let dot = facing.fold(0.0, f32::max);
    assert!(dot > 1.0001, "{dot}");
    let published = |f0: f32, b: f32, c: f32| schlick(f0, c) - b * c * pow(1.0 - c, 6.0);
    assert!(published(0.04, 0.1, dot).is_nan());
    for (method, arguments) in POWERS {
        assert_eq!(ours(method, dot, arguments), 0.04, "{method}");
    }
}

/// cocos2d #1123: `pow(0, y)` on PowerVR, where log2(0) times y is what the hardware makes of it; a NaN for y = 0
/// everywhere. No text of ours has a `pow` (`golden` looks), integer powers have no logarithm, that of others never sees 0.
#[test]
fn a_power_of_nothing_is_undefined() {
    assert!(pow(0.0, 0.0).is_nan());
    for exponent in [0.0, 0.2, 5.0, 60.0] {
        let f = ours("schlick_generalised", 1.0, &[0.04, 1.0, exponent]);
        assert!((0.04..=1.0).contains(&f), "{exponent}: {f}");
        let f = ours("empirical", 1.0, &[0.04, 0.96, exponent]);
        assert!((0.04..=1.0).contains(&f), "{exponent}: {f}");
    }
}

/// google/filament #10280: NoV computed in half precision on Metal came as a NaN, and 38 to 60 % of the fragments were
/// black. A NaN that comes in must not come out; what a stack makes of it is tried in `gpu::contract`.
#[test]
fn a_cosine_that_is_a_nan_blackened_half_the_fragments() {
    assert!(schlick(0.04, f32::NAN).is_nan());
    assert!(g_form(1.5, f32::NAN).is_nan());
    for (method, arguments) in POWERS {
        let f = ours(method, f32::NAN, arguments);
        assert!((0.0..=1.0).contains(&f), "{method}: {f}");
    }
    for (method, arguments) in [
        ("dielectric_exact", &[1.5f32][..]),
        ("conductor_exact", &[0.2, 3.0]),
        ("conductor_artistic", &[0.9, 0.5]),
        ("conductor_from_f0_f82", &[0.9, 0.8]),
    ] {
        let f = ours(method, f32::NAN, arguments);
        assert!((0.0..=1.0).contains(&f), "{method}: {f}");
    }
}

/// google/filament #9380: what exceeds 65504 is an infinity in half precision, and a tile is lost. The law for conductors
/// squares squares: from k = 16 on it overflows, and the quotient is a NaN.
#[test]
fn halves_overflow_in_the_law_for_conductors() {
    let number = Half::from_f64;
    let published = |n: f64, k: f64, c: f64| {
        let (n, k, c) = (number(n), number(k), number(c));
        let sine2 = number(1.0) - c * c;
        let t = n * n - k * k - sine2;
        let whole = (t * t + number(4.0) * n * n * k * k).sqrt();
        let a = (number(0.5) * (whole + t)).sqrt();
        let (sum, u) = (whole + c * c, number(2.0) * a * c);
        ((sum - u) / (sum + u)).to_f64()
    };
    assert!(published(2.0, 17.0, 0.5).is_nan());
    assert!(!published(2.0, 3.0, 0.5).is_nan());
    for k in [17.0f32, 1e3, 1e6] {
        let law = optics::conductor(2.0, f64::from(k), 0.5).unpolarised() as f32;
        near(ours("conductor_exact", 0.5, &[2.0, k]), law, 1e-6);
    }
}

/// skyrim-community-shaders PR #1653: a test that F_Schlick(F0, 1) is F0 was weakened "due to floating-point precision
/// issues", which nobody explained: a `pow` that makes 0 of 0 gives F0, the Gaussian in its place does not. What that test
/// wanted holds here for every F0, of methods that follow a second colour up to 1.
#[test]
fn at_normal_incidence_schlick_is_f0_to_the_last_bit() {
    assert_eq!(schlick(0.04, 1.0), 0.04);
    assert_ne!(gaussian(0.04, 1.0), 0.04);
    for f0 in (0..=4096)
        .map(|i| i as f32 / 4096.0)
        .chain([1e-41, 1e-20, 0.04, 1.06])
    {
        assert_eq!(ours("schlick", 1.0, &[f0]), f0);
        assert_eq!(ours("schlick_f90", 1.0, &[f0, 1.0]), f0);
        // Those that follow a second colour are limited to 1.
        assert_eq!(ours("f82_tint", 1.0, &[f0, 0.5]), f0.min(1.0));
        assert_eq!(ours("hoffman_f82", 1.0, &[f0, 0.5]), f0.min(1.0));
    }
}
