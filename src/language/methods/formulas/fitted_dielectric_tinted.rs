//! `F = F0 + (F90 - F0) t`, `t = m³ (a + m⁴ (b + (1 - a - b) m⁷))`, `m = 1 - cos θ`, a and b quadratic in 1/η: the curve of `dielectric_tinted` for an
//! index of 1.2 to 2.5, without a root.
//!
//! Source: ours, for the law of Cook and Torrance, 1982, <https://doi.org/10.1145/357290.357293>; the powers are those of `fitted_dielectric`. A linear program found the six numbers, for the least largest error of t over
//! η from 1.2 to 2.5 and all angles, .0025; no numbers of these powers, free at each η, have less than .0023 there.
//! Domain: η from 0.001 to 10000, below 1 as at 1. Below 1.2 it errs more, and it knows no total reflection: use `dielectric_tinted`. Error: [`METHOD`]'s claims.

use super::dielectric_exact::COOK_TORRANCE_1982;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "fitted_dielectric_tinted",
    summary: "the curve of dielectric_tinted for an index of 1.2 to 2.5, fitted",
    formula: &[
        "F = F0 + (F90 - F0) t, t = m^3 (a + m^4 (b + (1 - a - b) m^7)), m = 1 - c, F limited to [0, 1]",
        "a, b quadratic in 1/eta, which is 1 at most",
    ],
    source: COOK_TORRANCE_1982,
    origin: Origin::Ours("the law that it follows"),
    inputs: &[Input::IOR, Input::F0, Input::F90_COLOUR],
    class: Class::Dielectric,
    domain: "for ior from 1.2 to 2.5; it knows no total reflection",
    claims: Claims {
        model: &[Claim::dielectrics(0.0025, 70.2)],
        code_ulp: 11.0,
        code_over: MediaSet::Dielectrics,
        by_class: &[ByClass::of_class(
            "dielectric",
            [0.0027, 0.0038],
            [0.0028, 0.0040],
            0.0039,
        )],
        ..Claims::NONE
    },
    half: InHalf::within_over(
        0.0030,
        MediaSet::Dielectrics,
        "beyond eta 1.2 to 2.5 its quadratics cancel",
    )
    .materials_within(0.0030),
    build,
    ..Method::BASE
};

/// The numbers of a and b: of 1, 1/η and 1/η².
const OF_INVERSE: [[f64; 3]; 2] = [[-0.7879, 4.3571, -3.8865], [0.5852, -1.1432, 1.5688]];

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let inverse = (1.0 / x.get(Input::IOR)).at_most(1.0);
    let inverse = inverse.named("per_ior", "");
    let [a, b] = OF_INVERSE.map(|[one, first, second]| one + inverse * (first + inverse * second));
    let (a, b) = (a.named("a", ""), b.named("b", ""));
    let m = (1.0 - x.cosine()).named("m", "0 at normal incidence, 1 at grazing");
    let m2 = m.squared().named("m2", "");
    let m3 = (m2 * m).named("m3", "");
    let m4 = m2.squared().named("m4", "");
    let t = m3 * (a + m4 * (b + (1.0 - a - b) * (m3 * m4)));
    let t = t.at_most(1.0).named("t", "the weight of f90");
    let (f0, f90) = (x.get(Input::F0), x.get(Input::F90_COLOUR));
    (f0 + (f90 - f0) * t).saturate()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_from_f0_to_f90() {
        check(&METHOD, 1.0, &[1.5, 0.2, 0.6], 0.2);
        check(&METHOD, 0.0, &[1.5, 0.2, 0.6], 0.6);
    }
}
