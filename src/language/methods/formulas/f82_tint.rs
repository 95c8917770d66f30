//! `F = F_S(c) - b c (1-c)⁶`, `b = F_S(1/7) (1 - tint) / (1/7 (6/7)⁶)`, F_S being Schlick's approximation: the
//! reflectance at 81.79 degrees is `tint` times Schlick's.
//!
//! Source: Kutz, Hašan and Edmondson, "Novel aspects of the Adobe Standard Material", 2021,
//! <https://helpx.adobe.com/substance-3d-general/adobe-standard-material.html>.
//! With 1 / (1/7 (6/7)⁶) = 7⁷/6⁶, b = (49/46656) (1 - tint) (7776 + 9031 F0), exactly.
//! Domain: F0, tint ≥ 0. For tints below .52 the bare formula turns negative (to -.127). For tints above 1 it can exceed
//! 1. The result is clamped to [0, 1]. Error: [`METHOD`]'s claims.

use super::hoffman_f82::{WEIGHT_82, affine_weights, dip};
use super::schlick::grazing_weight;
use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const TINT: Input = Input::rgb(
        "tint",
        "reflectance at 81.79 degrees over Schlick's value there",
        [0.0, 2.0],
        InputSource::Material(|known| each_channel(|i| known.f82[i] / schlick_82(known.f0[i]))),
    )
    .tried(&[1.0, 0.0, 0.4, 1.4])
    .scanned(&[
        -0.5, 0.0, 1e-4, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1.0, 1.01, 1.1, 1.44, 2.0, 8.0,
    ]);
}

/// 7² / 6⁶.
const SCALE: f64 = 49.0 / 46_656.0;

/// Schlick's value at cos θ = 1/7, where the weight is (6/7)⁵.
pub fn schlick_82(f0: f64) -> f64 {
    f0 + (1.0 - f0) * 7_776.0 / 16_807.0
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "f82_tint",
    summary: "Schlick's approximation corrected to a tint at 81.79 degrees",
    formula: &[
        "F = F0 + (1 - F0) (1 - c)^5 - b c (1 - c)^6, limited to [0, 1]",
        "b = (49 / 46656) (1 - tint) (7776 + 9031 F0)",
    ],
    source: Citation {
        authors: "Kutz, Hasan, Edmondson",
        title: "Novel aspects of the Adobe Standard Material",
        place: "Adobe",
        year: 2021,
        link: "https://helpx.adobe.com/substance-3d-general/adobe-standard-material.html",
    },
    inputs: &[Input::F0, Input::TINT],
    domain: "the result is limited to [0, 1], of f0 above 1 too",
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0341, 67.8),
            Claim::metals(0.0837, 87.3),
        ],
        code_ulp: 6.0,
        colours: ColourClaim::within(6e-7),
        ..Claims::NONE
    },
    half: InHalf::within(0.0016),
    build,
    variants: &[&DIP_FIRST],
    for_constants: Some(for_constants),
    affine: Some(Affine {
        numbers: &[
            "f0",
            "1 - f0",
            "(tint - 1) * (f0 + (1 - f0) * 7776 / 16807)",
        ],
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

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (f0, tint) = (x.get(Input::F0), x.get(Input::TINT));
    let m5 = grazing_weight(x);
    let dip = dip(x.cosine(), m5).named("dip", "c (1 - c)^6");
    let of_f0 = (SCALE * 9031.0 * dip).named("of_f0", "");
    let of_white = (SCALE * 7776.0 * dip).named("of_white", "");
    let first = (1.0 - m5 - of_f0).named("first", "the weight of f0 where the tint is 0");
    let second = (m5 - of_white).named("second", "the weight of white where the tint is 0");
    let bare = f0 * (tint * of_f0 + first) + (tint * of_white + second);
    bare.saturate()
}

/// `F0 + (1 - c)^5 (1 - F0 + (tint b - b) c (1 - c))`. With a tint of 1 the difference is 0, since both products round alike.
fn dip_first<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (f0, tint) = (x.get(Input::F0), x.get(Input::TINT));
    let b =
        (SCALE * 9031.0 * f0 + SCALE * 7776.0).named("b", "the depth of the dip without a tint");
    let c = x.cosine();
    let m5 = grazing_weight(x);
    let arch = (c * (1.0 - c)).named("arch", "c (1 - c)");
    (f0 + m5 * (1.0 - f0 + (tint * b - b) * arch)).saturate()
}

fn for_constants<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (f0, tint) = (x.get(Input::F0), x.get(Input::TINT));
    let (scale, less) = (SCALE, 1.0 - tint);
    let b = if x.is_half() {
        less * (scale * 7776.0 + scale * 9031.0 * f0)
    } else {
        scale * less * (7776.0 + 9031.0 * f0)
    };
    let b = b.named("b", "the depth of the dip");
    let m5 = grazing_weight(x);
    let bare =
        (f0 + (1.0 - f0) * m5 - b * dip(x.cosine(), m5)).named("bare", "Schlick less the dip");
    bare.saturate()
}

/// F0, 1 - F0, and the difference between F82 and Schlick's value that the tint makes.
fn numbers<'b>(x: &Inputs<'b>) -> Vec<Expr<'b>> {
    let f0 = x.get(Input::F0);
    let rise = (1.0 - f0).named("rise", "");
    vec![
        f0,
        rise,
        (x.get(Input::TINT) - 1.0) * (f0 + WEIGHT_82 * rise),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_f0_the_tint_and_one() {
        let c = 1.0 / 7.0;
        check(&METHOD, 1.0, &[0.6, 0.8], 0.6);
        check(&METHOD, 0.0, &[0.6, 0.8], 1.0);
        let schlick = value(&METHOD, c, &[0.6, 1.0]);
        check(&METHOD, c, &[0.6, 0.8], 0.8 * schlick);
    }

    #[test]
    fn where_the_bare_formula_turns_negative_it_gives_zero() {
        check(&METHOD, 0.2, &[0.0, 0.0], 0.0);
    }
}
