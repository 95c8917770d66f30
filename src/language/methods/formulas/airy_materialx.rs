//! `F = (F_s + F_p) / 2`, `F_x = R12 + R_s + Σ 2 C_m S(m D, m φ)`: Airy's series of a film with exact reflectances and phases in both
//! polarisations, weighted with Gaussians that stand for an observer, as MaterialX has it. It is kept for comparison.
//!
//! ```text
//! D = 2 n₂ d c₂                         the path; n₂ the film's index, c₂ the cosine in it
//! R12, R23                              Fresnel's law, of air and film, and of film and base with n and k
//! T = 1 - R12, R_s = T² R23 / (1 - R12 R23), C_m = (R_s - T) (R12 R23)^(m/2), m = 1, 2
//! S                                     as in `iridescence_khr`
//! ```
//!
//! Source: Belcour, Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", ACM Transactions on
//! Graphics 36(4), 2017, <https://doi.org/10.1145/3072959.3073620>, in the form of `mx_fresnel_airy` of MaterialX 1.39.5,
//! <https://github.com/AcademySoftwareFoundation/MaterialX>, with its two iterations. Arctangents of phases are left out: what is needed
//! are the cosine and sine of the phase, which are quotients. The polarisations share the observer's waves. 1 - R12 R23 is at least
//! 1e-6: at 90 degrees MaterialX divides 0 by 0.
//! Domain: film_ior from .05 to 10, taken as 1 where it is less. Error: a channel's reflectances are turned into another channel's
//! colour, as if they were X, Y and Z, with the primaries of CIE RGB, and two terms are too few for metals: .06 to .27.

use super::*;

use super::iridescence_khr::{BELCOUR_BARLA_2017, observer, to_rgb};

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const CHANNEL_N: Input = Input::rgb(
        "channel_n",
        "refractive index of the base without its film, one a channel, relative to the medium outside",
        [1e-3, 100.0],
        InputSource::Material(|known| known.film.bare.n),
    )
    .tried(&[1.5, 0.2, 1.0])
    .scanned(&[0.05, 0.2, 0.7, 1.0, 1.5, 2.6, 4.0]);

    pub const CHANNEL_K: Input = Input::rgb(
        "channel_k",
        "extinction coefficient of the base without its film, one a channel, relative to the same",
        [0.0, 100.0],
        InputSource::Material(|known| known.film.bare.k),
    )
    .tried(&[0.0, 3.4])
    .scanned(&[0.0, 0.1, 1.0, 3.4, 7.0]);
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "airy_materialx",
    summary: "a film as MaterialX has it, Airy's series, for comparison",
    formula: &[
        "F = (F_s + F_p) / 2, F_x = R12 + R_s + sum of 2 C_m S(m D, m phi), m = 1, 2, D = 2 film_ior d c2",
        "T = 1 - R12, R_s = T^2 R23 / (1 - R12 R23), C_m = (R_s - T) (R12 R23)^(m/2), R12, R23 and phi by Fresnel's law",
    ],
    source: BELCOUR_BARLA_2017,
    origin: Origin::Adapted("as mx_fresnel_airy of MaterialX has it, without arctangents"),
    inputs: &[
        Input::THICKNESS,
        Input::FILM_IOR,
        Input::CHANNEL_N,
        Input::CHANNEL_K,
    ],
    class: Class::OneFilm,
    domain: "a film of an index below 1 is taken as 1; a film that absorbs is taken as clear",
    claims: Claims {
        code_abs: 1.6e-4,
        ..Claims::NONE
    },
    contract: Contract::Exempt(
        "beside 90 degrees single precision loses a film of nearly the medium's index",
    ),
    half: InHalf::Refused("half precision keeps no phase"),
    build,
    ..Method::BASE
};

/// Linear colours of X, Y and Z for the primaries of CIE RGB.
const CIE_RGB: [[f64; 3]; 3] = [
    [2.370_674_3, -0.900_040_5, -0.470_633_8],
    [-0.513_885, 1.425_303_6, 0.088_581_4],
    [0.005_298_2, -0.014_694_9, 1.009_396_8],
];

