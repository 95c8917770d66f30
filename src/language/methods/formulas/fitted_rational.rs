//! `F = c0 + a (c1 + r (c2 + q c3))`, `r = 1 / (c + .144)`, `q = √r`, `a = 1 / (c² + .112) - q`, c = cos θ: four coefficients a
//! channel, without an exponential.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>.
//! A search among products of cheap factors found the nesting and its constants for Mali-G72, where an exponential is expensive:
//! it costs half a bundle more than Schlick. On other GPUs
//! [`fitted`](crate::language::methods::formulas::fitted) is cheaper, and no worse.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims.

use super::fitted::{FITTED, FLOOR};
use super::*;

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[
        Factor::Peak(0.112, 0.144),
        Factor::Reciprocal(0.144),
        Factor::Root(0.144),
    ],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_rational",
    summary: "four coefficients fitted to a metal or semiconductor, without an exponential",
    formula: &[
        "F = c0 + a (c1 + r (c2 + q c3)), limited to [0, 1]",
        "r = 1 / (c + 0.144), q = sqrt(r), a = 1 / (c^2 + 0.112) - q",
    ],
    claims: Claims {
        model: &[
            Claim::dielectrics(0.0034, 48.4),
            Claim::metals(0.0098, 64.8),
        ],
        code_ulp: 8.5,
        code_over: MediaSet::Metals,
        by_class: &[
            ByClass::of_class("metal", [0.0022, 0.0036], [0.0023, 0.0100], 0.0037),
            ByClass::of_class("semiconductor", [0.0027, 0.0039], [0.0026, 0.0056], 0.0054),
            ByClass::of_class("dielectric", [0.0030, 0.0033], [0.0030, 0.0033], 0.0033),
        ],
        ..Claims::NONE
    },
    half: InHalf::within_over(0.0025, MediaSet::Metals, FLOOR).materials_within(0.003),
    build: |x| SHAPE.build(x),
    shape: Some(SHAPE),
    ..FITTED
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_c0_and_what_its_factors_add() {
        check(&METHOD, 1.0, &[0.5, 0.0, 0.0, 0.0], 0.5);
        // a is 1/.112 - 1/√.144 at grazing.
        let a = 1.0 / 0.112 - 1.0 / 0.144_f64.sqrt();
        check(&METHOD, 0.0, &[0.25, 0.5 / a, 0.0, 0.0], 0.75);
        check(&METHOD, 0.0, &[0.25, 0.0, 0.5 * 0.144 / a, 0.0], 0.75);
    }
}
