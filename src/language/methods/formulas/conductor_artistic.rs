//! `n = g (1-r)/(1+r) + (1-g) (1+√r)/(1-√r)`, `k² = (r (n+1)² - (n-1)²) / (1-r)`, then the exact law: reflectivity r
//! and edge tint g in place of n and k.
//!
//! Source: Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014, <https://jcgt.org/published/0003/04/03/>.
//! k² is computed as (n_max - n)(n - 1/n_max), which is the same number: with √r (n+1) ± (n-1) factored,
//! (1-√r)(1+√r) = 1-r cancels the divisor. Both factors are sums of positive terms, g (n_max - n_min) and
//! (1-g)(n_max - n_min) + 2√r / (n_max (1+r)), so no digits are lost.
//! Domain: r in [0, 1), g in [0, 1]. r is clamped to 0.999, because n_max is singular at 1: F0 above it is lowered by
//! at most .001. Error: none where r and g come from n and k; [`METHOD`]'s claims hold with both derived from n and k.

use super::conductor_exact::{conductor, least_squared, root_or_zero};
use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const REFLECTIVITY: Input = Input::rgb(
        "reflectivity",
        "reflectance at normal incidence, linear",
        [0.0, 1.0],
        InputSource::Material(|known| {
            each_channel(|i| optics::normal_incidence(known.n[i], known.k[i]))
        }),
    )
    .tried(&[0.04, 0.0, 1e-6, 0.5, 0.98, 1.0])
    .scanned(Input::F0.scanned);

    pub const EDGE_TINT: Input = Input::rgb(
        "edge_tint",
        "1 for the least n that the reflectivity allows, 0 for the most",
        [0.0, 1.0],
        InputSource::Material(|known| each_channel(|i| edge_tint(known.n[i], known.k[i]))),
    )
    .tried(SHARES)
    .scanned(SHARES_AND_BEYOND);
}

/// Gulbrandsen's g: the position of n between the largest (0) and the smallest (1) that F0 allows.
fn edge_tint(n: f64, k: f64) -> f64 {
    let r = optics::normal_incidence(n, k);
    let (most, least) = ((1.0 + r.sqrt()) / (1.0 - r.sqrt()), (1.0 - r) / (1.0 + r));
    if most == least {
        0.0
    } else {
        ((most - n) / (most - least)).clamp(0.0, 1.0)
    }
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "conductor_artistic",
    summary: "the exact law for conductors from reflectivity and edge tint",
    formula: &[
        "n = g (1 - r) / (1 + r) + (1 - g) (1 + sqrt(r)) / (1 - sqrt(r)), k^2 = (r (n + 1)^2 - (n - 1)^2) / (1 - r)",
        "r = min(reflectivity, 0.999), g = edge_tint; then conductor_exact(cos_theta, n, k)",
    ],
    source: Citation {
        authors: "Gulbrandsen",
        title: "Artist Friendly Metallic Fresnel",
        place: "Journal of Computer Graphics Techniques 3(4), 64-72",
        year: 2014,
        link: "https://jcgt.org/published/0003/04/03/",
    },
    inputs: &[Input::REFLECTIVITY, Input::EDGE_TINT],
    domain: "both are clamped to [0, 1]; reflectivity above 0.999 counts as 0.999",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Metals)],
        code_ulp: 9.5,
        code_over: MediaSet::Metals,
        colours: Some(ColourClaim {
            max_abs: 3e-6,
            ends: &[("reflectivity", Range::new(0.001, 1.0))],
            beyond: "below, where n is next to 1, digits go as those of n - 1 do",
        }),
        ..Claims::NONE
    },
    half: InHalf::Specialised(
        "the square of n_max = (1 + sqrt(r))^2 / (1 - r) overflows where r is above 0.984, as silver's red is",
    ),
    build,
    replacement: Some(solved),
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let r = x
        .get(Input::REFLECTIVITY)
        .at_least(least_squared(x.precision()))
        .at_most(0.999)
        .named("facing", "n_max is singular at 1");
    let g = x.get(Input::EDGE_TINT).saturate().named("edge", "");
    let r_more = (1.0 + r).named("r_more", "");
    let lack = (1.0 - r).named("lack", "");
    let least = (lack / r_more).named("n_min", "the least n that r allows");
    let root = r.sqrt().named("root", "");
    let more = (1.0 + root).named("root_more", "");
    let most = (more.squared() / lack).named("n_max", "the most, where k = 0");
    let span = (most - least).named("span", "");
    let above = ((1.0 - g) * span).named("above", "n - n_min");
    let n = (least + above).named("n", "");
    let gap = 2.0 * root / (most * r_more);
    let k2 = g * span * (above + gap);
    let k2 = k2.named("k2", "(n_max - n)(n - 1 / n_max), in positive terms");
    let k = root_or_zero(x.precision(), k2).named("k", "0 where k2 is 0, by any arithmetic");
    conductor(x.precision(), x.cosine(), n, k)
}

/// n and k solved in f64, then the exact law.
fn solved(values: &Values) -> Option<(&'static Method, Values)> {
    let index = |i: usize| {
        let r = values["reflectivity"][i].clamp(0.0, 0.999);
        let g = values["edge_tint"][i].clamp(0.0, 1.0);
        let (least, most) = ((1.0 - r) / (1.0 + r), (1.0 + r.sqrt()).powi(2) / (1.0 - r));
        let above = (1.0 - g) * (most - least);
        let gap = 2.0 * r.sqrt() / (most * (1.0 + r));
        (least + above, (g * (most - least) * (above + gap)).sqrt())
    };
    Some(conductor_exact::with(each_channel(index)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_the_reflectivity_whatever_the_tint() {
        for g in [0.0, 0.3, 1.0] {
            check(&METHOD, 1.0, &[0.7, g], 0.7);
            check(&METHOD, 0.0, &[0.7, g], 1.0);
        }
    }

    #[test]
    fn an_edge_tint_of_zero_is_a_dielectric() {
        let glass = optics::dielectric(1.5, 0.5).unpolarised();
        check(&METHOD, 0.5, &[0.04, 0.0], glass);
    }
}