/// The least radicand: compilers may compute a root as x / sqrt(x), which is no number at 0.
const LEAST: f64 = 1e-37;

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let c = x.cosine();
    let number = |value: f64| c.builder().number(value);
    let (n, k) = (x.get(Input::CHANNEL_N), x.get(Input::CHANNEL_K));
    let ior = x.get(Input::FILM_IOR).at_least(1.0).named("ior", "");
    let s2 = (1.0 - c.squared()).named("s2", "");
    let inside2 = (1.0 - s2 / ior.squared())
        .at_least(1e-12)
        .named("inside2", "");
    let inside = inside2.sqrt().named("inside", "the cosine in the film");

    // Air and film.
    let (near, far) = (
        (ior * inside).named("y", ""),
        (ior * c).named("slanted", ""),
    );
    let ratio_s = ((c - near) / (c + near)).named("ratio_s", "");
    let outer_s = ratio_s.squared().named("outer_s", "R12 of s");
    let ratio_p = ((far - inside) / (far + inside)).named("ratio_p", "");
    let outer_p = ratio_p.squared().named("outer_p", "R12 of p");
    let brewster = (1.0 / (1.0 + ior.squared()).sqrt()).named("brewster", "cos atan ior");
    let sign_p = c.choose_below(brewster, number(1.0), number(-1.0));
    let sign_p = sign_p.named("sign_p", "s always turns by pi");

    // Film and base: u + iv = sqrt(m² - n₂² sin²).
    let re = ((n - k) * (n + k)).named("re", "m^2");
    let im = (2.0 * n * k).named("im", "");
    let im2 = im.squared().named("im2", "");
    let across = (re - s2).named("across", "");
    let size = (across.squared() + im2)
        .at_least(LEAST)
        .sqrt()
        .named("size", "u^2 + v^2");
    let u = (0.5 * (size + across))
        .at_least(LEAST)
        .sqrt()
        .named("u", "");
    let v = (0.5 * (size - across))
        .at_least(LEAST)
        .sqrt()
        .named("v", "");
    let near2 = near.squared().named("y2", "");
    let near_twice = (2.0 * near).named("y_twice", "");
    let cross_s = (near_twice * u).named("cross_s", "");
    let sum_s = (size + near2).named("sum_s", "");
    let inner_s = (sum_s - cross_s).max(number(0.0).rgb()) / (sum_s + cross_s);
    let inner_s = inner_s.named("inner_s", "R23 of s");
    let base4 = (re.squared() + im2).named("base4", "|m|^4");
    let ior2 = ior.squared().named("ior2", "");
    let mixed = (re * u + im * v).named("mixed", "");
    let cross_p = (near_twice * mixed).named("cross_p", "");
    let whole_p = (base4 * inside2).named("whole_p", "");
    let film_p = (ior2 * size).named("film_p", "");
    let sum_p = (whole_p + film_p).named("sum_p", "");
    let inner_p = (sum_p - cross_p).max(number(0.0).rgb()) / (sum_p + cross_p);
    let inner_p = inner_p.named("inner_p", "R23 of p; rounding must not make it negative");
    let turn_s = [size - near2, near_twice * v];
    let turn_p = [whole_p - film_p, near_twice * (im * u - re * v)];

    // Both polarisations see the same waves.
    let path = (near_twice * x.get(Input::THICKNESS)).named("path", "D");
    let waves = [1.0, 2.0].map(|m| observer((m * path).named(&format!("path_{m}"), ""), m));
    let of = |name: &str, outer: Expr<'b>, inner: Expr<'b>, sign: Expr<'b>, turn: [Expr<'b>; 2]| {
        let named = |part: Expr<'b>, what: &str| part.named(&format!("{what}_{name}"), "");
        let turn = [named(turn[0], "along"), named(turn[1], "across")];
        let long = (turn[0].squared() + turn[1].squared())
            .at_least(1e-30)
            .inverse_sqrt();
        let long = named(long, "long");
        let (cos, sin) = (
            named(sign * turn[0] * long, "cos"),
            named(sign * turn[1] * long, "sin"),
        );
        let through = named(1.0 - outer, "through");
        let product = named(outer * inner, "product");
        let all = named(
            through.squared() * inner / (1.0 - product).at_least(1e-6),
            "all",
        );
        let step = named(product.at_least(LEAST).sqrt(), "step");
        let first = named((all - through) * step, "first");
        let twice = [
            named(2.0 * cos.squared() - 1.0, "cos2"),
            named(2.0 * cos * sin, "sin2"),
        ];
        let fringe =
            |m: usize, part: Expr<'b>, [cos, sin]: [Expr<'b>; 2]| part * waves[m].turned(cos, sin);
        outer + all + 2.0 * (fringe(0, first, [cos, sin]) + fringe(1, first * step, twice))
    };
    let minus = number(-1.0);
    let s = of("of_s", outer_s, inner_s, minus, turn_s);
    let p = of("of_p", outer_p, inner_p, sign_p, turn_p);
    to_rgb((0.5 * (s + p)).named("mean", ""), CIE_RGB, 3.0).saturate()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::ir::{Value, evaluate};

    /// Computed from MaterialX's formulas, with their arctangents, by a program of its own, in f64.
    #[test]
    fn it_is_what_materialx_computes() {
        const GOLD: [[f64; 3]; 2] = [[0.16, 0.42, 1.38], [3.35, 2.35, 1.77]];
        const TITANIUM: [[f64; 3]; 2] = [[2.75, 2.54, 2.27], [3.82, 3.43, 3.04]];
        const GLASS: [[f64; 3]; 2] = [[1.5; 3], [0.0; 3]];
        for (c, [n, k], ior, nm, want) in [
            (1.0, GOLD, 1.4, 200.0, [1.0, 0.6309556, 0.2035453]),
            (0.5, GOLD, 1.4, 600.0, [1.0, 0.5690022, 0.3936524]),
            (1.0, TITANIUM, 2.6, 45.0, [0.0141886, 0.1417282, 0.3468538]),
            (0.2, TITANIUM, 2.6, 100.0, [0.5266739, 0.5002668, 0.5972089]),
            (1.0, GLASS, 1.3, 400.0, [0.0136090, 0.0339241, 0.0178432]),
        ] {
            let numbers = [
                Value::scalar(nm),
                Value::scalar(ior),
                Value::rgb(n),
                Value::rgb(k),
            ];
            let arguments = [&[Value::scalar(c)], &numbers[..]].concat();
            let got = evaluate::<f64>(&METHOD.function(false).unwrap(), &arguments).at(0);
            let near = |i: usize| (got[i] - want[i]).abs() < 1e-6;
            assert!((0..3).all(near), "{c} {ior} {nm}: {got:?} {want:?}");
        }
    }
}
