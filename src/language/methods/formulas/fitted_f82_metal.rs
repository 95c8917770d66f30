//! `F = F0 (1 - A - B) + F82 B + A + s (u - 5/8) (g1 + u g2)`: the curve of `fitted_f82`, and what it lacks, by five products of two
//! colours that a texture holds.
//!
//! `g1` and `g2` are linear in `X = 1 - F0`, `Y = 1 - F82`, `XY`, `Y²` and `H = XY / (X + Y/2)`, all of which are 0 for white. The factor
//! `s (u - 5/8)` is 0 at 0°, 81.79° and 90°, so that F0, F82 and white stay what they are.
//! Source: ours; the two colours are those of Hoffman, "Fresnel Equations Considered Harmful", 2019,
//! <https://renderwonk.com/publications/mam2019/>. A search by linear programs found the ten numbers, for the least median and 90th
//! percentile of the largest errors over 75 pages of metals and semiconductors. `tests/fit-f82` repeats it, and reports the error
//! of each substance when it is left out.
//! For scenes with many lights it has a second curve, from the same two colours and H: the coefficients of `fitted`, which are found once a
//! pixel. There `F = c0 + b (c1 + b (c2 + b c3))`, `b = 2^(-6.5 cos θ)`, with c1, c2 and c3 linear in X, Y, XY, Y², H and X²; 18 numbers, found in
//! the same way.
//! Both are for metals and semiconductors: water errs by .04, use `fitted_f82`. Colours of no metal get a curve that no metal has.
//! Domain: any F0 and F82, of which what lies outside of [0, 1] counts as 0 or 1; clamped to [0, 1]. White stays white. Error: [`METHOD`]'s
//! claims.

use super::fitted_f82::{Weights, weights};
use super::hoffman_f82::HOFFMAN_2019;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_f82_metal",
    summary: "fitted_f82 and what it lacks of metals, from the reflectances at 0 and 81.79 degrees",
    formula: &[
        "F = F0 (1 - A - B) + F82 B + A + s (u - 5/8) (g1 + u g2), limited to [0, 1]; A, B, u, s = u (1 - u) as of fitted_f82",
        "g1, g2 linear in X = 1 - F0, Y = 1 - F82, X Y, Y^2 and H = X Y / (X + Y/2), X and Y limited to [0, 1]",
    ],
    source: HOFFMAN_2019,
    origin: Origin::Ours("the two colours that it takes"),
    inputs: &[Input::F0, Input::F82],
    domain: "the result is limited to [0, 1]; for metals and semiconductors: of water it errs by 0.04",
    claims: Claims {
        model: &[Claim::metals(0.0271, 87.3)],
        code_ulp: 9.0,
        code_over: MediaSet::Metals,
        colours: ColourClaim::within(6e-7),
        by_class: &[
            ByClass::of_class("metal", [0.0037, 0.0089], [0.0030, 0.0336], 0.0090),
            ByClass::of_class("semiconductor", [0.0027, 0.0036], [0.0038, 0.0070], 0.0067),
        ],
        ..Claims::NONE
    },
    half: InHalf::within(0.0045),
    build,
    for_constants: Some(by_channel),
    coefficients: Some(CoefficientsFromInputs {
        fitted: "fitted",
        build: coefficients,
        model: [0.0034, 0.0088],
        code_abs: 4.3e-6,
    }),
    ..Method::BASE
};

/// The numbers of g1 and g2: of X, Y, XY, Y² and H. Rounding them to four digits changes no page's error by more than 5e-5.
const OF_LIBRARY: [[f64; 5]; 2] = [
    [0.7933, -5.7916, -5.0517, 6.2321, 6.7222],
    [-18.5664, -19.0808, 18.7348, -38.4907, 69.6092],
];
/// The numbers of c1, c2 and c3: of X, Y, XY, Y², H and X².
const OF_FITTED: [[f64; 6]; 3] = [
    [4.9009, 3.3056, -5.4495, 7.5257, -15.8129, 1.8363],
    [-8.2937, -18.3943, 14.9038, -21.7169, 48.5374, -4.6799],
    [4.3822, 15.2962, -9.2012, 13.9162, -33.0, 2.8133],
];

