//! `F = c0 + s (c1 + u (c2 + u (c3 + c (c4 + c c5))))`, `g = log2(c + .09)`, `s = g² - .75`, `u = g + 1.58`, c = cos θ: six
//! coefficients a channel, for a material under films.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>. A film of
//! fixed thickness is one more F of the cosine, and few terms follow it: fringes of one wavelength are sharp, those of a third of the
//! spectrum are not. Between grazing and normal incidence its fringes are spread as the logarithm of c + p is, which bends near grazing
//! as a root does and cancels less. Factors and constants are from a search over the films of `data/records/films.csv`, by the largest
//! of median, 90th percentile and worst error, among forms that lose few digits. The six shared curves that follow these films best,
//! whatever they are, err by .0015 in the median and .0161 at the 90th percentile (principal components), or by .0018 and .0151.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims. A film thicker than about half a
//! micrometre has more fringes than six terms follow: `fitted_film_eight` follows more of them, and the error in the function's head
//! says what is left.

use super::fitted::FITTED;
use super::*;

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[
        Factor::LogarithmSquared(0.09, -0.75),
        Factor::Logarithm(0.09, 1.58),
        Factor::Logarithm(0.09, 1.58),
        Factor::Cosine,
        Factor::Cosine,
    ],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_film",
    summary: "six coefficients fitted to a material under films",
    formula: &[
        "F = c0 + s (c1 + u (c2 + u (c3 + c (c4 + c c5)))), limited to [0, 1]",
        "g = log2(c + 0.09), s = g^2 - 0.75, u = g + 1.58",
    ],
    inputs: Input::COEFFICIENTS.split_at(6).0,
    class: Class::Film,
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0011, 35.6),
            Claim::metals(0.0047, 63.0),
        ],
        code_ulp: 4.5,
        code_over: MediaSet::Metals,
        by_class: &[ByClass::of_class(
            "film",
            [0.0015, 0.0149],
            [0.0019, 0.0079],
            0.0138,
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
        for c in [0.0, 0.2, 1.0] {
            let g = libm::log2(c + 0.09);
            let (s, u) = (g * g - 0.75, g + 1.58);
            let sum = 0.3 + s * (0.1 + u * (0.02 + u * (0.05 + c * (0.02 + c * 0.01))));
            check(
                &METHOD,
                c,
                &[0.3, 0.1, 0.02, 0.05, 0.02, 0.01],
                sum.clamp(0.0, 1.0),
            );
        }
        check(&METHOD, 0.0, &[-0.5, 0.0, 0.0, 0.0, 0.0, 0.0], 0.0);
    }
}
