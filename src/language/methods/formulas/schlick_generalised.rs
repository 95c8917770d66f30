//! `F = F0 + (F90 - F0) (1 - cos θ)^exponent`: Schlick's approximation with F90 and the exponent as inputs.
//!
//! Source: Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course, 2017,
//! <https://blog.selfshadow.com/publications/s2017-shading-course/>, which the specification of MaterialX cites for its
//! `generalized_schlick_bsdf` of `color0`, `color90` and `exponent`. That node later got a term at 82 degrees (Hoffman,
//! "Generalization of Adobe's Fresnel Model", 2023, <https://renderwonk.com/publications/gfm/>). This method has none.
//! Domain: F0 ≥ 0, F90 in [0, 1], exponent ≥ 0.2 (below, 2^(-126 exponent) shows at normal incidence). Error: that of `schlick`
//! at exponent 5 and F90 = 1. The real power is computed by exp2 and log2, whose error is part of the code error.

use super::schlick_f90::to_f90;
use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const EXPONENT: Input = Input::scalar(
        "exponent",
        "how late the curve rises to f90; 5 is Schlick's",
        [0.2, 1000.0],
        InputSource::Artist(5.0),
    )
    .tried(POWERS)
    .scanned(POWERS_AND_BEYOND);
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick_generalised",
    summary: "Schlick's approximation with F90 and any exponent",
    formula: &["F = F0 + (F90 - F0) (1 - cos_theta)^exponent"],
    source: Citation {
        authors: "Kulla, Conty",
        title: "Revisiting Physically Based Shading at Imageworks",
        place: "SIGGRAPH course",
        year: 2017,
        link: "https://blog.selfshadow.com/publications/s2017-shading-course/",
    },
    inputs: &[Input::F0, Input::F90, Input::EXPONENT],
    forms: Forms::ColourAndScalar,
    domain: "the result lies between f0 and f90, and f0 above 1 is taken as it is",
    claims: Claims {
        model: &[Claim::dielectrics(0.0841, 84.5), Claim::metals(0.278, 84.5)],
        code_ulp: 0.0,
        ..Claims::NONE
    },
    half: InHalf::within(0.0017),
    build,
    for_constants: Some(for_constants),
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    to_f90(x, weight(x))
}

fn for_constants<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let f0 = x.get(Input::F0);
    f0 + (x.get(Input::F90) - f0) * weight(x)
}

fn weight<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let m = (1.0 - x.cosine()).named("m", "0 at normal incidence, 1 at grazing");
    let weight = m.power(x.get(Input::EXPONENT), x.precision());
    weight.named("weight", "1 at grazing")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_f0_and_f90() {
        check(&METHOD, 1.0, &[0.04, 0.5, 5.0], 0.04);
        check(&METHOD, 0.0, &[0.04, 0.5, 5.0], 0.5);
        check(&METHOD, 0.5, &[0.0, 1.0, 3.0], 0.125);
    }
}
