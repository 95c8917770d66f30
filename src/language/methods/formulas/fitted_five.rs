//! `F = c0 + b (c1 + q (c2 + b (c3 + c c4)))`, `b = 2^(-11 c)`, `q = c² + .094`, c = cos θ: five coefficients a channel.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>: one
//! coefficient more, a quarter of the error. A search among products of cheap factors found the nesting and its constants
//! for Adreno 330, where it costs no more than four coefficients do. Coefficients reach some hundreds and cancel: single
//! precision has enough digits for that, half precision has not.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims.

use super::fitted::{FITTED, FLOOR};
use super::*;

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[
        Factor::Exponential(11.0),
        Factor::Square(0.094),
        Factor::Exponential(11.0),
        Factor::Cosine,
    ],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_five",
    summary: "five coefficients fitted to a metal or semiconductor",
    formula: &[
        "F = c0 + b (c1 + q (c2 + b (c3 + c c4))), limited to [0, 1]",
        "b = 2^(-11 c), q = c^2 + 0.094",
    ],
    inputs: &[Input::C0, Input::C1, Input::C2, Input::C3, Input::C4],
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0016, 74.4),
            Claim::metals(0.0023, 23.8),
        ],
        code_ulp: 8.0,
        code_over: MediaSet::Metals,
        by_class: &[
            ByClass::of_class("metal", [0.0006, 0.0011], [0.0006, 0.0071], 0.0012),
            ByClass::of_class("semiconductor", [0.0005, 0.0005], [0.0006, 0.0008], 0.0008),
            ByClass::of_class("dielectric", [0.0015, 0.0015], [0.0013, 0.0015], 0.0015),
        ],
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
    fn it_begins_near_c0_and_ends_at_a_sum() {
        // At normal incidence 2^-11 of the brackets is left.
        check(&METHOD, 1.0, &[0.5, 0.0, 0.0, 0.0, 0.0], 0.5);
        check(&METHOD, 1.0, &[0.0, 1024.0, 0.0, 0.0, 0.0], 0.5);
        check(&METHOD, 0.0, &[0.5, 0.25, 0.0, 0.0, 7.0], 0.75);
    }
}
