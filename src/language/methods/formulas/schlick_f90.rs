//! `F = F0 + (F90 - F0) (1 - cos θ)⁵`: Schlick's approximation with the reflectance at 90 degrees as an input.
//!
//! Source: Lagarde and de Rousiers, "Moving Frostbite to Physically Based Rendering", SIGGRAPH course, 2014,
//! <https://seblagarde.wordpress.com/2015/07/14/siggraph-2014-moving-frostbite-to-physically-based-rendering/>.
//! Domain: F0 ≥ 0, F90 in [0, 1]; engines lower F90 as occlusion for surfaces with an F0 below that of any material.
//! Error: that of `schlick` where F90 = 1.

use super::schlick::{affine_weights, grazing_weight};
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick_f90",
    summary: "Schlick's approximation between F0 and F90",
    formula: &["F = F0 + (F90 - F0) (1 - cos_theta)^5"],
    source: Citation {
        authors: "Lagarde, de Rousiers",
        title: "Moving Frostbite to Physically Based Rendering",
        place: "SIGGRAPH course",
        year: 2014,
        link: "https://seblagarde.wordpress.com/2015/07/14/siggraph-2014-moving-frostbite-to-physically-based-rendering/",
    },
    inputs: &[Input::F0, Input::F90],
    forms: Forms::ColourAndScalar,
    domain: "the result lies between f0 and f90, and f0 above 1 is taken as it is",
    claims: Claims {
        model: &[Claim::dielectrics(0.0841, 84.5), Claim::metals(0.278, 84.5)],
        code_ulp: 5.0,
        colours: ColourClaim::within(3e-7),
        ..Claims::NONE
    },
    half: InHalf::within(0.0013),
    build,
    for_constants: Some(for_constants),
    affine: Some(Affine {
        numbers: &["f0", "f90 - f0"],
        build: numbers,
        weights: affine_weights,
    }),
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    to_f90(x, grazing_weight(x))
}

fn for_constants<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let f0 = x.get(Input::F0);
    f0 + (x.get(Input::F90) - f0) * grazing_weight(x)
}

/// `F0 + (F90 - F0) w` as `F0 (1 - w) + F90 w`: both weights are one number for three channels.
pub(super) fn to_f90<'b>(x: &Inputs<'b>, weight: Expr<'b>) -> Expr<'b> {
    let end = (x.get(Input::F90) * weight).named("end", "");
    x.get(Input::F0) * (1.0 - weight).named("kept", "the weight of f0") + end
}

fn numbers<'b>(x: &Inputs<'b>) -> Vec<Expr<'b>> {
    let f0 = x.get(Input::F0);
    vec![f0, x.get(Input::F90) - f0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_f0_and_f90() {
        check(&METHOD, 1.0, &[0.04, 0.5], 0.04);
        check(&METHOD, 0.0, &[0.04, 0.5], 0.5);
        check(&METHOD, 2.0, &[1.1, 1.0], 1.1);
    }
}
