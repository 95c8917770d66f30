//! `n = unit(x t + y b + z n)`: a normal map's normal in world space. The normal is transformed, never the ray.
//!
//! Source: Mikkelsen, *Simulation of Wrinkled Surfaces Revisited*, University of Copenhagen, 2008,
//! <http://image.diku.dk/projects/media/morten.mikkelsen.08.pdf>.
//! Reflection, refraction and look-ups then happen in one space, and no ray is transformed twice.

use super::*;

const TANGENT_NORMAL: Argument = Argument::direction(
    "tangent_normal",
    "the map's normal, 2 texel - 1: x along the tangent, y along the bitangent, z along the normal",
);
const TANGENT: Argument = Argument::direction("tangent", "of unit length, along growing u");
const BITANGENT_SIGN: Argument = Argument::scalar(
    "bitangent_sign",
    "1, or -1 where the texture is mirrored: bitangent = sign cross(normal, tangent)",
    [-1.0, 1.0],
);

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "normal_mapping",
    summary: "A normal map's normal in the world",
    formula: &["n = unit(x t + y sign cross(n0, t) + z n0)"],
    source: Citation {
        authors: "Mikkelsen",
        title: "Simulation of Wrinkled Surfaces Revisited",
        place: "University of Copenhagen",
        year: 2008,
        link: "http://image.diku.dk/projects/media/morten.mikkelsen.08.pdf",
    },
    conventions: &[
        "Transform the normal and leave the ray in the world: a cube map is looked up in the world.",
    ],
    fails: &[
        "A normal that points away from the eye after mapping has a negative cosine: R is then that of grazing incidence.",
    ],
    functions: &[EffectFunction {
        name: "normal_to_world",
        gives: "the mapped normal, of unit length, in the space of tangent and normal; zero where these are zero",
        arguments: &[TANGENT_NORMAL, TANGENT, BITANGENT_SIGN, NORMAL],
        letters: Letters::Xyz,
        build: normal_to_world,
        ..EffectFunction::BASE
    }],
};

fn normal_to_world<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (mapped, tangent, normal) = (
        with.get(TANGENT_NORMAL),
        with.get(TANGENT),
        with.get(NORMAL),
    );
    let square = cross(with, normal, tangent);
    let [x, y, z] = ["square_x", "square_y", "square_z"];
    let [x, y, z] = [(0, x), (1, y), (2, z)].map(|(i, name)| square.channel(i).named(name, ""));
    let bitangent = with.vector(x, y, z) * with.get(BITANGENT_SIGN);
    let bitangent = bitangent.named("bitangent", "along growing v");
    let sum =
        tangent * mapped.channel(0) + bitangent * mapped.channel(1) + normal * mapped.channel(2);
    unit_or_zero(sum.named(
        "sum",
        "of unit length only where all three are square to each other",
    ))
}
