//! `uv = ndc scale + bias`: the scene behind water, looked up in an image of it where the waves refract the ray to.
//!
//! Source: Sousa, *Generic Refraction Simulation*, GPU Gems 2, chapter 19, Addison-Wesley, 2005,
//! <https://developer.nvidia.com/gpugems/gpugems2/part-ii-shading-lighting-and-shadows/chapter-19-generic-refraction-simulation>.
//! The refracted look-up is used only where it shows something below the water, so nothing in front of the water leaks into it.

use super::*;

const POSITION: Argument = Argument::vector("position", "in the world", [-1.0, 1.0]);
const UV: Argument = Argument::pair("uv", "of the pixel in the picture", [0.0, 1.0]);
const DISTORTION: Argument = Argument::pair(
    "distortion",
    "by how much the waves bend it, in texture coordinates",
    [-0.1, 0.1],
);
const MAP: Argument = Argument::whole(
    "map",
    "the picture of what lies below the water, with 1 in alpha; what stands before the water has 0 there",
    Ty::Texture,
);

/// A filtered alpha below this includes a texel in front of the water. An 8-bit filter weight has steps of .004.
const ALL_BELOW: f64 = 0.998;

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "water",
    summary: "Texture coordinates of a place in a picture, and what lies below water, bent by its waves",
    formula: &[
        "planar_uv = (view_projection (p, 1)).xy / w * scale + bias",
        "water_refraction = map at uv + distortion where its alpha there is 1, else map at uv",
    ],
    source: Citation {
        authors: "Sousa",
        title: "Generic Refraction Simulation",
        place: "GPU Gems 2, chapter 19, Addison-Wesley",
        year: 2005,
        link: "https://developer.nvidia.com/gpugems/gpugems2/part-ii-shading-lighting-and-shadows/chapter-19-generic-refraction-simulation",
    },
    conventions: &[
        "Draw the mirrored scene with a camera mirrored in the water's plane and an oblique near plane in it; read it with planar_uv \
         of that camera.",
        "R times the planar reflection, plus (1 - R) water_refraction, with R of interface at eta = 1.333.",
    ],
    fails: &[
        "What the picture does not show, beyond its edge or behind what stands before the water, cannot be refracted.",
    ],
    functions: &[
        EffectFunction {
            name: "planar_uv",
            gives: "texture coordinates in x and y, and w in z: 0 or less is behind the camera",
            arguments: &[POSITION, VIEW_PROJECTION, UV_SCALE_BIAS],
            letters: Letters::Xyz,
            build: planar_uv,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "water_refraction",
            gives: "the colour below the water, never one from before it",
            arguments: &[UV, DISTORTION, MAP],
            build: water_refraction,
            ..EffectFunction::BASE
        },
    ],
};

fn planar_uv<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (matrix, position) = (with.get(VIEW_PROJECTION), with.get(POSITION));
    let scale_bias = with.get(UV_SCALE_BIAS);
    let w = matrix
        .transform(3, position)
        .named("w", "0 or less is behind the camera");
    let size = w.abs().at_least(1e-20);
    let size = size.named("size", "never 0, so that nothing is NaN");
    let texture_coordinate = |i: usize| {
        matrix.transform(i, position) / size * scale_bias.channel(i) + scale_bias.channel(i + 2)
    };
    with.vector(texture_coordinate(0), texture_coordinate(1), w)
}

fn water_refraction<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (uv, distortion, map) = (with.get(UV), with.get(DISTORTION), with.get(MAP));
    let [u, v] = [0, 1].map(|i| uv.channel(i) + distortion.channel(i));
    let (u, v) = (u.named("u", "where the waves bend it to"), v.named("v", ""));
    let below = map
        .sample_alpha(u, v)
        .choose_below(with.number(ALL_BELOW), with.number(0.0), with.number(1.0))
        .named(
            "below",
            "the bent sample is the mask: what it shows must be below the water",
        );
    let [u, v] = [0, 1].map(|i| uv.channel(i) + distortion.channel(i) * below);
    map.sample(u.named("read_u", "bent or not"), v.named("read_v", ""))
}
