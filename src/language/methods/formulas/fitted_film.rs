//! `F = c0 + t (c1 + y (c2 + q (c3 + g² (c4 + b c5))))`, `t = 1/√(c + .084)`, `y = c (c + .102)`, `q = 1/√(c + .031)`, `g = 1 - c`,
//! `b = 2^(-12.7 c)`, c = cos θ: six coefficients a channel, for a material under films.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>. A film of
//! fixed thickness is one more F of the cosine, and few terms follow it: fringes of one wavelength are sharp, those of a third of the
//! spectrum are not. The factors and their constants are from a search over the films of `data/records/films.csv`, by the largest of
//! median, 90th percentile and worst error. The six shared curves that follow these films best, whatever they are, err by .0015 in the
//! median and .0161 at the 90th percentile (principal components), or by .0018 and .0151.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims. A film thicker than about half a
//! micrometre has more fringes than six terms follow: the error in the function's head says so, and a table has them all.

use super::fitted::{FITTED, FLOOR};
use super::*;

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[
        Factor::Root(0.084),
        Factor::Rising(0.102),
        Factor::Root(0.031),
        Factor::Grazing(2),
        Factor::Exponential(12.7),
    ],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_film",
    summary: "six coefficients fitted to a material under films",
    formula: &[
        "F = c0 + t (c1 + y (c2 + q (c3 + g^2 (c4 + b c5)))), limited to [0, 1]",
        "t = 1/sqrt(c + 0.084), y = c (c + 0.102), q = 1/sqrt(c + 0.031), g = 1 - c, b = 2^(-12.7 c)",
    ],
    inputs: &Input::COEFFICIENTS,
    class: Class::Film,
    claims: Claims {
        model: &[
            Claim::dielectrics(0.001, 30.3),
            Claim::metals(0.0041, 33.1),
        ],
        code_ulp: 22.0,
        code_over: MediaSet::Metals,
        by_class: &[ByClass::of_class("film", [0.0015, 0.015], [0.0014, 0.0124], 0.0146)],
        ..Claims::NONE
    },
    half: InHalf::within_over(0.0028, MediaSet::Metals, FLOOR).materials_within(0.0026),
    build: |x| SHAPE.build(x),
    shape: Some(SHAPE),
    ..FITTED
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_of_its_terms() {
        // At normal incidence g and what follows it vanish, at grazing y.
        let (t, q) = (1.0 / 1.084_f64.sqrt(), 1.0 / 1.031_f64.sqrt());
        let sum = 0.3 + t * (0.2 + 1.102 * (0.1 + q * 0.05));
        check(&METHOD, 1.0, &[0.3, 0.2, 0.1, 0.05, 9.0, 9.0], sum);
        check(&METHOD, 0.0, &[0.3, 0.1, 9.0, 9.0, 9.0, 9.0], 0.3 + 0.1 / 0.084_f64.sqrt());
    }
}
