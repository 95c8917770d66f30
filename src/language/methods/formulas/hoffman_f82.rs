//! `F = F_S(c) - b c (1-c)⁶`, `b = (F_S(1/7) - F82) / (1/7 (6/7)⁶)`, F_S being Schlick's approximation: the curve goes
//! through F82 at 81.79 degrees, where the term c (1-c)⁶ has its maximum.
//!
//! Source: Hoffman, "Fresnel Equations Considered Harmful", MAM workshop, 2019,
//! <https://renderwonk.com/publications/mam2019/>.
//! 1 / (1/7 (6/7)⁶) = 7⁷/6⁶ and F_S(1/7) = F0 + (1 - F0) (6/7)⁵, both exact.
//! Domain: F0, F82 ≥ 0; clamped to [0, 1]. Error: [`METHOD`]'s claims.

use super::schlick::{grazing_power, grazing_weight};
use super::*;

/// 7⁷/6⁶, the reciprocal of the maximum of c (1-c)⁶.
const PEAK: f64 = 823_543.0 / 46_656.0;
/// (6/7)⁵, Schlick's weight at cos θ = 1/7.
pub(super) const WEIGHT_82: f64 = 7_776.0 / 16_807.0;

/// Hoffman 2019.
pub(super) const HOFFMAN_2019: Citation = Citation {
    authors: "Hoffman",
    title: "Fresnel Equations Considered Harmful",
    place: "Eurographics Workshop on Material Appearance Modeling",
    year: 2019,
    link: "https://renderwonk.com/publications/mam2019/",
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "hoffman_f82",
    summary: "Schlick's approximation corrected to the reflectance at 81.79 degrees",
    formula: &[
        "F = F0 + (1 - F0) (1 - c)^5 - b c (1 - c)^6, limited to [0, 1]",
        "b = (823543 / 46656) (F0 + (1 - F0) 7776 / 16807 - F82)",
    ],
    source: HOFFMAN_2019,
    inputs: &[Input::F0, Input::F82],
    domain: "the result is limited to [0, 1], of f0 above 1 too",
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0341, 67.8),
            Claim::metals(0.0837, 87.3),
        ],
        code_ulp: 6.0,
        colours: ColourClaim::within(5e-7),
        ..Claims::NONE
    },
    half: InHalf::within(0.0017),
    build,
    variants: &[&DIP_FIRST, &RISE],
    for_constants: Some(for_constants),
    affine: Some(Affine {
        numbers: &["f0", "1 - f0", "f82 - (f0 + (1 - f0) * 7776 / 16807)"],
        build: numbers,
        weights: affine_weights,
    }),
    ..Method::BASE
};

/// The depth of the dip in each channel first: for GPUs that compute vectors, or count waits.
static DIP_FIRST: Method = Method {
    variant: "dip_first",
    build: dip_first,
    variants: &[],
    ..METHOD
};

/// What is added to F0, by weights that channels share.
static RISE: Method = Method {
    variant: "rise",
    build: rise,
    variants: &[],
    ..METHOD
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let m5 = grazing_weight(x);
    let b = (PEAK * dip(x.cosine(), m5)).named("b", "the weight of f82: 1 at 81.79 degrees");
    let a =
        (m5 - WEIGHT_82 * b).named("a", "the weight of white: 1 at grazing, 0 at 81.79 degrees");
    between(x, a, b)
}

/// `F0 + (1 - c)^5 (1 - F0 + b c (1 - c))`, `b = (823543 / 46656) (F82 - F_S(1/7))`.
fn dip_first<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (f0, f82) = (x.get(Input::F0), x.get(Input::F82));
    let c = x.cosine();
    let b = PEAK * f82 - PEAK * WEIGHT_82 - PEAK * (1.0 - WEIGHT_82) * f0;
    let b = b.named("b", "less than 0 where there is a dip");
    let m5 = grazing_weight(x);
    let arch = (c * (1.0 - c)).named("arch", "c (1 - c)");
    (f0 + m5 * (1.0 - f0 + b * arch)).saturate()
}

/// `F0 + (1 - c)^5 (F82 d + (1 - w d) - F0 (1 + (1 - w) d))`, `d = (823543 / 46656) c (1 - c)`, `w = 7776 / 16807`.
fn rise<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (f0, f82) = (x.get(Input::F0), x.get(Input::F82));
    let c = x.cosine();
    let d = (PEAK * (c * (1.0 - c))).named("d", "");
    let white = (1.0 - WEIGHT_82 * d).named("white", "");
    let less = (-1.0 - (1.0 - WEIGHT_82) * d).named("less", "");
    let m5 = grazing_weight(x);
    (f0 + m5 * (f0 * less + white + f82 * d)).saturate()
}

/// `F0 (1 - a - b) + F82 b + a`, clamped to [0, 1]: the form that is affine in F0 and F82 and keeps white white. The channels share
/// the weights.
pub(super) fn between<'b>(x: &Inputs<'b>, a: Expr<'b>, b: Expr<'b>) -> Expr<'b> {
    let rest = (1.0 - a - b).named("kept", "the weight of f0");
    let bare = x.get(Input::F0) * rest + (x.get(Input::F82) * b + a);
    bare.saturate()
}

fn for_constants<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (f0, f82) = (x.get(Input::F0), x.get(Input::F82));
    let rise = (1.0 - f0).named("rise", "");
    let b = (PEAK * (f0 + rise * WEIGHT_82 - f82)).named("b", "the depth of the dip");
    let m5 = grazing_weight(x);
    let bare = (f0 + rise * m5 - b * dip(x.cosine(), m5)).named("bare", "Schlick less the dip");
    bare.saturate()
}

/// `c (1-c)⁶`, from the fifth power `m5`.
pub(super) fn dip<'b>(c: Expr<'b>, m5: Expr<'b>) -> Expr<'b> {
    c * (m5 * (1.0 - c))
}

/// F0, 1 - F0, and the difference between F82 and Schlick's value.
fn numbers<'b>(x: &Inputs<'b>) -> Vec<Expr<'b>> {
    let f0 = x.get(Input::F0);
    let rise = (1.0 - f0).named("rise", "");
    vec![f0, rise, x.get(Input::F82) - (f0 + WEIGHT_82 * rise)]
}

/// The weights of these numbers in f64. The last is 1 at 81.79 degrees.
pub(super) fn affine_weights(c: f64) -> [f64; 4] {
    let m5 = grazing_power(c);
    [1.0, m5, PEAK * c * (1.0 - c) * m5, 0.0]
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
}
