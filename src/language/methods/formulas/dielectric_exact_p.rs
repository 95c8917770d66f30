//! `F_p = (r_s B)²`: the exact law for dielectrics and light polarised in the plane of incidence.
//!
//! Source: as in `dielectric_exact` (Cook and Torrance, 1982, <https://doi.org/10.1145/357290.357293>).
//! Domain: η from 0.001 to 1e12, on both sides of 1; past the critical angle exactly 1, except at the number next to it; 0 at
//! Brewster's angle (tan θ = η). Error: none in the model; at Brewster's zero only an absolute bound makes sense.

use super::dielectric_exact::{BELOW_ONE, COOK_TORRANCE_1982, steps};
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "dielectric_exact_p",
    summary: "the exact law for dielectrics, p-polarised light",
    formula: &[
        "t = (eta - 1)(eta + 1), u = sqrt(t + c^2) + c, r_s = t / u^2",
        "F = (r_s (c u - 1) / (c t / u + 1))^2; 1 where t + c^2 < 0",
    ],
    source: COOK_TORRANCE_1982,
    inputs: &[Input::ETA],
    forms: Forms::ColourAndScalar,
    class: Class::Dielectric,
    light: Light::P,
    domain: "on both sides of 1; 0 at Brewster's angle. Past the critical angle exactly 1, but for the number next to its cosine, where rounding \
             decides: 0.98 or more for eta from 0.25 on",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Dielectrics)],
        code_ulp: 14.5,
        ..Claims::NONE
    },
    half: InHalf::within_but(0.0022, BELOW_ONE).ending(&[("eta", 180.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let steps = steps(x);
    steps.reflected(steps.p())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brewsters_angle_reflects_nothing() {
        let eta: f64 = 1.5;
        check(&METHOD, 1.0 / (1.0 + eta * eta).sqrt(), &[eta], 0.0);
    }

    #[test]
    fn it_meets_its_limits() {
        check(&METHOD, 1.0, &[1.5], 0.04);
        check(&METHOD, 0.0, &[1.5], 1.0);
        check(&METHOD, 0.5, &[0.5], 1.0);
    }
}
