//! Babylon.js: a module with a plugin for PBR materials.

use super::flavour::{Flavour, FlavourPage, MATERIALS_MODULE, MATERIALS_TYPES};
use crate::generator::exchange::Model;
use crate::generator::lut::SplitSumAxis;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "babylon",
    summary: "a module with a plugin for PBR materials",
    host: "Babylon.js 9.0.0 to 9.35.0",
    source: "https://doc.babylonjs.com/features/featuresDeepDive/materials/using/materialPlugins",
    proof: "run in Babylon.js 9.35.0 by WebGL 2 and by WebGPU, in 9.0.0 by WebGL 2",
    stock: Some(|material| match material.film {
        Some(film) if film.thickness_nm > 0.0 => Model::iridescence(&film, film.f0),
        _ => Model::schlick(material.f0_in_engines()),
    }),
    coated_f0: Some(|f0: f64| {
        // `getR0RemappedForClearCoat` of its shaders.
        (f0 * (f0 * (0.941_892 - 0.263_008 * f0) + 0.346_479) - 0.028_599_8).clamp(0.0, 1.0)
    }),
    languages: &["gles", "wgsl"],
    table: Some((80, [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt])),
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/babylon/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.js",
            template: include_str!("../../../templates/flavours/babylon/fresnel.js.tera"),
        },
        FlavourPage {
            name: "fresnel.d.ts",
            template: include_str!("../../../templates/flavours/babylon/fresnel.d.ts.tera"),
        },
        MATERIALS_MODULE,
        MATERIALS_TYPES,
    ],
};