/// What two colours lack of white.
struct Lacks<'b> {
    /// X = 1 - F0.
    x: Expr<'b>,
    /// Y = 1 - F82.
    y: Expr<'b>,
    /// H / X.
    ratio: Expr<'b>,
}

fn lacks<'b>(inputs: &Inputs<'b>) -> Lacks<'b> {
    let [x, y] = [Input::F0, Input::F82].map(|input| (1.0 - inputs.get(input)).saturate());
    let (x, y) = (x.named("x", ""), y.named("y", ""));
    let least = match inputs.is_half() {
        false => 1e-6,
        true => inputs.precision().smallest(),
    };
    let ratio = y / (x + 0.5 * y).at_least(least);
    let ratio = ratio.named(
        "ratio",
        "times x it is half of the harmonic mean of 2 x and y",
    );
    Lacks { x, y, ratio }
}

fn build<'b>(inputs: &Inputs<'b>) -> Expr<'b> {
    let Lacks { x, y, ratio } = lacks(inputs);
    let Weights { u, s, a, b } = weights(inputs.cosine());
    let p = (s * (u - 0.625)).named("p", "0 at 0, 81.79 and 90 degrees");
    let [of_x, of_y, of_xy, of_yy, of_h] =
        core::array::from_fn(|i| p * (OF_LIBRARY[0][i] + OF_LIBRARY[1][i] * u));
    let of_x = (of_x + (a + b - 1.0)).named("of_x", "");
    let of_y = (of_y - b).named("of_y", "");
    let sum = x * (of_x + of_xy * y + of_h * ratio) + y * (of_y + of_yy * y);
    (1.0 + sum).saturate()
}

/// `p (g1 + u g2)` with g1 and g2 of each channel, which are constants of a material.
fn by_channel<'b>(inputs: &Inputs<'b>) -> Expr<'b> {
    let Lacks { x, y, ratio } = lacks(inputs);
    let Weights { u, s, a, b } = weights(inputs.cosine());
    let [g1, g2] = OF_LIBRARY.map(|[of_x, of_y, of_xy, of_yy, of_h]| {
        x * (of_x + of_xy * y + of_h * ratio) + y * (of_y + of_yy * y)
    });
    let p = (s * (u - 0.625)).named("p", "0 at 0, 81.79 and 90 degrees");
    // Not from 1 downwards: a dark substance, such as water, would lose its digits.
    let curve = (1.0 - x) + x * a + (x - y) * b;
    (curve + p * (g1 + u * g2)).saturate()
}

fn coefficients<'b>(inputs: &Inputs<'b>) -> [Expr<'b>; 4] {
    let Lacks { x, y, ratio } = lacks(inputs);
    let linear = |i: usize| {
        let [of_x, of_y, of_xy, of_yy, of_h, of_xx] = OF_FITTED[i];
        let sum = x * (of_x + of_xx * x + of_xy * y + of_h * ratio) + y * (of_y + of_yy * y);
        sum.named(["c1", "c2", "c3"][i], "")
    };
    let [c1, c2, c3] = [0, 1, 2].map(linear);
    let e = f64::exp2(-6.5);
    let c0 = 1.0 - x - e * (c1 + e * (c2 + e * c3));
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

    #[test]
    fn it_meets_f0_f82_and_one() {
        for (f0, f82) in [(0.6, 0.7), (0.95, 0.93), (0.5, 0.6)] {
            check(&METHOD, 1.0, &[f0, f82], f0);
            check(&METHOD, 1.0 / 7.0, &[f0, f82], f82);
            check(&METHOD, 0.0, &[f0, f82], 1.0);
        }
    }

    #[test]
    fn white_stays_white() {
        for c in [0.0, 0.01, 0.1, 0.3, 0.7, 1.0] {
            check(&METHOD, c, &[1.0, 1.0], 1.0);
        }
    }

    /// A texture's F0 above 1 by rounding is white.
    #[test]
    fn above_white_is_white() {
        check(&METHOD, 0.3, &[1.02, 1.0], 1.0);
        let [white, above] = [1.0, 1.02].map(|f0| value(&METHOD, 0.3, &[f0, 0.98]));
        assert_eq!(white, above);
    }
}
