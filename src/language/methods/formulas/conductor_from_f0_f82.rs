//! The exact law for conductors with the n and k that have reflectance F0 at normal incidence and F82 at
//! cos θ = 1/7: two colours that an artist or a table of metals provides, and no approximation of the curve between.
//!
//! Source: ours; the circle of all (n, k) with one F0 is Gulbrandsen's, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014,
//! <https://jcgt.org/published/0003/04/03/>: k² = (n - n_min)(n_max - n), n_max = (1+√F0)²/(1-F0), n_min = 1/n_max, so
//! that F(0°) = F0 whatever n is. F82 falls strictly as n grows along it. n is found from the deficit m = 1 - F82 in two
//! steps. The first guess is n = n_min + u m √F0 / T(u, √F0), u = m √F0 / (1-F0), whose nine constants were fitted for the
//! least final error. The second repeats it with m corrected by the guess's error, from the exact deficit with k eliminated.
//! Domain: F0 is clamped to [0, 0.999]; an F82 that no n and k can give is replaced by the nearest possible one.
//! Error of these two steps against the exact n and k, scanned over F0 .02 to .985 and every possible F82: .00042 for
//! metals (n .05-5, k 1-8, F0 above .3), .00037 for semiconductors (n 2-5.5, k below 3), none for dielectrics, .0058 at
//! worst (F0 .905, F82 .74, an index that no material has).
//! Specialised to a material, n and k are solved in f64, without this error.

use super::conductor_exact::{conductor, least_squared, root_or_zero};
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "conductor_from_f0_f82",
    summary: "the exact law for conductors with n and k solved from two reflectances",
    formula: &[
        "n, k such that F(cos_theta = 1) = F0 and F(cos_theta = 1/7) = F82, in a guess and one correction",
        "k^2 = (n - n_min)(n_max - n), n_max = (1 + sqrt(F0))^2 / (1 - F0), n_min = 1 / n_max",
        "then conductor_exact(cos_theta, n, k)",
    ],
    source: Citation {
        authors: "Gulbrandsen",
        title: "Artist Friendly Metallic Fresnel",
        place: "Journal of Computer Graphics Techniques 3(4), 64-72",
        year: 2014,
        link: "https://jcgt.org/published/0003/04/03/",
    },
    origin: Origin::Ours("all n and k of one F0"),
    inputs: &[Input::F0, Input::F82],
    domain: "f0 counts as at most 0.999; an f82 that no n and k can give takes the nearest that one can",
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0000347, 82.2),
            Claim::metals(0.000384, 72.5),
        ],
        code_ulp: 10.5,
        code_over: MediaSet::Metals,
        colours: Some(ColourClaim {
            max_abs: 5e-4,
            ends: &[
                ("f0", Range::new(0.05, 1.0)),
                ("f82", Range::new(0.0, 0.99)),
            ],
            beyond: "of other pairs f32 may be off by 0.3",
        }),
        ..Claims::NONE
    },
    half: InHalf::Specialised(
        "n is solved from what F0 and F82 lack of 1, differences of which half precision leaves no digits",
    ),
    build,
    replacement: Some(solved),
    ..Method::BASE
};

/// sin² at cos θ = 1/7.
const SIN2: f64 = 48.0 / 49.0;

/// The steps that depend on F0 alone.
struct Circle<'b> {
    root: Expr<'b>,
    inverse: Expr<'b>,
    least: Expr<'b>,
    /// Coefficients of T in u, each a quadratic in √F0.
    curvature: [Expr<'b>; 3],
    /// n_max - n_min.
    span: Expr<'b>,
    u_scale: Expr<'b>,
}

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let tiny = least_squared(x.precision());
    let circle = circle(x.get(Input::F0), tiny);
    let m = (1.0 - x.get(Input::F82))
        .at_least(0.0)
        .named("m", "what the reflectance at 82 degrees lacks of 1");
    let guess = aimed(&circle, m, ["u_guess", "curve_guess", "n_guess_less"]);
    let n_guess = (circle.least + guess).named("n_guess", "");
    let missed = deficit(&circle, n_guess, tiny).named("m_guess", "what it lacks with this n");
    let aim = (2.0 * m - missed)
        .at_least(0.0)
        .named("aim", "as far on the other side");
    let above = aimed(&circle, aim, ["u_aim", "curve_aim", "above"]);
    let k2 = (above * (circle.span - above)).named("k2", "on the circle of one F0");
    let k = root_or_zero(x.precision(), k2).named("k", "0 where k2 is 0, by any arithmetic");
    let n = (circle.least + above).named("n", "");
    conductor(x.precision(), x.cosine(), n, k)
}

