//! `F = ((n-1)² + 4n (1 - cos θ)⁵ + k²) / ((n+1)² + k²) - 2n cos θ (1 - cos θ)^λ`: the rescaled Schlick with a term
//! that restores the minimum of metals.
//!
//! Source: Lazányi and Szirmay-Kalos, "Fresnel Term Approximations for Metals", WSCG, 2005,
//! <https://hdl.handle.net/11025/11214>, which subtracts a cos θ (1 - cos θ)^α with a and α free for each metal. a = 2n
//! and a matched exponent λ are the choice of the thesis. Its eq. 15 lacks the factor cos θ: as printed,
//! F(90°) = 1 - 2n would be negative.
//! λ is computed per material and channel so that F equals the exact law at a matching angle (81.37 degrees,
//! cos θ = 0.15). Where no λ does, as in gold's green, the term is dropped, which λ ≤ 0 stands for.
//! Domain: n from 0.001 to 1e9, k from 0 to 1e9; clamped to [0, 1]. Error: [`METHOD`]'s claims.

use super::schlick_rescaled::{LAZANYI_2005, rescaled};
use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const LAMBDA: Input = Input::rgb(
        "lambda",
        "exponent of the correction; 0 or less where there is none",
        [-1000.0, 1000.0],
        InputSource::MaterialOrNone(|known| {
            let KnownSurface {
                n,
                k,
                matching_cos,
                matching,
                ..
            } = *known;
            each_channel(|i| lambda_for(n[i], k[i], matching_cos, matching[i]))
        }),
    )
    .tried(&[7.0, -1.0, 0.0, 0.5, 60.0])
    .scanned(&[-5.0, 0.0, 0.2, 0.5, 1.0, 3.0, 5.0, 8.0, 20.0, 100.0, 1000.0]);
}

/// The λ with which the corrected method equals the exact law at `cos_theta`, for one channel:
/// `(1-c)^λ = (F_rescaled - F_exact) / (2 n c)`. There is none where the exact law lies above the rescaled Schlick (gold's green),
/// or so far below that λ would not be positive.
pub fn lambda(n: f64, k: f64, cos_theta: f64) -> Option<f64> {
    let exact = optics::conductor(n, k, cos_theta).unpolarised();
    lambda_for(n, k, cos_theta, exact)
}

/// The same for a reflectance that is `exact` at `cos_theta`.
fn lambda_for(n: f64, k: f64, cos_theta: f64, exact: f64) -> Option<f64> {
    let (less, more, m) = (n - 1.0, n + 1.0, 1.0 - cos_theta);
    let rescaled = (less * less + 4.0 * n * m * m * m * m * m + k * k) / (more * more + k * k);
    let share = (rescaled - exact) / (2.0 * n * cos_theta);
    (share > 0.0 && share < 1.0).then(|| libm::log2(share) / libm::log2(1.0 - cos_theta))
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick_corrected",
    summary: "the rescaled Schlick with a term that restores the minimum of metals",
    formula: &[
        "F = ((n - 1)^2 + 4 n (1 - cos_theta)^5 + k^2) / ((n + 1)^2 + k^2)",
        "    - 2 n cos_theta (1 - cos_theta)^lambda; without the last term where lambda <= 0",
    ],
    source: LAZANYI_2005,
    origin: Origin::Adapted("a = 2 n and the matched exponent are the thesis's"),
    inputs: &[Input::N, Input::K, Input::LAMBDA],
    domain: "clamped to [0, 1]; lambda <= 0 drops the correction",
    claims: Claims {
        model: &[Claim::metals(0.0872, 75.8)],
        code_ulp: 16.0,
        ..Claims::NONE
    },
    half: InHalf::within(0.0024).ending(&[("n", 180.0), ("k", 180.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, n, lambda) = (x.cosine(), x.get(Input::N), x.get(Input::LAMBDA));
    let base = rescaled(x).named("base", "the rescaled Schlick");
    let zero = c.builder().number(0.0);
    let fall = (1.0 - c)
        .rgb()
        .power(lambda, x.precision())
        .named("fall", "(1 - c)^lambda");
    let dip = (2.0 * n * (c * fall)).named("dip", "where lambda is above 0");
    let dip = zero
        .choose_below(lambda, dip, zero)
        .named("correction", "what the minimum takes away");
    (base - dip).saturate()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_normal_incidence_and_grazing() {
        let bare = value(&METHOD, 1.0, &[2.49, 4.44, 0.0]);
        check(&METHOD, 1.0, &[2.49, 4.44, 7.0], bare);
        check(&METHOD, 0.0, &[2.49, 4.44, 7.0], 1.0);
    }

    #[test]
    fn without_lambda_it_is_the_rescaled_schlick() {
        let rescaled = value(&schlick_rescaled::METHOD, 0.2, &[0.57, 2.18]);
        check(&METHOD, 0.2, &[0.57, 2.18, -1.0], rescaled);
    }
}
