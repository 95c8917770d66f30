//! `F = c0 + b³ (c1 + b⁴ (c2 + b⁷ c3))`, `b = 1 - cos θ`: four coefficients a channel for dielectrics.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>.
//! Powers follow the low reflectance of a dielectric away from grazing more closely than an exponential does. There a small
//! error is a large relative one. Among integer exponents 0, 3, 7 and 14 are second best (.0011 at the 90th percentile of
//! glasses; 0, 3, 7 and 13: .0010).
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims.

use crate::language::ir::Expr;
use crate::language::methods::formulas::fitted::{FLOOR, STIEFEL_1959};
use crate::language::methods::half::InHalf;
use crate::language::methods::input::{Input, Inputs};
use crate::language::methods::method::{
    ByClass, Claim, Claims, Class, Forms, Method, Origin, Over,
};
use crate::language::methods::shape::{Factor, Shape};

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[Factor::Grazing(3), Factor::Grazing(4), Factor::Grazing(7)],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_dielectric",
    summary: "four coefficients fitted to a dielectric of n 1.2 or more",
    formula: &["F = c0 + b^3 (c1 + b^4 (c2 + b^7 c3)), b = 1 - c, limited to [0, 1]"],
    source: STIEFEL_1959,
    origin: Origin::Ours("algorithm of the fit"),
    inputs: &[Input::C0, Input::C1, Input::C2, Input::C3],
    forms: Forms::ColourAndScalar,
    class: Class::Dielectric,
    domain: "limited to [0, 1]",
    claims: Claims {
        model: &[Claim {
            over: Over::Dielectrics,
            max_abs: 0.0012,
            at_degrees: 48.4,
        }],
        code_ulp: 7.5,
        code_over: Over::Dielectrics,
        colours: None,
        by_class: &[ByClass::of_class(
            "dielectric",
            [0.0007, 0.0011],
            [0.0011, 0.0012],
            0.0012,
        )],
    },
    half: InHalf::within_over(0.0015, Over::Dielectrics, FLOOR),
    build,
    shape: Some(SHAPE),
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    SHAPE.build(x)
}

#[cfg(test)]
mod tests {
    use super::METHOD;
    use crate::language::methods::limits::check;

    #[test]
    fn it_begins_at_c0_and_ends_at_the_sum() {
        check(&METHOD, 1.0, &[0.04, 0.5, 0.25, 0.125], 0.04);
        check(&METHOD, 0.0, &[0.04, 0.5, 0.25, 0.125], 0.915);
        check(
            &METHOD,
            0.5,
            &[0.25, 0.5, 0.25, 0.0],
            0.25 + 0.0625 + 0.25 / 128.0,
        );
    }
}
