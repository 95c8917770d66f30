//! `F = ((n-1)² + 4n (1 - cos θ)⁵) / (n+1)²`: Schlick's approximation from the index of refraction.
//!
//! Source: Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994,
//! <https://doi.org/10.1111/1467-8659.1330233>; eq. 7 of the thesis.
//! Domain: η from 0.001 to 1e12. Below 1 it misses total reflection altogether. Error: [`METHOD`]'s claim; good for η 1.4 to 2.2.

use super::schlick::{SCHLICK_1994, grazing_weight, to_white};
use super::schlick_rescaled::from_least;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick_ior",
    summary: "Schlick's approximation from the index of refraction",
    formula: &["F = ((eta - 1)^2 + 4 eta (1 - cos_theta)^5) / (eta + 1)^2"],
    source: SCHLICK_1994,
    inputs: &[Input::ETA],
    forms: Forms::ColourAndScalar,
    class: Class::Dielectric,
    domain: "off by at most 0.059 for eta from 1.4 to 2.2; below 1 it misses total reflection",
    claims: Claims {
        model: &[Claim::dielectrics(0.0841, 84.5)],
        code_ulp: 7.0,
        ..Claims::NONE
    },
    half: InHalf::within(0.0014).ending(&[("eta", 65504.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let eta = x.get(Input::ETA);
    let less = (eta - 1.0).named("eta_less", "");
    if x.is_half() {
        // A quotient near 1 would have five rounding errors.
        let more = (eta + 1.0).named("eta_more", "");
        let r = (less / more).named("r", "the amplitude at normal incidence");
        let f0 = r.squared().named("f0", "");
        return to_white(f0, grazing_weight(x));
    }
    let least = less.squared().named("least", "(eta - 1)^2");
    from_least(x, least, eta).saturate()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_normal_incidence_and_grazing() {
        check(&METHOD, 1.0, &[1.5], 0.04);
        check(&METHOD, 0.0, &[1.5], 1.0);
    }

    /// The error that the record's `domain` states.
    #[test]
    fn it_is_off_by_what_its_domain_says() {
        let mut worst = 0.0f64;
        for (i, j) in (0..=8).flat_map(|i| (0..=500).map(move |j| (i, j))) {
            let (eta, c) = (1.4 + 0.1 * f64::from(i), f64::from(j) / 500.0);
            let exact = value(&dielectric_exact::METHOD, c, &[eta]);
            worst = worst.max((value(&METHOD, c, &[eta]) - exact).abs());
        }
        assert!((0.058..0.059).contains(&worst), "{worst}");
    }
}
