//! `F = c0 + s (c1 + w (c2 + u (c3 + b (c4 + q c5))))`, `s = c² - .96`, `q = 1/√(c + .145)`, `w = (1 - c)² q²`, `u = c² - .785`,
//! `b = 2^(-7.7 c)`, c = cos θ: six coefficients a channel, for a material under films.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>. A film of
//! fixed thickness is one more F of the cosine, and few terms follow it: fringes of one wavelength are sharp, those of a third of the
//! spectrum are not. The factors and their constants are from a search over the films of `data/records/films.csv`, by the largest of
//! median, 90th percentile and worst error. The six shared curves that follow these films best, whatever they are, err by .0015 in the
//! median and .0161 at the 90th percentile (principal components), or by .0018 and .0151.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims. A film thicker than about half a
//! micrometre has more fringes than six terms follow: the error in the function's head says so, and a table has them all.

use super::fitted::FITTED;
use super::*;

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[
        Factor::Square(-0.96),
        Factor::Glancing(0.145),
        Factor::Square(-0.785),
        Factor::Exponential(7.7),
        Factor::Root(0.145),
    ],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_film",
    summary: "six coefficients fitted to a material under films",
    formula: &[
        "F = c0 + s (c1 + w (c2 + u (c3 + b (c4 + q c5)))), limited to [0, 1]",
        "s = c^2 - 0.96, q = 1/sqrt(c + 0.145), w = (1 - c)^2 q^2, u = c^2 - 0.785, b = 2^(-7.7 c)",
    ],
    inputs: &Input::COEFFICIENTS,
    class: Class::Film,
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0012, 34.0),
            Claim::metals(0.0042, 37.7),
        ],
        code_ulp: 6.5,
        code_over: MediaSet::Metals,
        by_class: &[ByClass::of_class(
            "film",
            [0.0016, 0.0160],
            [0.0019, 0.0124],
            0.0152,
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
        // At normal incidence w and what follows it vanish.
        check(&METHOD, 1.0, &[0.3, 0.2, 9.0, 9.0, 9.0, 9.0], 0.308);
        let q = 1.0 / 0.145_f64.sqrt();
        let sum = 0.7 - 0.96 * (0.1 + q * q * (0.02 - 0.785 * (0.05 + 0.02 + q * 0.01)));
        check(&METHOD, 0.0, &[0.7, 0.1, 0.02, 0.05, 0.02, 0.01], sum);
        check(&METHOD, 0.0, &[-0.5, 0.0, 0.0, 0.0, 0.0, 0.0], 0.0);
    }
}
