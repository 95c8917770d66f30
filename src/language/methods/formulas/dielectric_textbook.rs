//! `R_s = |(cos θ - n √(1-(sin θ/n)²)) / (cos θ + n √(1-(sin θ/n)²))|²`, `R_p` alike with the roles exchanged,
//! `R = (R_s + R_p) / 2`: the exact law for dielectrics as textbooks and the thesis (eqs. 1-3) print it.
//!
//! Source: Pharr and Humphreys, "Physically Based Rendering", 2nd edition, 2010, section 8.2,
//! <https://www.pbr-book.org>; as printed in the thesis. Kept for comparison: no guard, no clamp.
//! Domain: n > 1, 0 ≤ cos θ ≤ 1. Error: none in the model, but the code loses thousands of ulp as n tends
//! to 1, and gives NaN past the critical angle.

use super::*;

/// Physically Based Rendering, second edition.
pub const PBRT_2010: Citation = Citation {
    authors: "Pharr, Humphreys",
    title: "Physically Based Rendering: From Theory to Implementation, 2nd edition",
    place: "Morgan Kaufmann, section 8.2",
    year: 2010,
    link: "https://www.pbr-book.org",
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "dielectric_textbook",
    summary: "the exact law for dielectrics as textbooks print it, for comparison",
    formula: &[
        "root = sqrt(1 - (sin_theta / eta)^2)",
        "R_s = ((cos_theta - eta root) / (cos_theta + eta root))^2, R_p = ((root - eta cos_theta) / (root + eta cos_theta))^2",
        "F = (R_s + R_p) / 2",
    ],
    source: PBRT_2010,
    inputs: &[Input::ETA],
    forms: Forms::ColourAndScalar,
    class: Class::Dielectric,
    domain: "eta > 1 and 0 <= cos_theta <= 1",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Dielectrics)],
        code_ulp: 11000.0,
        ..Claims::NONE
    },
    contract: Contract::Exempt(
        "NaN past the critical angle; thousands of ulp as eta tends to 1; no clamp; NaN, not 0, at eta = 1 and 90 degrees",
    ),
    half: InHalf::Refused(
        "1 - (sin theta / n)^2 cancels as n tends to 1, and nothing guards the root",
    ),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, n) = (x.raw_cosine(), x.get(Input::ETA));
    let sin2_t = ((1.0 - c * c) / (n * n)).named("sin2_t", "Snell: (sin theta / n)^2");
    let root = (1.0 - sin2_t)
        .sqrt()
        .named("root", "cosine of the refracted ray");
    let nr = (n * root).named("n_root", "");
    let nc = (n * c).named("n_cos", "");
    let r_s = ((c - nr) / (c + nr)).named("r_s", "thesis, eq. 1");
    let r_p = ((root - nc) / (root + nc)).named("r_p", "thesis, eq. 2");
    0.5 * (r_s.squared() + r_p.squared())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_its_limits() {
        check(&METHOD, 1.0, &[1.5], 0.04);
        check(&METHOD, 0.0, &[1.5], 1.0);
    }
}
