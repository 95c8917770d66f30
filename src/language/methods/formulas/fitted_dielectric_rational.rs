//! `F = c0 + w (c1 + w (c2 + c c3))`, `w = (1 - c)² / (1 + 4c)`: four coefficients a channel for dielectrics, with a division.
//!
//! Source: ours, as [`fitted`](crate::language::methods::formulas::fitted), by the exchange of Stiefel 1959, <https://doi.org/10.1007/BF01386369>. The search over
//! nested products of cheap factors (`fit --search --terms 4`) found the shape for dielectrics.
//! It errs less than [`fitted_dielectric`](crate::language::methods::formulas::fitted_dielectric). It costs less where a division
//! is cheap, as on phones, and more on GCN.
//! Domain: any coefficients; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims.

use super::fitted::{FITTED, FLOOR};
use super::*;

/// The shape.
const SHAPE: Shape = Shape {
    factors: &[Factor::Bent(4.0), Factor::Bent(4.0), Factor::Cosine],
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_dielectric_rational",
    summary: "four coefficients fitted to a dielectric of n 1.2 or more, with a division",
    formula: &["F = c0 + w (c1 + w (c2 + c c3)), w = (1 - c)^2 / (1 + 4 c), limited to [0, 1]"],
    class: Class::Dielectric,
    claims: Claims {
        model: &[Claim::dielectrics(0.0011, 59.2)],
        code_ulp: 7.0,
        code_over: MediaSet::Dielectrics,
        by_class: &[ByClass::of_class(
            "dielectric",
            [0.0004, 0.0009],
            [0.0004, 0.0005],
            0.0009,
        )],
        ..Claims::NONE
    },
    half: InHalf::within_over(0.0025, MediaSet::Dielectrics, FLOOR).materials_within(0.0025),
    build: |x| SHAPE.build(x),
    shape: Some(SHAPE),
    ..FITTED
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_begins_at_c0_and_ends_without_c3() {
        check(&METHOD, 1.0, &[0.04, 0.5, 0.25, 0.125], 0.04);
        check(&METHOD, 0.0, &[0.04, 0.5, 0.25, 0.125], 0.79);
        // w is 1/12.
        let sum = 0.25 + (0.6 + 2.4 / 12.0) / 12.0;
        check(&METHOD, 0.5, &[0.25, 0.6, 1.2, 2.4], sum);
    }
}
