//! `R_p = R_s (x - u s²) / (x + u s²)`: the exact law for conductors and light polarised in the plane of incidence.
//!
//! Source: as in `conductor_exact`: Glassner, "Principles of Digital Image Synthesis", 1995,
//! <https://www.realtimerendering.com/Principles_of_Digital_Image_Synthesis_v1.0.1.pdf>.
//! Domain: n from 0.001 to 1e9, k from 0 to 1e9; k = 0 is the dielectric. Error: none in the model; the code error is [`METHOD`]'s claim.

use super::conductor_exact::polarised;
use super::conductor_textbook::GLASSNER_1995;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "conductor_exact_p",
    summary: "the exact law for conductors, p-polarised light",
    formula: &[
        "R_p = R_s (x - u s^2) / (x + u s^2), x = r c^2 + s^4, s^2 = 1 - c^2; r, u and R_s as of conductor_exact_s",
    ],
    source: GLASSNER_1995,
    inputs: &[Input::N, Input::K],
    light: Light::P,
    domain: "k = 0 is the dielectric, 0 at Brewster's angle; n = 1 with k = 0 gives 0 at every angle; from n = k = 3e9 on it overflows",
    claims: Claims {
        model: &[
            Claim::exact(MediaSet::Dielectrics),
            Claim::exact(MediaSet::Metals),
        ],
        code_ulp: 8.0,
        ..Claims::NONE
    },
    half: InHalf::within_but(0.0016, "for n below 1 with k near 0 see dielectric_exact")
        .ending(&[("n", 180.0), ("k", 180.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    polarised(x.precision(), x.cosine(), x.get(Input::N), x.get(Input::K)).p()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_its_limits() {
        check(&METHOD, 1.0, &[0.23, 3.94], 16.1165 / 17.0365);
        check(&METHOD, 0.0, &[0.23, 3.94], 1.0);
    }

    #[test]
    fn without_absorption_it_is_the_dielectric() {
        for (c, n) in [(0.3, 1.5), (0.9, 0.7), (0.5, 0.7)] {
            check(
                &METHOD,
                c,
                &[n, 0.0],
                value(&dielectric_exact_p::METHOD, c, &[n]),
            );
        }
    }

    /// The mean of both is unpolarised light.
    #[test]
    fn both_make_the_whole() {
        for c in [0.9, 0.3, 0.05] {
            let [s, p, whole] = [
                &conductor_exact_s::METHOD,
                &METHOD,
                &conductor_exact::METHOD,
            ]
            .map(|method| value(method, c, &[1.2, 3.1]));
            assert!((0.5 * (s + p) - whole).abs() < 1e-14);
        }
    }
}
