//! `t = r (i + c n) - n sqrt(1 - r^2 (1 - c^2))`: reflection and refraction at one surface, and the share of light in each.
//!
//! Source: Born, Wolf, *Principles of Optics*, 1999, sections 1.5.1 and 3.2.2, <https://doi.org/10.1017/CBO9781139644181>.
//! `eta` is the ratio of two arbitrary indices: below 1, light leaves the denser medium. The direction keeps unit length to rounding.
//! Close to the critical angle, a rounding error of `incident` turns it by the square root of that error.

use super::*;

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "interface",
    summary: "One surface: the reflected ray, the refracted ray, and how much is reflected",
    formula: &[
        "reflected = i - 2 (i . n) n",
        "refracted = r (i + c n) - n sqrt(1 - r^2 (1 - c^2)),  r = n_i / n_t,  c = -i . n",
        "R = the chosen method at cos_theta = c",
    ],
    source: Citation {
        authors: "Born, Wolf",
        title: "Principles of Optics",
        place: "7th edition, Cambridge University Press, sections 1.5.1 and 3.2.2",
        year: 1999,
        link: "https://doi.org/10.1017/CBO9781139644181",
    },
    conventions: &[
        "A transparent surface shows R environment(reflected) + (1 - R) environment(refracted).",
        "Radiance in a medium is n^2 times as large; across both surfaces of a body that cancels, so nothing is scaled here. \
         A camera inside the medium must scale it.",
    ],
    fails: &["A normal that is not of unit length bends the ray too much or too little."],
    functions: &[
        EffectFunction {
            name: "reflected",
            gives: "the direction of the reflected ray; zero where the incident ray or the normal is zero",
            arguments: &[INCIDENT, NORMAL],
            letters: Letters::Xyz,
            build: reflected,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "refracted",
            gives: "the direction of the refracted ray; zero past the critical angle, and where the incident ray or the normal is zero",
            arguments: &[INCIDENT, NORMAL, ETA],
            letters: Letters::Xyz,
            build: refracted,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "interface_reflectance",
            gives: "the reflected share R; 1 where the incident ray or the normal is zero",
            arguments: &[INCIDENT, NORMAL],
            reflectance: Reflectance::EachChannel,
            build: interface_reflectance,
            ..EffectFunction::BASE
        },
    ],
};

fn reflected<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (incident, normal) = (with.get(INCIDENT), with.get(NORMAL));
    let squared = normal.dot(normal);
    let present = with
        .number(0.5)
        .choose_below(squared, with.number(1.0), with.number(0.0))
        .named("present", "a zero normal gives zero");
    mirrored(incident, normal) * present
}

fn refracted<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let refraction = refraction(with, with.get(INCIDENT), with.get(NORMAL), with.get(ETA));
    refraction.direction * refraction.passes
}

fn interface_reflectance<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let cosine = -with.get(INCIDENT).dot(with.get(NORMAL));
    with.fresnel(cosine.named("cosine", USED_TWICE))
}
