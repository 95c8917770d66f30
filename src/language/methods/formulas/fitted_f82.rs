//! `F = F0 (1 - A - B) + F82 B + A`, `w = 3.6c/(1+2.6c)`, `u = 1 - w`, `A = u - uw (1 + 8u/3)`, `B = uw (531.2u/75 - .16)`: two colours
//! that a texture holds, and two curves that all materials share.
//!
//! Source: ours, of the kind of Hoffman, "Fresnel Equations Considered Harmful", 2019, <https://renderwonk.com/publications/mam2019/>,
//! where the shared curves are Schlick's and one more. It is affine in F0 and F82, so one split-sum table of three numbers serves
//! every material.
//! 2.6 makes u 5/8 at 81.79 degrees. There A = 0 and B = 1. At normal incidence both are 0. At grazing A = 1 and B = 0. F0 = F82 = 1
//! gives 1. All this is exact for any colours. Two numbers remain free, the slopes 8/3 and 531.2/75 = 1.66 · 64/15 in the brackets.
//! They have about the least median and 90th percentile of the largest errors over 75 pages of metals and semiconductors, .0133 and
//! .0210, where no pair of curves has less than .0122 and .0213 together. With 8/3 the weight of white begins flat.
//! Domain: any F0 and F82; clamped to [0, 1]. It serves dielectrics too. Error: [`METHOD`]'s claims.

use super::hoffman_f82::{HOFFMAN_2019, between};
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_f82",
    summary: "two fitted curves between the reflectances at 0 and 81.79 degrees",
    formula: &[
        "F = F0 (1 - A - B) + F82 B + A, limited to [0, 1], u = (1 - c) / (1 + 2.6 c), w = 1 - u = 3.6 c / (1 + 2.6 c)",
        "A = u - u w (1 + 8/3 u), B = u w (531.2/75 u - 0.16)",
    ],
    source: HOFFMAN_2019,
    origin: Origin::Ours("the two colours that it takes"),
    inputs: &[Input::F0, Input::F82],
    forms: Forms::ColourAndScalar,
    domain: "the result is limited to [0, 1], of f0 above 1 too",
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0088, 71.6),
            Claim::metals(0.0504, 87.3),
        ],
        code_ulp: 0.0,
        colours: ColourClaim::within(6e-7),
        by_class: &[
            ByClass::of_class("metal", [0.0138, 0.0210], [0.0129, 0.0573], 0.0211),
            ByClass::of_class("semiconductor", [0.0161, 0.0217], [0.0139, 0.0293], 0.0285),
            ByClass::of_class("dielectric", [0.0055, 0.0083], [0.0078, 0.0085], 0.0084),
        ],
        ..Claims::NONE
    },
    half: InHalf::within(0.0015),
    build,
    variants: &[&EACH_CHANNEL],
    affine: Some(Affine {
        numbers: &["f0", "1 - f0", "f82 - (f0 + (1 - f0) * 0.4)"],
        build: numbers,
        weights: affine_weights,
    }),
    ..Method::BASE
};

/// `F0 + A (1 - F0) + B (F82 - F0)` in each channel: for GPUs that count waits.
static EACH_CHANNEL: Method = Method {
    variant: "each_channel",
    build: each_channel,
    variants: &[],
    ..METHOD
};

/// The constant that makes u 5/8 at cos θ = 1/7.
const BEND: f64 = 2.6;
/// The slope of B's bracket, which makes B = 1 at u = 5/8, where s = 15/64.
const SLOPE: f64 = 1.66 * 64.0 / 15.0;
const START: f64 = -0.16;

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let Weights { a, b, .. } = weights(x.cosine());
    between(x, a, b)
}

fn each_channel<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let Weights { a, b, .. } = weights(x.cosine());
    let (f0, f82) = (x.get(Input::F0), x.get(Input::F82));
    (f0 + a * (1.0 - f0) + b * (f82 - f0)).saturate()
}

/// Curves that all materials share.
pub(super) struct Weights<'b> {
    /// 0 at normal incidence, 5/8 at 81.79 degrees, 1 at grazing.
    pub u: Expr<'b>,
    /// u (1 - u).
    pub s: Expr<'b>,
    /// The weight of white, A.
    pub a: Expr<'b>,
    /// The weight of F82, B.
    pub b: Expr<'b>,
}

pub(super) fn weights(c: Expr<'_>) -> Weights<'_> {
    let w = c / (1.0 / (1.0 + BEND) + BEND / (1.0 + BEND) * c);
    let w = w.named("w", "1 at normal incidence, 0 at grazing");
    // u comes from w, which is accurate where it is small. With w = 1 - u, the rounding of u would show at grazing.
    let u = (1.0 - w).named("u", "5/8 at 81.79 degrees");
    let s = (u * w).named("s", "");
    let a = u - s * (11.0 / 3.0 - 8.0 / 3.0 * w);
    let b = s * (SLOPE + START - SLOPE * w);
    Weights {
        u,
        s,
        a: a.named("a", "the weight of white"),
        b: b.named("b", "the weight of f82"),
    }
}

/// The reflectance of F0 = 0 at 81.79 degrees that is taken out of F82: then the weight A + .4 B is hardly below 0 anywhere.
const BLACK_82: f64 = 0.4;

/// F0, 1 - F0, and the difference between F82 and a curve that is about a dielectric's.
fn numbers<'b>(x: &Inputs<'b>) -> Vec<Expr<'b>> {
    let f0 = x.get(Input::F0);
    let rise = (1.0 - f0).named("rise", "");
    vec![f0, rise, x.get(Input::F82) - (f0 + BLACK_82 * rise)]
}

/// The weights of these numbers, in f64.
fn affine_weights(c: f64) -> [f64; 4] {
    let u = (1.0 - c) / (1.0 + BEND * c);
    let s = u - u * u;
    let a = u - s * (1.0 + 8.0 / 3.0 * u);
    let b = s * (SLOPE * u + START);
    [1.0, a + BLACK_82 * b, b, 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_f0_f82_and_one() {
        check(&METHOD, 1.0, &[0.6, 0.7], 0.6);
        check(&METHOD, 1.0 / 7.0, &[0.6, 0.7], 0.7);
        check(&METHOD, 0.0, &[0.6, 0.7], 1.0);
    }

    #[test]
    fn white_stays_white() {
        for c in [0.0, 0.01, 0.1, 0.3, 0.7, 1.0] {
            check(&METHOD, c, &[1.0, 1.0], 1.0);
        }
    }

    /// The slope at normal incidence is a hundredth of the rise that Schlick's power has there.
    #[test]
    fn it_is_nearly_flat_at_normal_incidence() {
        let fall = value(&METHOD, 1.0, &[0.04, 0.39]) - value(&METHOD, 0.9, &[0.04, 0.39]);
        assert!(fall.abs() < 0.002, "{fall}");
    }
}
