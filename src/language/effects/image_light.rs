//! `E_F + (1 - E) F_ms`: the share of an image's light that a rough surface reflects, with all that is reflected more than once.
//!
//! Source: the split sum is B. Karis, *Real Shading in Unreal Engine 4*, SIGGRAPH course *Physically Based Shading in Theory and Practice*,
//! 2013, <https://blog.selfshadow.com/publications/s2013-shading-course/karis/s2013_pbs_epic_notes_v2.pdf>. That light which masking keeps is
//! reflected again: C. Kulla, A. Conty, *Revisiting Physically Based Shading at Imageworks*, SIGGRAPH course, 2017, with F̄ squared as S. Hill
//! has it, <https://blog.selfshadow.com/2018/06/04/multi-faceted-part-2/>.
//! The table is that of `fresnel-gen bake --dfg`: term i of F, times GGX with Smith's masking, integrated over all light. So E_F is exact for
//! F before its limit to [0, 1]. The fit of the mean over directions, lost, is ours, within .0007 of roughness 0 to 1.

use super::*;

const DFG: Argument = Argument::whole(
    "dfg",
    "the table of `bake --dfg`, four channels: cosine along x, roughness along y; the sampler filters linearly and clamps to the edge",
    Ty::Texture,
);
const TEXELS: Argument = Argument::scalar(
    "texels",
    "texels of a side of the table: 128 unless --size said another number",
    [2.0, 1024.0],
);
const COS_V: Argument = Argument::scalar("cos_v", "dot(normal, view)", [0.0, 1.0]);
const ROUGHNESS: Argument =
    Argument::scalar("roughness", "0 to 1; GGX's alpha is its square", [0.0, 1.0]);
const C0: Argument = Argument::vector(
    "c0",
    "what the table's red is multiplied by: c0 of the method, F0 of f82_tint",
    [0.02, 1.0],
);
const C1: Argument = Argument::vector(
    "c1",
    "what its green is multiplied by: c1, 1 - F0",
    [-0.5, 1.0],
);
const C2: Argument = Argument::vector(
    "c2",
    "what its blue is multiplied by; 0 if there is no third number",
    [-0.5, 1.0],
);
const C3: Argument = Argument::vector(
    "c3",
    "what its alpha is multiplied by; 0 if there is no fourth number",
    [-0.5, 1.0],
);
const AVERAGE: Argument = Argument::vector(
    "average",
    "the mean of F over the hemisphere, 2 int F c dc: fresnel_fitted_average(c0, c1, c2, c3), or `average` of catalogue.json",
    [0.0, 1.0],
);

/// A surface that reflects less than this share has its factor limited: its light is none that can be seen.
const LEAST_SHARE: f64 = 1e-3;
/// The coefficients a to d of 1 - Ē = r³ (a + r (b + r (c + r d))) over the roughness r, for GGX with height-correlated Smith masking and
/// α = r²: our fit, within .0007.
pub const WHITE_MEAN_LOST: [f64; 4] = [0.20275, 3.50269, -4.97845, 1.8645];

const ARGUMENTS: [Argument; 9] = [COS_V, ROUGHNESS, C0, C1, C2, C3, AVERAGE, TEXELS, DFG];

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "image_light",
    summary: "The share of an image's light that a rough surface reflects, and the factor for lamps that adds what is reflected twice and more",
    formula: &[
        "T = dfg at (sqrt(cos_v), sqrt(roughness)), each (x (texels - 1) + 1/2) / texels",
        "E = T.r,  E_F = clamp(c0 T.r + c1 T.g + c2 T.b + c3 T.a, 0, E)",
        "F_ms = average^2 (1 - lost) / (1 - average lost),  lost = r^3 (.20275 + r (3.50269 + r (-4.97845 + 1.8645 r)))",
        "image_reflectance = E_F + (1 - E) F_ms,  lamp_factor = 1 + (1 - E) F_ms / E_F",
    ],
    source: Citation {
        authors: "Kulla, Conty",
        title: "Revisiting Physically Based Shading at Imageworks",
        place: "SIGGRAPH course Physically Based Shading in Theory and Practice",
        year: 2017,
        link: "https://blog.selfshadow.com/publications/s2017-shading-course/imageworks/s2017_pbs_imageworks_slides_v2.pdf",
    },
    conventions: &[
        "The table is that of the method whose numbers c0 to c3 are: `fresnel-gen bake --dfg --method fitted`, its file .ktx2, along its usual axes. Each method has its own. Methods with fewer numbers leave the last ones 0.",
        "An image: its radiance, blurred for this roughness, times image_reflectance. A lamp: D G F / (4 n.l n.v) times lamp_factor.",
        "PNG and EXR have the fourth channel in a file of its own: its alpha is 1, and c3 would be counted whole.",
    ],
    fails: &[
        "Each reflection after the first is taken for one of F's mean in all directions. A test holds furnaces of metals within .0006 between lamps and image.",
        "Where less than .001 is reflected at once the factor for lamps ends.",
    ],
    functions: &[
        EffectFunction {
            name: "image_reflectance",
            gives: "the share of the image's light that is reflected, once and more often, 0 to 1",
            arguments: &ARGUMENTS,
            build: image_reflectance,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "lamp_factor",
            gives: "what the light of lamps is multiplied by, so that lamps and image agree: 1 or more",
            arguments: &ARGUMENTS,
            build: lamp_factor,
            ..EffectFunction::BASE
        },
    ],
};

/// E_F, and (1 - E) F_ms.
fn shares<'b>(with: &Arguments<'b>) -> [Expr<'b>; 2] {
    let (dfg, texels, roughness) = (with.get(DFG), with.get(TEXELS), with.get(ROUGHNESS));
    let place = |number: Expr<'b>| {
        let root = number.saturate().sqrt();
        (root * (texels - 1.0) + 0.5) / texels
    };
    let u = place(with.get(COS_V)).named("u", "from texel centre to texel centre");
    let v = place(roughness).named("v", "");
    let terms = dfg.sample(u, v).named("terms", "");
    let fourth = dfg.sample_alpha(u, v).named("fourth", "no opacity");
    let white = terms
        .channel(0)
        .named("white", "E: what a white surface reflects at once");
    let sum = with.get(C0) * white
        + with.get(C1) * terms.channel(1)
        + with.get(C2) * terms.channel(2)
        + with.get(C3) * fourth;
    let once = sum.named("sum", "").at_least(0.0).min(white);
    let once = once.named("once", "E_F, with the limit of F");
    let r = roughness.saturate().named("r", "");
    let [first, second, third, last] = WHITE_MEAN_LOST;
    let lost = r * r * r * (((r * last + third) * r + second) * r + first);
    let lost = lost.named("lost", "1 - the mean of E over directions");
    let average = with.get(AVERAGE).saturate().named("mean", "");
    let more = average * average * (1.0 - lost) / (1.0 - average * lost);
    [
        once,
        (more * (1.0 - white)).named("more", "reflected twice and more often"),
    ]
}

fn image_reflectance<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let [once, more] = shares(with);
    once + more
}

fn lamp_factor<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let [once, more] = shares(with);
    more / once.at_least(LEAST_SHARE) + 1.0
}
