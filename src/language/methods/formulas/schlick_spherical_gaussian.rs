//! `F = F0 + (1 - F0) 2^((-5.55473 cos θ - 6.98316) cos θ)`: Schlick's power as a spherical Gaussian.
//!
//! Source: Karis, "Real Shading in Unreal Engine 4", SIGGRAPH course, 2013,
//! <https://blog.selfshadow.com/publications/s2013-shading-course/>, after Lagarde's fit.
//! The two constants are as published. The weight they give is off by .0038 at 86.8 degrees, and by 1.7e-4 at
//! normal incidence, where F is not quite F0. Domain: F0 ≥ 0. Error: [`METHOD`]'s claims.

use super::schlick::to_white;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick_spherical_gaussian",
    summary: "Schlick's power as a spherical Gaussian",
    formula: &["F = F0 + (1 - F0) 2^((-5.55473 cos_theta - 6.98316) cos_theta)"],
    source: Citation {
        authors: "Karis",
        title: "Real Shading in Unreal Engine 4",
        place: "SIGGRAPH course",
        year: 2013,
        link: "https://blog.selfshadow.com/publications/s2013-shading-course/",
    },
    inputs: &[Input::F0],
    forms: Forms::ColourAndScalar,
    domain: "f0 above 1 is taken as it is: the result then lies in [0, max(1, f0)]; at normal incidence the result is f0 + 1.7e-4 (1 - f0)",
    claims: Claims {
        model: &[Claim::dielectrics(0.0864, 84.6), Claim::metals(0.279, 84.5)],
        code_ulp: 0.0,
        colours: ColourClaim::within(3e-7),
        ..Claims::NONE
    },
    half: InHalf::within(0.0008),
    build,
    variants: &[&EACH_CHANNEL],
    for_constants: Some(for_constants),
    affine: Some(Affine::to_white(affine_weights)),
    ..Method::BASE
};

/// `F0 - (F0 - 1) w` in each channel: for GPUs that count waits.
static EACH_CHANNEL: Method = Method {
    variant: "each_channel",
    build: each_channel,
    variants: &[],
    ..METHOD
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    to_white(x.get(Input::F0), weight(x))
}

fn each_channel<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let f0 = x.get(Input::F0);
    f0 - (f0 - 1.0) * weight(x)
}

fn for_constants<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let f0 = x.get(Input::F0);
    f0 + (1.0 - f0) * weight(x)
}

fn weight<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let c = x.cosine();
    let weight = ((-5.55473 * c - 6.98316) * c).exp2();
    weight.named("weight", "1 at grazing")
}

fn affine_weights(c: f64) -> [f64; 4] {
    [1.0, libm::exp2((-5.55473 * c - 6.98316) * c), 0.0, 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_one_at_grazing_and_nearly_f0_at_normal_incidence() {
        check(&METHOD, 0.0, &[0.04], 1.0);
        check(&METHOD, 1.0, &[0.0], f64::exp2(-5.55473 - 6.98316));
    }
}
