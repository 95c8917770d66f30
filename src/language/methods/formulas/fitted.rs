//! `F = c0 + b (c1 + b (c2 + b c3))`, `b = 2^(-6.5 cos θ)`: four coefficients a channel.
//!
//! Source: ours, by the exchange of Stiefel, "Über diskrete und lineare Tschebyscheff-Approximationen", 1959,
//! <https://doi.org/10.1007/BF01386369>. The coefficients minimise the largest error over all angles (`fit`), for any F, such as
//! a spectrum in any colour space. F is linear in them, so they can be blended, filtered and interpolated like colours.
//! The base and its 6.5 were found by a search over metals and semiconductors.
//! In half precision rounding alone costs about .001, the floor of the type. Coefficients are rounded one by one in the fit, so that
//! the others compensate (`fit --precision f16`), and the formula loses at most what is promised.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims.

use super::*;

/// The source of the exchange algorithm that finds the coefficients of all fitted methods.
pub const STIEFEL_1959: Citation = Citation {
    authors: "Stiefel",
    title: "Ueber diskrete und lineare Tschebyscheff-Approximationen",
    place: "Numerische Mathematik 1, 1-28",
    year: 1959,
    link: "https://doi.org/10.1007/BF01386369",
};

/// What methods of fitted coefficients have in common.
pub(super) const FITTED: Method = Method {
    source: STIEFEL_1959,
    origin: Origin::Ours("algorithm of the fit"),
    inputs: &[Input::C0, Input::C1, Input::C2, Input::C3],
    forms: Forms::ColourAndScalar,
    domain: "limited to [0, 1]",
    ..Method::BASE
};

/// What half precision requires of callers of fitted methods, and where it fails.
pub(super) const FLOOR: &str = "take coefficients that were fitted for half precision; near n = 1 large ones cancel, and up to .01 is lost, of five terms .1";

/// The shape. Of all exponents in steps of .5, 6.5 has the smallest 90th percentile over metals and semiconductors.
const SHAPE: Shape = Shape {
    factors: &[Factor::Exponential(6.5); 3],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted",
    summary: "four coefficients fitted to a metal or semiconductor",
    formula: &["F = c0 + b (c1 + b (c2 + b c3)), b = 2^(-6.5 c), limited to [0, 1]"],
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0038, 53.9),
            Claim::metals(0.0085, 81.5),
        ],
        code_ulp: 0.0,
        code_over: MediaSet::Metals,
        by_class: &[
            ByClass::of_class("metal", [0.0020, 0.0030], [0.0019, 0.0118], 0.0032),
            ByClass::of_class("semiconductor", [0.0040, 0.0052], [0.0036, 0.0066], 0.0064),
            ByClass::of_class("dielectric", [0.0036, 0.0038], [0.0030, 0.0037], 0.0038),
        ],
        ..Claims::NONE
    },
    half: InHalf::within_over(0.0013, MediaSet::Metals, FLOOR),
    build: |x| SHAPE.build(x),
    shape: Some(SHAPE),
    ..FITTED
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_at_grazing_and_limited() {
        check(&METHOD, 0.0, &[0.5, 0.25, 0.125, 0.0625], 0.9375);
        check(&METHOD, 0.0, &[0.5, 0.5, 0.5, 0.5], 1.0);
        check(&METHOD, 0.0, &[-0.5, 0.0, 0.0, 0.0], 0.0);
        // b is 1/4.
        let sum = 0.5 + 0.25 + 0.0625 + 0.015625;
        check(&METHOD, 2.0 / 6.5, &[0.5, 1.0, 1.0, 1.0], sum);
    }
}
