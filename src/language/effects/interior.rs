//! `d' = |P(p + d v) - p|`: a step of the search, in an image of a body's back faces, for the point where a ray inside it leaves.
//!
//! Source: the iteration is that of Shah, Konttinen, Pattanaik, *Caustics Mapping*, IEEE Transactions on Visualization and Computer Graphics
//! 13(2), 2007, <https://doi.org/10.1109/TVCG.2007.32>. A tutorial calls it Newton-Raphson, but it is a fixed-point iteration.
//! Image-space refraction at two surfaces is Wyman's (2005, <https://doi.org/10.1145/1073204.1073310>).
//! It converges fast on convex bodies. It also finds total reflection where there is none.

use super::*;

const ENTRY: Argument = Argument::vector(
    "entry",
    "where the ray enters, or starts, in the world",
    [-1.0, 1.0],
);
const DIRECTION: Argument = Argument::direction("direction", "of the ray, of unit length");
const DISTANCE: Argument = Argument::scalar(
    "distance",
    "the estimate so far, in units of the world: begin with the body's size; the sign is not read",
    [-4.0, 4.0],
);
const POSITIONS: Argument = Argument::whole(
    "positions",
    "places of the back as that camera sees them, in the world, with 1 in alpha; all 0 where it sees nothing",
    Ty::Texture,
);
const NORMAL_OUT: Argument = Argument::direction("normal_out", "of unit length, out of the body");

/// After a miss the next estimate is this share of the last. The point lay outside the silhouette, so the ray was too long.
const AFTER_A_MISS: f64 = 0.7;

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "interior",
    summary: "Two surfaces: where a ray leaves a body, in which direction, and how much of it",
    formula: &[
        "p1 = positions at the texture coordinates of entry + |distance| direction",
        "distance' = |p1 - entry|, or -.7 |distance| where that camera sees nothing there",
        "exit direction: direction refracted at -normal_out, or reflected past the critical angle;  T = 1 - R",
    ],
    source: Citation {
        authors: "Shah, Konttinen, Pattanaik",
        title: "Caustics Mapping: An Image-Space Technique for Real-Time Caustics",
        place: "IEEE Transactions on Visualization and Computer Graphics 13(2), 272-280",
        year: 2007,
        link: "https://doi.org/10.1109/TVCG.2007.32",
    },
    conventions: &[
        "Draw the back of the body into `positions` (and its normals beside) with the camera of `view_projection`. Call the step \
         three or four times, each with the distance that the last one gave. A negative last distance is a miss.",
        "The ray leaves at entry + |distance| direction; look up the normal there, at planar_uv of the effect water, and make it of unit \
         length.",
        "eta at the exit is n_outside / n_inside: the inverse of that at the entry.",
        "The same step finds other objects in a picture of theirs, for rays that left and for photons.",
        "What is seen is T_entry T_exit environment(exit_direction): radiance is not scaled by n^2 across both surfaces.",
        "Past the critical angle T is 0, since all light stays inside: search once more, from there along exit_direction. A common \
         shortcut takes that ray as outside with T = 1.",
    ],
    fails: &[
        "A ray past the critical angle is reflected once and then taken as outside.",
        "Concave bodies have more than one back, and the picture holds one.",
        "At silhouettes the normal of the picture is that of the other side.",
    ],
    functions: &[
        EffectFunction {
            name: "interior_search_step",
            gives: "a better distance from entry, or -.7 of the last where the look-up missed",
            arguments: &[
                ENTRY,
                DIRECTION,
                DISTANCE,
                VIEW_PROJECTION,
                UV_SCALE_BIAS,
                POSITIONS,
            ],
            letters: Letters::Xyz,
            build: interior_search_step,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "exit_direction",
            gives: "the direction outside, or inside after total reflection, where exit_transmittance is 0; zero for a zero direction, unchanged for \
                    a zero normal",
            arguments: &[DIRECTION, NORMAL_OUT, ETA],
            letters: Letters::Xyz,
            build: exit_direction,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "exit_transmittance",
            gives: "the transmitted share T = 1 - R, 0 past the critical angle",
            arguments: &[DIRECTION, NORMAL_OUT],
            reflectance: Reflectance::FromWithin,
            build: exit_transmittance,
            ..EffectFunction::BASE
        },
    ],
};

fn interior_search_step<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let entry = with.get(ENTRY);
    let distance = with
        .get(DISTANCE)
        .abs()
        .named("d", "the sign says only whether the last step missed");
    let reached =
        (entry + with.get(DIRECTION) * distance).named("reached", "as far as the estimate goes");
    let matrix = with.get(VIEW_PROJECTION);
    let w = matrix
        .transform(3, reached)
        .named("w", "0 or less is behind the camera");
    let scale_bias = with.get(UV_SCALE_BIAS);
    let texture_coordinate = |i: usize| {
        matrix.transform(i, reached) / w * scale_bias.channel(i) + scale_bias.channel(i + 2)
    };
    let u = texture_coordinate(0).named("u", "");
    let v = texture_coordinate(1).named("v", "");
    let positions = with.get(POSITIONS);
    let share = positions
        .sample_alpha(u, v)
        .named("share", "of the texels that show the body");
    let texel = positions.sample(u, v).named("texel", "");
    let seen = texel / share.at_least(0.5);
    let found = length((seen - entry).named("to_seen", "by the texels that show the body alone"));
    let missed =
        (distance * -AFTER_A_MISS).named("missed", "shorter, for the ray left the silhouette");
    let on_body = share.choose_below(with.number(0.5), missed, found);
    with.number(0.0).choose_below(w, on_body, missed)
}

fn exit_direction<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (direction, normal) = (with.get(DIRECTION), -with.get(NORMAL_OUT));
    let normal = normal.named("normal", "on the side that the light comes from");
    direction.dot(normal).named("facing", "minus the cosine");
    let refraction = refraction(with, direction, normal, with.get(ETA));
    let mirrored = mirrored(direction, normal);
    refraction.direction * refraction.passes + mirrored * (1.0 - refraction.passes)
}

fn exit_transmittance<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let cosine = with.get(DIRECTION).dot(with.get(NORMAL_OUT));
    1.0 - with.fresnel(cosine.named("cosine", USED_TWICE))
}
