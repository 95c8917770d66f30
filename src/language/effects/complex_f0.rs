//! `F0 = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2)`: a metal's reflectance at normal incidence from its complex index.
//!
//! Source: Born, Wolf, *Principles of Optics*, 1999, section 14.2, <https://doi.org/10.1017/CBO9781139644181>.
//! Exact at normal incidence for each channel of n and k.

use super::*;

const N: Argument = Argument::vector(
    "n",
    "refractive index, relative to the medium before the surface",
    [0.05, 5.0],
);
const K: Argument = Argument::vector("k", "extinction coefficient, relative likewise", [0.0, 8.0]);

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "complex_f0",
    summary: "Reflectance at normal incidence from n and k",
    formula: &["F0 = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2)"],
    source: Citation {
        authors: "Born, Wolf",
        title: "Principles of Optics",
        place: "7th edition, Cambridge University Press, section 14.2",
        year: 1999,
        link: "https://doi.org/10.1017/CBO9781139644181",
    },
    conventions: &[
        "The sign of k does not matter. Give F0 to a method that takes it, or n and k to interface_reflectance by conductor_exact.",
    ],
    fails: &[
        "Three channels of n and k stand for a spectrum: gold's own colour needs indices that were made for that.",
    ],
    functions: &[EffectFunction {
        name: "complex_f0",
        gives: "F0 of each channel, 0 to 1",
        arguments: &[N, K],
        build: complex_f0,
        ..EffectFunction::BASE
    }],
};

fn complex_f0<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (n, k) = (with.get(N), with.get(K));
    let below = (n - 1.0).named("below", "");
    let above = (n + 1.0).named("above", "");
    let k2 = (k * k).named("k2", "");
    (below * below + k2) / (above * above + k2)
}
