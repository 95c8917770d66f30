//! `F = max(0, min(1, bias + scale (1 + I·N)^power))`: NVIDIA's empirical term, with I·N = -cos θ.
//!
//! Source: Fernando and Kilgard, "The Cg Tutorial", chapter 7, 2003,
//! <https://developer.download.nvidia.com/CgTutorial/cg_tutorial_chapter07.html>; eq. 6 of the thesis.
//! Domain: bias, scale in [0, 1], power ≥ 0.2 (below, 2^(-126 power) shows at normal incidence). It is not physical: the three
//! numbers are tuned by hand, or derived from a material as bias = F0, scale = 1 - F0 and the power that matches the exact law
//! at 60 degrees. Error: [`METHOD`]'s claims, with parameters derived from the material.

use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const BIAS: Input = Input::scalar(
        "bias",
        "reflectance at normal incidence",
        [0.0, 1.0],
        InputSource::Material(|known| [mean(known.f0); 3]),
    )
    .tried(SHARES)
    .scanned(SHARES_AND_BEYOND);

    pub const SCALE: Input = Input::scalar(
        "scale",
        "what grazing incidence adds",
        [0.0, 1.0],
        InputSource::Material(|known| [1.0 - mean(known.f0); 3]),
    )
    .tried(SHARES)
    .scanned(SHARES_AND_BEYOND);

    pub const POWER: Input = Input::scalar(
        "power",
        "how late it is added",
        [0.2, 1000.0],
        InputSource::Material(|known| [power(mean(known.f0), mean(known.f60)); 3]),
    )
    .tried(POWERS)
    .scanned(POWERS_AND_BEYOND);
}

/// The power with which bias + (1 - bias) (1-c)^power equals `target` at 60 degrees; Schlick's 5 where there is none.
fn power(bias: f64, target: f64) -> f64 {
    let share = (target - bias) / (1.0 - bias);
    if share > 0.0 && share < 1.0 {
        libm::log2(share) / libm::log2(1.0 - COS_60)
    } else {
        5.0
    }
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "empirical",
    summary: "NVIDIA's bias, scale and power",
    formula: &["F = max(0, min(1, bias + scale (1 - cos_theta)^power))"],
    source: Citation {
        authors: "Fernando, Kilgard",
        title: "The Cg Tutorial, chapter 7",
        place: "Addison-Wesley",
        year: 2003,
        link: "https://developer.download.nvidia.com/CgTutorial/cg_tutorial_chapter07.html",
    },
    inputs: &[Input::BIAS, Input::SCALE, Input::POWER],
    forms: Forms::ColourAndScalar,
    domain: "the arguments are numbers: the three channels get the same reflectance",
    claims: Claims {
        model: &[Claim::dielectrics(0.113, 83.6), Claim::metals(0.42, 0.0)],
        code_ulp: 15.0,
        ..Claims::NONE
    },
    half: InHalf::within(0.0017),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let m = (1.0 - x.cosine()).named("m", "1 + I.N, as I.N = -cos_theta");
    (x.get(Input::BIAS) + x.get(Input::SCALE) * m.power(x.get(Input::POWER), x.precision()))
        .saturate()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_bias_and_bias_plus_scale() {
        check(&METHOD, 1.0, &[0.1, 0.7, 5.0], 0.1);
        check(&METHOD, 0.0, &[0.1, 0.7, 5.0], 0.8);
        check(&METHOD, 0.5, &[0.0, 1.0, 2.0], 0.25);
        check(&METHOD, 0.0, &[0.9, 0.7, 5.0], 1.0);
    }
}
