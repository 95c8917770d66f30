//! `F_s = (τ / u²)²`: the exact law for dielectrics and light polarised perpendicular to the plane of incidence.
//!
//! Source: as in `dielectric_exact` (Cook and Torrance, 1982, <https://doi.org/10.1145/357290.357293>).
//! Domain: η from 0.001 to 1e12, on both sides of 1; past the critical angle exactly 1, except at the number next to it.
//! Error: none in the model.

use super::dielectric_exact::{BELOW_ONE, COOK_TORRANCE_1982, steps};
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "dielectric_exact_s",
    summary: "the exact law for dielectrics, s-polarised light",
    formula: &[
        "t = (eta - 1)(eta + 1), u = sqrt(t + c^2) + c, F = (t / u^2)^2; 1 where t + c^2 < 0",
    ],
    source: COOK_TORRANCE_1982,
    inputs: &[Input::ETA],
    forms: Forms::ColourAndScalar,
    class: Class::Dielectric,
    light: Light::S,
    domain: "on both sides of 1; eta = 1 gives 0 at every angle. Past the critical angle exactly 1, but for the number next to its cosine, where rounding decides: 0.998 or more",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Dielectrics)],
        code_ulp: 0.0,
        ..Claims::NONE
    },
    half: InHalf::within_but(0.0012, BELOW_ONE).ending(&[("eta", 255.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let steps = steps(x);
    steps.reflected(steps.s())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_its_limits() {
        check(&METHOD, 1.0, &[1.5], 0.04);
        check(&METHOD, 0.0, &[1.5], 1.0);
        check(&METHOD, 0.5, &[1.0], 0.0);
        check(&METHOD, 0.5, &[0.5], 1.0);
    }
}
