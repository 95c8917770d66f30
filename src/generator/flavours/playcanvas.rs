//! PlayCanvas: a module that patches the shader chunks of standard materials.

use super::flavour::{Flavour, FlavourPage, MATERIALS_MODULE, MATERIALS_TYPES};
use crate::generator::exchange::Model;
use crate::generator::lut::SplitSumAxis;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "playcanvas",
    summary: "a module that patches standard materials",
    host: "PlayCanvas 2.8.2 to 2.23.3",
    source: "https://developer.playcanvas.com/user-manual/graphics/shaders/",
    proof: "run in PlayCanvas 2.23.3 by WebGL 2 and by WebGPU, in 2.8.2 by WebGL 2",
    stock: Some(|material| match material.film {
        Some(film) if film.thickness_nm > 0.0 => Model::iridescence(&film, film.f0),
        _ => Model::schlick(material.f0_in_engines()),
    }),
    coated_f0: Some(|f0| f0),
    languages: &["gles", "wgsl"],
    table: Some((80, [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt])),
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/playcanvas/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.js",
            template: include_str!("../../../templates/flavours/playcanvas/fresnel.js.tera"),
        },
        FlavourPage {
            name: "fresnel.d.ts",
            template: include_str!("../../../templates/flavours/playcanvas/fresnel.d.ts.tera"),
        },
        MATERIALS_MODULE,
        MATERIALS_TYPES,
    ],
};
