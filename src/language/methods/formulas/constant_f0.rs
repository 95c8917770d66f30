//! `F = F0`: one reflectance for every angle, no Fresnel at all.
//!
//! Source: Hoffman, "Background: Physics and Math of Shading", SIGGRAPH course, 2013,
//! <https://blog.selfshadow.com/publications/s2013-shading-course/>, which takes F(0°) as a material's characteristic
//! reflectance, since F stays close to it at most angles; Schlick's formula without its angular term.
//! Domain: F0 ≥ 0; above 1 it is returned unchanged. Error: 1 - F0 at 90 degrees; see [`METHOD`]'s claims.

use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "constant_f0",
    summary: "F0 at every angle: no Fresnel at all",
    formula: &["F = F0"],
    source: Citation {
        authors: "Hoffman",
        title: "Background: Physics and Math of Shading",
        place: "SIGGRAPH course Physically Based Shading in Theory and Practice",
        year: 2013,
        link: "https://blog.selfshadow.com/publications/s2013-shading-course/",
    },
    inputs: &[Input::F0],
    forms: Forms::ColourAndScalar,
    domain: "the result is f0, also above 1 and at 90 degrees, where the law reflects everything",
    claims: Claims {
        model: &[Claim::dielectrics(0.983, 90.0), Claim::metals(0.714, 90.0)],
        code_ulp: 0.0,
        colours: ColourClaim::within(0.0),
        ..Claims::NONE
    },
    half: InHalf::within(0.0),
    build,
    affine: Some(Affine {
        numbers: &["f0"],
        build: |x| vec![x.get(Input::F0)],
        weights: |_| [1.0, 0.0, 0.0, 0.0],
    }),
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    x.get(Input::F0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_f0_at_every_angle() {
        check(&METHOD, 1.0, &[0.04], 0.04);
        check(&METHOD, 0.0, &[0.04], 0.04);
        check(&METHOD, -3.0, &[1.05], 1.05);
    }

    #[test]
    fn it_computes_nothing() {
        let function = METHOD.function(false).expect("it is well formed");
        assert_eq!(function.work(), 0);
    }
}
