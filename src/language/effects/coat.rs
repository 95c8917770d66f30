//! `R = R1 + (1 - R1)^2 R2 / (1 - R1 R2)`: a clear coat over a surface, a thin slab, and the F0 of a metal under a coat.
//!
//! Source: both interfaces with all reflections between them summed are G. G. Stokes, *On the intensity of the light reflected from or
//! transmitted through a pile of plates*, Proceedings of the Royal Society of London 11, 1862,
//! <https://doi.org/10.1098/rspl.1860.0119>. The refracted cosine is Snell's law in R. L. Cook, K. E. Torrance, 1982,
//! <https://doi.org/10.1145/357290.357293>. The F0 of a metal under a coat is our own fit.
//! Under a coat of index 1.5 only cosines of .745 and more occur at the base: sqrt(1 - 1/1.5^2).
//! One R stands for both polarisations. Composed from the mean of both, a coated metal of the catalogue is off by .014 at most,
//! and thin glass of index 1.5 by .022.

use super::*;

const F0: Argument = Argument::vector(
    "f0",
    "the metal's reflectance in air at normal incidence",
    [0.0, 1.0],
);
const F82: Argument = Argument::vector(
    "f82",
    "the metal's reflectance in air at 81.79 degrees",
    [0.0, 1.0],
);
const COS_I: Argument = Argument::scalar(
    "cos_i",
    "cosine of the angle of incidence, on the side that the light comes from",
    [0.0, 1.0],
);
const ETA: Argument = Argument::scalar(
    "eta",
    "n_t / n_i, the index behind the interface by that before it, above 0",
    [0.4, 2.5],
);
const COAT_R: Argument = Argument::scalar(
    "coat_r",
    "R of the coat's interface, at the cosine outside",
    [0.0, 1.0],
);
const BASE_R: Argument = Argument::vector(
    "base_r",
    "R of the base under the coat, at the refracted cosine",
    [0.0, 1.0],
);
const SLAB_R: Argument = Argument::vector("r", "R of one interface of the slab", [0.0, 1.0]);

/// The fit of F0 under a coat of index 1.5: least squares over the three channels of 75 measurements of metals and semiconductors.
/// The reference is each measurement's F0 from its spectrum, in a medium of index 1.5.
/// F0 + (1 - F0)(a + b F0) + (1 - F82)(c + d F0 + e F82) keeps F0 = F82 = 1, a mirror.
const OVER_F0: [f64; 2] = [0.3513, -0.5128];
const OVER_F82: [f64; 3] = [-0.5512, 0.8608, -0.5326];

/// Divisors are clamped to this, so that 0 / 0 is 0. It is far below what single precision resolves here.
const LEAST_DIVISOR: f64 = 1e-12;

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "coat",
    summary: "Clear coats and slabs: both interfaces with all reflections between them, and F0 of a metal under a coat",
    formula: &[
        "R = R1 + (1 - R1)^2 R2 / (1 - R1 R2),  of a slab with both interfaces alike 2 R / (1 + R)",
        "F0 under 1.5 = F0 + (1 - F0)(.3513 - .5128 F0) + (1 - F82)(-.5512 + .8608 F0 - .5326 F82)",
        "cos_t = sqrt(1 - (1 - cos_i^2) / eta^2)",
    ],
    source: Citation {
        authors: "Stokes",
        title: "On the intensity of the light reflected from or transmitted through a pile of plates",
        place: "Proceedings of the Royal Society of London 11, 545-556",
        year: 1862,
        link: "https://doi.org/10.1098/rspl.1860.0119",
    },
    conventions: &[
        "A coated metal: interface_and_cosine(cos_i, 1.5), then R of the base with coated_metal_f0 at the refracted cosine, then coated_reflectance.",
        "Under a coat of index 1.5 only cosines of .745 and more occur at the base, so that there R differs little from F0.",
        "Coat and slab absorb nothing: what is not reflected reaches the base, or passes the slab. They are thick beside a wavelength.",
        "Where coat_r and base_r are both 1, nothing enters the coat: R is 1.",
        "`fresnel-gen materials coat` computes F0 exactly for a coat of any index.",
    ],
    fails: &[
        "coated_metal_f0 is for metals and semiconductors, and for a coat of index 1.5. Over 75 measurements it is off by .0016 in the median, .0064 at \
         the 90th percentile and .0137 at most; of 20 further ones potassium is off by .0194.",
        "One R stands for both polarisations: a coated metal is off by .014 at most, a thin glass of index 1.5 by .022, of 1.8 by .043.",
        "A film as thin as a wavelength interferes, and shows colours.",
    ],
    functions: &[
        EffectFunction {
            name: "coated_metal_f0",
            gives: "F0 of a metal under a coat of index 1.5, 0 to 1",
            arguments: &[F0, F82],
            build: coated_metal_f0,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "interface_and_cosine",
            gives: "R of a dielectric interface, 1 - R, and the refracted cosine, in this order; 1, 0 and 0 past the critical angle",
            arguments: &[COS_I, ETA],
            letters: Letters::Xyz,
            build: interface_and_cosine,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "coated_reflectance",
            gives: "R of coat and base together, all reflections between them summed",
            arguments: &[COAT_R, BASE_R],
            build: coated_reflectance,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "slab_reflectance",
            gives: "R of both interfaces of a slab, a window pane for example",
            arguments: &[SLAB_R],
            build: slab_reflectance,
            ..EffectFunction::BASE
        },
    ],
};

fn coated_metal_f0<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (f0, f82) = (with.get(F0), with.get(F82));
    let [flat, by_f0] = OVER_F0;
    let [flat_82, by_f0_82, by_f82] = OVER_F82;
    let below_one = (1.0 - f0) * (f0 * by_f0 + flat);
    let below_one_82 = (1.0 - f82) * (f0 * by_f0_82 + f82 * by_f82 + flat_82);
    (f0 + below_one + below_one_82).saturate()
}

fn interface_and_cosine<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (c, eta) = (with.get(COS_I).saturate(), with.get(ETA));
    let c = c.named("c", "clamp: a rounded dot product may exceed 1");
    let c2 = (c * c).named("c2", "");
    let s2 = (1.0 - c2).named("s2", "sin^2 theta");
    let apart = (eta - 1.0).named("apart", "");
    let tau = (apart * eta + apart).named("tau", "eta^2 - 1 without its cancellation near 1");
    let g2 = (tau + c2).at_least(0.0);
    let g2 = g2.named("g2", "square of eta cos_t; 0 past the critical angle");
    let g = g2.sqrt().named("g", "");
    let divisor = c * ((tau + 1.0) * (g + c) + g) + g2;
    let q = (tau / divisor.at_least(LEAST_DIVISOR)).named("q", "");
    let r = ((c2 * g2 + s2 * s2) * (q * q)).at_most(1.0);
    let r = r.named("reflected", "as dielectric_exact has it");
    with.vector(r, 1.0 - r, g / eta)
}

fn coated_reflectance<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (coat, base) = (with.get(COAT_R), with.get(BASE_R));
    let enters = (1.0 - coat).named("enters", "1 - R1");
    let between = (1.0 - base * coat).at_least(LEAST_DIVISOR);
    base * (enters * enters) / between + coat
}

fn slab_reflectance<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let r = with.get(SLAB_R);
    r * 2.0 / (r + 1.0)
}
