//! `E = flux / area`: photons that a body refracts or reflects, and the irradiance where they land.
//!
//! Source: Wyman and Davis, *Interactive Image-Space Techniques for Approximating Caustics*, I3D, 2006,
//! <https://doi.org/10.1145/1111411.1111439>; triangles after Watt, *Light-Water Interaction Using Backward Beam Tracing*, SIGGRAPH, 1990,
//! <https://doi.org/10.1145/97879.97902>. The splat is Epanechnikov's kernel.

use super::*;

const T_ENTRY: Argument = Argument::vector(
    "t_entry",
    "the transmitted share 1 - R at the first surface",
    [0.0, 1.0],
);
const T_EXIT: Argument = Argument::vector(
    "t_exit",
    "the same at the second; for a caustic by reflection 1, with R in the place of t_entry",
    [0.0, 1.0],
);
const AREA: Argument = Argument::scalar(
    "area",
    "of the photon's share of the light's cross-section, in square units of the world",
    [0.0, 1.0],
);
const FLUX: Argument = Argument::vector(
    "flux",
    "of the triangle: the mean of t_entry t_exit at its corners, times its area before the body",
    [0.0, 1.0],
);
const A: Argument = Argument::vector(
    "a",
    "where the first photon lands, in the world",
    [-1.0, 1.0],
);
const B: Argument = Argument::vector("b", "where the second lands", [-1.0, 1.0]);
const C: Argument = Argument::vector("c", "where the third lands", [-1.0, 1.0]);
const OFFSET: Argument = Argument::pair(
    "offset",
    "from the splat's centre, in units of the world",
    [-1.0, 1.0],
);
const RADIUS: Argument = Argument::scalar("radius", "of the splat, above 0", [0.5, 2.0]);

/// A triangle with less area than this, in square world units, counts as degenerate.
const SMALLEST: f64 = 1e-20;

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "caustics",
    summary: "Light that a body gathers: the energy of a photon, and what triangles or splats of photons make of it",
    formula: &[
        "photon_energy = t_entry t_exit area",
        "triangle_irradiance = flux / (|cross(b - a, c - a)| / 2)",
        "splat_weight = 2 / (pi radius^2) (1 - |offset|^2 / radius^2), 0 beyond radius: its integral is 1",
    ],
    source: Citation {
        authors: "Wyman, Davis",
        title: "Interactive Image-Space Techniques for Approximating Caustics",
        place: "Symposium on Interactive 3D Graphics",
        year: 2006,
        link: "https://doi.org/10.1145/1111411.1111439",
    },
    conventions: &[
        "Send photons along the light through a grid. Follow each through the body by the functions of interior. Draw the grid's \
         triangles where they land, and add triangle_irradiance; leave out a triangle with a photon that missed.",
        "Flux is never scaled by n^2.",
    ],
    fails: &[
        "Light that enters by more ways than the grid follows, after a second total reflection, is missing.",
    ],
    functions: &[
        EffectFunction {
            name: "photon_energy",
            gives: "the flux (power) of a photon, for light of irradiance 1; area is in it",
            arguments: &[T_ENTRY, T_EXIT, AREA],
            build: |with| with.get(T_ENTRY) * with.get(T_EXIT) * with.get(AREA),
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "triangle_irradiance",
            gives: "the irradiance inside the triangle; 0 where it has no area",
            arguments: &[FLUX, A, B, C],
            letters: Letters::Xyz,
            build: triangle_irradiance,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "splat_weight",
            gives: "the share of a photon's flux per square unit at an offset from where it lands",
            arguments: &[OFFSET, RADIUS],
            letters: Letters::Xyz,
            build: splat_weight,
            ..EffectFunction::BASE
        },
    ],
};

fn triangle_irradiance<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let [a, b, c] = [A, B, C].map(|corner| with.get(corner));
    let along_b = (b - a).named("along_b", "");
    let along_c = (c - a).named("along_c", "");
    let normal = cross(with, along_b, along_c).named("normal", "as long as twice the area");
    let area = (0.5 * length(normal)).named("area", "");
    let smallest = with.number(SMALLEST);
    let share = area.choose_below(smallest, with.number(0.0), 1.0 / area.max(smallest));
    with.get(FLUX) * share
}

fn splat_weight<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (offset, radius) = (with.get(OFFSET), with.get(RADIUS));
    let [x, y] = [0, 1].map(|i| offset.channel(i));
    let squared = (radius * radius).named("squared", "");
    let inside = (1.0 - (x * x + y * y) / squared).at_least(0.0);
    std::f64::consts::FRAC_2_PI / squared * inside
}
