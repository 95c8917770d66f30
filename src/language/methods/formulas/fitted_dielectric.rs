//! `F = c0 + b³ (c1 + b⁴ (c2 + b⁷ c3))`, `b = 1 - cos θ`: four coefficients a channel for dielectrics.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>.
//! Powers follow the low reflectance of a dielectric away from grazing more closely than an exponential does. There a small
//! error is a large relative one. Among integer exponents 0, 3, 7 and 14 are second best (.0011 at the 90th percentile of
//! glasses; 0, 3, 7 and 13: .0010).
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims.

use super::fitted::{FITTED, FLOOR};
use super::*;

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[Factor::Grazing(3), Factor::Grazing(4), Factor::Grazing(7)],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_dielectric",
    summary: "four coefficients fitted to a dielectric of n 1.2 or more",
    formula: &["F = c0 + b^3 (c1 + b^4 (c2 + b^7 c3)), b = 1 - c, limited to [0, 1]"],
    class: Class::Dielectric,
    claims: Claims {
        model: &[Claim::dielectrics(0.0012, 48.4)],
        code_ulp: 7.5,
        code_over: MediaSet::Dielectrics,
        by_class: &[ByClass::of_class(
            "dielectric",
            [0.0007, 0.0011],
            [0.0011, 0.0012],
            0.0012,
        )],
        ..Claims::NONE
    },
    half: InHalf::within_over(0.0015, MediaSet::Dielectrics, FLOOR),
    build: |x| SHAPE.build(x),
    shape: Some(SHAPE),
    ..FITTED
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_begins_at_c0_and_ends_at_the_sum() {
        check(&METHOD, 1.0, &[0.04, 0.5, 0.25, 0.125], 0.04);
        check(&METHOD, 0.0, &[0.04, 0.5, 0.25, 0.125], 0.915);
        let sum = 0.25 + 0.0625 + 0.25 / 128.0;
        check(&METHOD, 0.5, &[0.25, 0.5, 0.25, 0.0], sum);
    }
}