fn circle<'b>(f0: Expr<'b>, tiny: f64) -> Circle<'b> {
    let f0 = f0
        .at_least(tiny)
        .at_most(0.999)
        .named("f0_less", "n_max is infinite at 1");
    let root = f0.sqrt().named("root", "");
    let inverse = (1.0 / (1.0 - f0)).named("reciprocal", "");
    let one_more = (1.0 + root).named("one_more", "");
    let most = (one_more.squared() * inverse).named("n_max", "the dielectric with this F0");
    let least = (1.0 / most).named("n_min", "");
    let quadratic = |a: f64, b: f64, c: f64, name| (a + root * (b + root * c)).named(name, "");
    let curvature = [
        quadratic(0.0220, 0.1945, -0.1102, "t_a"),
        quadratic(-0.5740, 0.6110, 0.2284, "t_b"),
        quadratic(1.1373, -2.7968, 1.5775, "t_c"),
    ];
    Circle {
        root,
        inverse,
        least,
        curvature,
        span: (most - least).named("span", ""),
        u_scale: (root * inverse).named("u_scale", ""),
    }
}

/// n - n_min for an n whose deficit is about `m`: it grows as m², with a fitted curvature.
fn aimed<'b>(circle: &Circle<'b>, m: Expr<'b>, names: [&str; 3]) -> Expr<'b> {
    let u = (m * circle.u_scale).named(names[0], "");
    let [a, b, c] = circle.curvature;
    let curve = (a + u * (b + u * c)).at_least(1e-5).named(names[1], "");
    (u * (m * circle.root) / curve)
        .min(circle.span)
        .named(names[2], "")
}

/// 1 - F at cos θ = 1/7 for an n on the circle, without k and without cancellation.
fn deficit<'b>(circle: &Circle<'b>, n: Expr<'b>, tiny: f64) -> Expr<'b> {
    let (c, s) = (1.0 / 7.0, SIN2.sqrt());
    let q = ((4.0 * circle.inverse - 2.0) * n - c * c).named("q", "n^2 + k^2 + sin^2");
    let h = (2.0 * s * n).named("h", "");
    let r = ((q - h) * (q + h))
        .at_least(tiny)
        .sqrt()
        .named("r_guess", "a^2 + b^2 there");
    let a = (n * (1.0 - 2.0 * SIN2 / (r + q)).at_least(tiny).sqrt()).named("a_guess", "");
    let x = (r / (2.0 * c) + 0.5 * c).named("x_guess", "");
    let y = (r * (c / (2.0 * SIN2)) + SIN2 / (2.0 * c)).named("y_guess", "");
    a * (x + 2.0 * y + a) / ((x + a) * (y + a))
}

/// With constants known, n and k are solved in f64, then the exact law applies.
fn solved(values: &Values) -> Option<(&'static Method, Values)> {
    let colour = |name: &str| values.get(name).copied().unwrap_or([0.0; 3]);
    let (f0, f82) = (colour("f0"), colour("f82"));
    let index = |i: usize| {
        let index = optics::index_from_f0_f82(f0[i], f82[i]);
        (index.n, index.k)
    };
    Some(conductor_exact::with(each_channel(index)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_f0_and_one() {
        check(&METHOD, 1.0, &[0.7, 0.75], 0.7);
        check(&METHOD, 0.0, &[0.7, 0.75], 1.0);
    }

    #[test]
    fn it_meets_f82_within_its_stated_error() {
        for (f0, f82) in [(0.7, 0.75), (0.95, 0.93), (0.5, 0.6), (0.36, 0.61)] {
            let off = (value(&METHOD, 1.0 / 7.0, &[f0, f82]) - f82).abs();
            assert!(off < 4e-4, "{f0} {f82}");
        }
    }

    #[test]
    fn its_stated_worst_is_its_worst() {
        let (f0, f82) = (0.905, 0.74);
        let index = optics::index_from_f0_f82(f0, f82);
        let error = |c: f64| {
            let exact = optics::conductor(index.n, index.k, c).unpolarised();
            (value(&METHOD, c, &[f0, f82]) - exact).abs()
        };
        let errors = (0..=100).map(|i| error(f64::from(i) / 100.0));
        let worst = errors.fold(0.0, f64::max);
        assert!((0.0055..0.0060).contains(&worst), "{worst}");
    }

    #[test]
    fn a_pair_that_no_index_gives_takes_the_nearest() {
        check(&METHOD, 1.0, &[0.04, 0.0], 0.04);
        let glass = optics::dielectric(1.5, 0.5).unpolarised();
        check(&METHOD, 0.5, &[0.04, 0.0], glass);
    }
}
