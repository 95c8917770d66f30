//! `M = [[m, d, 0, 0], [d, m, 0, 0], [0, 0, C, S], [0, 0, -S, C]]`: what a smooth surface does to polarised light, for dielectrics and metals.
//!
//! Source: Born, Wolf, *Principles of Optics*, 1999, sections 1.5.2, 14.2 and 10.9, <https://doi.org/10.1017/CBO9781139644181>; the amplitudes are those
//! of `conductor_exact`, which is stable near n = 1, at small k and at grazing. With q the root of (n + i k)² - s², r_s = (c - q) / (c + q) and
//! r_p / r_s = (c q - s²) / (c q + s²). A phase is an angle of a quotient; these four numbers need no inverse tangent.
//! Where k is 0 and n below 1, past the critical angle, C and S are the phases of total reflection.

use super::*;
use crate::language::methods::{Polarised, polarised};
use crate::physics::num::Precision;

const COS_THETA: Argument = Argument::scalar(
    "cos_theta",
    "of the angle of incidence, clamped to [0, 1]",
    [0.0, 1.0],
);
const N: Argument = Argument::vector(
    "n",
    "refractive index, relative to the medium before the surface",
    [0.05, 5.0],
);
const K: Argument = Argument::vector("k", "extinction coefficient, relative likewise", [0.0, 8.0]);

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "polarisation",
    summary: "Mueller's matrix of a smooth surface, for polarised light on dielectrics and metals",
    formula: &[
        "m = (R_s + R_p) / 2,  d = (R_s - R_p) / 2,  C + i S = r_p r_s*",
        "r_s = (c - q) / (c + q),  r_p = r_s (c q - s^2) / (c q + s^2),  q^2 = (n + i k)^2 - s^2,  s^2 = 1 - c^2",
    ],
    source: Citation {
        authors: "Born, Wolf",
        title: "Principles of Optics",
        place: "7th edition, Cambridge University Press, sections 1.5.2, 10.9 and 14.2",
        year: 1999,
        link: "https://doi.org/10.1017/CBO9781139644181",
    },
    conventions: &[
        "Stokes vectors (I, Q, U, V) with Q > 0 for light across the plane of incidence: M = [[m, d, 0, 0], [d, m, 0, 0], [0, 0, C, S], [0, 0, -S, C]].",
        "U + i V = 2 E_s E_p*, and waves are exp(-i w t), so that n + i k absorbs. Where waves are exp(+i w t), or V has the other sign, negate S.",
        "At normal incidence r_p = r_s, so C is F0. Where p is drawn so that r_p = -r_s there, negate C and S.",
        "The phase of p behind s is atan2(S, C).",
    ],
    fails: &["A rough surface depolarises light; this is the matrix of one facet."],
    functions: &[
        EffectFunction {
            name: "mueller_m",
            gives: "m, the reflectance of unpolarised light, 0 to 1",
            arguments: &[COS_THETA, N, K],
            code_abs: 2.6e-6,
            build: |with| of(with).mean(),
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "mueller_d",
            gives: "d, half of what s-polarised light is reflected more than p-polarised light",
            arguments: &[COS_THETA, N, K],
            build: |with| of(with).half_difference(),
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "mueller_c",
            gives: "C, sqrt(R_s R_p) times the cosine of the phase between p and s",
            arguments: &[COS_THETA, N, K],
            code_abs: 2.6e-6,
            build: |with| of(with).phases()[0],
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "mueller_s",
            gives: "S, sqrt(R_s R_p) times the sine of the phase between p and s",
            arguments: &[COS_THETA, N, K],
            build: |with| of(with).phases()[1],
            ..EffectFunction::BASE
        },
    ],
};

fn of<'b>(with: &Arguments<'b>) -> Polarised<'b> {
    let cosine = with.get(COS_THETA).saturate().named("c", "");
    polarised(Precision::F32, cosine, with.get(N), with.get(K))
}
