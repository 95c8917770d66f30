//! `t_j = refracted(i, n, eta_j)`: a refracted ray for each colour, and weights of spectral samples that sum to 1.
//!
//! Source: Born, Wolf, *Principles of Optics*, 1999, section 4.7, <https://doi.org/10.1017/CBO9781139644181>; the weights are ours.
//! One reflectance for all channels is right for real media: it differs by at most half a step of 255 for water and BK7.

use super::*;

const ETAS: Argument = Argument::vector(
    "etas",
    "n_t / n_i for red, green and blue, each above 0; GLSL's refract takes the inverse",
    [0.4, 2.5],
);
const INDEX: Argument = Argument::scalar(
    "index",
    "which sample, 0 to count - 1, from red to blue",
    [0.0, 15.0],
);
const COUNT: Argument = Argument::scalar(
    "count",
    "how many samples, 1 or more: as many as red and blue lie pixels apart are enough",
    [1.0, 16.0],
);

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "dispersion",
    summary: "A refracted ray for each colour, and weights of spectral samples",
    formula: &[
        "refracted_red = r (i + c n) - n sqrt(1 - r^2 (1 - c^2)),  r = 1 / etas.x;  green and blue likewise",
        "weight = ((1 - t)^2, 2 t (1 - t), t^2) / their sums over all samples,  t = (index + 1/2) / count",
    ],
    source: Citation {
        authors: "Born, Wolf",
        title: "Principles of Optics",
        place: "7th edition, Cambridge University Press, section 4.7",
        year: 1999,
        link: "https://doi.org/10.1017/CBO9781139644181",
    },
    conventions: &[
        "Look up red along the first ray, green along the second, blue along the third; or take N samples: sample i has the \
         index etas.x + (etas.z - etas.x) (2 t - 1/2) with t = (i + 1/2) / N, and weights its look-up by spectral_weight(i, N), whose red \
         and blue have their middles at t = 1/4 and 3/4.",
        "One R serves all channels of a real medium (interface_reflectance_scalar): in steps of 255 the difference is a \
         third for water and BK7, .7 for diamond.",
    ],
    fails: &["Three samples show three edges where they lie more than a pixel apart."],
    functions: &[
        EffectFunction {
            name: "refracted_red",
            gives: "the red ray; zero past its critical angle",
            arguments: &[INCIDENT, NORMAL, ETAS],
            letters: Letters::Xyz,
            build: |with| of_channel(with, 0),
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "refracted_green",
            gives: "the green ray; zero past its critical angle",
            arguments: &[INCIDENT, NORMAL, ETAS],
            letters: Letters::Xyz,
            build: |with| of_channel(with, 1),
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "refracted_blue",
            gives: "the blue ray; zero past its critical angle",
            arguments: &[INCIDENT, NORMAL, ETAS],
            letters: Letters::Xyz,
            build: |with| of_channel(with, 2),
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "spectral_weight",
            gives: "the weight of a sample in red, green and blue; over all samples each sums to 1",
            arguments: &[INDEX, COUNT],
            build: spectral_weight,
            ..EffectFunction::BASE
        },
    ],
};

fn of_channel<'b>(with: &Arguments<'b>, channel: usize) -> Expr<'b> {
    let eta = with.get(ETAS).channel(channel);
    let refraction = refraction(with, with.get(INCIDENT), with.get(NORMAL), eta);
    refraction.direction * refraction.passes
}

/// Over the midpoints of N equal steps, (1 - t)^2 and t^2 sum to N (1/3 - 1/(12 N^2)), and 2 t (1 - t) to N (1/3 + 1/(6 N^2)).
fn spectral_weight<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let count = with.get(COUNT);
    let t = ((with.get(INDEX) + 0.5) / count)
        .named("t", "the middle of the sample's share of the spectrum");
    let rest = (1.0 - t).named("rest", "");
    let parts = with.vector(rest * rest, 2.0 * t * rest, t * t);
    let correction =
        (1.0 / (12.0 * count)).named("correction", "sums over middles are no integrals");
    let third = (count * (1.0 / 3.0)).named("third", "the integral of each, times count");
    let end = (third - correction).named("end", "the sum of the first and of the last");
    parts / with.vector(end, third + 2.0 * correction, end)
}
