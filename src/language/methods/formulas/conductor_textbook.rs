//! `F_s = (a²+b²-2a cos θ+cos²θ)/(a²+b²+2a cos θ+cos²θ)`, `F_p = F_s (a²+b²-2a sin θ tan θ+sin²θ tan²θ)/(…+…)`,
//! `F = (F_s+F_p)/2`, `2a², 2b² = √((n²-k²-sin²θ)²+4n²k²) ± (n²-k²-sin²θ)`: the exact law for conductors as
//! printed in the thesis (eqs. 8-12).
//!
//! Source: Glassner, "Principles of Digital Image Synthesis", Morgan Kaufmann, 1995,
//! <https://www.realtimerendering.com/Principles_of_Digital_Image_Synthesis_v1.0.1.pdf>; as printed in the thesis.
//! Kept for comparison: no guard, no clamp.
//! Domain: k > 0, 0 < cos θ ≤ 1. Error: none in the model, but the code loses thousands of ulp where k is small. It is NaN at
//! exactly 90 degrees, where tan θ is infinite, and for cos θ of 1 + 1 ulp, where sin²θ is negative.

use super::*;

/// Principles of Digital Image Synthesis.
pub const GLASSNER_1995: Citation = Citation {
    authors: "Glassner",
    title: "Principles of Digital Image Synthesis",
    place: "Morgan Kaufmann",
    year: 1995,
    link: "https://www.realtimerendering.com/Principles_of_Digital_Image_Synthesis_v1.0.1.pdf",
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "conductor_textbook",
    summary: "the exact law for conductors as textbooks print it, for comparison",
    formula: &[
        "2 a^2, 2 b^2 = sqrt((n^2 - k^2 - sin^2)^2 + 4 n^2 k^2) + or - (n^2 - k^2 - sin^2)",
        "F_s = (a^2 + b^2 - 2 a cos + cos^2) / (a^2 + b^2 + 2 a cos + cos^2)",
        "F_p = F_s (a^2 + b^2 - 2 a sin tan + sin^2 tan^2) / (a^2 + b^2 + 2 a sin tan + sin^2 tan^2)",
        "F = (F_s + F_p) / 2",
    ],
    source: GLASSNER_1995,
    inputs: &[Input::N, Input::K],
    domain: "k > 0 and 0 < cos_theta <= 1",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Metals)],
        code_ulp: 7000.0,
        ..Claims::NONE
    },
    contract: Contract::Exempt(
        "NaN at exactly 90 degrees and for cos_theta above 1; thousands of ulp where k is small; no clamp",
    ),
    half: InHalf::Refused(
        "differences of nearly equal numbers, and squares of squares that overflow",
    ),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, n, k) = (x.raw_cosine(), x.get(Input::N), x.get(Input::K));
    let c2 = c.squared().named("cos2", "");
    let sin2 = (1.0 - c2).named("sin2", "");
    let sin = sin2.sqrt().named("sin_theta", "");
    let (n2, k2) = (n.squared().named("n2", ""), k.squared().named("k2", ""));
    let t = (n2 - k2 - sin2).named("t", "n^2 - k^2 - sin^2 theta");
    let root = (t.squared() + 4.0 * n2 * k2).sqrt().named("root", "");
    let a2 = (0.5 * (root + t)).named("a2", "thesis, eq. 8");
    let b2 = (0.5 * (root - t)).named("b2", "thesis, eq. 9");
    let a = a2.sqrt().named("a", "");
    let twice = (2.0 * a).named("twice_a", "");
    let sum = (a2 + b2).named("sum", "");
    let across = (twice * c).named("across", "");
    let f_s = ((sum - across + c2) / (sum + across + c2)).named("f_s", "thesis, eq. 10");
    let sin_tan = (sin * (sin / c)).named("sin_tan", "sin theta tan theta");
    let along = (twice * sin_tan).named("along", "");
    let square = sin_tan.squared().named("square", "");
    let f_p = f_s * ((sum - along + square) / (sum + along + square));
    0.5 * (f_s + f_p.named("f_p", "thesis, eq. 11"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_normal_incidence() {
        check(&METHOD, 1.0, &[1.5, 0.0], 0.04);
        check(&METHOD, 1.0, &[0.23, 3.94], 16.1165 / 17.0365);
    }

    #[test]
    fn it_fails_at_grazing_as_its_record_says() {
        assert!(value(&METHOD, 0.0, &[1.5, 1.0]).is_nan());
    }
}
