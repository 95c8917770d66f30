//! `f = D V F`: the specular reflection of a rough surface, GGX with height-correlated masking.
//!
//! Source: Walter, Marschner, Li, Torrance, *Microfacet Models for Refraction through Rough Surfaces*, EGSR, 2007,
//! <https://www.graphics.cornell.edu/~bjw/microfacetbsdf.pdf>; Heitz, *Understanding the Masking-Shadowing Function in
//! Microfacet-Based BRDFs*, JCGT 3, 2014, <https://jcgt.org/published/0003/02/03/>.
//! It is single scattering: light that bounces twice is lost, up to two thirds of it at alpha 1.

use super::*;

const N_DOT_V: Argument =
    Argument::scalar("n_dot_v", "cosine between normal and view", [-1.0, 1.0]);
const N_DOT_L: Argument =
    Argument::scalar("n_dot_l", "cosine between normal and light", [-1.0, 1.0]);
const N_DOT_H: Argument = Argument::scalar(
    "n_dot_h",
    "cosine between normal and half vector",
    [0.0, 1.0],
);
const V_DOT_H: Argument = Argument::scalar(
    "v_dot_h",
    "cosine between view and half vector: the angle that F is taken at",
    [0.0, 1.0],
);
const ALPHA: Argument = Argument::scalar(
    "alpha",
    "roughness squared; below .001 it counts as .001",
    [0.0, 1.0],
);

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "ggx_specular",
    summary: "A rough surface: GGX with height-correlated masking, times the Fresnel method",
    formula: &[
        "D = alpha^2 / (pi ((n.h)^2 (alpha^2 - 1) + 1)^2)",
        "V = 1 / (2 (n.l sqrt((n.v)^2 (1 - alpha^2) + alpha^2) + n.v sqrt((n.l)^2 (1 - alpha^2) + alpha^2)))",
        "f = D V F(v.h)",
    ],
    source: Citation {
        authors: "Heitz",
        title: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs",
        place: "Journal of Computer Graphics Techniques 3",
        year: 2014,
        link: "https://jcgt.org/published/0003/02/03/",
    },
    conventions: &[
        "The result is the BRDF, per steradian: multiply by n_dot_l and by the light's irradiance on a plane that faces it.",
    ],
    fails: &["Light that bounces twice is missing: with F = 1 and alpha 1 up to two thirds of it."],
    functions: &[EffectFunction {
        name: "ggx_specular",
        gives: "the BRDF, per steradian; 0 where light or view is below the surface",
        arguments: &[N_DOT_V, N_DOT_L, N_DOT_H, V_DOT_H, ALPHA],
        reflectance: Reflectance::EachChannel,
        build: ggx_specular,
        ..EffectFunction::BASE
    }],
};

fn ggx_specular<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let [n_dot_v, n_dot_l, n_dot_h] = [N_DOT_V, N_DOT_L, N_DOT_H].map(|cosine| with.get(cosine));
    let view = n_dot_v.saturate().named("nv", "");
    let light = n_dot_l.saturate().named("nl", "");
    let half = n_dot_h.saturate().named("nh", "");
    let alpha = with.get(ALPHA).saturate().at_least(1e-3);
    let alpha = alpha.named("rough", "a smaller one is no surface: D would overflow");
    let squared = (alpha * alpha).named("rough2", "");
    // (1 - nh)(1 + nh) + nh^2 a2, which does not cancel near the peak.
    let spread = (1.0 - half) * (1.0 + half) + half * half * squared;
    let spread = spread.named(
        "spread",
        "(n.h)^2 (alpha^2 - 1) + 1, without cancellation at the peak",
    );
    let lobe = (squared * std::f64::consts::FRAC_1_PI / (spread * spread)).named("lobe", "GGX's D");
    let rest = (1.0 - squared).named("rest", "");
    let masked = |one: Expr<'b>, other: Expr<'b>| other * (one * one * rest + squared).sqrt();
    let masking = masked(view, light) + masked(light, view);
    let visible = (0.5 / masking.at_least(1e-20))
        .named("masking", "Smith's masking, correlated, over 4 (n.l)(n.v)");
    let zero = with.number(0.0);
    let lit = zero.choose_below(view * light, lobe * visible, zero);
    with.fresnel(with.get(V_DOT_H)) * lit.named("lit", "0 below the surface")
}
