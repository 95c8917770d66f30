//! `F = c0 + b (c1 + b (c2 + b c3))`, `b = 2^(-6.5 cos θ)`, with c1, c2 and c3 quadratic in F0 and F82, and c0 such that F(0°) = F0: the
//! coefficients of `fitted` from two colours that a texture holds.
//!
//! Source: ours; the two colours are those of Hoffman, "Fresnel Equations Considered Harmful", 2019,
//! <https://renderwonk.com/publications/mam2019/>. A search by linear programs found the 18 numbers, for the least median and 90th
//! percentile of the largest errors over 75 pages of metals and semiconductors. `tests/fit-f82` repeats it, and reports the error
//! of each substance when it is left out.
//! It is for metals and semiconductors: water errs by .04, use `fitted_f82`. Colours of no metal get a curve that no metal has.
//! The coefficients have functions of their own, for scenes with many lights: they are computed once a pixel, and `fitted` is called
//! once a light.
//! Domain: any F0 and F82; clamped to [0, 1]. White stays white. Error: [`METHOD`]'s claims.

use super::hoffman_f82::HOFFMAN_2019;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_f82_metal",
    summary: "the coefficients of fitted from the reflectances at 0 and 81.79 degrees of a metal",
    formula: &[
        "F = c0 + b (c1 + b (c2 + b c3)), b = 2^(-6.5 c), limited to [0, 1]",
        "c1, c2, c3 quadratic in F0 and F82; c0 = F0 - e (c1 + e (c2 + e c3)), e = 2^(-6.5)",
    ],
    source: HOFFMAN_2019,
    origin: Origin::Ours("the two colours that it takes"),
    inputs: &[Input::F0, Input::F82],
    domain: "the result is limited to [0, 1]; for metals and semiconductors: of water it errs by 0.04",
    claims: Claims {
        model: &[Claim::metals(0.0452, 87.5)],
        code_ulp: 16.0,
        code_over: MediaSet::Metals,
        colours: ColourClaim::within(8.5e-6),
        by_class: &[
            ByClass::of_class("metal", [0.0042, 0.0100], [0.0047, 0.0430], 0.0141),
            ByClass::of_class("semiconductor", [0.0066, 0.0074], [0.0065, 0.0096], 0.0094),
        ],
        ..Claims::NONE
    },
    half: InHalf::Specialised("its coefficients cancel"),
    build,
    coefficients: Some(CoefficientsFromInputs {
        fitted: "fitted",
        build: coefficients,
        code_abs: 7e-7,
    }),
    ..Method::BASE
};

/// The F0 at which the quadratics are centred: amid the colours of metals, so that little cancels.
const CENTRE: f64 = 0.6;
/// The quadratics of c1, c2 and c3: the coefficients of 1, z, z², x, x z and x², with x = F0 - `CENTRE` and z = F82 - F0. They are
/// those that were found, re-expanded: in this form f32 loses half as much.
const QUADRATICS: [[f64; 6]; 3] = [
    [-0.28801525, 0.021885, 12.4904, -0.70374, 10.8233, 3.5649],
    [0.37288925, 7.783125, -36.5052, 3.31076, -32.3231, -10.5149],
    [0.31154125, -7.770585, 23.8447, -3.57474, 21.2275, 6.8923],
];

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let [c0, c1, c2, c3] = coefficients(x);
    let b = (-6.5 * x.cosine()).exp2();
    let b = b.named("b", "small at normal incidence, 1 at grazing");
    (c0 + b * (c1 + b * (c2 + b * c3))).saturate()
}

fn coefficients<'b>(x: &Inputs<'b>) -> [Expr<'b>; 4] {
    let f0 = x.get(Input::F0);
    let above = (f0 - CENTRE).named("x", "");
    let rise = (x.get(Input::F82) - f0).named("z", "");
    let quadratic = |i: usize| {
        let [one, z, zz, x, xz, xx] = QUADRATICS[i];
        let sum = one + rise * (z + rise * zz) + above * (x + rise * xz + above * xx);
        sum.named(["c1", "c2", "c3"][i], "")
    };
    let [c1, c2, c3] = [0, 1, 2].map(quadratic);
    let e = f64::exp2(-6.5);
    let c0 = f0 - e * (c1 + e * (c2 + e * c3));
    [
        c0.named("c0", "so that F is f0 at normal incidence"),
        c1,
        c2,
        c3,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `tests/fit-f82` finds them: the coefficients of 1, y, y², x, x y and x² with x = F0 - .75 and y = F82 - .65. Rounding them
    /// to four digits changes no page's error by more than 5e-5.
    const FOUND: [[f64; 6]; 3] = [
        [-0.353, -0.8527, 12.4904, 0.1361, -14.1575, 5.232],
        [-0.0256, 10.2357, -36.5052, -6.8471, 40.6873, -14.697],
        [0.6275, -9.3554, 23.8447, 5.7256, -26.4619, 9.5095],
    ];

    #[test]
    fn the_quadratics_are_those_that_were_found() {
        for (f0, f82) in [(0.3, 0.7), (0.5, 0.2), (0.95, 0.93), (1.0, 1.0)] {
            for (found, written) in FOUND.iter().zip(&QUADRATICS) {
                let value = |q: &[f64; 6], x: f64, y: f64| {
                    q[0] + y * (q[1] + y * q[2]) + x * (q[3] + y * q[4] + x * q[5])
                };
                let difference =
                    value(found, f0 - 0.75, f82 - 0.65) - value(written, f0 - CENTRE, f82 - f0);
                assert!(difference.abs() < 1e-12, "{f0} {f82}: {difference}");
            }
        }
    }

    #[test]
    fn it_meets_f0_at_normal_incidence() {
        check(&METHOD, 1.0, &[0.6, 0.7], 0.6);
        check(&METHOD, 1.0, &[0.95, 0.93], 0.95);
    }

    #[test]
    fn white_stays_white() {
        for c in [0.0, 0.01, 0.1, 0.3, 0.7, 1.0] {
            check(&METHOD, c, &[1.0, 1.0], 1.0);
        }
    }

    /// Within its error at the 90th percentile.
    #[test]
    fn it_comes_near_f82_and_one() {
        for (f0, f82) in [(0.7, 0.75), (0.95, 0.93), (0.5, 0.6)] {
            let [at_82, at_90] = [1.0 / 7.0, 0.0].map(|c| value(&METHOD, c, &[f0, f82]));
            assert!(
                (at_82 - f82).abs() < 0.01 && at_90 > 0.99,
                "{f0} {f82}: {at_82} {at_90}"
            );
        }
    }
}
