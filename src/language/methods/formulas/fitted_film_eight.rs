//! `F = c0 + g (c1 + c (c2 + g (c3 + c (c4 + g (c5 + c (c6 + g c7))))))`, `g = log2(c + .08)`, c = cos θ: eight coefficients a channel,
//! for a material under films of up to a micrometre.
//!
//! Source: ours, as [`fitted_film`](crate::language::methods::formulas::fitted_film), by the exchange of Stiefel 1959,
//! <https://doi.org/10.1007/BF01386369>. Each coefficient more follows about half a fringe more. Powers of the cosine alone, or of roots and
//! quotients beside it, cancel: with the logarithm no step loses more than a few ulp. A cosine or sine of the film's own phase as a
//! factor was tried, and follows no more for the same cost.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims; of films of 500 to 1000 nm .003 in the
//! median, .012 at the 90th percentile, .016 at most, over forty of index 1.3 to 2.4 on six bases.

use super::fitted::FITTED;
use super::*;

const LOGARITHM: Factor = Factor::Logarithm(0.08, 0.0);

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[
        LOGARITHM,
        Factor::Cosine,
        LOGARITHM,
        Factor::Cosine,
        LOGARITHM,
        Factor::Cosine,
        LOGARITHM,
    ],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_film_eight",
    summary: "eight coefficients fitted to a material under thicker films",
    formula: &[
        "F = c0 + g (c1 + c (c2 + g (c3 + c (c4 + g (c5 + c (c6 + g c7)))))), limited to [0, 1]",
        "g = log2(c + 0.08)",
    ],
    inputs: &Input::COEFFICIENTS,
    class: Class::Film,
    claims: Claims {
        model: &[
            Claim::dielectrics(0.000072, 19.8),
            Claim::metals(0.0022, 21.5),
        ],
        code_ulp: 0.0,
        code_over: MediaSet::Metals,
        by_class: &[ByClass::of_class(
            "film",
            [0.0004, 0.0061],
            [0.0003, 0.0051],
            0.0062,
        )],
        ..Claims::NONE
    },
    half: InHalf::Refused("its terms cancel, and half precision loses up to .03"),
    build: |x| SHAPE.build(x),
    shape: Some(SHAPE),
    ..FITTED
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_of_its_terms() {
        let given = [0.3, 0.1, 0.02, 0.05, 0.02, 0.01, -0.03, 0.04];
        for c in [0.0, 0.2, 1.0] {
            let g = libm::log2(c + 0.08);
            let [c0, c1, c2, c3, c4, c5, c6, c7] = given;
            let sum = c0 + g * (c1 + c * (c2 + g * (c3 + c * (c4 + g * (c5 + c * (c6 + g * c7))))));
            check(&METHOD, c, &given, sum.clamp(0.0, 1.0));
        }
    }
}
