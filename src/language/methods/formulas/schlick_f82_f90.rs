//! `F = F_S(c) - b c (1-c)⁶`, `F_S(c) = F0 + (F90 - F0) (1-c)^exponent`, `b = F_S(1/7) (1 - tint) / (1/7 (6/7)⁶)`: Schlick's approximation between
//! two colours with any exponent, corrected to a tint at 81.79 degrees.
//!
//! Source: Hoffman, "Generalization of Adobe's Fresnel Model", 2023, <https://renderwonk.com/publications/gfm/>, as `generalized_schlick_bsdf`
//! of MaterialX has it: F0, tint and F90 are its `color0`, `color82` and `color90`.
//! Domain: F0, tint ≥ 0, F90 in [0, 1], exponent ≥ 0.2; clamped to [0, 1]. Where tint, F90 and exponent are 1, 1 and 5 it is `schlick`; where F90
//! and exponent are 1 and 5 it is `f82_tint`. Error: [`METHOD`]'s claims. The real power is computed by exp2 and log2, whose error is part of
//! the code error.

use super::hoffman_f82::dip;
use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const F90_COLOUR: Input = Input::rgb(
        "f90_colour",
        "reflectance at 90 degrees in each channel, linear",
        [0.0, 1.0],
        InputSource::Artist(1.0),
    )
    .tried(&[1.0, 0.0, 0.3])
    .scanned(super::super::input::SHARES_AND_BEYOND);
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick_f82_f90",
    summary: "Schlick's approximation between F0 and F90 with any exponent, corrected to a tint at 81.79 degrees",
    formula: &[
        "F = F_S(c) - b c (1 - c)^6, limited to [0, 1], F_S(c) = F0 + (F90 - F0) (1 - c)^exponent",
        "b = 7^7 / 6^6 (1 - tint) F_S(1/7)",
    ],
    source: Citation {
        authors: "Hoffman",
        title: "Generalization of Adobe's Fresnel Model",
        place: "renderwonk",
        year: 2023,
        link: "https://renderwonk.com/publications/gfm/",
    },
    inputs: &[Input::F0, Input::TINT, Input::F90_COLOUR, Input::EXPONENT],
    domain: "the result is limited to [0, 1], of f0 above 1 too. The code error is that of an exponent of 5, and grows with it",
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0341, 67.8),
            Claim::metals(0.0837, 87.3),
        ],
        code_ulp: 5.5,
        ..Claims::NONE
    },
    half: InHalf::within(0.0020),
    build,
    variants: &[&LESS],
    ..Method::BASE
};

/// With what is lacking at 81.79 degrees of each channel: for GPUs with instructions on three numbers.
static LESS: Method = Method {
    variant: "less",
    build: less,
    variants: &[],
    ..METHOD
};

/// 7⁷ / 6⁶: 1 over c (1 - c)⁶ at cos θ = 1/7.
const PEAK: f64 = 823_543.0 / 46_656.0;

/// The steps that both forms share.
struct Steps<'b> {
    f0: Expr<'b>,
    /// F90 - F0.
    rise: Expr<'b>,
    /// (1 - c) to the exponent.
    weight: Expr<'b>,
    /// F_S at 81.79 degrees.
    there: Expr<'b>,
}

fn steps<'b>(x: &Inputs<'b>, m: Expr<'b>) -> Steps<'b> {
    let (f0, f90, exponent) = (
        x.get(Input::F0),
        x.get(Input::F90_COLOUR),
        x.get(Input::EXPONENT),
    );
    let weight = m.power(exponent, x.precision());
    let at_82 = (exponent * (6.0f64 / 7.0).log2()).exp2();
    let at_82 = at_82.named("at_82", "the weight at 81.79 degrees");
    let rise = (f90 - f0).named("rise", "");
    Steps {
        f0,
        rise,
        weight: weight.named("weight", "1 at grazing"),
        there: f0 + rise * at_82,
    }
}

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, tint) = (x.cosine(), x.get(Input::TINT));
    let m = (1.0 - c).named("m", "0 at normal incidence, 1 at grazing");
    let steps = steps(x, m);
    let m3 = (m.squared() * m).named("m3", "");
    let dip = (PEAK * c * m3.squared()).named("dip", "1 at 81.79 degrees");
    (steps.f0 + steps.rise * steps.weight + (tint * dip - dip) * steps.there).saturate()
}

fn less<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, tint) = (x.cosine(), x.get(Input::TINT));
    let m = (1.0 - c).named("m", "0 at normal incidence, 1 at grazing");
    let steps = steps(x, m);
    let m2 = m.squared().named("m2", "");
    let dip = (PEAK * dip(c, m2 * m2 * m)).named("dip", "1 at 81.79 degrees");
    let less = ((1.0 - tint) * steps.there).named("less", "what it lacks of F_S there");
    (steps.f0 + steps.rise * steps.weight - less * dip).saturate()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_its_three_colours() {
        check(&METHOD, 1.0, &[0.9, 0.7, 0.8, 5.0], 0.9);
        check(&METHOD, 0.0, &[0.9, 0.7, 0.8, 5.0], 0.8);
        let bare = 0.9 - 0.1 * (6.0f64 / 7.0).powi(3);
        check(&METHOD, 1.0 / 7.0, &[0.9, 0.7, 0.8, 3.0], 0.7 * bare);
    }

    #[test]
    fn with_white_edges_it_is_f82_tint() {
        for c in [0.9, 0.4, 0.1] {
            let tinted = value(&f82_tint::METHOD, c, &[0.9, 0.6]);
            check(&METHOD, c, &[0.9, 0.6, 1.0, 5.0], tinted);
        }
    }
}
