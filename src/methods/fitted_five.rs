//! `F = c0 + b (c1 + b (c2 + b (c3 + b c4)))`, `b = (1 - cos θ)² / (1 + 3.5 cos θ)`: five coefficients a channel.
//!
//! Source: ours, as [`fitted`](super::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>: one
//! coefficient and one division more, a fifth of the error, for all classes. Of all a in steps of a half, 3.5 has the
//! least 90th percentile over metals and semiconductors.
//! Domain: any coefficients; the result is limited to [0, 1]. Error: see [`METHOD`]'s claims.

use crate::ir::Expr;

use super::fitted::{NOT_IN_HALF, STIEFEL_1959};
use super::half::InHalf;
use super::input::{Input, Inputs};
use super::method::{Claim, Claims, Class, Contract, Forms, Light, Method, Over};
use super::shape::{Base, Shape};

/// The shape.
const SHAPE: Shape = Shape {
    base: Base::Rational(3.5),
    steps: &[1, 1, 1, 1],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_five",
    summary: "five coefficients fitted to a metal, or a dielectric of n 1.2 or more",
    formula: &[
        "F = c0 + b (c1 + b (c2 + b (c3 + b c4))), limited to [0, 1]",
        "b = (1 - c)^2 / (1 + 3.5 c)",
    ],
    source: STIEFEL_1959,
    inputs: &Input::COEFFICIENTS,
    forms: Forms::ColourAndScalar,
    class: Class::Any,
    light: Light::Unpolarised,
    domain: "any coefficients; limited to [0, 1]",
    claims: Claims {
        model: &[
            Claim {
                over: Over::Dielectrics,
                max_abs: 0.0011,
                at_degrees: 54.1,
            },
            Claim {
                over: Over::Metals,
                max_abs: 0.0026,
                at_degrees: 85.9,
            },
        ],
        code_ulp: 6.0,
        code_over: Over::Metals,
    },
    contract: Contract::Kept,
    half: InHalf::Refused(NOT_IN_HALF),
    build,
    plain: None,
    specialised: None,
    shape: Some(SHAPE),
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    SHAPE.build(x)
}

#[cfg(test)]
mod tests {
    use super::super::limits::check;
    use super::METHOD;

    #[test]
    fn it_begins_at_c0_and_ends_at_the_sum() {
        check(&METHOD, 1.0, &[0.5, 0.25, 0.5, 0.5, 0.5], 0.5);
        check(&METHOD, 0.0, &[0.5, 0.25, 0.125, 0.0625, -0.5], 0.4375);
    }
}
