//! `R_s = (r + c² - u) / (r + c² + u)`: the exact law for conductors and light polarised across the plane of incidence.
//!
//! Source: as in `conductor_exact`: Glassner, "Principles of Digital Image Synthesis", 1995,
//! <https://www.realtimerendering.com/Principles_of_Digital_Image_Synthesis_v1.0.1.pdf>.
//! Domain: n from 0.001 to 1e9, k from 0 to 1e9; k = 0 is the dielectric. Error: none in the model; the code error is [`METHOD`]'s claim.

use super::conductor_exact::polarised;
use super::conductor_textbook::GLASSNER_1995;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "conductor_exact_s",
    summary: "the exact law for conductors, s-polarised light",
    formula: &[
        "R_s = (r + c^2 - u) / (r + c^2 + u), r = |n^2 - k^2 - s^2 + 2 i n k|, u = 2 a c, a^2 = (r + n^2 - k^2 - s^2) / 2",
    ],
    source: GLASSNER_1995,
    inputs: &[Input::N, Input::K],
    light: Light::S,
    domain: "k = 0 is the dielectric; n = 1 with k = 0 gives 0 at every angle; from n = k = 3e9 on it overflows",
    claims: Claims {
        model: &[
            Claim::exact(MediaSet::Dielectrics),
            Claim::exact(MediaSet::Metals),
        ],
        code_ulp: 5.5,
        ..Claims::NONE
    },
    half: InHalf::within_but(0.0015, "for n below 1 with k near 0 see dielectric_exact")
        .ending(&[("n", 180.0), ("k", 180.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    polarised(x.precision(), x.cosine(), x.get(Input::N), x.get(Input::K)).s()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_its_limits() {
        check(&METHOD, 1.0, &[0.23, 3.94], 16.1165 / 17.0365);
        check(&METHOD, 0.0, &[0.23, 3.94], 1.0);
    }

    /// Without absorption it is the dielectric, total reflection included.
    #[test]
    fn without_absorption_it_is_the_dielectric() {
        for (c, n) in [(0.3, 1.5), (0.9, 0.7), (0.5, 0.7)] {
            check(
                &METHOD,
                c,
                &[n, 0.0],
                value(&dielectric_exact_s::METHOD, c, &[n]),
            );
        }
    }
}
